"""Faults of a plan, as the judge finds them: kind, robots, vertices, tick and numbers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.facts import get_teller
from rightofway.model import Scenario, Tick
from rightofway.site import VertexId

FaultKind = Literal[
    "unknown vertex",
    "wrong home",
    "backwards",
    "jump",
    "forbidden turn",
    "too fast",
    "turn cut short",
    "work cut short",
    "stop missed",
    "wrong end",
    "vertex conflict",
    "headway",
    "swap conflict",
    "rotation",
    "space conflict",
    "too close",
    "zone conflict",
    "closed",
    "barred",
    "stop at pass",
    "wrong start",
    "before ready",
    "outside visit",
    "wrong duration",
    "items overlap",
    "wrong stop",
    "wrong load",
    "too early",
    "too late",
    "stop not done",
    "stop done again",
    "job divided",
    "stop order",
    "wrong robot",
    "also unserved",
    "begun unserved",
    "after unserved",
    "wrong order",
    "wrong charger",
    "low battery",
    "stranded",
]
"""Kinds of faults of plans.

===================  ===============================================================================
``unknown vertex``   a visit is at a vertex that the roadmap does not have
``wrong home``       the first visit is not at home, or not from tick 0
``backwards``        a visit ends before it begins
``jump``             no edge joins two visits, or one vertex is entered twice in a row
``forbidden turn``   a robot turns inside a lane, or at a vertex where it may not
``too fast``         an edge is driven in less than the robot's ticks for it
``turn cut short``   a change of heading takes less than the robot's ticks for it
``work cut short``   a stop is visited, but never for long enough to work and turn
``stop missed``      a stop is not visited after the one before it
``wrong end``        the last visit is not where the trip ends
``vertex conflict``  two robots book one vertex at the same time
``headway``          they would not without the headway: one comes too soon after the other
``swap conflict``    two robots exchange two vertices at the same instant
``rotation``         three or more robots move round a circle at one instant, where rules forbid it
``space conflict``   two robots book places at one time that are too near for their sizes
``too close``        two robots come nearer to each other than their sizes and the clearance allow
``zone conflict``    two robots book one zone at the same time
``closed``           a robot books a vertex or an edge while that is closed
``barred``           a robot drives along an edge that is barred for its type, or into a wall
``stop at pass``     a robot stays longer at a passed vertex than it needs to drive through
``wrong start``      with jobs: the first visit is not where the robot begins, or not from tick 0
``before ready``     a robot drives, turns, works or charges before it is ready
``outside visit``    work or a charge is not inside its visit, before its turning and drive
``wrong duration``   work at a stop takes longer or shorter than it should
``items overlap``    an item of a tour begins before the end of the item before it
``wrong stop``       the work of a stop is done at another vertex
``wrong load``       after a stop the load is negative, or above the capacity
``too early``        the work of a stop begins before its ``earliest``
``too late``         the work of a stop ends after its ``latest``
``stop not done``    a stop of a job is in no tour, and the job is not named as unserved
``stop done again``  a stop is done twice, or was done before the plan
``job divided``      several robots do stops of one job
``stop order``       a stop is done after a later one of its job
``wrong robot``      a job is done by a robot that may not do it
``also unserved``    a job is named as unserved, and done
``begun unserved``   a job that a robot has begun is unserved
``after unserved``   a job is done that follows an unserved one
``wrong order``      a job begins before the end of a job that it follows
``wrong charger``    a robot charges at a vertex where it may not
``low battery``      the state of charge is below the least one
``stranded``         a robot rests with too little left for the way to a charging place
===================  ===============================================================================
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Fault:
    """One place where a plan breaks a rule.

    Attributes
    ----------
    kind
        Which rule.
    robots
        The robots that break it, by index, increasing.
    vertices
        Where. For a jump or a drive its tail and head; for a swap the vertex that each robot
        leaves; for a rotation the circle; for robots that are too near the vertex or the ends of
        the edge of the first one, then those of the second one.
    tick
        When it begins [ticks].
    numbers
        Other values of its kind: durations and moments in ticks, lengths, names of zones.
    scenario
        The scenario that robots, vertices and ticks are of.

    Notes
    -----
    ``str(fault)`` is an English sentence: when, which rule, how, and a remedy.
    """

    kind: FaultKind
    robots: tuple[int, ...]
    vertices: tuple[VertexId, ...]
    tick: Tick
    numbers: Mapping[str, Any] = field(default_factory=dict)
    scenario: Scenario = field(repr=False, compare=False)

    @property
    def message(self) -> str:
        """The reason and a remedy, in English."""
        return get_teller().write_message(self)

    def __str__(self) -> str:
        return get_teller().tell_fact(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class Report:
    """The judgement of a plan.

    Attributes
    ----------
    faults
        The earliest faults, by tick, then by robots.
    counts
        The number of faults of each kind that occurs, including those not listed.
    """

    faults: tuple[Fault, ...]
    counts: Mapping[FaultKind, int]

    @property
    def ok(self) -> bool:
        """Whether the plan keeps every rule."""
        return not self.counts

    @property
    def total(self) -> int:
        """The number of faults, including those not listed."""
        return sum(self.counts.values())

    @property
    def summary(self) -> str:
        """The number of faults of each kind, in an English line."""
        return get_teller().summarize_report(self)

    def __str__(self) -> str:
        return get_teller().tell_fact(self)


class FaultGroup(NamedTuple):
    """Faults of one kind that a rule found at once: a bad plan may have millions.

    Attributes
    ----------
    kind
        Which rule.
    ticks
        When each begins [ticks]; shape (n,).
    robots
        As in `Fault`, an array of shape (n,) for each place in the tuple.
    make
        Makes the fault of a position in these arrays; it is called for the earliest only.
    """

    kind: FaultKind
    ticks: NDArray[Any]
    robots: tuple[NDArray[Any], ...]
    make: Callable[[int], Fault]


def make_report(faults: Iterable[Fault | FaultGroup], limit: int) -> Report:
    """Count all faults, and list the earliest, as many as ``limit``."""
    counts, listed = Counter[FaultKind](), list[Fault]()
    for group in faults:
        if isinstance(group, Fault):
            counts[group.kind] += 1
            listed.append(group)
        elif len(group.ticks):
            counts[group.kind] += len(group.ticks)
            earliest = np.lexsort((*reversed(group.robots), group.ticks))[:limit]
            listed.extend(map(group.make, earliest.tolist()))
    listed.sort(key=lambda fault: (fault.tick, fault.robots, fault.kind, fault.vertices))
    return Report(faults=tuple(listed[:limit]), counts=dict(sorted(counts.items())))
