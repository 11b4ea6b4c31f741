"""Choose a fair timetable of each group with the most value of laps per tick."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain, count, islice

import numpy as np

from rightofway.cyclic.closing import close_windows
from rightofway.cyclic.from_plan import repeat_plan, take_one_lap
from rightofway.cyclic.from_run import SimulatedRun, choose_runs, extract_cycle
from rightofway.cyclic.lns import fill, improve, insert_all
from rightofway.cyclic.problem import Candidate, CyclicProblem, RobotCycle
from rightofway.cyclic.result import BaselineComparison, BaselineEnds, CyclicResult, GroupResult
from rightofway.cyclic.route import (
    CyclicRoute,
    GroupContext,
    clear_and_direct,
    make_cyclic_routes,
    make_lap_rows,
    split_groups,
    take_out_closed_places,
)
from rightofway.cyclic.rules import TIMETABLE
from rightofway.cyclic.run import advance, make_simulation
from rightofway.cyclic.startup import start
from rightofway.deadline import limit_loop, limit_work
from rightofway.errors import GaveUp, InputError
from rightofway.facts import Fact
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import POSITIVE, SEED, SHARE, allow_none, list_of, make_whole
from rightofway.model import Scenario, Tick, require_time_limit
from rightofway.planners import Deadline
from rightofway.precedence import unroll_schedule
from rightofway.progress import log_progress
from rightofway.repair.routing import ROUTING
from rightofway.search import Distances, RoundTrip

CLOSING = Fact("closing a stretch")
"""A step that may take the time, for messages."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ChoiceParams:
    """Division of the time of a group; shares of the time left."""

    large: int = 100  # Larger groups have a stretch of a simulation closed.
    most_with_round_trips: int = 200  # Larger fleets search for no laps beyond the given ones.
    baseline_share: float = 0.2  # First come first served is simulated.
    other_rule_share: float = 0.05  # Each other rule is simulated.
    cutting_share: float = 0.25  # Timetables are cut out of the baseline.
    closing_share: float = 0.6  # In this part of that, windows are closed; then laps are added.
    cuts_kept: int = 2  # This many timetables cut out are kept besides the best.
    short: int = 4_000  # Timetables with more visits improve slowly: only the best is kept.
    building_share: float = 0.2  # First timetables are built.
    many: int = 300  # Larger groups are built once and filled.
    filling_share: float = 0.3  # The building share of these.
    placing_share: float = 0.7  # The first timetable may take this to place all robots.
    first_period: float = 1.2  # The first timetable has this period [longest laps].
    longest_period: float = 5  # The others have periods of at most this [longest laps].
    improved: int = 3  # This many first timetables are improved.
    trying_share: float = 0.5  # All of them are improved a little.
    continuing_share: float = 0.7  # The best of these is improved; in the rest, the best of all.
    most_visits: int = 20_000  # Up to this many visits, a fractional cycle time becomes whole.


