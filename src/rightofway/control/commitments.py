"""Kept parts of routes when remaining routes are replanned, and remaining stops."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace

from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import RouteToDrive
from rightofway.model import Scenario
from rightofway.model.route import compute_drives_along
from rightofway.resume.rest_of_fleet import KeptPart, StopToMake

__all__ = [
    "RobotCommitment",
    "begin_at_stop",
    "find_last_open",
    "leave_out_unsent",
    "list_stops_to_make",
    "make_robot_commitment",
]


def list_stops_to_make(own: RobotLedger, released: int) -> list[StopToMake]:
    """Return the jobs and ends of laps of a robot behind what is released, in their order.

    Parameters
    ----------
    own
        What is known of the robot.
    released
        Its last part that is kept.
    """
    stops = []
    for visit in range(released + 1, own.route.end):
        place = own.route.get_place(visit)
        rows = zip(own.route.get_jobs(visit), own.route.get_work(visit), strict=True)
        stops += [StopToMake(place, job, work) for job, work in rows if job not in own.finished]
        stops += [StopToMake(place, ends_lap=True)] * own.route.lap_ends.count(visit)
    return stops


def find_last_open(
    own: RobotLedger,
    last: int,
    closed: Collection[tuple[str, str]],
    may_stop: Callable[[str], bool],
) -> int:
    """Return the visit up to which a robot enters nothing that is closed, ``last`` at most.

    Parameters
    ----------
    own
        What is known of the robot; what is released to it is looked at no more.
    last
        A visit of its route.
    closed
        Edges that robots shall not enter any more, as names of their vertices.
    may_stop
        Tells whether robots may stop at a vertex, by its name.
    """
    visit, route, end = own.released, own.route, own.released
    while visit < last and (route.get_place(visit), route.get_place(visit + 1)) not in closed:
        visit += 1
        end = visit if may_stop(route.get_place(visit)) else end
    return end


def begin_at_stop(own: RobotLedger, may_stop: Callable[[str], bool]) -> RobotLedger:
    """Return a robot as if it had arrived no further than where it last might stop.

    A drive through passed vertices is planned as a whole.

    Parameters
    ----------
    own
        Its state in the ledger.
    may_stop
        Tells whether robots may stop at a vertex, by its name.
    """
    visit = own.arrived
    while visit > own.route.first and not may_stop(own.route.get_place(visit)):
        visit -= 1
    return own if visit == own.arrived else replace(own, arrived=visit)


def leave_out_unsent(own: RobotLedger, last: int) -> RobotLedger:
    """Return a robot without the work of its last kept visit that no order contains.

    Parameters
    ----------
    own
        Its state in the ledger.
    last
        The last visit that it keeps.
    """
    route, index = own.route, last - own.route.first
    rows = zip(route.jobs[index], route.work[index], strict=True)
    sent = [(item, ticks) for item, ticks in rows if own.is_sent(item)]
    jobs = (*route.jobs[:index], tuple(item for item, _ in sent), *route.jobs[index + 1 :])
    work = (*route.work[:index], tuple(ticks for _, ticks in sent), *route.work[index + 1 :])
    return replace(own, route=replace(route, jobs=jobs, work=work))


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotCommitment:
    """The kept part of a robot's route, from the visit on at which it has arrived."""

    route: RouteToDrive  # up to the last released part
    part: KeptPart


def make_robot_commitment(
    scenario: Scenario, robot: int, own: RobotLedger, released: int
) -> RobotCommitment:
    """Return what a robot keeps, up to its last released part.

    Parameters
    ----------
    scenario
        The problem.
    robot
        Its number.
    own
        Its state in the ledger.
    released
        Its last part that is kept.
    """
    route = own.route.cut_before(own.arrived)
    length = released - own.arrived + 1
    roadmap = scenario.roadmap
    vertices = tuple(roadmap.unfold_route(list(map(roadmap.get_vertex, route.places[:length]))))
    work = sum(
        ticks
        for names, times in zip(route.jobs[:length], route.work[:length], strict=True)
        for job, ticks in zip(names, times, strict=True)
        if job not in own.finished
    )
    itinerary = scenario.problem.itineraries[robot]
    drives = compute_drives_along(roadmap, itinerary, vertices) if length > 1 else []
    return RobotCommitment(
        route=route.cut_after(released),
        part=KeptPart(vertices, work, work + sum(drives)),
    )
