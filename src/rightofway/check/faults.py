"""What the judge says: faults, each with who, where, when and what would be right."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Scenario, Tick
from rightofway.model.place_names import PlaceNames
from rightofway.phrases import Phrase, chain_items, say_count
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


FAULT_NAMES: Mapping[FaultKind, tuple[Phrase, Phrase]] = {
    "unknown vertex": (Phrase("unknown vertex"), Phrase("unknown vertices")),
    "wrong home": (Phrase("wrong home"), Phrase("wrong homes")),
    "backwards": (Phrase("backwards"), Phrase("backwards")),
    "jump": (Phrase("jump"), Phrase("jumps")),
    "too fast": (Phrase("too fast"), Phrase("too fast")),
    "turn cut short": (Phrase("turn cut short"), Phrase("turns cut short")),
    "work cut short": (Phrase("work cut short"), Phrase("work cut short")),
    "stop missed": (Phrase("stop missed"), Phrase("stops missed")),
    "wrong end": (Phrase("wrong end"), Phrase("wrong ends")),
    "vertex conflict": (Phrase("vertex conflict"), Phrase("vertex conflicts")),
    "headway": (Phrase("headway"), Phrase("headways")),
    "swap conflict": (Phrase("swap conflict"), Phrase("swap conflicts")),
    "rotation": (Phrase("rotation"), Phrase("rotations")),
    "space conflict": (Phrase("space conflict"), Phrase("space conflicts")),
    "too close": (Phrase("too close"), Phrase("too close")),
    "zone conflict": (Phrase("zone conflict"), Phrase("zone conflicts")),
    "closed": (Phrase("closed"), Phrase("closed")),
    "barred": (Phrase("barred"), Phrase("barred")),
}
"""What people call a fault of each kind, and several of it."""


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
        return Phrase("{reason} ({remedy})", reason=self.reason, remedy=self.remedy)

    @property
    def sentence(self) -> str:
        """When it begins, what kind of fault it is, and the message."""
        return Phrase(
            "{moment}: {kind}: {message}",
            moment=self.moment or Phrase("tick {tick}", tick=str(self.tick)),
            kind=FAULT_NAMES[self.kind][0],
            message=self.message,
        )

    def __str__(self) -> str:
        return str(self.sentence)


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
        if self.ok:
            return Phrase("no fault")
        kinds = [
            Phrase("{number} {kind}", number=str(count), kind=FAULT_NAMES[kind][count != 1])
            for kind, count in self.counts.items()
        ]
        return Phrase(
            "{faults}: {kinds}",
            faults=say_count(self.total, "fault", "faults"),
            kinds=chain_items(kinds),
        )

    def __str__(self) -> str:
        return "\n".join(self.list_sentences())

    def list_sentences(self) -> Iterator[str]:
        """Yield the number of faults of each kind, and each fault that is listed."""
        yield self.summary
        for fault in self.faults:
            yield fault.sentence
        if unlisted := self.total - len(self.faults):
            number = str(unlisted)
            yield Phrase("and {number} more (raise the limit to list them)", number=number)


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
            faults=tuple(
                replace(fault, moment=self._names.say_moment(fault.tick)) for fault in listed
            ),
            counts=dict(sorted(self._counts.items())),
        )


@dataclass(frozen=True)
class Names:
    """What people call robots and places of a scenario, and how times are written."""

    scenario: Scenario
    quantities: Quantities

    def name_robot(self, index: int) -> str:
        """Return a robot's name."""
        return self.scenario.robots[index].name

    def name_vertex(self, vertex: int) -> str:
        """Return what people call a vertex, whether the roadmap has it or not."""
        if 0 <= vertex < self.scenario.roadmap.n_vertices:
            return self.places(vertex)
        return Phrase("vertex {number}", number=str(vertex))

    @cached_property
    def places(self) -> PlaceNames:
        """What people call the vertices."""
        return PlaceNames(self.scenario, numbered=True)

    def say_moment(self, tick: int) -> str:
        """Return a point in time: ``time 2``, ``6 min 23 s``."""
        return self.quantities.format_moment(int(tick))

    def say_until(self, tick: int) -> str:
        """Return a point in time that follows another one in a sentence: ``2``, ``6 min 23 s``."""
        has_unit = self.quantities.time_unit and not self.quantities.in_ticks
        return self.say_moment(tick) if has_unit else self.quantities.format_cell(int(tick))

    def say_duration(self, ticks: int) -> str:
        """Return how long something lasts: ``2 time units``."""
        return self.quantities.format_duration(int(ticks))