@checks_arguments
def find_best_timetable(
    scenario: Scenario,
    *,
    weights: Sequence[Fraction] | None = None,
    least_fairness: Fraction = Fraction(0),
    time_limit: float | None = 10,
    rounds: int | None = None,
    seed: int = 0,
    report: Callable[[Fact], None] = log_progress,
) -> CyclicResult:
    """Choose laps, their numbers per period and rights of way for the most value of laps per tick.

    Parameters
    ----------
    scenario
        The problem; its number of laps is not used.
    weights
        The value of a lap of each robot, above 0; 1 each if None.
    least_fairness
        The least ratio of laps made to laps possible alone for each robot, 0 to 1.
    time_limit
        Time limit [s]; None for no limit. Groups get shares by their size.
    rounds
        Number of first timetables per group, and of improvement steps per kept timetable; None:
        until time is over.
    seed
        Seed of random choices.
    report
        Receives sentences on progress.

    Returns
    -------
    CyclicResult
        One result with a `BaselineComparison` for each independent group; or one for all robots if
        a group needs the vertices of other groups to avoid a deadlock.

    Raises
    ------
    InputError
        For invalid weights or limits, or a robot without a lap to repeat.
    NoPlanExists
        If a robot cannot reach a place, or a group is proven to have no plan for one lap each.
    GaveUp
        If no timetable with all robots and the least fairness was found.

    Notes
    -----
    Never below the pattern of first come first served, if this pattern is fair and found in its
    share of the time. Deterministic for a seed if the rounds end before the limit. Not optimal.
    """
    seed = SEED.read_at("seed", seed)
    weights = _check_weights(weights, len(scenario.robots))
    least_fairness = SHARE.read_at("least_fairness", least_fairness)
    rounds = allow_none(make_whole(0, 2**31 - 1)).read_at("rounds", rounds)
    time_limit = require_time_limit(time_limit)
    scenario = take_out_closed_places(scenario)
    if time_limit is None and rounds is None:
        raise InputError.at("rounds", "neither they nor the time are limited (limit one of them)")
    deadline = Deadline.after(time_limit)
    with limit_work(deadline):
        results = _choose_all(
            scenario, weights, least_fairness, deadline, rounds=rounds, seed=seed, report=report
        )
    return CyclicResult(scenario=scenario, rule=TIMETABLE, routes="chosen", groups=tuple(results))


def _choose_all(
    scenario: Scenario,
    weights: tuple[Fraction, ...],
    least_fairness: Fraction,
    deadline: Deadline,
    *,
    rounds: int | None,
    seed: int,
    report: Callable[[Fact], None],
) -> list[GroupResult]:
    """Choose a timetable for each independent group, or one for all robots."""
    params = ChoiceParams()
    if len(scenario.robots) > params.large:
        usual, others = clear_and_direct(scenario)
    else:
        usual, others = make_cyclic_routes(scenario), make_cyclic_routes(scenario, "shortest")
    fleet = CyclicProblem(
        context=GroupContext(scenario=scenario, routes=tuple(usual)),
        ways=tuple((first.lap, second.lap) for first, second in zip(usual, others, strict=True)),
        round_trips=(),
        forbidden=frozenset(),
        weights=weights,
        least_fairness=least_fairness,
        deadline=deadline,
        draw=random.Random(),  # noqa: S311 (each group has its own)
    )
    groups = split_groups(scenario, usual)
    try:
        return _choose_by_groups(fleet, groups, params, rounds=rounds, seed=seed, report=report)
    except GaveUp:
        if len(groups) == 1 or fleet.is_out_of_time:
            raise
    # With the vertices of other groups.
    return _choose_by_groups(fleet, [usual], params, rounds=rounds, seed=seed, report=report)


def _check_weights(weights: Sequence[Fraction] | None, n_robots: int) -> tuple[Fraction, ...]:
    """Return the weight of each robot; 1 by default."""
    if weights is None:
        return (Fraction(1),) * n_robots
    weights = list_of(POSITIVE).read_at("weights", weights)
    if len(weights) != n_robots:
        raise InputError.at("weights", f"{len(weights)} for {n_robots} robots (give one for each)")
    return weights


def _choose_by_groups(
    fleet: CyclicProblem,
    groups: Sequence[Sequence[CyclicRoute]],
    params: ChoiceParams,
    *,
    rounds: int | None,
    seed: int,
    report: Callable[[Fact], None],
) -> list[GroupResult]:
    """Choose a timetable for each group, small groups first, without vertices of other groups."""
    scenario = fleet.context.scenario

    def excluded_by(routes: Sequence[CyclicRoute]) -> frozenset[int]:
        rows = (make_lap_rows(scenario, route.robot, route.lap).excluded for route in routes)
        return frozenset().union(*rows)

    excluded = [excluded_by(group) for group in groups]
    uses = Counter(chain.from_iterable(excluded))
    taken = set(uses)
    results: dict[int, GroupResult] = {}
    left = len(fleet)
    for index in sorted(range(len(groups)), key=lambda index: len(groups[index])):
        group = groups[index]
        report(Fact("groups done", number=len(results), groups=len(groups), robots=len(group)))
        uses.subtract(excluded[index])
        taken.difference_update(row for row in excluded[index] if not uses[row])
        draw = random.Random(f"{seed} {index}")  # noqa: S311 (no secret depends on it)
        problem = _make_part(fleet, group, taken, draw, params).shorten(len(group) / left)
        left -= len(group)
        results[index] = _choose(problem, rounds, params)
        after = excluded_by(results[index].context.routes)
        uses.update(after)
        taken |= after
    return [results[index] for index in range(len(groups))]


