"""Reports on a plan: its costs, the time that each robot loses, the decisions behind it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import chain
from operator import attrgetter

from rightofway.check import Report
from rightofway.metrics import (
    Metrics,
    compute_alone_completions,
    compute_lost_time,
    find_collisions,
    find_swaps,
    free_running,
    measure,
)
from rightofway.model import ForcedLoss, Loss, LostTime, Plan, Proof, Scenario
from rightofway.report.facts import FactWriter
from rightofway.report.jobs import list_job_costs, list_jobs
from rightofway.report.judgement import list_report_sentences
from rightofway.report.lines import (
    Facts,
    Line,
    Paragraph,
    Part,
    Table,
    choose_further_format,
    lay_out,
)
from rightofway.report.phrases import Phrase, chain_items, join_items, say_count
from rightofway.report.place_names import PlaceNames
from rightofway.report.quantities import Quantities, format_decimal
from rightofway.report.sentences import (
    Words,
    describe_decision,
    describe_forced_loss,
    describe_improvement,
    describe_losses,
    describe_proof,
    explain_decision,
    list_forced_losses,
)

MAX_LINES = 10
"""Lines of a list; longer lists end with the number of further ones, --json has them all."""

MAX_DETOURS = 8
"""Robots that take the longest detours, as far as a report names them."""

MAX_HOMES = 5
"""Homes on the way of other robots that a report names: those that cost most."""

ROBOT_COLUMNS: dict[str, Callable[[LostTime], int]] = {
    "completes": attrgetter("completion"),
    "alone": attrgetter("alone"),
    "detours": attrgetter("detours"),
    "makes room": attrgetter("making_room"),
    "waits": attrgetter("waiting"),
}
"""The columns of the table of robots [ticks], also of workbooks: the first is the sum of the
others."""

NOT_COMPUTED = "not computed, because the time limit is over"


def summarize_plan(plan: Plan, quantities: Quantities, *, with_lost_time: bool = True) -> str:
    """Return the costs of a plan, and where and to which others robots lose time.

    Lost time of thousands of robots takes seconds; without it the costs alone are returned.
    """
    words, metrics = Words(plan=plan, quantities=quantities), measure(plan)
    lost = compute_lost_time(plan) if with_lost_time else ()
    lost_in_words = _write_lost(words, lost) if with_lost_time else NOT_COMPUTED
    costs = [
        ("planner", describe_planning(plan, quantities)),
        ("flowtime", _write_flowtime(words, metrics)),
        ("makespan", words.say_time(metrics.makespan)),
        ("lost time", lost_in_words),
        *list_job_costs(words),
    ]
    if quantities.in_ticks:
        costs.append(("tick", replace(quantities, in_ticks=False).format_duration(1)))
    details = [*_make_robots(words, lost), *_write_losses(words, lost)] if with_lost_time else []
    parts = [*details, *_write_forced_losses(words), *list_jobs(words)]
    return lay_out([Facts(costs), "", *parts])


def describe_planning(plan: Plan, quantities: Quantities) -> str:
    """Describe the work of the planner without terms of its method."""
    run, metrics, words = plan.run, measure(plan), Words(plan=plan, quantities=quantities)
    parts = [run.name]
    if run.seconds is not None:
        parts = [f"{run.name}, planned in {format_decimal(run.seconds)} s"]
    proven = describe_proof(plan)
    if proven:
        parts.append(proven)
    if metrics.flowtime == metrics.flowtime_alone:
        pass  # nothing was to be improved
    elif run.improvement is not None:
        parts.append(describe_improvement(run.improvement, quantities))
    if run.start is not None:
        parts.append(
            "{routes} of {fleet} keep their old route, {tracks} also its times".format(
                routes=str(run.start.routes),
                fleet=say_count(len(plan.tracks), "robot", "robots"),
                tracks=str(run.start.tracks),
            )
        )
    if run.reroutes:
        names = [words.name_robot(reroute.robot) for reroute in run.reroutes]
        parts.append(f"rerouted: {chain_items(names)}")
    return chain_items(parts, "two clauses")


def _write_flowtime(words: Words, metrics: Metrics) -> str:
    flowtime, bound = words.say_time(metrics.flowtime), metrics.lower_bound
    if metrics.gap is None:
        return flowtime
    if metrics.flowtime == bound:
        return f"{flowtime}, the least possible"
    return "{flowtime}, {gap} above the lower bound of {bound}".format(
        flowtime=flowtime,
        gap=f"{metrics.gap:.1%}",
        bound=words.say_time(bound),
    )


def _write_lost(words: Words, lost: Sequence[LostTime]) -> str:
    parts = {
        "detours": sum(times.detours for times in lost),
        "making room": sum(times.making_room for times in lost),
        "waiting": sum(times.waiting for times in lost),
    }
    causes = [f"{cause} {words.say_time(ticks)}" for cause, ticks in parts.items() if ticks]
    if not causes:
        return "none"
    return f"{words.say_time(sum(parts.values()))}: {chain_items(causes)}"


def _make_robots(words: Words, lost: Sequence[LostTime]) -> Iterator[Part]:
    most = sorted(range(len(lost)), key=lambda robot: -lost[robot].lost)[:MAX_LINES]
    if len(lost) > MAX_LINES:
        most = [robot for robot in most if lost[robot].lost] or most
    listed, cell = sorted(most), words.quantities.format_cell
    heading = "times of each robot"
    if len(listed) < len(lost):
        heading = "times of the robots that lose most"
    yield words.quantities.format_heading(heading)
    rows = [
        [words.name_robot(robot), *(cell(get(lost[robot])) for get in ROBOT_COLUMNS.values())]
        for robot in listed
    ]
    yield Table(("robot", *ROBOT_COLUMNS), rows)
    if len(lost) > len(listed):
        rest = say_count(len(lost) - len(listed), "more robot", "more robots")
        yield f"… and {rest} that lose less time (--json lists all)"


def _write_losses(words: Words, lost: Sequence[LostTime]) -> Iterator[Part]:
    """Yield where and to which robots time is lost, the largest losses first."""
    groups: dict[tuple[object, ...], list[Loss]] = {}
    for loss in chain.from_iterable(times.losses for times in lost):
        groups.setdefault((loss.kind, loss.robot, loss.for_robot), []).append(loss)
    largest = sorted(
        groups.values(), key=lambda group: (-sum(loss.ticks for loss in group), group[0].tick)
    )
    if largest:
        yield ""
    for group in largest[:MAX_LINES]:
        yield describe_losses(words, group)
    if len(largest) > MAX_LINES:
        yield f"… and {len(largest) - MAX_LINES} more (--json lists all)"
    yield from _write_detours(words, lost)
    yield from _write_homes_in_the_way(words, chain.from_iterable(groups.values()))


def _write_forced_losses(words: Words) -> Iterator[Part]:
    """Yield why no plan is better, where that is proven."""
    losses = list_forced_losses(words.plan)
    if losses:
        yield ""
    for loss in losses[:MAX_LINES]:
        place = words.name_place(loss.vertex)
        yield describe_forced_loss(words.plan.scenario, loss, words.quantities, place)
    if len(losses) > MAX_LINES:
        yield f"… and {len(losses) - MAX_LINES} more (--json lists all)"


def _write_detours(words: Words, lost: Sequence[LostTime]) -> Iterator[Part]:
    """Yield one sentence on the robots whose drives take longer than on their shortest trips."""
    longest = sorted(
        (robot for robot in lost if robot.detours > 0), key=lambda robot: -robot.detours
    )
    if not longest:
        return
    times = [words.say_time, *[choose_further_format(words.quantities)] * (MAX_DETOURS - 1)]
    listed: list[str] = [
        f"{words.name_robot(lost_by.robot)} {write(lost_by.detours)}"
        for lost_by, write in zip(longest, times, strict=False)
    ]
    robots = chain_items(listed)
    if rest := len(longest) - len(listed):
        more = say_count(rest, "more robot", "more robots")
        robots = f"{robots} and {more}"
    yield ""
    yield f"Detours: {robots}."


def _write_homes_in_the_way(words: Words, losses: Iterable[Loss]) -> Iterator[Part]:
    """Say where the last place of a robot that loses time is on the way of others.

    Such a robot makes room at its last place; or it waits on its way there, while the other robot
    has yet to come through.
    """
    scenario, tracks = words.plan.scenario, words.plan.tracks
    stays = words.plan.stays
    costs: dict[int, dict[int, int]] = {}
    for loss in losses:
        if loss.for_robot is None or loss.kind == "follows":
            continue
        stay, other = stays[loss.robot], tracks[loss.for_robot]
        last = scenario.problem.itineraries[loss.robot].last
        comes = other.enter[other.vertices == last]
        before_last = tracks[loss.robot].enter[list(stay.serves[-2:-1])]
        is_last_leg = bool((loss.tick >= before_last).all())
        is_blocked = bool(((comes >= loss.tick) & (comes < stay.completion)).any())
        if loss.vertex == last if loss.kind == "makes room" else is_last_leg and is_blocked:
            others = costs.setdefault(loss.robot, {})
            others[loss.for_robot] = others.get(loss.for_robot, 0) + loss.ticks
    largest = sorted(costs, key=lambda robot: -sum(costs[robot].values()))
    if largest:
        yield ""
    for robot in largest[:MAX_HOMES]:
        last = scenario.problem.itineraries[robot].last
        ranked = sorted(costs[robot], key=lambda other: -costs[robot][other])
        names: list[str] = [*map(words.name_robot, ranked[:3])]
        if ranked[3:]:
            names.append("others")
        values = {
            "place": words.places.describe_place(last),
            "robot": words.name_robot(robot),
            "others": join_items(names),
            "time": words.say_time(sum(costs[robot].values())),
        }
        if last == scenario.robots[robot].home:
            yield (
                "{place}, the home of {robot}, is on the way of {others} and costs {robot} {time}:"
                " a home or a parking place off that way would help."
            ).format(
                **values,
            )
        else:
            yield (
                "{place}, the last place of {robot}, is on the way of {others} and costs {robot}"
                " {time}: a last place or a parking place off that way would help."
            ).format(
                **values,
            )


def report_decisions(plan: Plan, quantities: Quantities) -> str:
    """Return every decision of the planner with its reason, in the order they were taken."""
    return lay_out(_write_decisions(Words(plan=plan, quantities=quantities)))


def _write_decisions(words: Words) -> Iterator[Part]:
    plan = words.plan
    for decision in plan.run.decisions:
        yield f"At {words.say_moment(decision.tick)}: {describe_decision(words, decision)}"
        yield Paragraph(explain_decision(words, decision), "    ")
    for reroute in plan.run.reroutes:
        robot = words.name_robot(reroute.robot)
        why = FactWriter(plan.scenario).write(reroute.because)
        yield f"{robot} is rerouted: {why}."
    if plan.run.decisions or plan.run.reroutes:
        return
    tracks = free_running(plan)
    if not find_collisions(plan.scenario, tracks) and not find_swaps(tracks):
        yield "No decision was needed: no two robots meet."
        return
    yield (
        "The search that found this plan records no decisions, so no wait has a reason here"
        " (`--planner two-level` plans with a reason for each decision;"
        " `rightofway table PLAN --events` lists each wait and the robot waited for)."
    )


def report_bounds(
    scenario: Scenario,
    quantities: Quantities,
    proof: Proof | None,
    *,
    is_reached: bool,
    losses: Sequence[ForcedLoss] = (),
) -> list[Part]:
    """Return the lower bound of plans, and when each robot would be done alone.

    ``proof`` is of a higher bound, which a plan may have reached; ``losses`` say why it is higher.
    """
    alone = compute_alone_completions(scenario)

    def at_least(ticks: int) -> str:
        return f"at least {quantities.format_duration(ticks)}"

    bounds: list[tuple[str, str]] = [
        ("flowtime", at_least(sum(alone))),
        ("makespan", at_least(max(alone))),
    ]
    if proof is not None and proof.bound is not None:
        proven: str = at_least(proof.bound)
        if is_reached:
            proven = f"{proven}, and a plan reaches it"
        bounds.append((f"{Phrase(proof.objective.value)}, proven", proven))
    rows = [
        (robot.name, quantities.format_cell(ticks))
        for robot, ticks in zip(scenario.robots[:MAX_LINES], alone, strict=False)
    ]
    heading = quantities.format_heading("alone")
    parts: list[Part] = [Facts(bounds), "", Table(("robot", heading), rows)]
    if len(alone) > MAX_LINES:
        more = say_count(len(alone) - MAX_LINES, "more robot", "more robots")
        parts.append(f"… and {more} (--json lists all)")
    if losses:
        parts.append("")
    place = PlaceNames(scenario)
    parts += [
        describe_forced_loss(scenario, loss, quantities, place(loss.vertex))
        for loss in losses[:MAX_LINES]
    ]
    return parts


def report_check(
    file: str, plan: Plan, judgement: Report, quantities: Quantities
) -> Iterator[Part]:
    """Yield the faults of the plan of a file, each in a line."""
    if judgement.ok:
        yield Line(
            f"{file}: no fault in {len(plan.tracks)} robots and {sum(map(len, plan.tracks))} visits"
        )
        return
    first, *others = list_report_sentences(judgement, quantities)
    yield Line(f"{file}: {first}")
    yield from map(Line, others)
