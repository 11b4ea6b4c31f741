"""When robots serve the stages of tours: each in the first visit that is long enough.

The work of a stage begins as soon as its robot is at the vertex and ready, `earliest` has come, and
the stages before it have ended: those of the robot, and those of other robots by arcs. A visit
serves as many stages as fit in before the robot turns at the stop, turns to the next edge and
drives. The last visit never ends. Work may end later than `latest`: that is for the judge.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rightofway.model.itinerary import Itinerary
from rightofway.model.problem import Problem
from rightofway.model.route import Track
from rightofway.model.units import Tick


@dataclass(frozen=True, slots=True, kw_only=True)
class StageTimes:
    """The work of one robot.

    Attributes
    ----------
    serves
        The visit of each stage. It ends before the first stage that no visit serves.
    begins, ends
        When the work of each of these stages begins and ends [ticks].
    """

    serves: tuple[int, ...]
    begins: tuple[Tick, ...]
    ends: tuple[Tick, ...]


def find_stage_times(
    problem: Problem, tracks: Sequence[Track], until: Sequence[Sequence[int]]
) -> tuple[StageTimes, ...]:
    """Return when each robot of a problem with times serves its stages.

    Tracks may break the rules. `until` says when each visit of each robot begins to turn to its
    next edge; NEVER for last visits [ticks].

    Begins by arcs only rise from round to round, so the last ones are the least. Where stages wait
    for each other in a circle, which tours never do, rounds end after as many as there are stages.
    """
    raised: dict[tuple[int, int], Tick] = {}
    times = [StageTimes(serves=(), begins=(), ends=()) for _ in tracks]
    stale = set(range(len(tracks)))
    for _ in range(sum(len(robot.stages) for robot in problem.itineraries) + 1):
        for robot in stale:
            itinerary = problem.itineraries[robot]
            times[robot] = _serve(itinerary, tracks[robot], until[robot], _own(raised, robot))
        stale = set()
        for (robot, stage), after in problem.after:
            ends = times[robot].ends
            if stage < len(ends) and raised.get(after, 0) < ends[stage]:
                raised[after] = ends[stage]
                stale.add(after[0])
        if not stale:
            break
    return tuple(times)


def _own(raised: Mapping[tuple[int, int], Tick], robot: int) -> Mapping[int, Tick]:
    return {stage: tick for (other, stage), tick in raised.items() if other == robot}


def _serve(
    itinerary: Itinerary, track: Track, until: Sequence[int], raised: Mapping[int, Tick]
) -> StageTimes:
    """Return when one robot serves its stages, some of which begin only after others have ended."""
    stages = itinerary.stages_to_serve
    vertices, enter = track.vertices.tolist(), track.enter.tolist()
    serves, begins, ends = list[int](), list[Tick](), list[Tick]()
    visit, now = 0, max(enter[0], itinerary.ready)
    last = len(vertices) - 1
    for number, stage in enumerate(stages):
        is_rest = not itinerary.ends_anywhere and number == len(stages) - 1
        while True:
            begin = max(now, stage.earliest, raised.get(number, 0))
            end = begin + stage.work
            if vertices[visit] == stage.vertex and (
                visit == last or (not is_rest and end + stage.turn <= until[visit])
            ):
                break
            if visit == last:
                return StageTimes(serves=tuple(serves), begins=tuple(begins), ends=tuple(ends))
            visit += 1
            now = max(enter[visit], itinerary.ready)
        serves.append(visit)
        begins.append(Tick(begin))
        ends.append(Tick(end))
        now = end
    return StageTimes(serves=tuple(serves), begins=tuple(begins), ends=tuple(ends))
