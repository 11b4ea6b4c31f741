"""The track of each robot: from its home along edges, no faster than it can, through all stops."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from heapq import heappop, heappush

import numpy as np
from numpy.typing import NDArray

from rightofway.check.faults import Fault, FaultCollector, FaultKind, Names
from rightofway.check.turning import MICRO
from rightofway.check.visits import Visits
from rightofway.model import Itinerary, Plan, Stage, Tick
from rightofway.quantities import decimal
from rightofway.site import VertexId


def judge_drives(visits: Visits, names: Names, collector: FaultCollector) -> None:
    """Find unknown vertices, jumps, drives that are too fast and times that go backwards."""

    def robot(visit: int) -> str:
        return names.robot(int(visits.robot[visit]))

    def vertex(visit: int) -> str:
        return names.vertex(int(visits.vertex[visit]))

    def unknown(visit: int) -> str:
        n_vertices = names.scenario.roadmap.n_vertices
        return (
            f"{robot(visit)} enters {vertex(visit)}, which is not on the roadmap"
            f" (its vertices are 0 to {n_vertices - 1})"
        )

    def backwards(visit: int) -> str:
        return (
            f"{robot(visit)} enters {vertex(visit)} at {names.moment(visits.enter[visit])}, but"
            f" {vertex(visit + 1)} after it at {names.moment(visits.leave[visit])}"
            f" (later visits have later times)"
        )

    def jump(visit: int) -> str:
        tail, head = vertex(visit), vertex(visit + 1)
        if tail == head:
            return f"{robot(visit)} enters {tail} twice in a row (make it one visit)"
        return f"{robot(visit)} goes from {tail} to {head}, no edge leads there (use edges)"

    def too_fast(visit: int) -> str:
        drive = visits.drive[visit]
        return (
            f"{robot(visit)} drives from {vertex(visit)} to {vertex(visit + 1)}"
            f" in {names.duration(stay[visit])}, it needs {names.duration(drive)}"
            f" (enter at {names.moment(visits.enter[visit] + drive)} or later)"
        )

    def report(kind: FaultKind, broken: NDArray[np.bool_], message: Callable[[int], str]) -> None:
        where = np.flatnonzero(broken)
        # An unknown vertex is wrong as soon as it is entered, a move at the instant it is made.
        times, ends = (visits.enter, 1) if kind == "unknown vertex" else (visits.leave, 2)

        def fault(position: int) -> Fault:
            visit = int(where[position])
            return Fault(
                kind=kind,
                robots=(int(visits.robot[visit]),),
                vertices=tuple(map(VertexId, visits.vertex[visit : visit + ends].tolist())),
                tick=Tick(int(times[visit])),
                message=message(visit),
            )

        collector.add_all(kind, times[where], (visits.robot[where],), fault)

    stay, moves, joined = visits.leave - visits.enter, ~visits.last, visits.edge >= 0
    both_known = visits.known & np.roll(visits.known, -1)
    report("unknown vertex", ~visits.known, unknown)
    report("backwards", moves & (stay < 0), backwards)
    report("jump", moves & both_known & ~joined, jump)
    report("too fast", joined & (stay >= 0) & (stay < visits.drive), too_fast)


def judge_turns(visits: Visits, names: Names, collector: FaultCollector) -> None:
    """Find changes of heading that are too fast."""
    stay = visits.leave - visits.enter
    broken = (visits.edge >= 0) & (stay >= visits.drive) & (stay < visits.drive + visits.turn)
    where = np.flatnonzero(broken)

    def fault(position: int) -> Fault:
        visit = int(where[position])
        robot, ends = int(visits.robot[visit]), visits.vertex[visit : visit + 2].tolist()
        at, to = map(names.vertex, ends)
        least = visits.turn[visit] + visits.drive[visit]
        message = (
            f"{names.robot(robot)} turns {decimal(Fraction(int(visits.angle[visit]), MICRO), 6)}"
            f" degrees at {at} in {names.duration(stay[visit] - visits.drive[visit])}, it needs"
            f" {names.duration(visits.turn[visit])} (enter {to} at"
            f" {names.moment(visits.enter[visit] + least)} or later)"
        )
        return Fault(
            kind="turn cut short",
            robots=(robot,),
            vertices=(VertexId(ends[0]),),
            tick=Tick(int(visits.leave[visit])),
            message=message,
        )

    collector.add_all("turn cut short", visits.leave[where], (visits.robot[where],), fault)


def judge_trips(plan: Plan, visits: Visits, names: Names, collector: FaultCollector) -> None:
    """Find wrong homes, wrong ends, missed stops and work cut short."""
    spare = np.maximum(visits.leave - visits.enter - visits.drive - visits.turn, 0).tolist()
    begin = 0
    for robot, track in enumerate(plan.tracks):
        end = begin + len(track)
        trip = _Trip(
            robot=robot,
            itinerary=plan.scenario.problem.itineraries[robot],
            vertices=track.vertices.tolist(),
            enter=track.enter.tolist(),
            spare=spare[begin:end],
            names=names,
        )
        for fault in trip.faults():
            collector.add(fault)
        begin = end


@dataclass(slots=True, kw_only=True)
class _Trip:
    """A robot's track against its itinerary.

    `spare` is how long each visit lasts beyond the drive that ends it and the turn before, less
    what has been worked there so far [ticks]; the last visit's counts for nothing, it never ends.
    `too_short` holds, for each stage, which may recur in every lap, the visits that were: a heap of
    (-spare, visit).
    """

    robot: int
    itinerary: Itinerary
    vertices: list[int]
    enter: list[int]
    spare: list[int]
    names: Names
    too_short: dict[Stage, list[tuple[int, int]]] = field(default_factory=dict)

    def faults(self) -> Iterator[Fault]:
        yield from self._ends()
        yield from self._work()

    def _ends(self) -> Iterator[Fault]:
        home, last = self.itinerary.home, self.itinerary.stages[-1].vertex
        name, vertex = self._name, self.names.vertex
        if self.vertices[0] != home or self.enter[0] != 0:
            message = (
                f"{name} starts at {vertex(self.vertices[0])} at"
                f" {self.names.moment(self.enter[0])} (start at its home, {vertex(home)}, at"
                f" {self.names.moment(0)})"
            )
            yield self._fault("wrong home", self.vertices[0], self.enter[0], message)
        if self.vertices[-1] != last:
            message = f"{name} ends at {vertex(self.vertices[-1])} (end at {vertex(last)})"
            yield self._fault("wrong end", self.vertices[-1], self.enter[-1], message)

    def _work(self) -> Iterator[Fault]:
        stages = self.itinerary.stages
        if self.vertices[-1] != stages[-1].vertex:
            stages = stages[:-1]  # a wrong end is reported already
        hopeless = set()  # or every lap would search the rest of the track again
        visit = 0
        for stage in stages:
            found = None if stage in hopeless else self._serve(stage, visit)
            if found is None:
                hopeless.add(stage)
                yield self._unserved(stage, visit)
            else:
                visit = found

    def _serve(self, stage: Stage, visit: int) -> int | None:
        """Return the first visit, from this one on, that is long enough; take its time."""
        need = stage.work + stage.turn
        last = len(self.vertices) - 1
        while True:
            try:
                visit = self.vertices.index(stage.vertex, visit)
            except ValueError:
                return None
            if visit == last or self.spare[visit] >= need:
                self.spare[visit] -= need
                return visit
            heappush(self.too_short.setdefault(stage, []), (-self.spare[visit], visit))
            visit += 1

    def _unserved(self, stage: Stage, visit: int) -> Fault:
        too_short = self.too_short.get(stage)
        if too_short:
            minus_spare, visit = heappop(too_short)
            return self._cut_short(stage, -minus_spare, self.enter[visit])
        message = (
            f"{self._name} does not come to {self.names.vertex(stage.vertex)}"
            f" at {self.names.moment(self.enter[visit])} or later (visit its stops in their order)"
        )
        return self._fault("stop missed", stage.vertex, self.enter[visit], message)

    def _cut_short(self, stage: Stage, spare: int, enter: int) -> Fault:
        needs = {"working": stage.work, "turning": stage.turn}
        duration = self.names.duration
        need = " and ".join(f"{duration(ticks)} {what}" for what, ticks in needs.items() if ticks)
        message = (
            f"{self._name} has {duration(spare)} at {self.names.vertex(stage.vertex)}, it needs"
            f" {need} (stay {duration(stage.work + stage.turn - spare)} longer)"
        )
        return self._fault("work cut short", stage.vertex, enter, message)

    @property
    def _name(self) -> str:
        return self.names.robot(self.robot)

    def _fault(self, kind: FaultKind, vertex: int, tick: int, message: str) -> Fault:
        return Fault(
            kind=kind,
            robots=(self.robot,),
            vertices=(VertexId(vertex),),
            tick=Tick(tick),
            message=message,
        )