def _make_part(
    fleet: CyclicProblem,
    group: Sequence[CyclicRoute],
    taken: set[int],
    draw: random.Random,
    params: ChoiceParams,
) -> CyclicProblem:
    """Return the problem of one group, without vertices of other groups."""
    scenario, robots = fleet.context.scenario, [route.robot for route in group]
    trips: tuple[RoundTrip, ...] = ()
    if len(fleet) <= params.most_with_round_trips:
        distances = Distances(scenario.roadmap)
        rows = sorted(taken)
        round_trips = [
            _round_trip(scenario, robot, distances, rows)
            for robot in limit_loop(robots, ROUTING, 8)
        ]
        trips = tuple(trip for trip in round_trips if trip is not None)
        trips = trips if len(trips) == len(round_trips) else ()
    ways = []
    for robot in limit_loop(robots, ROUTING):
        usual, other = fleet.ways[robot]
        fits = other != usual and taken.isdisjoint(make_lap_rows(scenario, robot, other).booked)
        ways.append((usual, other) if fits else (usual,))
    return replace(
        fleet,
        context=GroupContext(scenario=scenario, routes=tuple(group)),
        ways=tuple(ways),
        round_trips=trips,
        forbidden=frozenset(taken),
        weights=tuple(fleet.weights[robot] for robot in robots),
        draw=draw,
    )


def _round_trip(
    scenario: Scenario, robot: int, distances: Distances, taken: Sequence[int]
) -> RoundTrip | None:
    """Return a round trip of a robot that keeps clear of rows.

    A robot with a size does not visit an end of an edge that it must not drive along. None if it
    works at both ends of such an edge.
    """
    resources, once = scenario.problem.resources, take_one_lap(scenario, robot)
    places, roadmap = {stage.vertex for stage in once.stages}, scenario.roadmap
    own = np.arange(resources.n_vertices + resources.n_edges)
    is_taken = np.isin(own + resources.get_vertex_row(robot, 0), taken)
    forbidden = set(np.flatnonzero(is_taken[: resources.n_vertices]).tolist())
    edges = np.flatnonzero(is_taken[resources.n_vertices :])
    tails = np.searchsorted(roadmap.indptr, edges, side="right") - 1
    for ends in zip(roadmap.heads[edges].tolist(), tails.tolist(), strict=True):
        if forbidden.isdisjoint(ends):
            free = [vertex for vertex in ends if vertex not in places]
            if not free:
                return None
            forbidden.add(free[0])
    return RoundTrip.of(once, distances, forbidden=forbidden)


