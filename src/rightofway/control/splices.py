"""Conditions of a splice (rule 10): released parts, jobs, lanes, and an order without a cycle."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from itertools import pairwise

from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import RouteToDrive
from rightofway.errors import InputError
from rightofway.precedence import ReleaseGraph

__all__ = ["refuse_changes", "refuse_rotation", "refuse_ways"]


def refuse_changes(
    robots: Sequence[RobotLedger],
    routes: Sequence[RouteToDrive],
    committed: Sequence[int],
    withdrawn: Collection[tuple[int, str]],
    placed: Collection[int],
) -> None:
    """Refuse routes that change what is released, or lose a job.

    Parameters
    ----------
    robots
        What is known of each robot.
    routes
        The new routes.
    committed
        The last part of each robot that they have to keep.
    withdrawn
        Robot and name of withdrawn jobs.
    placed
        Robots off the floor that were put at the begin of their routes.

    Raises
    ------
    InputError
        If a route changes what is released, or a job is lost.
    """
    for robot, (own, new, end) in enumerate(zip(robots, routes, committed, strict=True)):
        old, begin = own.route, max(own.route.first, new.first)
        if robot in placed:
            keeps_released = own.is_off and begin == old.end
        else:
            keeps_released = begin <= own.arrived and all(
                _keeps_visit(own, new, visit, is_last=visit == end)
                for visit in range(begin, end + 1)
            )
        if not keeps_released:
            message = "the route changes what is released (begin it with the released parts)"
            raise InputError.at(("routes", robot), message)
        unwanted = {job for other, job in withdrawn if other == robot}
        if lost := sorted(old.all_jobs - own.finished - new.all_jobs - unwanted):
            raise InputError.at(("routes", robot), f"{lost[0]} is in no visit (keep each job)")


def _keeps_visit(own: RobotLedger, new: RouteToDrive, visit: int, *, is_last: bool) -> bool:
    """Return whether a route keeps place and work of a visit.

    Work that no order has yet may change in the last one: it gets an order of its own.
    """
    before, after = own.route.get_jobs(visit), new.get_jobs(visit)
    if is_last and before != after:
        before = tuple(filter(own.is_sent, before))
        after = after[: len(before)]
    return own.route.get_place(visit) == new.get_place(visit) and before == after


def refuse_ways(
    routes: Sequence[RouteToDrive],
    committed: Sequence[int],
    names: Sequence[str],
    may_drive: Callable[[int, str, str], bool],
) -> None:
    """Refuse routes along which a robot may not drive.

    Parameters
    ----------
    routes
        The new routes.
    committed
        The last part of each robot that they have to keep; what is before was looked at earlier.
    names
        Of the robots.
    may_drive
        Tells whether a robot may drive from one place to the next.

    Raises
    ------
    InputError
        If no lane leads from one place to the next, or the robot is barred from it.
    """
    for robot, (route, end) in enumerate(zip(routes, committed, strict=True)):
        for tail, head in dict.fromkeys(pairwise(route.stretch(end, route.end))):
            if not may_drive(robot, tail, head):
                message = f"{names[robot]} may not drive from {tail} to {head}"
                remedy = "take lanes that are there and not barred for it"
                raise InputError.at(("routes", robot), f"{message} ({remedy})")


def refuse_rotation(graph: ReleaseGraph, names: Sequence[str]) -> None:
    """Refuse a release graph with a cycle.

    Parameters
    ----------
    graph
        Who waits for whom.
    names
        Of the robots.

    Raises
    ------
    InputError
        If robots move round a circle at one instant.
    """
    if cycle := graph.find_rotation():
        robots = ", ".join(names[robot] for robot in sorted({part.robot for part in cycle}))
        message = f"{robots} move round a circle at one instant, which orders cannot make safe"
        raise InputError.at("plan", f"{message} (plan with rotations: false)")
