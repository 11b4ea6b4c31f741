"""One run in phases: watched until a robot breaks down, then by a new plan for what is left."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rightofway.floor.replanning import plan_the_rest
from rightofway.floor.standing import (
    Rest,
    come_to_a_stand,
    first_breakdown,
    with_standstills,
)
from rightofway.floor.watching import Watch
from rightofway.model import Tick, Track
from rightofway.precedence import NEVER, DelayedPlan, Execution, Setbacks

__all__ = ["Ended", "run_in_phases"]


@dataclass(kw_only=True)
class Ended:
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

    floor: DelayedPlan
    setbacks: Setbacks
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
    floor: DelayedPlan, seed: int, run: int, *, switch: bool, replan: bool = True
) -> Ended:
    """Run a plan once; change it, or plan anew, while it runs.

    Parameters
    ----------
    floor
        The plan.
    seed, run
        As for `DelayedPlan.setbacks`.
    switch
        Whether rights of way are switched.
    replan
        Whether what is left is planned anew: on the move where the fleet has fallen behind, and
        from a stand when a robot breaks down.
    """
    return _Phases(floor, seed, run, switch=switch, replan=replan).ended


class _Phases:
    def __init__(
        self, floor: DelayedPlan, seed: int, run: int, *, switch: bool, replan: bool
    ) -> None:
        self.seed, self.run, self.switch, self.replan = seed, run, switch, replan
        self.offset, setbacks = Tick(0), floor.setbacks(seed, run)
        robots = len(floor.routes)
        self.ended = Ended(
            floor=floor,
            setbacks=setbacks,
            completion=np.full(robots, NEVER, np.int64),
            collisions=np.array([0, 0, 0, NEVER]),
        )
        while (following := self.phase(floor, setbacks)) is not None:
            floor, setbacks = following

    def phase(self, floor: DelayedPlan, setbacks: Setbacks) -> tuple[DelayedPlan, Setbacks] | None:
        """Run a plan to its end or to the next breakdown; return what then is to be run."""
        draw = self.draw if self.replan else None
        watch = Watch(floor, setbacks, switch=self.switch, draw=draw, seed=self.seed)
        floor, setbacks, happens = watch.floor, watch.setbacks, watch.happens
        self.ended.floor, self.ended.setbacks = floor, setbacks
        self.ended.switches += watch.switches
        self.ended.replans += watch.replans
        since = first_breakdown(setbacks, happens) if self.replan else NEVER
        following = None if since == NEVER else self.follow(floor, setbacks, since)
        if following is None:
            self.ended.deadlocked |= frozenset(floor.deadlocked())
            down = enumerate(happens.is_broken & (happens.completion == NEVER))
            self.write_down(floor, happens, self.ended.cut_off)
            self.ended.broken |= {robot for robot, is_down in down if is_down}
        return following

    def draw(self, floor: DelayedPlan) -> Setbacks:
        """Return what befalls a plan in this phase."""
        return floor.setbacks(self.seed + (self.ended.stands << 32), self.run)

    def follow(
        self, floor: DelayedPlan, setbacks: Setbacks, since: Tick
    ) -> tuple[DelayedPlan, Setbacks] | None:
        """Come to a stand and plan anew; None if nothing can be planned."""
        happens, rest = come_to_a_stand(floor, setbacks, since, self.ended.broken)
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
        new = DelayedPlan(anew.plan.scenario, anew.plan.tracks, hazards)
        return new, self.what_comes(new, setbacks, rest)

    def what_comes(self, new: DelayedPlan, setbacks: Setbacks, rest: Rest) -> Setbacks:
        """Return new delays, and what is left of the standstills that were to come."""
        return with_standstills(
            self.draw(new),
            [
                [
                    (Tick(max(tick - rest.tick, 0)), _less(ticks, max(rest.tick - tick, 0)))
                    for tick, ticks in setbacks.of(robot)
                    if robot not in rest.broken and tick + ticks > rest.tick
                ]
                for robot in range(len(new.routes))
            ],
        )

    def write_down(
        self, floor: DelayedPlan, happens: Execution, unfinished: frozenset[int]
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
