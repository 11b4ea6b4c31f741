"""The native core: its twin of a problem, and the compiler of the core."""

from __future__ import annotations

import atexit
import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import accumulate, chain, pairwise
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.errors import InputError, quote
from rightofway.model import NEVER, BookingRules, Itinerary, Problem, Stage, Tick, Track
from rightofway.model.turning import Turning
from rightofway.native.resources import bind_lists
from rightofway.site import Roadmap, VertexId

ANYWHERE = VertexId(-1)
"""The vertex of the last stage of a robot that ends anywhere."""

LARGEST_SLOPE = 2**18
"""Cost of a tick that delays all stages of a robot; search keys have 37 bits for costs."""

LARGEST_COST = 10**6
"""The largest cost of a tick of one stage."""

_BOUND: WeakKeyDictionary[Problem, _core.Problem] = WeakKeyDictionary()
atexit.register(_BOUND.clear)  # a problem that lives to the end takes no native object along


def bind_native(problem: Problem) -> _core.Problem:
    """Return the native twin of a problem, which is made once and stored with it.

    Robots of one pace need the same ticks for every edge.

    Parameters
    ----------
    problem
        The scenario in ticks.

    Raises
    ------
    OverflowError
        If the ticks for an edge do not fit int32.
    InputError
        If it is no problem.
    """
    if not isinstance(problem, Problem):
        raise InputError.at("problem", f"{quote(problem)} is no problem (give scenario.problem)")
    native = _BOUND.get(problem)
    if native is None:
        roadmap, robots, sizes = problem.roadmap, problem.itineraries, problem.resources
        closed = problem.closures
        number: dict[tuple[Tick, ...], int] = {}
        pace_of = [number.setdefault(robot.edge_ticks, len(number)) for robot in robots]
        all_stages = [list_native_stages(robot) for robot in robots]
        stages = list(chain.from_iterable(all_stages))
        first_stage = [0, *accumulate(map(len, all_stages))]
        native = _BOUND[problem] = _core.Problem(
            bind_roads(roadmap),
            _core.Robots(
                paces=np.array(list(chain.from_iterable(number)), np.int32),
                pace_of=np.array(pace_of, np.int32),
                home=np.array([robot.home for robot in robots], np.int32),
                first_stage=np.array(first_stage, np.int32),
                stage_vertex=np.array([stage.vertex for stage in stages], np.int32),
                stage_work=np.array([stage.work for stage in stages], np.int64),
                stage_turn=np.array([stage.turn for stage in stages], np.int64),
                size_of=sizes.size_of,
                weight=np.array([robot.weight for robot in robots], np.int64),
            ),
            bind_rules(problem.booking_rules),
            lists=bind_lists(sizes),
            turning=bind_turning([robot.turning for robot in robots]),
            surcharges=np.array(robots[0].surcharges, np.int64) if robots[0].surcharges else None,
            closures=(
                None if closed is None else _core.Closures(closed.row, closed.start, closed.end)
            ),
            work=_bind_work(problem, stages, first_stage) if problem.has_times else None,
        )
    return native


def list_native_stages(itinerary: Itinerary) -> tuple[Stage, ...]:
    """Return the stages of a robot as kernels take them; one that ends anywhere ends at `ANYWHERE`.

    Parameters
    ----------
    itinerary
        What the robot has to do.
    """
    if not itinerary.ends_anywhere:
        return itinerary.stages
    return (*itinerary.stages_to_serve, Stage(vertex=ANYWHERE, work=Tick(0), turn=Tick(0)))


def _bind_work(problem: Problem, stages: Sequence[Stage], first_stage: Sequence[int]) -> _core.Work:
    """Return the times of a problem with jobs."""
    robots = problem.itineraries
    first_turns = [robot.first_turns for robot in robots]
    before, after = (
        np.array([first_stage[robot] + stage for robot, stage in pairs], np.int32)
        for pairs in ([arc.before for arc in problem.after], [arc.after for arc in problem.after])
    )
    latest = [NEVER if stage.latest is None else stage.latest for stage in stages]
    costs = _scale_costs(problem, stages, first_stage)
    return _core.Work(
        earliest=np.array([stage.earliest for stage in stages], np.int64),
        latest=np.array(latest, np.int64),
        ready=np.array([robot.ready for robot in robots], np.int64),
        first_turn_of=np.array([0, *accumulate(map(len, first_turns))], np.int32),
        first_turn=np.array(list(chain.from_iterable(first_turns)), np.int32),
        before=before,
        after=after,
        n_places=problem.roadmap.n_drawn,
        cost=None if costs is None else costs[0],
        late_cost=None if costs is None else costs[1],
        due=None
        if costs is None
        else np.array([NEVER if stage.due is None else stage.due for stage in stages], np.int64),
    )


