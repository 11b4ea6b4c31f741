"""Batteries of a plan: the state of charge of each robot, exactly, from its start to its rest."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from heapq import heappop, heappush
from itertools import pairwise
from math import lcm

from rightofway.check.faults import Fault, FaultKind
from rightofway.check.visits import Visits
from rightofway.check.work import TourOfPlan, lay_out_tours
from rightofway.model import NEVER, Battery, PlannedItem, Scenario, Tick
from rightofway.site import VertexId


def judge_batteries(visits: Visits) -> Iterator[Fault]:
    """Find states of charge below the least one, and robots that rest too far from a charge."""
    scenario = visits.scenario
    if not scenario.batteries:
        return
    batteries = dict(scenario.batteries)
    for own, robot in zip(lay_out_tours(visits), scenario.robots, strict=True):
        if robot.battery is not None:
            soc = Fraction(1) if robot.start is None else robot.start.soc
            battery = batteries[robot.battery]
            yield from _Charge(own=own, battery=battery, soc=soc, scenario=scenario).find_faults()


@dataclass(frozen=True, slots=True, kw_only=True)
class _Charge:
    """The battery of one robot along its track.

    `soc` is the state of charge when the robot is ready.
    """

    own: TourOfPlan
    battery: Battery
    soc: Fraction
    scenario: Scenario

    @property
    def rest(self) -> int:
        """From when on the robot rests [ticks]."""
        return max(self.own.state.ready, self.own.enter[-1], self.own.end)

    def find_faults(self) -> Iterator[Fault]:
        """Yield the first instant at which the battery is too low, or else a rest that is."""
        unit = self._find_unit()
        at, soc = 0, int(self.soc * unit)
        for moment, at, soc, least in self._follow(unit):
            if soc < least:
                level, needed = Fraction(soc, unit), Fraction(least, unit)
                yield self._fault("low battery", at, moment, soc=level, least=needed)
                return
        if self.own.tour:
            need = self._measure_way_to_charge()
            lowest = None if need is None else self.battery.reserve + need
            level = Fraction(soc, unit)
            if lowest is None or level < lowest:
                yield self._fault("stranded", at, self.rest, soc=level, least=lowest)

    def _find_unit(self) -> int:
        """Return the least number of which all changes of the state of charge are whole parts."""
        battery, tick = self.battery, self.scenario.problem.clock.tick
        shares = (
            *(battery.drive * own.length for own in self.scenario.roadmap.edge_classes),
            *(share * tick for share in (battery.on, battery.work, battery.charge)),
            battery.reserve,
            self.soc,
        )
        return lcm(*(share.denominator for share in shares))

    def _follow(self, unit: int) -> Iterator[tuple[int, int, int, int]]:
        """Yield instants with the place, the state of charge then, and the least one allowed.

        Between two of them the state of charge rises or falls evenly. Both are in parts of a
        battery, of which a full one has `unit`.
        """
        state, tick = self.own.state, self.scenario.problem.clock.tick
        falls, rest = self._list_drives(unit), self.rest
        moments = {state.ready, rest, *falls}
        moments.update(moment for item in self.own.tour for moment in (item.begin, item.end))
        within = sorted(moment for moment in moments if state.ready <= moment <= rest)
        charge = int(self.battery.charge * tick * unit)
        on, work = (int(share * tick * unit) for share in (self.battery.on, self.battery.work))
        reserve, low_until = int(self.battery.reserve * unit), self._find_end_of_low()
        soc, visit = int(self.soc * unit) - falls.get(state.ready, 0), 0
        coming = sorted(self.own.tour, key=lambda item: item.begin, reverse=True)
        during = list[PlannedItem]()
        for before, moment in pairwise([state.ready, *within]):
            while coming and coming[-1].begin <= before:
                during.append(coming.pop())
            during = [item for item in during if moment <= item.end]
            if any(item.job is None for item in during):
                soc = min(soc + (moment - before) * charge, unit)
            else:
                soc -= (moment - before) * (on + len(during) * work)
            if moment > before:
                soc -= falls.get(moment, 0)
            while visit + 1 < len(self.own.enter) and self.own.enter[visit + 1] <= moment:
                visit += 1
            least = 0 if moment < low_until else reserve
            yield moment, self.own.vertices[visit], soc, least

    def _list_drives(self, unit: int) -> dict[int, int]:
        """Return what drives take at the instants at which they end, in parts of a battery."""
        roadmap, falls = self.scenario.roadmap, dict[int, int]()
        shares = [int(self.battery.drive * own.length * unit) for own in roadmap.edge_classes]
        for enter, edge in zip(self.own.enter[1:], self.own.edges, strict=False):
            if edge >= 0:
                share = shares[int(roadmap.class_of_edge[edge])]
                falls[enter] = falls.get(enter, 0) + share
        return falls

    def _find_end_of_low(self) -> int:
        """Return until when the reserve may be used: a robot that begins below it charges first."""
        if self.soc >= self.battery.reserve:
            return 0
        first: PlannedItem | None = self.own.tour[0] if self.own.tour else None
        if first is None:
            return NEVER
        return first.end if first.job is None else 0

    def _measure_way_to_charge(self) -> Fraction | None:
        """Return the least share for a drive from the last vertex to a charging place.

        None where no way leads to one. Turns and other robots do not count.
        """
        shares = self._list_shares()
        unit = lcm(*(share.denominator for share in shares if share is not None))
        costs = [None if share is None else int(share * unit) for share in shares]
        roadmap = self.scenario.roadmap
        goals = {at for vertex in self.own.state.charging for at in roadmap.list_place(vertex)}
        rest = self.own.vertices[-1]
        if not 0 <= rest < roadmap.n_vertices:
            return None
        least, heap = {rest: 0}, [(0, rest)]
        while heap:
            cost, vertex = heappop(heap)
            if vertex in goals:
                return Fraction(cost, unit)
            if cost > least[vertex]:
                continue
            for edge in range(int(roadmap.indptr[vertex]), int(roadmap.indptr[vertex + 1])):
                share, head = costs[int(roadmap.class_of_edge[edge])], int(roadmap.heads[edge])
                if share is not None and cost + share < least.get(head, cost + share + 1):
                    least[head] = cost + share
                    heappush(heap, (cost + share, head))
        return None

    def _list_shares(self) -> list[Fraction | None]:
        """Return what a drive along an edge of each class takes; None where it is barred."""
        itinerary = self.scenario.problem.itineraries[self.own.robot]
        tick = self.scenario.problem.clock.tick
        return [
            None
            if ticks < 0
            else self.battery.drive * edge_class.length + self.battery.on * ticks * tick
            for edge_class, ticks in zip(
                self.scenario.roadmap.edge_classes, itinerary.edge_ticks, strict=True
            )
        ]

    def _fault(
        self, kind: FaultKind, vertex: int, tick: int, *, soc: Fraction, least: Fraction | None
    ) -> Fault:
        return Fault(
            kind=kind,
            robots=(self.own.robot,),
            vertices=(VertexId(vertex),),
            tick=Tick(tick),
            numbers={"soc": soc, "least": least},
            scenario=self.scenario,
        )
