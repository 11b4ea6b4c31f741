"""A plan with jobs, which tests vary: two robots, four jobs, a battery and a charge."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from rightofway.model import (
    Battery,
    Job,
    JobStop,
    Plan,
    PlannedItem,
    PlannerRun,
    Robot,
    RobotState,
    Scenario,
    Tick,
    Track,
)
from rightofway.site import VertexId, make_grid_roadmap

F, V = Fraction, VertexId

# The rows 0 1 2 3 4 and 5 6 7 8 9; a drive takes a tick, and so does the turn at a stop.
GRID = [".....", "....."]
BATTERY = Battery(drive=F(1, 10), on=F(1, 100), work=F(1, 50), charge=F(1, 5), reserve=F(1, 5))
STATE = RobotState(at=V(9), ready=F(2), begun=(("J3", 1),))
ROBOTS = (
    Robot(name="R1", home=V(0), battery="large", charging=(V(0), V(1))),
    Robot(name="R2", home=V(4), type="fork", start=STATE),
)
JOBS = (
    Job(
        name="J1",
        stops=(
            JobStop(at=V(1), work=F(2), load=1, earliest=F(3)),
            JobStop(at=V(3), work=F(1), load=-1, latest=F(9)),
        ),
    ),
    Job(name="J2", stops=(JobStop(at=V(8), work=F(3)),), types=("fork",), after=("J1",)),
    Job(name="J3", stops=(JobStop(at=V(8), load=1), JobStop(at=V(7), load=-1, latest=F(0)))),
    Job(name="J4", stops=(JobStop(at=V(2)),), after=("J1",)),
)
TRACKS = (
    ([0, 1, 2, 3, 2, 1, 0], [0, 1, 7, 8, 11, 12, 13]),
    ([9, 8, 7, 8, 9, 4], [0, 3, 4, 6, 14, 15]),
)


def item(visit: int, begin: int, end: int, job: int | None = None, stop: int = 0) -> PlannedItem:
    """Return the work at a stop of a job, or a charge."""
    place = None if job is None else stop
    return PlannedItem(visit=visit, begin=Tick(begin), end=Tick(end), job=job, stop=place)


FIRST = [item(1, 3, 5, 0), item(3, 8, 9, 0, 1), item(6, 13, 15)]
SECOND = [item(2, 4, 4, 2, 1), item(3, 9, 12, 1)]


def make_plan(
    first: Sequence[PlannedItem] = FIRST,
    second: Sequence[PlannedItem] = SECOND,
    *,
    tracks: Sequence[tuple[Sequence[int], Sequence[int]]] = TRACKS,
    unserved: Sequence[int] = (3,),
    **changes: Any,
) -> Plan:
    """Return the plan of which faults are variations: R1 does J1 and charges, R2 does J3 and J2."""
    known = {
        "roadmap": make_grid_roadmap(GRID),
        "robots": ROBOTS,
        "jobs": JOBS,
        "batteries": {"large": BATTERY},
    }
    return Plan(
        scenario=Scenario(**{**known, **changes}),
        tracks=tuple(Track.of(*track) for track in tracks),
        run=PlannerRun(),
        tours=(tuple(first), tuple(second)),
        unserved=tuple((job, "not found") for job in unserved),
    )