def _choose(problem: CyclicProblem, rounds: int | None, params: ChoiceParams) -> GroupResult:
    """Choose the timetable of one group."""
    if len(problem) == 1:
        lap = min(problem.ways[0], key=lambda lap: lap.duration)
        enter = np.cumsum([0, *(lap.compute_least(visit) for visit in range(len(lap) - 1))])
        alone = Candidate.as_it_is(problem.join_cycles([RobotCycle(lap, 1, enter)], lap.duration))
        return _start_timetable(problem, alone, "repeats", problem.compute_value(alone))
    if len(problem) > params.large and (closed := _close_run(problem)):
        return closed
    problem.deadline.check(CLOSING)
    baseline = _simulate(problem, "first-come", params.baseline_share)
    if baseline.has_rotation():
        apart = replace(problem.context, is_apart=True)
        return _choose(replace(problem, context=apart), rounds, params)
    ends, worth = _measure_baseline(problem, baseline)
    pattern = _find_fair_pattern(problem, baseline)
    candidates = [
        *_try_other_rules(problem, params),
        *_cut_out(problem, baseline, params),
        *_build_timetables(problem, rounds, params),
    ]
    if pattern is not None:
        candidates.append(problem.make_candidate(pattern.timetable))
    starts = list(filter(problem.accepts, candidates))
    if not starts and pattern is not None:
        return _compare_run(problem, baseline, pattern, ends, worth)
    if not starts and (together := repeat_plan(problem)):
        problem = problem.add_ways(together.timetable.laps)
        starts = list(filter(problem.accepts, [together]))
    if not starts:
        kind = "no fair timetable" if problem.least_fairness else "no timetable"
        raise GaveUp(Fact(kind, robots=len(problem)))
    whole = _convert_to_whole(problem, _improve_timetables(problem, starts, rounds, params), params)
    if pattern is not None and worth > problem.compute_value(whole):
        return _compare_run(problem, baseline, pattern, ends, worth)
    return _start_timetable(problem, whole, ends, worth)


def _close_run(problem: CyclicProblem) -> GroupResult | None:
    """Return the closing of a simulation, or the baseline's pattern if the pattern is better."""
    if problem.deadline.at is None:
        return None
    problem.deadline.check(CLOSING)
    baseline = SimulatedRun(problem, problem.context, "first-come")
    if baseline.result.has_rotation():
        return None
    extracted = extract_cycle(problem, choose_runs(problem, baseline))
    pattern, compared = (
        _find_fair_pattern(problem, baseline.result),
        _measure_baseline(problem, baseline.result),
    )
    if pattern is not None and (
        extracted is None or problem.compute_value(pattern) >= problem.compute_value(extracted)
    ):
        return _compare_run(problem, baseline.result, pattern, *compared)
    return None if extracted is None else _start_timetable(problem, extracted, *compared)


def _find_fair_pattern(problem: CyclicProblem, run: GroupResult) -> Candidate | None:
    """Return the pattern of a simulation; None without a pattern, or if it is unfair."""
    if run.timetable is None or not problem.is_fair(run.timetable.counts, run.timetable.period):
        return None
    return Candidate.as_it_is(run.timetable)


def _simulate(problem: CyclicProblem, rule: str, share: float) -> GroupResult:
    """Simulate the group on its usual routes for a share of the time."""
    return advance(make_simulation(problem.context, rule), problem.deadline.shorten(share))


def _measure_baseline(problem: CyclicProblem, run: GroupResult) -> tuple[BaselineEnds, Fraction]:
    """Return the end of first come first served, and the value of its laps per tick."""
    if run.ends == "deadlock":
        return "deadlock", Fraction(0)
    starves = run.ends == "repeats" and run.timetable is None
    return "starves" if starves else run.ends, run.compute_rate(problem.weights)


def _try_other_rules(problem: CyclicProblem, params: ChoiceParams) -> Iterator[Candidate]:
    """Yield the patterns of other rules found in their share; none without a time limit."""
    if problem.deadline.at is None or len(problem) > params.many:
        return
    for rule in ("two-level", "fixed-order"):
        pattern = _find_fair_pattern(problem, _simulate(problem, rule, params.other_rule_share))
        if pattern is not None:
            yield problem.make_candidate(pattern.timetable)


