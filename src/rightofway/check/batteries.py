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
from rightofway.model import Battery, PlannedItem, Scenario, Tick
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
        at, soc = 0, self.soc
        for moment, at, soc, least in self._follow():
            if soc < least:
                yield self._fault("low battery", at, moment, soc=soc, least=least)
                return
        if self.own.tour:
            need = self._measure_way_to_charge()
            needed = None if need is None else self.battery.reserve + need
            if needed is None or soc < needed:
                yield self._fault("stranded", at, self.rest, soc=soc, least=needed)

    def _follow(self) -> Iterator[tuple[int, int, Fraction, Fraction]]:
        """Yield instants with the place, the state of charge then, and the least one allowed.

        Between two of them the state of charge rises or falls evenly.
        """
        state, tick = self.own.state, self.scenario.problem.clock.tick
        falls = self._list_drives()
        moments = {state.ready, self.rest, *falls}
        moments.update(moment for item in self.own.tour for moment in (item.begin, item.end))
        within = sorted(moment for moment in moments if state.ready <= moment <= self.rest)
        soc, visit = self.soc - falls.get(state.ready, 0), 0
        for before, moment in pairwise([state.ready, *within]):
            soc += self._change(before, moment) * tick
            soc = min(soc, Fraction(1))
            if moment > before:
                soc -= falls.get(moment, 0)
            while visit + 1 < len(self.own.enter) and self.own.enter[visit + 1] <= moment:
                visit += 1
            yield moment, self.own.vertices[visit], soc, self._find_least(moment)

    def _list_drives(self) -> dict[int, Fraction]:
        """Return what drives take at the instants at which they end."""
        roadmap, falls = self.scenario.roadmap, dict[int, Fraction]()
        for enter, edge in zip(self.own.enter[1:], self.own.edges, strict=False):
            if edge >= 0:
                share = self.battery.drive * roadmap.get_edge_class(edge).length
                falls[enter] = falls.get(enter, Fraction(0)) + share
        return falls

    def _change(self, begin: int, end: int) -> Fraction:
        """Return how the state of charge changes in an interval without events, by time unit."""
        during = [item for item in self.own.tour if item.begin <= begin and end <= item.end]
        if any(item.job is None for item in during):
            return (end - begin) * self.battery.charge
        return -(end - begin) * (self.battery.on + len(during) * self.battery.work)

    def _find_least(self, moment: int) -> Fraction:
        """Return the least state of charge; a robot that begins below its reserve charges first."""
        if self.soc >= self.battery.reserve:
            return self.battery.reserve
        first: PlannedItem | None = self.own.tour[0] if self.own.tour else None
        may_be_low = first is None or (first.job is None and moment < first.end)
        return Fraction(0) if may_be_low else self.battery.reserve

    def _measure_way_to_charge(self) -> Fraction | None:
        """Return the least share for a drive from the last vertex to a charging place.

        None where no way leads to one. Turns and other robots do not count.
        """
        shares = self._list_shares()
        unit = lcm(*(share.denominator for share in shares if share is not None))
        costs = [None if share is None else int(share * unit) for share in shares]
        roadmap, goals = self.scenario.roadmap, set(self.own.state.charging)
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
