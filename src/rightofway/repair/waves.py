"""A first plan of a fleet with jobs in waves, each from homes to homes, by methods without times.

Robots that begin elsewhere than at home, or whose homes block each other's ways, may find no plan
one after another. A wave is a scenario without times: each robot serves the next stages of its
tour that may begin, and drives home. The methods for such fleets plan it, LaCAM first, which is
complete for points. A wave begins when the one before has ended: so stages in waves before have
ended, and waits for `earliest` are waits between waves. The improvement that follows removes most
of them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from math import ceil

import numpy as np

from rightofway.errors import GaveUp, NoPlanExists
from rightofway.facts import Fact
from rightofway.model import Robot, Scenario, Status, Stop, Tick, Track
from rightofway.model.stays import compute_completions, find_stays
from rightofway.repair.plan_request import Draft, PlanRequest
from rightofway.site import VertexId

PlanWave = Callable[[PlanRequest], Draft]
"""Plans a fleet without times; raises `GaveUp` or `NoPlanExists`."""

HALF_TURN = 180
"""The most that a robot turns before a drive [degrees]."""


def plan_in_waves(request: PlanRequest, plan_wave: PlanWave) -> Draft:
    """Plan a fleet with tours in waves.

    Raises
    ------
    NoPlanExists
        If robots without tours cannot all drive home.
    GaveUp
        If no plan of a wave was found, a stage would end too late, or the scenario has closures.
    """
    scenario, itineraries = request.scenario, request.scenario.problem.itineraries
    if scenario.closures:
        raise GaveUp(Fact("no first plan"))
    waves = _Waves(scenario)
    begins = max(itinerary.ready for itinerary in itineraries)
    vertices = [[itinerary.home] for itinerary in itineraries]
    enter = [[0] for _ in itineraries]
    while True:
        counts = waves.count_open(begins)
        if not any(counts) and waves.is_at_home:
            if waves.is_done:
                break
            begins = waves.find_next_begin()
            continue
        wave = waves.make_scenario(counts)
        try:
            tracks = plan_wave(replace(request, scenario=wave, start=None, alone=None)).tracks
        except NoPlanExists:
            if waves.has_stages or any(itinerary.ends_anywhere for itinerary in itineraries):
                raise GaveUp(Fact("no first plan")) from None  # other tours may have one
            raise
        for robot, track in enumerate(tracks):
            vertices[robot] += track.vertices[1:].tolist()
            enter[robot] += (track.enter[1:] + begins).tolist()
        waves.serve(counts)
        # Who comes next to a place keeps the headway behind who was there in the wave before.
        lasted = max(compute_completions(wave, tracks))
        begins = Tick(begins + scenario.problem.booking_rules.end(lasted))
    tracks = tuple(
        Track(vertices=np.array(own, np.int32), enter=np.array(times, np.int64))
        for own, times in zip(vertices, enter, strict=True)
    )
    if not _is_in_time(scenario, tracks):
        raise GaveUp(Fact("no first plan"))
    request.has_plan()
    return Draft(tracks=tracks, status=Status("in waves"))


def _is_in_time(scenario: Scenario, tracks: Sequence[Track]) -> bool:
    """Return whether each stage ends at its `latest` or before."""
    return all(
        stage.latest is None or end <= stage.latest
        for itinerary, stays in zip(
            scenario.problem.itineraries, find_stays(scenario, tracks), strict=True
        )
        for stage, end in zip(itinerary.stages, stays.ends, strict=False)
    )


class _Waves:
    """The progress of robots on their tours after some waves."""

    def __init__(self, scenario: Scenario) -> None:
        self._scenario, itineraries = scenario, scenario.problem.itineraries
        self._places = [itinerary.home for itinerary in itineraries]
        self._stages = [
            itinerary.stages_to_serve[: None if itinerary.ends_anywhere else -1]
            for itinerary in itineraries
        ]
        self._served = [0] * len(itineraries)
        self._before: dict[tuple[int, int], list[tuple[int, int]]] = {}
        for before, after in scenario.problem.after:
            self._before.setdefault(after, []).append(before)

    @property
    def has_stages(self) -> bool:
        """Whether some robot has a tour."""
        return any(self._stages)

    @property
    def is_done(self) -> bool:
        """Whether all stages are served."""
        return self._served == [len(own) for own in self._stages]

    @property
    def is_at_home(self) -> bool:
        """Whether all robots are at home."""
        return self._places == [robot.home for robot in self._scenario.robots]

    def count_open(self, begins: Tick) -> list[int]:
        """Return how many stages each robot may serve in a wave that begins at a tick."""
        counts = []
        for robot, stages in enumerate(self._stages):
            end = self._served[robot]
            while end < len(stages) and stages[end].earliest <= begins and self._may(robot, end):
                end += 1
            counts.append(end - self._served[robot])
        return counts

    def _may(self, robot: int, stage: int) -> bool:
        """Return whether all stages that end before a stage are served in waves before."""
        before = self._before.get((robot, stage), ())
        return all(self._served[other] > earlier for other, earlier in before)

    def find_next_begin(self) -> Tick:
        """Return when the next stage may begin that waits for its earliest begin only [ticks]."""
        return min(
            stages[served].earliest
            for robot, (stages, served) in enumerate(zip(self._stages, self._served, strict=True))
            if served < len(stages) and self._may(robot, served)
        )

    def serve(self, counts: Sequence[int]) -> None:
        """Take in a wave: stages are served, and all robots are at home."""
        self._served = [own + more for own, more in zip(self._served, counts, strict=True)]
        self._places = [robot.home for robot in self._scenario.robots]

    def make_scenario(self, counts: Sequence[int]) -> Scenario:
        """Return a wave as a scenario without jobs."""
        robots = [self._make_robot(robot, count) for robot, count in enumerate(counts)]
        return replace(
            self._scenario,
            robots=tuple(robots),
            clock=self._scenario.problem.clock,
            jobs=None,
            batteries=(),
            charging=(),
            tours=None,
            rules=replace(self._scenario.rules, objective=None, late=None, patience=None),
        )

    def _make_robot(self, number: int, count: int) -> Robot:
        """Return a robot that serves some stages and drives home, on one way.

        The turn at each stop, and the first one, are left to work there.
        """
        robot, place = self._scenario.robots[number], self._places[number]
        itinerary, time = (
            self._scenario.problem.itineraries[number],
            self._scenario.problem.clock.convert_to_time,
        )
        turning = itinerary.turning
        turn = Tick(0) if turning is None else Tick(ceil(HALF_TURN / turning.rate))
        served = self._served[number]
        stops = [
            Stop(at=VertexId(stage.vertex), work=time(Tick(stage.work + stage.turn)))
            for stage in self._stages[number][served : served + count]
        ]
        return replace(
            robot,
            home=place,
            stops=(Stop(at=place, work=time(turn)), *stops, Stop(at=robot.home)),
            turn=Fraction(0),
            ends="none",
            start=None,
            capacity=None,
            battery=None,
            charging=None,
        )
