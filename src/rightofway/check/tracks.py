"""The track of each robot: from its home along edges, no faster than it can, through all stops."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from heapq import heappop, heappush
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.check.faults import Fault, FaultGroup, FaultKind
from rightofway.check.turning import MICRO
from rightofway.check.visits import Visits
from rightofway.model import Itinerary, Scenario, Stage, Tick
from rightofway.site import VertexId


def judge_drives(visits: Visits) -> Iterator[FaultGroup]:
    """Find unknown vertices, jumps, forbidden turns, too fast drives, and times out of order."""

    def group(
        kind: FaultKind, broken: NDArray[np.bool_], describe: Callable[[int], Mapping[str, Any]]
    ) -> FaultGroup:
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
                numbers=describe(visit),
                scenario=visits.scenario,
            )

        return FaultGroup(kind, times[where], (visits.robot[where],), fault)

    def describe_drive(visit: int) -> Mapping[str, Any]:
        drive = int(visits.drive[visit])
        earliest = int(visits.enter[visit]) + drive
        return {"time": int(stay[visit]), "least": drive, "earliest": earliest}

    last_vertex = visits.scenario.roadmap.n_vertices - 1
    stay, moves, joined = visits.leave - visits.enter, ~visits.last, visits.edge >= 0
    both_known = visits.known & np.roll(visits.known, -1)
    yield group("unknown vertex", ~visits.known, lambda _: {"last": last_vertex})
    yield group(
        "backwards",
        moves & (stay < 0),
        lambda visit: {"enter": int(visits.enter[visit]), "leave": int(visits.leave[visit])},
    )
    broken = moves & both_known & ~joined
    turned = _find_forbidden_turns(visits, broken)
    yield group("jump", broken & ~turned, lambda _: {})
    yield group("forbidden turn", turned, lambda _: {})
    yield group("too fast", joined & (stay >= 0) & (stay < visits.drive), describe_drive)


def _find_forbidden_turns(visits: Visits, broken: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the moves without an edge that have one from, or to, another vertex of the place.

    Such a robot has come to the place in another direction, and has turned there.
    """
    turned, roadmap = np.zeros(len(broken), bool), visits.scenario.roadmap
    for visit in np.flatnonzero(broken).tolist() if roadmap.has_shared_places else ():
        at, following = (VertexId(vertex) for vertex in visits.vertex[visit : visit + 2].tolist())
        turned[visit] = at != following and (
            following in roadmap.list_place(at)
            or any(
                roadmap.find_edge(tail, head) is not None
                for tail, head in product(*map(roadmap.list_place, (at, following)))
            )
        )
    return turned


def judge_turns(visits: Visits) -> Iterator[FaultGroup]:
    """Find changes of heading that are too fast."""
    stay = visits.leave - visits.enter
    broken = (visits.edge >= 0) & (stay >= visits.drive) & (stay < visits.drive + visits.turn)
    where = np.flatnonzero(broken)

    def fault(position: int) -> Fault:
        visit = int(where[position])
        at, following = visits.vertex[visit : visit + 2].tolist()
        drive, turn = int(visits.drive[visit]), int(visits.turn[visit])
        return Fault(
            kind="turn cut short",
            robots=(int(visits.robot[visit]),),
            vertices=(VertexId(at),),
            tick=Tick(int(visits.leave[visit])),
            numbers={
                "angle": Fraction(int(visits.angle[visit]), MICRO),
                "time": int(stay[visit]) - drive,
                "least": turn,
                "next": following,
                "earliest": int(visits.enter[visit]) + turn + drive,
            },
            scenario=visits.scenario,
        )

    yield FaultGroup("turn cut short", visits.leave[where], (visits.robot[where],), fault)


