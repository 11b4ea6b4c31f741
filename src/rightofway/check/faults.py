"""What the judge says: faults, each with who, where, when and what would be right."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Scenario, Tick
from rightofway.model.place_names import PlaceNames
from rightofway.phrases import Phrase
from rightofway.quantities import Quantities
from rightofway.site import VertexId

FaultKind = Literal[
    "unknown vertex",
    "wrong home",
    "backwards",
    "jump",
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
]
"""The ways a plan can be wrong.

===================  ===============================================================================
``unknown vertex``   a visit is at a vertex that the roadmap does not have
``wrong home``       the first visit is not at home, or not from tick 0
``backwards``        a visit ends before it begins
``jump``             no edge joins two visits, or one vertex is entered twice in a row
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
===================  ===============================================================================
"""


PLURALS: Mapping[FaultKind, str] = {
    "unknown vertex": "unknown vertices",
    "wrong home": "wrong homes",
    "jump": "jumps",
    "turn cut short": "turns cut short",
    "stop missed": "stops missed",
    "wrong end": "wrong ends",
    "vertex conflict": "vertex conflicts",
    "headway": "headways",
    "swap conflict": "swap conflicts",
    "rotation": "rotations",
    "space conflict": "space conflicts",
    "zone conflict": "zone conflicts",
}
"""Of several faults of a kind; a kind that is not a noun has none."""


Verdict = tuple[Phrase, Phrase]
"""What is wrong, and what would be right."""

ONE_AFTER_THE_OTHER = Phrase("let one come when the other has left")
"""What would be right where two robots are in one place."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Fault:
    """One place where a plan breaks a rule.

    Attributes
    ----------
    kind
        Which rule.
    robots
        Who breaks it, by index, increasing.
    vertices
        Where. For a jump or a drive its tail and head; for a swap the vertex that each robot
        leaves; for a rotation the circle; for robots that are too near the vertex or the ends of
        the edge of the first one, then those of the second one.
    tick
        When it begins [ticks].
    reason
        The same for people.
    remedy
        What would be right, for people.
    moment
        When it begins, for people.
    """

    kind: FaultKind
    robots: tuple[int, ...]
    vertices: tuple[VertexId, ...]
    tick: Tick
    reason: str
    remedy: str
    moment: str = ""

    @property
    def message(self) -> str:
        """What is wrong, with what would be right in brackets."""
        return f"{self.reason} ({self.remedy})"

    def __str__(self) -> str:
        return f"{self.moment or f'tick {self.tick}'}: {self.kind}: {self.message}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Report:
    """The judgement of a plan.

    Attributes
    ----------
    faults
        The earliest faults, by tick, then by robots.
    counts
        How many faults there are of each kind that occurs, those not listed included.
    """

    faults: tuple[Fault, ...]
    counts: Mapping[FaultKind, int]

    @property
    def ok(self) -> bool:
        """Whether the plan keeps every rule."""
        return not self.counts

    @property
    def total(self) -> int:
        """How many faults there are, those not listed included."""
        return sum(self.counts.values())

    @property
    def summary(self) -> str:
        """The number of faults of each kind, in a line."""
        kinds = ", ".join(
            f"{count} {kind if count == 1 else PLURALS.get(kind, kind)}"
            for kind, count in self.counts.items()
        )
        return f"{self.total} fault{'s' * (self.total != 1)}: {kinds}" if kinds else "no fault"

    def __str__(self) -> str:
        unlisted = self.total - len(self.faults)
        more = [f"and {unlisted} more (raise the limit to list them)"] if unlisted else []
        return "\n".join([self.summary, *map(str, self.faults), *more])


class FaultCollector:
    """Counts all faults, in any order, and keeps the earliest: a bad plan may have millions."""

    def __init__(self, limit: int, names: Names) -> None:
        self._limit = limit
        self._names = names
        self._counts: Counter[FaultKind] = Counter()
        self._kept: list[Fault] = []

    def add(self, fault: Fault) -> None:
        """Add one fault."""
        self._counts[fault.kind] += 1
        self._kept.append(fault)

    def add_all(
        self,
        kind: FaultKind,
        ticks: NDArray[Any],
        robots: tuple[NDArray[Any], ...],
        fault_at: Callable[[int], Fault],
    ) -> None:
        """Add many faults of a kind that begin at ``ticks``; arrays have shape (n,).

        ``robots`` are as in `Fault`, one array for each place in the tuple. ``fault_at`` makes the
        fault of a position in these arrays; it is called for the earliest only.
        """
        if len(ticks):
            self._counts[kind] += len(ticks)
            earliest = np.lexsort((*reversed(robots), ticks))[: self._limit]
            self._kept.extend(fault_at(int(position)) for position in earliest)

    def report(self) -> Report:
        """Return the judgement on all faults added."""
        self._kept.sort(key=lambda fault: (fault.tick, fault.robots, fault.kind, fault.vertices))
        listed = self._kept[: self._limit]
        return Report(
            faults=tuple(replace(fault, moment=self._names.moment(fault.tick)) for fault in listed),
            counts=dict(sorted(self._counts.items())),
        )


@dataclass(frozen=True)
class Names:
    """What people call robots and places of a scenario, and how times are written."""

    scenario: Scenario
    quantities: Quantities

    def robot(self, index: int) -> str:
        """Return a robot's name."""
        return self.scenario.robots[index].name

    def vertex(self, vertex: int) -> str:
        """Return what people call a vertex, whether the roadmap has it or not."""
        if 0 <= vertex < self.scenario.roadmap.n_vertices:
            return self.places(vertex)
        return Phrase("vertex {number}", number=str(vertex))

    @cached_property
    def places(self) -> PlaceNames:
        """What people call the vertices."""
        return PlaceNames(self.scenario, numbered=True)

    def moment(self, tick: int) -> str:
        """Return a point in time: ``time 2``, ``6 min 23 s``."""
        return self.quantities.moment(int(tick))

    def until(self, tick: int) -> str:
        """Return a point in time that follows another one in a sentence: ``2``, ``6 min 23 s``."""
        has_unit = self.quantities.time_unit and not self.quantities.in_ticks
        return self.moment(tick) if has_unit else self.quantities.cell(int(tick))

    def duration(self, ticks: int) -> str:
        """Return how long something lasts: ``2 time units``."""
        return self.quantities.duration(int(ticks))
