"""A fleet that repeats its work: every group until its pattern repeats, or time is over."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Literal

from rightofway.cyclic.backjumping import Deadlock
from rightofway.cyclic.groups import independent_groups
from rightofway.cyclic.native_rules import Native
from rightofway.cyclic.pattern import pattern_of
from rightofway.cyclic.result import CyclicResult, GroupRun
from rightofway.cyclic.rolling_horizon import Rolling
from rightofway.cyclic.route import CyclicRoute, cyclic_routes
from rightofway.cyclic.rules import FAR_SIGHTED, RULES
from rightofway.cyclic.window import Ground
from rightofway.errors import GaveUp, InputError, kernel_limits
from rightofway.model import Scenario, checked_time_limit
from rightofway.planners import Deadline, Task, planning_headway

__all__ = ["ROUTES", "go_on", "make_simulator", "run_group", "run_laps", "share_time"]

ROUTES = ("clear", "direct", "shortest")
"""How round trips may be chosen."""

LEAST_SHARE = 0.05
"""The part of the time left that a group may take at first, however small it is."""


@kernel_limits()
def run_laps(
    scenario: Scenario,
    rule: str = "first-come",
    *,
    routes: str = "clear",
    time_limit: float | None = 10,
    report: Callable[[str], None] | None = None,
) -> CyclicResult:
    """Let every robot repeat its round trip until the pattern of the fleet repeats.

    Parameters
    ----------
    scenario
        The problem; its number of laps plays no part.
    rule
        Who goes first where two robots meet: ``first-come``, ``fixed-order`` (the first in the
        scenario), ``least-loss`` (who would lose the larger part of its lap) or ``two-level`` (as
        the paper does).
    routes
        How the round trips are chosen, once and for all laps: ``clear``, ``direct`` or
        ``shortest``.
    time_limit
        When to stop [s]; None for no limit. Groups get shares of it by their size; those that are
        open then go on with what is left.
    report
        Takes sentences on the progress.

    Returns
    -------
    LapsRun
        What each independent group of robots does.

    Raises
    ------
    InputError
        For an unknown rule, or a robot that has no lap to repeat.
    NoPlanExists
        If a robot has no way to a place.

    Notes
    -----
    Exact: a pattern is reported when a state came again, so that it repeats for ever. A group whose
    state has not come again in time has an open end. Where the time limit is not reached, the same
    scenario has the same result.
    """
    _refuse_unknown("rule", rule, tuple(RULES))
    _refuse_unknown("routes", routes, ROUTES)
    deadline = Deadline.after(checked_time_limit(time_limit))
    groups = independent_groups(cyclic_routes(scenario, routes))
    going = [make_simulator(Task(scenario=scenario), group, rule) for group in groups]
    return CyclicResult(
        scenario=scenario,
        rule=rule,
        routes=routes,
        groups=tuple(share_time(going, deadline, report or (lambda _: None))),
    )


def share_time(
    going: Sequence[Rolling | Native], deadline: Deadline, report: Callable[[str], None]
) -> list[GroupRun]:
    """Let all groups go on, small ones first, and those that are open again with what is left."""
    found: dict[int, GroupRun] = {}
    sizes = [len(one.ground.group) for one in going]
    open_ones = sorted(range(len(going)), key=lambda index: sizes[index])
    while open_ones:
        left = sum(sizes[index] for index in open_ones)
        for index in open_ones:
            known = sum(one.ends != "open" for one in found.values())
            report(f"{known} of {len(going)} groups done, next one of {sizes[index]} robots")
            share = deadline.sooner(max(sizes[index] / left, LEAST_SHARE))
            left -= sizes[index]
            found[index] = go_on(going[index], share)
        open_ones = [index for index in open_ones if found[index].ends == "open"]
        if deadline.seconds_left() == 0:
            break
    return [found[index] for index in range(len(going))]


def _refuse_unknown(key: str, given: str, known: Sequence[str]) -> None:
    if given not in known:
        raise InputError.at(key, f"{given!r} is unknown (choose {', '.join(known)})")


def run_group(task: Task, group: Sequence[CyclicRoute], rule: str) -> GroupRun:
    """Let one group repeat its round trips until its pattern repeats; see `run_laps`."""
    return go_on(make_simulator(task, group, rule), task.deadline)


def make_simulator(task: Task, group: Sequence[CyclicRoute], rule: str) -> Rolling | Native:
    """Return a group at its beginning."""
    ground = Ground(
        task=replace(task, options={"swaps": "resolve"}),
        group=group,
        headway=planning_headway(task.scenario),
        books_ahead=task.scenario.rules.books_ahead,
    )
    return Rolling(ground, rule) if rule in FAR_SIGHTED else Native(ground, rule)


def go_on(going: Rolling | Native, deadline: Deadline) -> GroupRun:
    """Let a group go on until its pattern repeats; where time runs out, it can be asked again."""
    ends: Literal["repeats", "deadlock", "open"] = "repeats"
    group, pattern, why = going.ground.group, None, ""
    try:
        known = going.until_it_repeats(deadline)
        pattern = pattern_of(going.history, [len(endless.lap) for endless in group], known)
    except Deadlock as deadlock:
        ends, why = "deadlock", _explain(deadlock, going.ground)
    except GaveUp:
        ends, why = "open", "no state came again within the time limit"
    history = pattern.history if pattern else going.history
    return GroupRun(ends=ends, why=why, group=tuple(group), history=tuple(history), pattern=pattern)


def _explain(deadlock: Deadlock, ground: Ground) -> str:
    scenario = ground.task.scenario
    names = [scenario.robots[endless.robot].name for endless in ground.group]
    i, j = (names[robot] for robot in deadlock.robots)
    where = f"at {scenario.roadmap.name(deadlock.vertex)}, tick {deadlock.tick}"
    why = f"waiting cannot keep {i} and {j} apart {where}"
    if len(deadlock.circle) < 3:  # noqa: PLR2004 (the two themselves)
        return why
    circle = ", ".join(names[robot] for robot in deadlock.circle)
    return f"{why}: in a circle, {circle} would each wait for the next"