def _scale_costs(
    problem: Problem, stages: Sequence[Stage], first_stage: Sequence[int]
) -> tuple[NDArray[np.int64], NDArray[np.int64]] | None:
    """Return what a tick of the end of each stage costs, and a tick after its due time more.

    None where ends cost nothing. A tick of completion costs the weight of its robot, and should
    decide only between plans of equal service: the scale is as large as the keys of the search
    allow, `LARGEST_SLOPE` for the stages of a robot together.
    """
    work = problem.work
    if work is None or not problem.minimizes_service:
        return None
    exact = [(stage.weight, stage.weight * work.late * (stage.due is not None)) for stage in stages]
    slope = max(
        sum(cost + late for cost, late in exact[first:end]) for first, end in pairwise(first_stage)
    )
    return scale_costs(exact, slope, work.late.denominator)


def scale_costs(
    costs: Sequence[tuple[Fraction | int, Fraction | int]], slope: Fraction | int, unit: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return what ticks of ends, and of ends after due times, cost in the keys of searches.

    ``costs`` are pairs of both. ``slope``, the largest sum of costs of the stages of a robot,
    becomes `LARGEST_SLOPE`. Costs stay exact if they are parts of a ``unit``, where the scale
    allows it.
    """
    scale = LARGEST_SLOPE / Fraction(slope)
    if scale >= unit:
        scale -= scale % unit  # all costs are whole numbers then
    scaled = [[min(math.ceil(cost * scale), LARGEST_COST) for cost in pair] for pair in costs]
    columns = np.array(scaled, np.int64).reshape(-1, 2).T
    return np.ascontiguousarray(columns[0]), np.ascontiguousarray(columns[1])


def bind_rules(rules: BookingRules) -> _core.BookingRules:
    """Return the rules of bookings for kernels.

    Parameters
    ----------
    rules
        Those of a problem.
    """
    return _core.BookingRules(int(rules.headway), rules.books_ahead, rules.rotations)


def bind_roads(roadmap: Roadmap) -> _core.Roads:
    """Return the graph of a roadmap.

    Parameters
    ----------
    roadmap
        Its vertices and directed edges, in rows by tail.
    """
    return _core.Roads(
        roadmap.indptr, roadmap.heads, roadmap.class_of_edge, n_classes=len(roadmap.edge_classes)
    )


def bind_turning(turnings: Sequence[Turning | None]) -> _core.Turning | None:
    """Return the turning times of robots; robots of one turn rate are a class.

    Parameters
    ----------
    turnings
        For each robot; None where turning takes no time.
    """
    number: dict[Turning, int] = {}
    class_of = [
        -1 if turning is None else number.setdefault(turning, len(number)) for turning in turnings
    ]
    classes = list(number)
    if not classes or not len(classes[0].ticks):
        return None  # or no edge follows another
    angles = classes[0].angles
    return _core.Turning(
        angles.offset,
        angles.kind,
        np.array(class_of, np.int32),
        np.concatenate([edge_class.ticks for edge_class in classes]).astype(np.int32),
        n_kinds=len(angles.angles),
    )


def make_tracks(
    first_visit: NDArray[np.int32], vertices: NDArray[np.int32], enter: NDArray[np.int64]
) -> list[Track]:
    """Return a track for each robot.

    Parameters
    ----------
    first_visit
        Robot ``r`` owns visits ``first_visit[r] .. first_visit[r + 1] - 1``; int32[R + 1].
    vertices, enter
        Where each visit is, and when it begins [ticks]; int32[N], int64[N].
    """
    return [
        Track(vertices=vertices[first:last].copy(), enter=enter[first:last].copy())
        for first, last in pairwise(first_visit.tolist())
    ]


def name_compiler() -> str:
    """Return the name and version of the compiler of the native core, like ``GCC 12.2.0``."""
    return _core.compiler()