def judge_stops(visits: Visits) -> Iterator[FaultGroup]:
    """Find stops at vertices that robots only drive through."""
    spare = visits.leave - visits.enter - visits.drive - visits.turn
    where = np.flatnonzero(visits.passed & (visits.edge >= 0) & (spare > 0))

    def fault(position: int) -> Fault:
        visit = int(where[position])
        time, enter = int(spare[visit]), int(visits.enter[visit])
        return Fault(
            kind="stop at pass",
            robots=(int(visits.robot[visit]),),
            vertices=(VertexId(int(visits.vertex[visit])),),
            tick=Tick(enter),
            numbers={"time": time, "late": enter + time},
            scenario=visits.scenario,
        )

    yield FaultGroup("stop at pass", visits.enter[where], (visits.robot[where],), fault)


def judge_trips(visits: Visits) -> Iterator[Fault]:
    """Find wrong homes, wrong ends, missed stops and work cut short."""
    if visits.scenario.jobs is not None:
        return  # tours are judged instead
    spare = np.maximum(visits.leave - visits.enter - visits.drive - visits.turn, 0).tolist()
    begin = 0
    for robot, track in enumerate(visits.plan.tracks):
        end = begin + len(track)
        trip = _Trip(
            robot=robot,
            itinerary=visits.scenario.problem.itineraries[robot],
            vertices=track.vertices.tolist(),
            enter=track.enter.tolist(),
            spare=spare[begin:end],
            scenario=visits.scenario,
        )
        yield from trip.find_faults()
        begin = end


@dataclass(slots=True, kw_only=True)
class _Trip:
    """A robot's track against its itinerary.

    `spare` is how long each visit lasts beyond the drive that ends it and the turn before, less
    the work done there so far [ticks]; 0 for the last visit, which never ends.
    `too_short` holds, for each stage, which may recur in every lap, the visits that were: a heap of
    (-spare, visit).
    """

    robot: int
    itinerary: Itinerary
    vertices: list[int]
    enter: list[int]
    spare: list[int]
    scenario: Scenario
    too_short: dict[Stage, list[tuple[int, int]]] = field(default_factory=dict)

    def find_faults(self) -> Iterator[Fault]:
        yield from self._check_ends()
        yield from self._check_work()

    def _check_ends(self) -> Iterator[Fault]:
        home, last = self.itinerary.home, self.itinerary.stages[-1].vertex
        if self.vertices[0] != home or self.enter[0] != 0:
            yield self._make_fault("wrong home", self.vertices[0], self.enter[0], home=int(home))
        if self.vertices[-1] != last:
            yield self._make_fault("wrong end", self.vertices[-1], self.enter[-1], end=int(last))

    def _check_work(self) -> Iterator[Fault]:
        stages = self.itinerary.stages
        if self.vertices[-1] != stages[-1].vertex:
            stages = stages[:-1]  # a wrong end is reported already
        hopeless = set()  # or every lap would search the rest of the track again
        visit = 0
        for stage in stages:
            visit_served = None if stage in hopeless else self._serve(stage, visit)
            if visit_served is None:
                hopeless.add(stage)
                yield self._make_unserved(stage, visit)
            else:
                visit = visit_served

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

    def _make_unserved(self, stage: Stage, visit: int) -> Fault:
        too_short = self.too_short.get(stage)
        if too_short:
            minus_spare, visit = heappop(too_short)
            return self._cut_short(stage, -minus_spare, self.enter[visit])
        return self._make_fault("stop missed", stage.vertex, self.enter[visit])

    def _cut_short(self, stage: Stage, spare: int, enter: int) -> Fault:
        missing = stage.work + stage.turn - spare
        return self._make_fault(
            "work cut short",
            stage.vertex,
            enter,
            time=spare,
            work=int(stage.work),
            turn=int(stage.turn),
            missing=missing,
        )

    def _make_fault(self, kind: FaultKind, vertex: int, tick: int, **numbers: int) -> Fault:
        return Fault(
            kind=kind,
            robots=(self.robot,),
            vertices=(VertexId(vertex),),
            tick=Tick(tick),
            numbers=numbers,
            scenario=self.scenario,
        )
