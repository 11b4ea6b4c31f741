"""The track of each robot: from its home along edges, no faster than it can, through all stops."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from heapq import heappop, heappush

import numpy as np
from numpy.typing import NDArray

from rightofway.check.faults import Fault, FaultCollector, FaultKind, Names, Verdict
from rightofway.check.turning import MICRO
from rightofway.check.visits import Visits
from rightofway.model import Itinerary, Plan, Stage, Tick
from rightofway.phrases import Phrase, join_items
from rightofway.quantities import format_decimal
from rightofway.site import VertexId


def judge_drives(visits: Visits, names: Names, collector: FaultCollector) -> None:
    """Find unknown vertices, jumps, drives that are too fast and times that go backwards."""

    def robot(visit: int) -> str:
        return names.name_robot(int(visits.robot[visit]))

    def vertex(visit: int) -> str:
        return names.name_vertex(int(visits.vertex[visit]))

    def unknown(visit: int) -> Verdict:
        last = str(names.scenario.roadmap.n_vertices - 1)
        return (
            Phrase(
                "{robot} enters {vertex}, which is not on the roadmap",
                robot=robot(visit),
                vertex=vertex(visit),
            ),
            Phrase("its vertices are 0 to {last}", last=last),
        )

    def backwards(visit: int) -> Verdict:
        reason = Phrase(
            "{robot} enters {vertex} at {moment}, but {next} after it at {earlier}",
            robot=robot(visit),
            vertex=vertex(visit),
            moment=names.say_moment(visits.enter[visit]),
            next=vertex(visit + 1),
            earlier=names.say_moment(visits.leave[visit]),
        )
        return reason, Phrase("later visits have later times")

    def jump(visit: int) -> Verdict:
        ends = {"robot": robot(visit), "tail": vertex(visit), "head": vertex(visit + 1)}
        if ends["tail"] == ends["head"]:
            return Phrase("{robot} enters {tail} twice in a row", **ends), Phrase(
                "make it one visit"
            )
        reason = Phrase("{robot} goes from {tail} to {head}, no edge leads there", **ends)
        return reason, Phrase("use edges")

    def too_fast(visit: int) -> Verdict:
        drive = visits.drive[visit]
        reason = Phrase(
            "{robot} drives from {tail} to {head} in {time}, it needs {least}",
            robot=robot(visit),
            tail=vertex(visit),
            head=vertex(visit + 1),
            time=names.say_duration(stay[visit]),
            least=names.say_duration(drive),
        )
        moment = names.say_moment(visits.enter[visit] + drive)
        return reason, Phrase("enter at {moment} or later", moment=moment)

    def report(
        kind: FaultKind, broken: NDArray[np.bool_], verdict: Callable[[int], Verdict]
    ) -> None:
        where = np.flatnonzero(broken)
        # An unknown vertex is wrong as soon as it is entered, a move at the instant it is made.
        times, ends = (visits.enter, 1) if kind == "unknown vertex" else (visits.leave, 2)

        def fault(position: int) -> Fault:
            visit = int(where[position])
            reason, remedy = verdict(visit)
            return Fault(
                kind=kind,
                robots=(int(visits.robot[visit]),),
                vertices=tuple(map(VertexId, visits.vertex[visit : visit + ends].tolist())),
                tick=Tick(int(times[visit])),
                reason=reason,
                remedy=remedy,
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
        at, to = map(names.name_vertex, ends)
        least = visits.turn[visit] + visits.drive[visit]
        reason = Phrase(
            "{robot} turns {angle} degrees at {vertex} in {time}, it needs {least}",
            robot=names.name_robot(robot),
            angle=format_decimal(Fraction(int(visits.angle[visit]), MICRO), 6),
            vertex=at,
            time=names.say_duration(stay[visit] - visits.drive[visit]),
            least=names.say_duration(visits.turn[visit]),
        )
        moment = names.say_moment(visits.enter[visit] + least)
        return Fault(
            kind="turn cut short",
            robots=(robot,),
            vertices=(VertexId(ends[0]),),
            tick=Tick(int(visits.leave[visit])),
            reason=reason,
            remedy=Phrase("enter {vertex} at {moment} or later", vertex=to, moment=moment),
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
        for fault in trip.find_faults():
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

    def find_faults(self) -> Iterator[Fault]:
        yield from self._ends()
        yield from self._work()

    def _ends(self) -> Iterator[Fault]:
        home, last = self.itinerary.home, self.itinerary.stages[-1].vertex
        name, vertex = self._name, self.names.name_vertex
        if self.vertices[0] != home or self.enter[0] != 0:
            reason = Phrase(
                "{robot} starts at {vertex} at {moment}",
                robot=name,
                vertex=vertex(self.vertices[0]),
                moment=self.names.say_moment(self.enter[0]),
            )
            remedy = Phrase(
                "start at its home, {home}, at {moment}",
                home=vertex(home),
                moment=self.names.say_moment(0),
            )
            yield self._fault("wrong home", self.vertices[0], self.enter[0], (reason, remedy))
        if self.vertices[-1] != last:
            end = vertex(self.vertices[-1])
            verdict = (
                Phrase("{robot} ends at {vertex}", robot=name, vertex=end),
                Phrase("end at {vertex}", vertex=vertex(last)),
            )
            yield self._fault("wrong end", self.vertices[-1], self.enter[-1], verdict)

    def _work(self) -> Iterator[Fault]:
        stages = self.itinerary.stages
        if self.vertices[-1] != stages[-1].vertex:
            stages = stages[:-1]  # a wrong end is reported already
        hopeless = set()  # or every lap would search the rest of the track again
        visit = 0
        for stage in stages:
            visit_served = None if stage in hopeless else self._serve(stage, visit)
            if visit_served is None:
                hopeless.add(stage)
                yield self._unserved(stage, visit)
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

    def _unserved(self, stage: Stage, visit: int) -> Fault:
        too_short = self.too_short.get(stage)
        if too_short:
            minus_spare, visit = heappop(too_short)
            return self._cut_short(stage, -minus_spare, self.enter[visit])
        reason = Phrase(
            "{robot} does not come to {vertex} at {moment} or later",
            robot=self._name,
            vertex=self.names.name_vertex(stage.vertex),
            moment=self.names.say_moment(self.enter[visit]),
        )
        verdict = (reason, Phrase("visit its stops in their order"))
        return self._fault("stop missed", stage.vertex, self.enter[visit], verdict)

    def _cut_short(self, stage: Stage, spare: int, enter: int) -> Fault:
        duration, needs = self.names.say_duration, []
        if stage.work:
            needs.append(Phrase("{time} working", time=duration(stage.work)))
        if stage.turn:
            needs.append(Phrase("{time} turning", time=duration(stage.turn)))
        reason = Phrase(
            "{robot} has {time} at {vertex}, it needs {need}",
            robot=self._name,
            time=duration(spare),
            vertex=self.names.name_vertex(stage.vertex),
            need=join_items(needs),
        )
        longer = duration(stage.work + stage.turn - spare)
        verdict = (reason, Phrase("stay {time} longer", time=longer))
        return self._fault("work cut short", stage.vertex, enter, verdict)

    @property
    def _name(self) -> str:
        return self.names.name_robot(self.robot)

    def _fault(self, kind: FaultKind, vertex: int, tick: int, verdict: Verdict) -> Fault:
        reason, remedy = verdict
        return Fault(
            kind=kind,
            robots=(self.robot,),
            vertices=(VertexId(vertex),),
            tick=Tick(tick),
            reason=reason,
            remedy=remedy,
        )