def _cut_out(problem: CyclicProblem, run: GroupResult, params: ChoiceParams) -> list[Candidate]:
    """Return the best timetables closed from a simulation, filled with further laps."""
    if not all(run.compute_mean_laps()):
        return []
    cutting = problem.shorten(params.cutting_share)
    windows = close_windows(cutting.shorten(params.closing_share), run)
    best = sorted(filter(problem.accepts, windows), key=problem.compute_value, reverse=True)
    short = [candidate for candidate in best if candidate.n_visits <= params.short]
    cuts = dict.fromkeys((*best[:1], *short[: params.cuts_kept]))
    filled = [
        candidate if cutting.is_out_of_time else fill(cutting, *cutting.book(candidate))
        for candidate in cuts
    ]
    return [max(pair, key=problem.compute_value) for pair in zip(cuts, filled, strict=True)]


def _build_timetables(
    problem: CyclicProblem, rounds: int | None, params: ChoiceParams
) -> list[Candidate]:
    """Return the best of several timetables, built by insertion for random periods."""
    is_small = len(problem) <= params.many
    building = problem.shorten(params.building_share if is_small else params.filling_share)
    first = problem.shorten(params.placing_share)
    built: list[Candidate] = []
    for drawn in islice(count(), rounds):
        times = problem.draw.uniform(1, params.longest_period) if drawn else params.first_period
        period = int(max(problem.alone) * times)
        try:
            built.append(insert_all(building if built else first, period, filling=building))
        except GaveUp:
            break
        if problem.compute_value(built[-1]) == problem.bound:
            break
    return sorted(filter(problem.accepts, built), key=problem.compute_value, reverse=True)[
        : params.improved
    ]


def _improve_timetables(
    problem: CyclicProblem,
    starts: Sequence[Candidate],
    rounds: int | None,
    params: ChoiceParams,
) -> Candidate:
    """Improve all short timetables, then the best of these, then the best of all."""
    net = max(starts, key=problem.compute_value)
    short = [candidate for candidate in starts if candidate.n_visits <= params.short] or [net]
    trying, tried = problem.shorten(params.trying_share), []
    for index, candidate in enumerate(short):
        tried.append(improve(trying.shorten(1 / (len(short) - index)), candidate, steps=rounds))
    continuing = problem.shorten(params.continuing_share)
    best = improve(continuing, max(tried, key=problem.compute_value), steps=rounds)
    return improve(problem, max(net, best, key=problem.compute_value), steps=rounds)


def _convert_to_whole(
    problem: CyclicProblem, candidate: Candidate, params: ChoiceParams
) -> Candidate:
    """Return the timetable in whole ticks; several periods if its cycle time is a fraction."""
    timetable, cycle_time = candidate.timetable, candidate.cycle_time
    if cycle_time.denominator * candidate.n_visits <= params.most_visits:
        timetable = unroll_schedule(timetable, cycle_time.denominator)
        cycle_time *= cycle_time.denominator
    period = Tick(Candidate(timetable, cycle_time).period)
    return Candidate.as_it_is(
        problem.build_graph(timetable).compute_earliest(period, cycle_time=cycle_time)
    )


def _start_timetable(
    problem: CyclicProblem, chosen: Candidate, ends: BaselineEnds, baseline: Fraction
) -> GroupResult:
    """Return the result of a timetable with which robots that wait at home can begin."""
    comparison = _compare(problem, chosen, ends, baseline)
    result = start(problem.context, chosen.timetable, comparison)
    assert result is not None, "candidates without a start are not accepted"
    return result


def _compare_run(
    problem: CyclicProblem,
    run: GroupResult,
    pattern: Candidate,
    ends: BaselineEnds,
    baseline: Fraction,
) -> GroupResult:
    """Return the result of a simulation as the chosen one, with the start that it had."""
    return replace(run, comparison=_compare(problem, pattern, ends, baseline))


def _compare(
    problem: CyclicProblem, chosen: Candidate, ends: BaselineEnds, baseline: Fraction
) -> BaselineComparison:
    return BaselineComparison(
        throughput=problem.compute_value(chosen),
        fairness=problem.compute_fairness(chosen.timetable.counts, chosen.cycle_time),
        baseline_ends=ends,
        baseline=baseline,
    )
