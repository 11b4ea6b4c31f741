"""One run in phases: watched until a robot breaks down, then by a new plan for what is left."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rightofway.execution.monitor import ExecutionMonitor
from rightofway.execution.replan import plan_the_rest
from rightofway.execution.stop import (
    Rest,
    first_breakdown,
    stop_all,
    with_standstills,
)
from rightofway.model import NEVER, Tick, Track
from rightofway.precedence import ActionDependencyGraph, DelaySample, Execution

__all__ = ["RunResult", "run_in_phases"]


@dataclass(kw_only=True)
class RunResult:
    """How a run ended.

    Attributes
    ----------
    floor, setbacks
        The plan that was run in the end, and what befell it; of all phases the last.
    completion
        When each robot completed, `NEVER` where it did not do everything [ticks]; int64[R].
    broken
        Robots that stand still for ever.
    cut_off
        Robots that could not be brought to all their places, or not home, any more.
    collisions
        As in `Execution`; int64[4].
    deadlocked
        Robots that wait for each other for ever.
    switches, replans
        How often the order was changed, and how often what was left was planned anew.
    stands
        How often that was from a stand, because a robot had broken down.
    tracks
        What really happened.
    """

    floor: ActionDependencyGraph
    delay_sample: DelaySample
    completion: NDArray[np.int64]
    broken: frozenset[int] = frozenset()
    cut_off: frozenset[int] = frozenset()
    collisions: NDArray[np.int64]
    deadlocked: frozenset[int] = frozenset()
    switches: int = 0
    replans: int = 0
    stands: int = 0
    tracks: tuple[Track, ...] = ()


def run_in_phases(
    floor: ActionDependencyGraph, seed: int, run: int, *, switch: bool, replan: bool = True
) -> RunResult:
    """Run a plan once; change it, or plan anew, while it runs.

    Parameters
    ----------
    floor
        The plan.
    seed, run
        As for `ActionDependencyGraph.delay_sample`.
    switch
        Whether rights of way are switched.
    replan
        Whether what is left is planned anew: on the move where the fleet has fallen behind, and
        from a stand when a robot breaks down.
    """
    return _Phases(floor, seed, run, switch=switch, replan=replan).ended


class _Phases:
    def __init__(
        self, floor: ActionDependencyGraph, seed: int, run: int, *, switch: bool, replan: bool
    ) -> None:
        self.seed, self.run, self.switch, self.replan = seed, run, switch, replan
        self.offset, delay_sample = Tick(0), floor.delay_sample(seed, run)
        robots = len(floor.routes)
        self.ended = RunResult(
            floor=floor,
            delay_sample=delay_sample,
            completion=np.full(robots, NEVER, np.int64),
            collisions=np.array([0, 0, 0, NEVER]),
        )
        while (following := self.phase(floor, delay_sample)) is not None:
            floor, delay_sample = following

    def phase(
        self, floor: ActionDependencyGraph, delay_sample: DelaySample
    ) -> tuple[ActionDependencyGraph, DelaySample] | None:
        """Run a plan to its end or to the next breakdown; return what then is to be run."""
        draw = self.draw if self.replan else None
        watch = ExecutionMonitor(floor, delay_sample, switch=self.switch, draw=draw, seed=self.seed)
        floor, delay_sample, happens = watch.floor, watch.delay_sample, watch.happens
        self.ended.floor, self.ended.delay_sample = floor, delay_sample
        self.ended.switches += watch.switches
        self.ended.replans += watch.replans
        since = first_breakdown(delay_sample, happens) if self.replan else NEVER
        following = None if since == NEVER else self.follow(floor, delay_sample, since)
        if following is None:
            self.ended.deadlocked |= frozenset(floor.deadlocked())
            down = enumerate(happens.is_broken & (happens.completion == NEVER))
            self.write_down(floor, happens, self.ended.cut_off)
            self.ended.broken |= {robot for robot, is_down in down if is_down}
        return following

    def draw(self, floor: ActionDependencyGraph) -> DelaySample:
        """Return what befalls a plan in this phase."""
        return floor.delay_sample(self.seed + (self.ended.stands << 32), self.run)

    def follow(
        self, floor: ActionDependencyGraph, delay_sample: DelaySample, since: Tick
    ) -> tuple[ActionDependencyGraph, DelaySample] | None:
        """Come to a stand and plan anew; None if nothing can be planned."""
        happens, rest = stop_all(floor, delay_sample, since, self.ended.broken)
        anew = plan_the_rest(rest, self.seed)
        if anew is None:
            return None
        unfinished = frozenset(robot for robot, left in enumerate(rest.stages) if left)
        self.write_down(floor, happens, unfinished)
        self.ended.replans += 1
        self.ended.stands += 1
        self.ended.broken = rest.broken
        self.ended.cut_off |= anew.cut_off
        self.offset = Tick(self.offset + rest.tick)
        hazards = replace(
            floor.hazards,
            random=tuple(kind for kind in floor.hazards.random if kind[0] != "breaks"),
        )
        new = ActionDependencyGraph(anew.plan.scenario, anew.plan.tracks, hazards)
        return new, self.remaining_delays(new, delay_sample, rest)

    def remaining_delays(
        self, new: ActionDependencyGraph, delay_sample: DelaySample, rest: Rest
    ) -> DelaySample:
        """Return new delays, and what is left of the standstills that were to come."""
        return with_standstills(
            self.draw(new),
            [
                [
                    (Tick(max(tick - rest.tick, 0)), _less(ticks, max(rest.tick - tick, 0)))
                    for tick, ticks in delay_sample.of(robot)
                    if robot not in rest.broken and tick + ticks > rest.tick
                ]
                for robot in range(len(new.routes))
            ],
        )

    def write_down(
        self, floor: ActionDependencyGraph, happens: Execution, unfinished: frozenset[int]
    ) -> None:
        """Add what happened in a phase; who has moved again after completing completes later."""
        ended = self.ended
        counts = happens.collisions.copy()
        first = min(int(ended.collisions[3]), _less(Tick(int(counts[3])), -self.offset))
        ended.collisions = ended.collisions + counts
        ended.collisions[3] = first
        tracks = floor.split(happens.enter)
        for robot, track in enumerate(tracks):
            done = _less(Tick(int(happens.completion[robot])), -self.offset)
            if robot in ended.broken:
                continue
            if robot in unfinished:
                ended.completion[robot] = NEVER
            elif len(track) > 1 or ended.completion[robot] == NEVER:
                ended.completion[robot] = done
        before = ended.tracks or tuple(Track.of([track.vertices[0]], [0]) for track in tracks)
        ended.tracks = tuple(
            _joined(one, other, self.offset) for one, other in zip(before, tracks, strict=True)
        )


def _less(ticks: Tick, passed: int) -> Tick:
    return NEVER if ticks == NEVER else Tick(ticks - passed)


def _joined(one: Track, other: Track, offset: Tick) -> Track:
    """Join two tracks; the second begins where the first ends."""
    return Track(
        vertices=np.concatenate([one.vertices, other.vertices[1:]]),
        enter=np.concatenate([one.enter, other.enter[1:] + offset]),
    )
