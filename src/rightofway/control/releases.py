"""Parts that may be released to a robot (rule 4): nothing that excludes them is held by others.

Who goes first has arrived beyond; no person, closure or stray robot is in the way. Messages of
robots of themselves holds releases back in the control, and never lets one go.
"""

from __future__ import annotations

from collections.abc import Callable

from rightofway.control.ledger import Ledger, Names
from rightofway.control.robot_ledger import RobotLedger
from rightofway.precedence import Part

__all__ = ["find_closed", "find_last_part", "is_in_base", "list_strayed_to"]


def find_last_part(
    ledger: Ledger,
    robot: int,
    ahead: int,
    is_in_base: Callable[[RobotLedger, int], bool],
    *,
    may_enter: Callable[[int, int], bool],
    may_stop: Callable[[str], bool],
) -> int:
    """Return the last part that may be released now; that which is released if none may.

    Released parts end at a vertex where the robot may stop.

    Parameters
    ----------
    ledger
        The state that the journal describes.
    robot
        A robot that is fit.
    ahead
        How many parts beyond the vertex last arrived at may be released.
    is_in_base
        Tells whether a robot holds the vertex of a part already.
    may_enter
        Tells of a robot whether nothing else keeps it from a part, if all before it is released.
    may_stop
        Tells whether robots may stop at a vertex, by its name.
    """
    own, end = ledger.robots[robot], ledger.robots[robot].released
    # Rule 4: a robot that a person holds, or that is faulty (rule 11), gets nothing more.
    if own.is_on_hold or own.fault is not None:
        return end
    route, last, arrived = own.route, min(own.arrived + ahead, own.route.end - 1), list[int]()
    # Look-ahead bounds the base, but a base never ends where robots may not stop.
    while last < own.route.end - 1 and not may_stop(route.get_place(last)):
        last += 1
    part = end
    while (
        part < last
        # Each HARD action of the vertex before is finished.
        and own.finished.issuperset(route.get_jobs(part))
        # No node twice in a base: else a robot that forgot its order could drive a loop twice.
        and not is_in_base(own, part + 1)
        # All arrivals that the part waits for are known. They stay true, so no clock is read.
        and ledger.graph.may_go(Part(robot, part + 1), arrived := arrived or ledger.arrived)
        # Closures by people, robots that strayed, and closures by the clock only hold back.
        and find_closed(ledger, route.get_place(part), route.get_place(part + 1)) is None
        and not list_strayed_to(ledger, route.get_place(part + 1))
        and may_enter(robot, part + 1)
    ):
        # A part is released only together with those up to the next vertex where robots may stop.
        part += 1
        end = part if may_stop(route.get_place(part)) else end
    return end


def is_in_base(own: RobotLedger, part: int) -> bool:
    """Return whether a robot holds the vertex of a part already, by an earlier part.

    A robot that forgot its order would take an update again whose way ends where it began, and
    drive it twice.
    """
    return own.route.get_place(part) in own.route.stretch(own.arrived, part)


def find_closed(ledger: Ledger, tail: str, head: str) -> Names | None:
    """Return the closure that keeps robots off an edge; None where it is open."""
    return next((names for names, edges in ledger.closed.items() if (tail, head) in edges), None)


def list_strayed_to(ledger: Ledger, place: str) -> list[int]:
    """Return the faulty robots whose states name a place."""
    return [robot for robot, other in enumerate(ledger.robots) if other.strays_at == place]
