"""Reports on a plan: its costs, the time that each robot loses, the decisions behind it."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import chain

from rightofway.metrics import (
    Metrics,
    collisions,
    free_running,
    lost_time,
    measure,
    outcome_of,
    swaps,
)
from rightofway.model import Loss, LostTime, Objective, Plan
from rightofway.quantities import Quantities, decimal
from rightofway.report.lines import COLUMNS, counted, further, row, short, wrapped
from rightofway.report.sentences import (
    Words,
    decision_in_words,
    explanation_of,
    improvement_in_words,
    proof_in_words,
    sentence_on,
)

MAX_LINES = 10
"""Lines of a list; longer lists end with the number of further ones, --json has them all."""

MAX_DETOURS = 8
"""Robots that take the longest detours, as far as a report names them."""

MAX_HOMES = 5
"""Homes on the way of other robots that a report names: those that cost most."""

COLUMNS_OF_TIMES = ("completes", "alone", "detours", "makes room", "waits")
"""Headings of the table of robots: the first is the sum of the others."""


def summary(plan: Plan, quantities: Quantities) -> str:
    """Return the costs of a plan, and where and to which others robots lose time."""
    words = Words(plan=plan, quantities=quantities)
    metrics, lost = measure(plan), lost_time(plan)
    rows = [
        ("planner", planning(plan, quantities)),
        ("flowtime", _flowtime(words, metrics)),
        ("makespan", words.time(metrics.makespan)),
        ("lost time", _lost(words, lost)),
    ]
    if quantities.in_ticks:
        rows.append(("tick", replace(quantities, in_ticks=False).duration(1)))
    costs = [
        row(key, textwrap.shorten(text, 4 * COLUMNS, placeholder=" …"), 11) for key, text in rows
    ]
    return "\n".join([*costs, "", *_robots(words, lost), *_losses(words, lost)])


def planning(plan: Plan, quantities: Quantities) -> str:
    """Return what the planner did, in words that need no knowledge of its method."""
    run, metrics, words = plan.run, measure(plan), Words(plan=plan, quantities=quantities)
    parts = [run.name]
    if run.seconds is not None:
        parts[0] += f", planned in {decimal(run.seconds)} s"
    proven = proof_in_words(plan)
    if proven:
        parts.append(proven)
    if metrics.flowtime == metrics.lower_bound:
        pass  # nothing was to be improved
    elif run.improvement is not None:
        parts.append(improvement_in_words(run.improvement, quantities))
    if run.start is not None:
        start, fleet = run.start, counted(len(plan.tracks), "robot")
        parts.append(
            f"{start.routes} of {fleet} keep their old route, {start.tracks} also its times"
        )
    if run.reroutes:
        names = [words.robot(reroute.robot) for reroute in run.reroutes]
        parts.append(f"rerouted: {', '.join(names)}")
    return "; ".join(parts)


def _flowtime(words: Words, metrics: Metrics) -> str:
    outcome, flowtime = outcome_of(words.plan), words.time(metrics.flowtime)
    bound = int(metrics.lower_bound)
    if outcome.objective is Objective.FLOWTIME and outcome.bound is not None:
        bound = max(bound, outcome.bound)
    if metrics.flowtime == bound:
        return f"{flowtime}, the least possible"
    if not bound:
        return flowtime
    gap = metrics.flowtime / bound - 1
    return f"{flowtime}, {gap:.1%} above the lower bound of {words.time(bound)}"


def _lost(words: Words, lost: Sequence[LostTime]) -> str:
    parts = {
        "detours": sum(times.detours for times in lost),
        "making room": sum(times.making_room for times in lost),
        "waiting": sum(times.waiting for times in lost),
    }
    causes = [f"{key} {words.time(ticks)}" for key, ticks in parts.items() if ticks]
    return f"{words.time(sum(parts.values()))}: {', '.join(causes)}" if causes else "none"


def _robots(words: Words, lost: Sequence[LostTime]) -> Iterator[str]:
    most = sorted(range(len(lost)), key=lambda robot: -lost[robot].lost)[:MAX_LINES]
    if len(lost) > MAX_LINES:
        most = [robot for robot in most if lost[robot].lost] or most
    listed, cell = sorted(most), words.quantities.cell
    rows = [
        tuple(
            map(
                cell,
                (times.completion, times.alone, times.detours, times.making_room, times.waiting),
            )
        )
        for times in (lost[robot] for robot in listed)
    ]
    widths = [max(map(len, column)) for column in zip(COLUMNS_OF_TIMES, *rows, strict=True)]
    room = COLUMNS - sum(widths) - 2 * len(widths)
    names = [short(words.robot(robot), room) for robot in listed]
    width = max(map(len, ("robot", *names)))
    which = "each robot" if len(listed) == len(lost) else "the robots that lose most"
    yield words.quantities.heading(f"times of {which}")
    for name, cells in zip(("robot", *names), (COLUMNS_OF_TIMES, *rows), strict=True):
        line = "  ".join(
            f"{cell_text:>{space}}" for cell_text, space in zip(cells, widths, strict=True)
        )
        yield f"{name:{width}}  {line}"
    if len(lost) > len(listed):
        rest = counted(len(lost) - len(listed), "more robot")
        yield f"… and {rest} that lose less time (--json lists all)"


def _losses(words: Words, lost: Sequence[LostTime]) -> Iterator[str]:
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
        yield from wrapped(sentence_on(words, group))
    if len(largest) > MAX_LINES:
        yield f"… and {len(largest) - MAX_LINES} more (--json lists all)"
    yield from _detours(words, lost)
    yield from _homes_in_the_way(words, chain.from_iterable(groups.values()))


def _detours(words: Words, lost: Sequence[LostTime]) -> Iterator[str]:
    """Yield one sentence on the robots whose drives take longer than on their shortest trips."""
    longest = sorted(
        (robot for robot in lost if robot.detours > 0), key=lambda robot: -robot.detours
    )
    if not longest:
        return
    first, *others = longest[:MAX_DETOURS]
    write = further(words.quantities)
    listed = [f"{words.robot(first.robot)} {words.time(first.detours)}"]
    listed += [f"{words.robot(times.robot)} {write(times.detours)}" for times in others]
    rest = len(longest) - len(listed)
    more = f" and {counted(rest, 'more robot')}" if rest else ""
    yield ""
    yield from wrapped(f"Detours: {', '.join(listed)}{more}.")


def _homes_in_the_way(words: Words, losses: Iterable[Loss]) -> Iterator[str]:
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
        role = "home" if last == scenario.robots[robot].home else "last place"
        ranked = sorted(costs[robot], key=lambda other: -costs[robot][other])
        names = [*map(words.robot, ranked[:3]), *(["others"] if ranked[3:] else [])]
        listing = " and ".join(filter(None, (", ".join(names[:-1]), names[-1])))
        lost = words.time(sum(costs[robot].values()))
        yield from wrapped(
            f"{words.places.where(last)}, the {role} of {words.robot(robot)}, is on the way of"
            f" {listing} and costs {words.robot(robot)} {lost}: a {role} or a parking place off"
            " that way would help."
        )


def decision_log(plan: Plan, quantities: Quantities) -> str:
    """Return every decision of the planner with its reason, in the order they were taken."""
    words = Words(plan=plan, quantities=quantities)
    lines: list[str] = []
    for decision in plan.run.decisions:
        moment = quantities.moment(decision.tick)
        lines += wrapped(f"At {moment}: {decision_in_words(words, decision)}")
        lines += wrapped(explanation_of(words, decision), "    ")
    for reroute in plan.run.reroutes:
        lines += wrapped(f"{words.robot(reroute.robot)} is rerouted: {reroute.because}.")
    if lines:
        return "\n".join(lines)
    tracks = free_running(plan)
    if not collisions(plan.scenario, tracks) and not swaps(tracks):
        return "No decision was needed: no two robots meet."
    records = "The search that found this plan records no decisions, so no wait has a reason here"
    remedy = "`--planner two-level` plans with a reason for each decision"
    waits_listed = "`rightofway table PLAN --events` lists each wait and the robot waited for"
    return "\n".join(wrapped(f"{records} ({remedy}; {waits_listed})."))
