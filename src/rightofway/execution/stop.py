"""Coming to a stand: who is driving arrives, nobody else sets off; what is left is written down.

A robot between two vertices cannot be planned for. So when a robot breaks down, those who are
driving arrive first, by right of way, if they can.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, chain

import numpy as np

from rightofway.model import NEVER, Route, Scenario, Stage, Tick, VertexId
from rightofway.precedence import ActionDependencyGraph, DelaySample, Execution

__all__ = ["Rest", "breakdown", "first_breakdown", "served", "stop_all", "with_standstills"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Rest:
    """What is left of a plan at an instant at which everybody stands.

    Attributes
    ----------
    scenario
        Of which this is the rest.
    tick
        The instant; all headways are over [ticks].
    at
        Where each robot stands.
    stages
        What each still has to do; nothing for those that broke down.
    broken
        Robots that stand still for ever.
    closed
        Vertices that these hold.
    """

    scenario: Scenario
    tick: Tick
    at: tuple[VertexId, ...]
    stages: tuple[tuple[Stage, ...], ...]
    broken: frozenset[int]
    closed: frozenset[VertexId]


def breakdown(delay_sample: DelaySample, robot: int) -> Tick:
    """Return when a robot breaks down, `NEVER` if it does not [ticks]."""
    return min((tick for tick, ticks in delay_sample.of(robot) if ticks == NEVER), default=NEVER)


def first_breakdown(delay_sample: DelaySample, happens: Execution) -> Tick:
    """Return when the first robot breaks down that has not completed, `NEVER` if none does."""
    ticks = [
        breakdown(delay_sample, robot)
        for robot, completion in enumerate(happens.completion.tolist())
        if completion == NEVER
    ]
    return min(ticks, default=NEVER)


def stop_all(
    floor: ActionDependencyGraph, delay_sample: DelaySample, since: Tick, broken: frozenset[int]
) -> tuple[Execution, Rest]:
    """Let those who drive arrive, and nobody else set off.

    Parameters
    ----------
    floor, setbacks
        A plan and what befalls it.
    since
        The instant after which nobody sets off [ticks].
    broken
        Robots that broke down before.

    Returns
    -------
    happens, rest
        What happens until everybody stands, and what is left then.
    """
    happens = floor.execute(_held(floor, delay_sample, since))
    stand = _Stand(floor, delay_sample, happens)
    tick = Tick(max(stand.last_enter, since) + floor.scenario.problem.headway)
    robots = range(len(floor.routes))
    down = broken.union(robot for robot in robots if breakdown(delay_sample, robot) <= tick)
    rest = Rest(
        scenario=floor.scenario,
        tick=tick,
        at=tuple(stand.vertex(robot) for robot in robots),
        stages=tuple(() if robot in down else stand.left(robot, tick) for robot in robots),
        broken=down,
        closed=frozenset(chain.from_iterable(stand.booked(robot) for robot in down)),
    )
    return happens, rest


def _held(floor: ActionDependencyGraph, delay_sample: DelaySample, since: Tick) -> DelaySample:
    """Return the setbacks of a floor on which nobody sets off any more."""
    free = floor.execute(delay_sample)
    dwell = delay_sample.dwell.copy()
    standstills = [delay_sample.of(robot) for robot in range(len(floor.routes))]
    for robot, standing in enumerate(standstills):
        first, end = floor.first_visit[robot : robot + 2].tolist()
        at = first + int(np.count_nonzero(free.enter[first:end] <= since)) - 1
        if at + 1 == end or breakdown(delay_sample, robot) <= since:
            continue
        if floor.scenario.rules.books_ahead:
            drives = bool(free.start[at + 1] <= since)
        else:
            drives = int(free.enter[at] + delay_sample.dwell[at]) <= since
        if drives and at + 2 < end:
            dwell[at + 1] = NEVER
        elif drives:
            continue  # to where it ends
        else:
            standing[:] = [pair for pair in standing if sum(pair) <= since]
            standing.append((since, NEVER))
    return with_standstills(delay_sample._replace(dwell=dwell), standstills)


def with_standstills(
    delay_sample: DelaySample, standstills: Sequence[Sequence[tuple[Tick, Tick]]]
) -> DelaySample:
    """Return setbacks with these standstills of each robot in the place of their own."""
    every = list(chain.from_iterable(standstills))
    return delay_sample._replace(
        first_standstill=np.array([0, *accumulate(map(len, standstills))], np.int32),
        tick=np.array([tick for tick, _ in every], np.int64),
        ticks=np.array([ticks for _, ticks in every], np.int64),
    )


class _Stand:
    """Where everybody stands in the end, and what they have done until then."""

    def __init__(
        self, floor: ActionDependencyGraph, delay_sample: DelaySample, happens: Execution
    ) -> None:
        self._floor, self._setbacks, self._happens = floor, delay_sample, happens
        begun = (happens.enter < NEVER).astype(np.int64)
        counts = np.add.reduceat(begun, floor.first_visit[:-1])
        self._at = floor.first_visit[:-1] + counts - 1
        self.last_enter = int(happens.enter[self._at].max())

    def vertex(self, robot: int) -> VertexId:
        """Return where a robot stands."""
        return VertexId(int(self._floor.vertex[self._at[robot]]))

    def booked(self, robot: int) -> list[VertexId]:
        """Return what a robot that broke down holds: where it stands, and where it drives to."""
        at = int(self._at[robot])
        drives = at + 1 < self._floor.first_visit[robot + 1] and self._happens.start[at + 1] < NEVER
        visits = [at, at + 1] if drives else [at]
        return [VertexId(int(self._floor.vertex[visit])) for visit in visits]

    def left(self, robot: int, tick: Tick) -> tuple[Stage, ...]:
        """Return the stages a robot has not done; the one it is at is shorter by what is done."""
        stages = self._floor.scenario.problem.itineraries[robot].stages
        index = int(self._at[robot] - self._floor.first_visit[robot])
        serves = served(self._floor.routes[robot], stages)
        done = self._done(robot, tick)
        left = []
        for stage, serving in zip(stages, serves, strict=True):
            if serving < index:
                continue
            need = stage.work + (0 if serving == len(self._floor.routes[robot]) - 1 else stage.turn)
            if serving > index or done < need:
                left.append(replace(stage, work=Tick(max(stage.work - max(done, 0), 0))))
            done -= need if serving == index else done
        return tuple(left)

    def _done(self, robot: int, tick: Tick) -> int:
        """Return how much of the dwell of its visit a robot has done, in ticks of the plan."""
        visit = int(self._at[robot])
        began, really = int(self._happens.enter[visit]), int(self._setbacks.dwell[visit])
        stood = sum(
            max(min(tick, begin + ticks) - max(began, begin), 0)
            for begin, ticks in self._setbacks.of(robot)
        )
        done = min(max(tick - began - stood, 0), really)
        return int(self._floor.dwell[visit]) * done // max(really, 1)


def served(route: Route, stages: Sequence[Stage]) -> list[int]:
    """Return the visit that serves each stage; the dwell of a route is made of their times."""
    visit, last, spare, serves = 0, len(route) - 1, list(route.dwell), []
    for stage in stages[:-1]:
        need = stage.work + stage.turn
        while visit < last and (route.vertices[visit] != stage.vertex or spare[visit] < need):
            visit += 1
        spare[visit] = Tick(spare[visit] - need)
        serves.append(visit)
    return [*serves, last]
