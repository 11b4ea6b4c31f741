"""The plan as the page reads it, small enough for a thousand robots.

Long lists of integers are written as first differences (``[3, 4, 6]`` as ``[3, 1, 2]``): along a
route these are small and repeat, so the file is a fraction of the size. ``plan.js`` reads all this.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import chain
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from rightofway.check import Report
from rightofway.cyclic import list_pieces_of_plan
from rightofway.errors import InputError, NoPlanExists
from rightofway.metrics import compare, compute_lost_time, join_waits, measure
from rightofway.model import (
    Decision,
    ExecutionTrace,
    ForcedLoss,
    Loss,
    Plan,
    Scenario,
    Stays,
    SteadyState,
    Tick,
    Track,
)
from rightofway.model.closures import Closure
from rightofway.model.steady_state import refuse_unknown_robots
from rightofway.report.circuits import describe_circuit, summarize_circuit
from rightofway.report.facts import FactWriter
from rightofway.report.judgement import describe_fault, name_fault
from rightofway.report.phrases import Phrase, PhraseBook, to_parts
from rightofway.report.place_names import PlaceNames
from rightofway.report.quantities import Quantities
from rightofway.report.sentences import (
    Words,
    describe_closure,
    describe_decision,
    describe_executed_loss,
    describe_forced_loss,
    describe_improvement,
    describe_loss,
    describe_proof,
    describe_reason,
    list_closed_vertices,
    list_figures,
    list_forced_losses,
    read_closed_ticks,
    summarize_decision,
    summarize_forced_loss,
)
from rightofway.site import Roadmap
from rightofway.viz.motion import Trip, end_of, make_trips
from rightofway.viz.page.background import Background
from rightofway.viz.page.map_data import compute_differences, map_data, mark_charging_places
from rightofway.viz.page.schema import (
    ClosureData,
    ComparisonData,
    DecisionData,
    DrivenData,
    FaultsData,
    FloorData,
    ForcedLossData,
    LossRow,
    OtherPlan,
    Payload,
    PlannerData,
    RobotData,
    StageRow,
    SteadyData,
    TurnRow,
    UnitsData,
)
from rightofway.viz.page.work_data import make_work_data
from rightofway.viz.palette import choose_colours
from rightofway.viz.placement import make_edge_length, order_in_line
from rightofway.viz.verdict import LISTED_FAULTS, give_verdict, make_comparison_data

Stoppages = Sequence[tuple[Tick, Tick | None]]
"""When each stoppage of a robot begins, and how long it lasts [ticks]."""

DECIMALS = 3
"""Decimals of a place in the diagram; a thousandth of a length unit cannot be seen."""

LOSSES = ("waits", "follows", "makes room", "waits for job")
"""Kinds of lost time; the page is given their places in this list."""


def make_payload(
    plan: Plan,
    *,
    steady: Sequence[SteadyState] = (),
    actual: ExecutionTrace | None = None,
    no_plan: NoPlanExists | None = None,
    title: str = "",
    background: Background | None = None,
    others: Sequence[tuple[Plan, str]] = (),
) -> Payload:
    """Return the content of the page, as plain data for JSON.

    Parameters
    ----------
    plan, steady, actual, no_plan, title, background, others
        As for `make_page`; times in the result are ticks.

    Raises
    ------
    InputError
        If ``steady`` or ``actual`` are not of this plan, or the plans cannot be compared.
    """
    trips, steady = make_trips(plan), steady or plan.steady
    scenario, run, metrics = plan.scenario, plan.run, measure(plan)
    lost = compute_lost_time(plan)
    words, book = Words(plan=plan, quantities=Quantities.of(scenario)), PhraseBook()
    payload = make_bare_payload(plan, trips, book, title=title, background=background)
    payload["line"] = trace_line(plan, [other for other, _ in others])
    for data, completion, alone, own in zip(
        payload["robots"], metrics.completions, metrics.alone, lost, strict=True
    ):
        data["completion"], data["alone"] = completion, alone
        data["lost"] = (own.detours, own.making_room, own.waiting)
    payload["losses"] = [
        _make_loss(scenario.roadmap, loss, book.add(describe_loss(words, loss)))
        for robot_losses in lost
        for loss in robot_losses.losses
    ]
    payload["faults"] = _make_faults(plan, give_verdict(plan), book)
    payload["planner"] = _make_planner(plan)
    payload["decisions"] = [_make_decision(decision, words, book) for decision in run.decisions]
    payload["reroutes"] = [
        {"robot": reroute.robot, "because": to_parts(FactWriter(scenario).write(reroute.because))}
        for reroute in run.reroutes
    ]
    payload["metrics"] = {
        "flowtime": metrics.flowtime,
        "makespan": metrics.makespan,
        "lowerBound": metrics.lower_bound,
    }
    add_names(scenario, payload, book)
    if forced := list_forced_losses(plan):
        payload["forcedLosses"] = [_make_forced_loss(loss, words, book) for loss in forced]
    if steady:
        payload["steady"] = _list_steady(plan, steady, book)
        payload["laps"] = [robot.laps or scenario.rules.laps for robot in scenario.robots]
    if steady and actual is None:
        payload["end"] = _find_last_tick(trips, payload["steady"])
    if actual is not None:
        payload["floor"] = _make_execution(plan, actual, trips, words, book)
    if no_plan is not None:
        payload["noPlan"] = True
        payload["faults"] = _make_blockages(scenario, no_plan, book)
    if others:
        _compare(plan, title, others, payload)
    if scenario.problem.work is not None:
        payload["work"] = make_work_data(plan, book)
    return payload


def make_bare_payload(
    plan: Plan,
    trips: Sequence[Trip],
    book: PhraseBook,
    *,
    title: str = "",
    background: Background | None = None,
) -> Payload:
    """Return the site and the trips of robots alone: nothing is measured or judged.

    Each robot has the time of its last visit as its completion time.
    """
    scenario = plan.scenario
    tick = scenario.problem.clock.tick
    payload: Payload = {
        "title": title,
        "phrases": book.entries,
        "units": cast("UnitsData", scenario.units.to_document()),
        "tick": (tick.numerator, tick.denominator),
        "end": max(end_of(trips), 1),
        "headway": scenario.problem.booking_rules.headway,
        "booksAhead": scenario.problem.booking_rules.books_ahead,
        "map": map_data(scenario.roadmap, room=measure_room(scenario), background=background),
        "line": [],
        "robots": _list_robots(plan, trips),
        "losses": [],
        "faults": {"count": 0, "kinds": [], "listed": []},
        "planner": {"name": "", "method": ""},
        "decisions": [],
        "reroutes": [],
        "metrics": {"flowtime": 0, "makespan": 0, "lowerBound": 0},
    }
    if scenario.closures:
        payload["closures"] = [
            make_closure_data(closure, scenario) for closure in scenario.closures
        ]
    if scenario.rules.clearance:
        payload["clearance"] = float(scenario.rules.clearance)
    if work := scenario.problem.work:
        mark_charging_places(payload["map"], work)
    return payload


def add_names(scenario: Scenario, payload: Payload, book: PhraseBook) -> None:
    """Add the cells that are called after robots."""
    names = PlaceNames(scenario)
    if names.is_measured:
        payload["places"] = [(vertex, book.add(name)) for vertex, name in names.of_robots.items()]


def _compare(plan: Plan, title: str, others: Sequence[tuple[Plan, str]], payload: Payload) -> None:
    """Add the other plans, and the comparison: robots of one name have one colour.

    A plan on the same map has none of its own, and shares the line of places.
    """
    plans = [plan, *(other for other, _ in others)]
    comparison = compare(plans, [title, *(name for _, name in others)])
    colours = dict(zip(comparison.robots, choose_colours(len(comparison.robots)), strict=True))
    payload["others"] = []
    for other, name in others:
        data: dict[str, Any] = {**make_payload(other, title=name)}
        for robot in data["robots"]:
            robot["colour"] = colours[robot["name"]]
        if other.scenario.roadmap == plan.scenario.roadmap:
            data["line"] = payload["line"]
            del data["map"]
        data.pop("work", None)  # jobs are shown of the first plan
        payload["others"].append(cast(OtherPlan, data))
    payload["comparison"] = cast(ComparisonData, make_comparison_data(comparison))


def measure_room(scenario: Scenario) -> Fraction:
    """Return the distance that the two largest robots need [length unit]; 0 for points."""
    radii = sorted((robot.radius for robot in scenario.robots), reverse=True)[:2]
    return sum(radii) + scenario.rules.clearance if any(radii) else Fraction(0)


def _make_blockages(scenario: Scenario, no_plan: NoPlanExists, book: PhraseBook) -> FaultsData:
    """Return why there is no plan, as faults with the robots and vertices that they concern."""
    name, writer = book.add(Phrase("no plan")), FactWriter(scenario)
    return {
        "count": len(no_plan.blockages),
        "kinds": [(name, len(no_plan.blockages))],
        "listed": [
            {
                "kind": "no plan",
                "name": name,
                "reason": book.add(writer.write(blockage.reason)),
                "remedy": book.add(writer.write(blockage.remedy)),
                "tick": 0,
                "robots": list(blockage.robots),
                "vertices": list(map(int, blockage.vertices)),
            }
            for blockage in no_plan.blockages[:LISTED_FAULTS]
        ],
    }


def make_closure_data(closure: Closure, scenario: Scenario) -> ClosureData:
    """Return the vertices of a closure, along a lane in order, and when it is."""
    begin, end = read_closed_ticks(closure, scenario)
    return {
        "vertices": list(list_closed_vertices(closure, scenario)),
        "from": begin,
        "until": end,
        "radius": None if closure.radius is None else float(closure.radius),
        "text": to_parts(describe_closure(closure, scenario)),
    }


def _make_planner(plan: Plan) -> PlannerData:
    run = plan.run
    method = "" if run.status is None else FactWriter(plan.scenario).write(run.status)
    if run.improvement is not None:
        method = describe_improvement(run.improvement, Quantities.of(plan.scenario))
    data: PlannerData = {"name": run.name, "method": to_parts(method)}
    if proven := describe_proof(plan):
        data["proven"] = to_parts(proven)
    return data


def trace_line(plan: Plan, others: Sequence[Plan]) -> list[tuple[int, float]]:
    """Return the places over time of a small fleet: vertex and distance along the line.

    Other plans on the same map may visit other places, which come after.
    """
    roadmap, routes = plan.scenario.roadmap, dict[str, list[int]]()
    for compared_plan in (plan, *others):
        if compared_plan.scenario.roadmap == roadmap:
            for robot, trip in zip(
                compared_plan.scenario.robots, make_trips(compared_plan), strict=True
            ):
                routes.setdefault(robot.name, []).extend(trip.vertices)
    places = order_in_line([*routes.values()], make_edge_length(roadmap))
    return [(int(vertex), round(place, DECIMALS)) for vertex, place in places.items()]


def _list_robots(plan: Plan, trips: Sequence[Trip]) -> list[RobotData]:
    edge_ticks = [itinerary.edge_ticks for itinerary in plan.scenario.problem.itineraries]
    colours, robots = choose_colours(len(trips)), list[RobotData]()
    for index, (robot, trip, edges) in enumerate(
        zip(plan.scenario.robots, trips, edge_ticks, strict=True)
    ):
        robot_data: RobotData = {
            "name": robot.name,
            "colour": colours[index],
            "speed": str(robot.speed),
            "completion": trip.enter[-1],
            "alone": trip.enter[-1],
            "lost": (0, 0, 0),
            "vertices": compute_differences(trip.vertices),
            "enter": compute_differences(trip.enter),
            "drive": edges[0] if len(edges) == 1 else list(trip.drive),
            "stages": [
                (stage.vertex, stage.work, stage.turn, visit)
                for stage, visit in zip(trip.stages, trip.served, strict=True)
            ],
        }
        if robot.radius:
            robot_data["radius"] = float(robot.radius)
        if plan.tours is not None:
            robot_data["begins"] = [int(stage.earliest) for stage in trip.stages]
            charges = [place for place, item in enumerate(plan.tours[index]) if item.job is None]
            if charges:
                robot_data["charges"] = charges
        if any(trip.turns):
            robot_data["turns"] = _list_sparse(trip.turns)
        if min(trip.served) < 0:
            robot_data["stands"] = True
        robots.append(robot_data)
    return robots


def _make_forced_loss(loss: ForcedLoss, words: Words, book: PhraseBook) -> ForcedLossData:
    plan, place = words.plan, words.name_place(loss.vertex)
    head = summarize_forced_loss(plan.scenario, loss, words.quantities)
    text = describe_forced_loss(plan.scenario, loss, words.quantities, place)
    tracks = [plan.tracks[robot] for robot in loss.robots]
    comes = [track.enter[track.vertices == loss.vertex].tolist()[:1] for track in tracks]
    return {
        "head": book.add(head),
        "text": book.add(text),
        "robots": list(loss.robots),
        "vertices": [words.plan.scenario.roadmap.get_drawn(loss.vertex)],
        "tick": max(chain.from_iterable(comes), default=0),
    }


def _make_decision(decision: Decision, words: Words, book: PhraseBook) -> DecisionData:
    head, detail = summarize_decision(words, decision)
    return {
        "head": book.add(head),
        "detail": book.add(detail),
        "story": book.add(describe_decision(words, decision)),
        "reason": book.add(describe_reason(words, decision)),
        "tick": decision.tick,
        "kind": decision.kind,
        "vertices": list(map(words.plan.scenario.roadmap.get_drawn, decision.vertices)),
        "robots": decision.robots,
        "waits": decision.waits,
        "waitsAt": words.plan.scenario.roadmap.get_drawn(decision.waits_at),
        "ticks": decision.ticks,
        "level": decision.level,
        "figures": [
            (book.add(figure), book.add(if_one), book.add(if_other))
            for figure, if_one, if_other in list_figures(words, decision)
        ],
    }


def _list_steady(plan: Plan, steady: Sequence[SteadyState], book: PhraseBook) -> list[SteadyData]:
    names, groups = [robot.name for robot in plan.scenario.robots], list[SteadyData]()
    refuse_unknown_robots(steady, names, list(map(len, plan.tracks)))
    for group in steady:
        data: SteadyData = {
            "robots": list(group.robots),
            "start": group.start,
            "period": group.period,
            "until": min(_find_until(group, plan.tracks[robot]) for robot in group.robots),
            "critical": list(group.critical),
        }
        if pieces := list_pieces_of_plan(plan, group):
            short = summarize_circuit(pieces, plan.scenario, group.period)
            data["bottleneck"] = (
                book.add(short),
                book.add(describe_circuit(pieces, plan.scenario)),
            )
        groups.append(data)
    return groups


def _find_last_tick(trips: Sequence[Trip], groups: Sequence[SteadyData]) -> int:
    """Return the tick at which the first robot ends its laps; robots that stand still have none."""
    untils = {robot: group["until"] for group in groups for robot in group["robots"]}
    ends: list[int] = [
        untils.get(robot, trip.enter[-1])
        for robot, trip in enumerate(trips)
        if robot in untils or min(trip.served) >= 0
    ]
    return max(1, min(ends))


def _find_until(group: SteadyState, track: Track) -> int:
    """Return the tick up to which a robot repeats its previous period.

    The first visit that is missing or begins at another tick ends the repetition at the visit
    before.
    """
    first, again = np.searchsorted(track.enter, (group.start, group.start + group.period), "right")
    shift = int(again - first)
    if shift == 0 or track.vertices[again - 1] != track.vertices[first - 1]:
        return group.start
    before, after = slice(first, len(track) - shift), slice(again, None)
    same = (track.enter[after] - track.enter[before] == group.period) & (
        track.vertices[after] == track.vertices[before]
    )
    repeated = len(same) if same.all() else int(np.argmin(same))
    return int(track.enter[again - 1 + repeated])


def _make_execution(
    plan: Plan, actual: ExecutionTrace, trips: Sequence[Trip], words: Words, book: PhraseBook
) -> FloorData:
    if len(actual.tracks) != len(plan.tracks):
        counts = f"{len(actual.tracks)} for {len(plan.tracks)} robots"
        raise InputError.at(("actual", "tracks"), f"{counts} (give one for each)")
    still = actual.stoppages or ((),) * len(trips)
    stays = tuple(map(_measure_executed_stays, actual.tracks, actual.dwell, actual.drive, still))
    driven = make_trips(replace(plan, tracks=actual.tracks, steady=()))
    waits = [stay.waits for stay in plan.stays]

    def unplanned(loss: Loss) -> int:
        robot = loss.robot
        return _measure_unplanned(loss, plan.tracks[robot], actual.tracks[robot], waits[robot])

    robots = []
    for planned, taken, dwell, drive, stoppages, completion in zip(
        trips, driven, actual.dwell, actual.drive, still, actual.completion, strict=True
    ):
        is_planned = taken.vertices == planned.vertices[: len(taken.vertices)]
        stages, turns = _list_executed_duties(planned if is_planned else taken, dwell)
        robot: DrivenData = {
            "stages": stages,
            "enter": compute_differences(taken.enter),
            "drive": drive.tolist(),
            "still": list(stoppages),
            "completion": completion,
        }
        if planned.turns or taken.turns:
            robot["turns"] = turns
        if not is_planned:
            robot["vertices"] = compute_differences(taken.vertices)
        robots.append(robot)
    return {
        "end": max(1, *(stay.completion for stay in stays), *filter(None, actual.completion)),
        "robots": robots,
        "losses": [
            _make_loss(
                plan.scenario.roadmap,
                loss,
                book.add(describe_executed_loss(words, loss, unplanned(loss))),
            )
            for loss in join_waits(plan.scenario, actual.tracks, stays)
        ],
    }


def _measure_unplanned(loss: Loss, planned: Track, taken: Track, waits: NDArray[np.int64]) -> int:
    """Return how much longer the waits of a loss were than planned, 0 on another way [ticks]."""
    first = int(np.searchsorted(taken.enter, loss.tick, "right")) - 1
    after = int(np.searchsorted(taken.enter, loss.end, "left"))
    if not np.array_equal(taken.vertices[:after], planned.vertices[:after]):
        return 0
    return int(loss.ticks - waits[first:after].sum())


def _measure_executed_stays(
    track: Track, dwell: NDArray[np.int64], drive: NDArray[np.int64], still: Stoppages
) -> Stays:
    """Return the parts of each visit; a stoppage counts as dwell, not as a wait."""
    out = np.append(drive[1:], 0)
    stood = dwell.copy()
    for begin, ticks in still:
        if ticks is not None:
            inside: NDArray[np.int64] = np.clip(track.enter, begin, begin + ticks)
            stood[:-1] += np.diff(inside)
    waits = np.maximum(np.append(np.diff(track.enter), 0) - out - stood, 0)
    waits[-1] = 0
    completion = Tick(int(track.enter[-1] + dwell[-1]))
    return Stays(
        dwell=stood,
        drive=out,
        waits=waits,
        turns=np.zeros_like(stood),
        serves=(),
        completion=completion,
    )


def _list_executed_duties(
    trip: Trip, dwell: NDArray[np.int64]
) -> tuple[list[StageRow], list[TurnRow]]:
    """Return stages and turns; each takes its share of the executed duration of its visit."""
    reached, last = len(dwell), len(trip.vertices) - 1
    planned = np.zeros(reached, np.int64)
    planned[: len(trip.turns)] = trip.turns[:reached]
    for stage, visit in zip(trip.stages, trip.served, strict=True):
        if 0 <= visit < reached:
            planned[visit] += stage.work + (stage.turn if visit < last else 0)
    pace = [ticks / least if least else 1 for ticks, least in zip(dwell, planned, strict=True)]
    stages: list[StageRow] = [
        (stage.vertex, round(stage.work * pace[visit]), round(stage.turn * pace[visit]), visit)
        if 0 <= visit < reached
        else (stage.vertex, stage.work, stage.turn, -1)
        for stage, visit in zip(trip.stages, trip.served, strict=True)
    ]
    scaled = (round(ticks * share) for ticks, share in zip(trip.turns, pace, strict=False))
    return stages, _list_sparse(scaled)


def _list_sparse(numbers: Iterable[int]) -> list[TurnRow]:
    """Return the index and the value of each number that is not 0."""
    return [(index, number) for index, number in enumerate(numbers) if number]


def _make_loss(roadmap: Roadmap, loss: Loss, text: int) -> LossRow:
    vertex, until, towards = map(roadmap.get_drawn, (loss.vertex, loss.until_vertex, loss.towards))
    freed = None if loss.freed is None else roadmap.get_drawn(loss.freed)
    places, times = (vertex, until, towards, freed), (loss.tick, loss.end, loss.ticks)
    return (LOSSES.index(loss.kind), loss.robot, loss.for_robot, *places, *times, text)


def _make_faults(plan: Plan, report: Report, book: PhraseBook) -> FaultsData:
    known = range(plan.scenario.roadmap.n_drawn)
    described = ((fault, describe_fault(fault)) for fault in report.faults)
    return {
        "count": report.total,
        "kinds": [(book.add(name_fault(kind)), count) for kind, count in report.counts.items()],
        "listed": [
            {
                "kind": fault.kind,
                "name": book.add(name_fault(fault.kind)),
                "reason": book.add(reason),
                "remedy": book.add(remedy),
                "tick": fault.tick,
                "robots": list(fault.robots),
                "vertices": [vertex for vertex in fault.vertices if vertex in known],
            }
            for fault, (reason, remedy) in described
        ],
    }
