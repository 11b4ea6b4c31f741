"""Valid calls of every callable of the native core, on small problems of every kind.

`CALLS` has an entry for each function, constructor, method and property: it returns the arguments
of a valid call. A fuzz takes them apart (`tests.builders.broken_calls`).
"""

from __future__ import annotations

import os
import random
from collections.abc import Callable, Iterator
from enum import Enum
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.plan_work.neighbourhoods import Neighbourhoods
from tests.builders.neighbourhoods import make_arguments, make_neighbourhoods

if TYPE_CHECKING:
    from rightofway import _core
elif "CORE" in os.environ:  # the file of another build, as with sanitizers
    _spec = spec_from_file_location("rightofway._core", os.environ["CORE"])
    _core = module_from_spec(_spec)
    _spec.loader.exec_module(_core)
else:
    from rightofway import _core

__all__ = [
    "CALLS", "TRACKS", "Arguments", "Part", "_core", "build", "callables",
    "int32", "int64", "made_of", "problem_arguments", "real", "with_changes",
]  # fmt: skip

Arguments = dict[str, Any]


class Part(NamedTuple):
    """An object among the arguments of a call: its class, and the arguments that make it."""

    name: str
    arguments: Arguments


def build(name: str, arguments: Arguments) -> Any:
    """Call what a name says, with arguments whose parts are made first."""
    return getattr(_core, name)(**made_of(arguments))


def made_of(arguments: Arguments) -> Arguments:
    """Return arguments whose parts are objects."""
    return {
        name: build(*value) if isinstance(value, Part) else value
        for name, value in arguments.items()
    }


def with_changes(arguments: Arguments, **changes: Any) -> Arguments:
    """Return arguments with other values, those of a part too; a name that no part has is added."""
    left = dict(changes)

    def changed(some: Arguments) -> Arguments:
        own = {name: left.pop(name) for name in some if name in left}
        return {
            name: own[name]
            if name in own
            else Part(value.name, changed(value.arguments))
            if isinstance(value, Part)
            else value
            for name, value in some.items()
        }

    return changed(arguments) | left


ROWS, COLUMNS = 3, 4
KINDS = ("points", "ahead", "sizes", "turns", "closures", "closed edges", "barred", "surcharges")
"""Kinds of problems; the fleet and the floor are the same in all of them."""


def int32(*values: int) -> NDArray[np.int32]:
    """Return an array of int32."""
    return np.array(values, np.int32)


def int64(*values: int) -> NDArray[np.int64]:
    """Return an array of int64."""
    return np.array(values, np.int64)


def real(*values: float) -> NDArray[np.float64]:
    """Return an array of float64."""
    return np.array(values, np.float64)


def _grid() -> tuple[list[int], list[int], list[int]]:
    """Return the edges of the grid by tail, and their classes: 0 along rows, 1 along columns."""
    indptr, heads, classes = [0], list[int](), list[int]()
    for row in range(ROWS):
        for column in range(COLUMNS):
            for down, right in ((0, 1), (1, 0), (0, -1), (-1, 0)):
                if 0 <= row + down < ROWS and 0 <= column + right < COLUMNS:
                    heads.append((row + down) * COLUMNS + column + right)
                    classes.append(abs(down))
            indptr.append(len(heads))
    return indptr, heads, classes


INDPTR, HEADS, CLASSES = _grid()
V, E = len(INDPTR) - 1, len(HEADS)
TAILS = [vertex for vertex in range(V) for _ in range(INDPTR[vertex], INDPTR[vertex + 1])]
EDGE = {(tail, head): edge for edge, (tail, head) in enumerate(zip(TAILS, HEADS, strict=True))}
HOMES, STOPS = (0, 3, 8), (11, 8, 5)


def graph() -> Arguments:
    """Return the grid in compressed rows."""
    return {"indptr": int32(*INDPTR), "indices": int32(*HEADS)}


def problem_arguments(kind: str) -> Arguments:
    """Return the arguments of a problem: three robots that go to a stop and come home."""
    stages = [vertex for pair in zip(STOPS, HOMES, strict=True) for vertex in pair]
    robots: Arguments = {
        "paces": int32(1, 2, 3, 2),
        "pace_of": int32(0, 1, 0),
        "home": int32(*HOMES),
        "first_stage": int32(0, 2, 4, 6),
        "stage_vertex": int32(*stages),
        "stage_work": int64(2, 0, 3, 0, 1, 0),
        "stage_turn": int64(1, 0, 1, 0, 0, 0),
        "size_of": None,
    }
    arguments: Arguments = {"roads": _roads(), "robots": Part("Robots", robots), "rules": _rules()}
    if kind == "ahead":
        arguments["rules"] = _rules(headway=1, books_ahead=True)
    elif kind == "sizes":
        robots["size_of"] = int32(0, 1, 0)
        arguments |= {"rules": _rules(books_ahead=True), "lists": _lists()}
    elif kind == "turns":
        arguments["turning"] = _turning(0, -1, 1)
    elif kind.startswith("clos"):
        arguments["closures"] = _closures(V + EDGE[0, 1] if kind == "closed edges" else 1)
    elif kind == "barred":
        robots |= {"paces": int32(1, 2, 3, -1), "pace_of": int32(0, 0, 0)}
    elif kind == "surcharges":
        arguments["surcharges"] = int64(0, 7)
    elif kind == "times":
        arguments["work"] = _work()
    return arguments


def _work() -> Part:
    """Return times of stages: the stop of the first robot is served before that of the second."""
    return Part("Work", {
        "earliest": int64(0, 0, 9, 0, 4, 0), "latest": np.full(6, _core.NEVER, np.int64),
        "ready": int64(0, 3, 0), "first_turn_of": int32(0, 0, 2, 2), "first_turn": int32(1, 0),
        "before": int32(0), "after": int32(2), "n_places": V,
        "cost": int64(2, 0, 1, 0, 3, 0), "late_cost": int64(4, 0, 1, 0, 0, 0),
        "due": int64(3, 0, 20, 0, 0, 0),
    })  # fmt: skip


def _roads() -> Part:
    graph = {"indptr": int32(*INDPTR), "heads": int32(*HEADS)}
    return Part("Roads", {**graph, "length_class": int32(*CLASSES), "n_classes": 2})


def _rules(*, headway: int = 0, books_ahead: bool = False) -> Part:
    arguments = {"headway": headway, "books_ahead": books_ahead, "rotations": True}
    return Part("BookingRules", arguments)


def _lists() -> Part:
    """Return lists of rows of two sizes: two large robots exclude each other from neighbours."""
    cells = np.column_stack(
        (np.tile(np.arange(COLUMNS), ROWS), np.repeat(np.arange(ROWS), COLUMNS))
    )
    drawing = {
        "x": cells[:, 0].astype(np.float64), "y": cells[:, 1].astype(np.float64),
        "limbs": 5 * cells.ravel().astype(np.uint32), "is_grid": False,
    }  # fmt: skip
    return Part("ExcludedRows", {
        "roads": _roads(), "drawing": Part("Drawing", drawing),
        "distance": real(0.6, 0.8, 0.8, 1.2),
        "distance_limbs": np.array([3, 4, 4, 6], np.uint32),
        "zone_first": int32(0, 2), "zone_member": int32(0, V + EDGE[5, 6]),
    })  # fmt: skip


def _turning(*class_of: int) -> Part:
    kinds = [CLASSES[one] ^ CLASSES[other] for one in range(E) for other in range(E)]
    return Part("Turning", {
        "offset": int64(*range(0, E * E, E)), "kind": int32(*kinds),
        "class_of": int32(*class_of), "ticks": int32(0, 2, 0, 5), "n_kinds": 2,
    })  # fmt: skip


def _closures(row: int) -> Part:
    return Part("Closures", {"row": int32(6, row), "start": int64(2, 0), "end": int64(5, 4)})


def _problem(rng: random.Random, kind: str | None = None) -> Part:
    return Part("Problem", problem_arguments(kind or rng.choice(KINDS)))


def _ticks_of_edges(rng: random.Random) -> NDArray[np.int32]:
    """Return one or two ticks for each edge."""
    return int32(*(rng.choice((1, 1, 2)) for _ in HEADS))


def tables() -> _core.DistanceTables:
    """Return distance tables of the grid."""
    return _core.DistanceTables(**graph())


def to_stop(vertex: int) -> NDArray[np.int32]:
    """Return the least edges from each vertex."""
    return tables().to(vertex, np.ones(E, np.int32))


def tracks(kind: str = "points", *, late: int = 0) -> Arguments:
    """Return tracks of the problem of a kind; they keep its rules."""
    search = _core.FleetSearch(build("Problem", problem_arguments(kind)), 0, 1)
    search.prioritize(int32(0, 1, 2), 100, None, None)
    first_visit, vertices, enter = search.tracks()
    enter[np.arange(len(enter)) >= first_visit[2] + 1] += late
    return {"first_visit": first_visit, "vertices": vertices, "enter": enter}


TRACKS = tracks()

LAPS = ((0, 1, 2, 1), (5, 1, 4, 1), (6, 2, 3, 2))
"""Vertices of laps that cross at vertex 1 and 2."""


def visits(robot: int) -> Arguments:
    """Return the visits of a lap on the grid, for bookings."""
    return {"vertex": int32(*LAPS[robot]), "dwell": int64(3, 0, 2, 0), "drive": int64(1, 1, 1, 1)}


def _with_edges(arguments: Arguments, robot: int) -> Arguments:
    lap = LAPS[robot]
    edges = [V + EDGE.get((lap[k - 1], lap[k]), 0) for k in range(len(lap))]
    return arguments | {"edge": int32(*edges)}


def _fewest_actions(rng: random.Random) -> Arguments:
    kind = rng.choice(KINDS)
    return {
        "problem": _problem(rng, kind), **tracks(kind), "waits": int64(1, 0, 2),
        "latest": rng.choice((_core.NEVER, 60)), "most_states": 500, "time_limit": 0.2,
    }  # fmt: skip


def _bookings(rng: random.Random) -> Arguments:
    kinds: tuple[Arguments, ...] = (
        {"period": 40},
        {"period": None},
        {"period": 60, "rules": _rules(headway=1, books_ahead=True)},
        {"period": 60, "rules": _rules(books_ahead=True), "n_rows": 2 * (V + E),
         "lists": _lists()},
    )  # fmt: skip
    return {"rules": _rules(), "n_rows": V} | rng.choice(kinds)


def _add(rng: random.Random) -> Arguments:
    robot = rng.randrange(3)
    enter = int64(0, 4, 5, 8) + rng.randrange(9)
    return {"robot": robot, **visits(robot), "enter": enter, "leave": rng.choice((None, 12 + 9))}


def _sized(rng: random.Random, arguments: Arguments) -> Arguments:
    """Return visits with or without the rows of edges."""
    return _with_edges(arguments, rng.randrange(3)) if rng.random() < 1 / 3 else arguments


def _trip(turning: Part | None) -> Part:
    return Part("RoundTrip", {
        "pace": int32(1, 2), "stage_vertex": int32(11, 0), "stage_work": int64(2, 1),
        "stage_turn": int64(1, 0), "stage_tables": [to_stop(11), to_stop(0)], "turning": turning,
    })  # fmt: skip


def _find_route(rng: random.Random) -> Arguments:
    return {
        "roads": _roads(),
        "trip": _trip(rng.choice((None, _turning(1)))),
        "phase": rng.randrange(50),
        "time_limit": 0.2,
        "first_row": 0,
    }


def _simulator(rng: random.Random) -> Arguments:
    vertex = int32(*(vertex for lap in LAPS for vertex in lap))
    laps: Arguments = {
        "first_visit": int32(0, 4, 8, 12),
        "vertex": vertex,
        "dwell": int64(3, 0, 2, 0, 4, 1, 2, 1, 3, 0, 3, 0),
        "drive": np.ones(12, np.int64),
    }
    arguments: Arguments = {
        "rules": _rules(books_ahead=rng.random() < 1 / 2),
        "laps": Part("Routes", laps),
        "first_least": int64(3, 4, 3),
        "horizon": _horizon(),
        "rule": rng.randrange(3),
        "loss": int64(5, 3, 2),
    }
    if rng.random() < 1 / 3:
        edges = [V + EDGE.get((lap[k - 1], lap[k]), 0) for lap in LAPS for k in (1, 2, 3, 0)]
        arguments |= {"rules": _rules(books_ahead=True), "rows": _rows(vertex, edges)}
    return arguments


def _horizon() -> Part:
    return Part("Horizon", {
        "pacemaker": 0, "lag": 9, "most_lag": 48, "patience": 96, "reach": 12, "memory": 8
    })  # fmt: skip


VISITED = (0, 1, 2, 3, 5, 1, 4, 8, 6, 2, 1, 0)
"""Vertices of three routes of four visits."""


def _routes(*dwell: int) -> Part:
    return Part("Routes", {
        "first_visit": int32(0, 4, 8, 12), "vertex": int32(*VISITED), "dwell": int64(*dwell),
        "drive": int64(*([0, 1, 1, 1] * 3)),
    })  # fmt: skip


def _rows(vertex: NDArray[np.int32], edges: list[int]) -> Part:
    return Part("VisitRows", {"lists": _lists(), "vertex": vertex, "edge": int32(*edges)})


def _rows_of_routes() -> Part:
    """Return the rows of the visits of `_routes`."""
    ends = [(VISITED[k], VISITED[(k + 1) % 12]) for k in range(12)]
    edges = [-1 if k % 4 == 3 else V + EDGE.get(pair, 0) for k, pair in enumerate(ends)]
    return _rows(int32(*VISITED), edges)


def _precedence_graph(rng: random.Random) -> Arguments:
    kind = rng.choice(("points", "ahead", "sizes", "closures"))
    arguments: Arguments = {
        "rules": _rules(),
        "routes": _routes(1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0),
        "swaps_conflict": True,
    }
    if kind in {"ahead", "sizes"}:
        arguments["rules"] = _rules(headway=1, books_ahead=True)
    if kind == "sizes":
        arguments["rows"] = _rows_of_routes()
    if kind == "closures":
        arguments["closures"] = _closed()
    return arguments


def _closed() -> Part:
    """Return closures of the second visit, and of the edge into the last one."""
    first = [0, 0, 0, *([2] * 20), 2, 3]
    closed = {"start": int64(0, 9, 4), "end": int64(3, 12, 8)}
    return Part("VisitClosures", {"first": int32(*first), **closed})


def _order(first_right: list[int], rights: list[int]) -> Part:
    return Part("Order", {
        "planned": int64(0, 2, 3, 4, 0, 5, 8, 9, 0, 6, 9, 11), "first_right": int32(*first_right),
        "rights": int32(*rights), "since": np.zeros(12, np.int64),
    })  # fmt: skip


def _delays() -> Part:
    return Part("DelayModel", {
        "pace": real(1, 1.5, 1), "kind": int32(0, 1, 2, 3, 4), "a": real(0.2, 0, 0.1, 0.1, 0.05),
        "b": real(0, 0.5, 0.05, 4, 0), **_stoppages(),
    })  # fmt: skip


def _adg(rng: random.Random) -> Arguments:
    arguments: Arguments = {
        "rules": _rules(books_ahead=rng.random() < 1 / 2),
        "routes": _routes(1, 0, 0, 2, 0, 2, 0, 1, 0, 0, 1, 0),
        "order": _order([0] * 6 + [1] * 4 + [2, 3, 4], [1, 2, 5, 0]),
        "delays": _delays(),
    }
    if rng.random() < 1 / 3:
        arguments |= {"rows": _rows_of_routes(), "rules": _rules(books_ahead=True)}
        arguments["order"] = _order([0] * 6 + [1] * 4 + [2, 3, 3], [1, 2, 5])
    if rng.random() < 1 / 3:
        arguments["closures"] = _closed()
    return arguments


def _stoppages() -> Arguments:
    return {
        "first_stoppage": int32(0, 1, 1, 3),
        "stoppage_tick": int64(3, 1, 6),
        "stoppage_ticks": int64(2, 1, _core.NEVER),
    }


def _arcs(rng: random.Random) -> Arguments:
    return {
        "n_nodes": 4,
        "tail": int32(0, 1, 2, 3, 1),
        "head": int32(1, 0, 3, 2, 2),
        "length": int64(3, 4, 2, 9, 1),
        "height": int32(0, 1, 0, 1, 0),
        "time_limit": rng.choice((None, 0.2)),
    }


def _earliest_track(rng: random.Random) -> Arguments:
    kind = rng.choice(KINDS)
    robot = rng.randrange(3)
    rows = {"sizes": 2 * (V + E), "closed edges": V + E}.get(kind, V)
    table = _core.BookingTable(rows)
    for row in rng.sample(range(rows), 5):
        table.mark(row, 3, 9, 7)
    return {
        "problem": _problem(rng, kind),
        "robot": robot,
        "bookings": table,
        "stage_tables": [to_stop(STOPS[robot]), to_stop(HOMES[robot])],
        "time_limit": 0.2,
    }


def _conflict_based(rng: random.Random, problem: Part) -> Arguments:
    """Return arguments of a search; costs with surcharges are not those of a latest completion."""
    limits = (_core.NEVER,) if "surcharges" in problem.arguments else (_core.NEVER, 40)
    return {
        "problem": problem, "cardinal": rng.random() < 1 / 2, "bypass": rng.random() < 1 / 2,
        "clear": rng.random() < 1 / 2, "targets": rng.random() < 1 / 2,
        "disjoint": rng.random() < 1 / 2,
        "pairs": rng.random() < 1 / 2, "pair_nodes": rng.randrange(9),
        "joint_states": rng.choice((0, 9, 1000)),
        "factor": rng.choice((10**6, 11 * 10**5)), "latest": rng.choice(limits),
    }  # fmt: skip


def _timed(**arguments: Any) -> Callable[[random.Random], Arguments]:
    return lambda rng: {**arguments, "time_limit": rng.choice((0.0, 0.05, 0.2))}


def _always(**arguments: Any) -> Callable[[random.Random], Arguments]:
    return lambda rng: dict(arguments)  # noqa: ARG005


def _tour_parts() -> dict[str, Part]:
    """Return jobs of one and two stops for two robots among five places, one with a battery."""
    spread = np.abs(np.subtract.outer(np.arange(5), np.arange(5)))
    return {
        "robots": Part("TourRobots", {
            "travel": int32(0, 0), "battery": int32(-1, 0), "start": int32(3, 4),
            "end": int32(-1, 0), "ready": int64(0, 2), "capacity": int32(1, 2),
            "load": int32(0, 0), "soc": int64(0, 9), "weight": int64(1, 2),
        }),
        "jobs": Part("TourJobs", {
            "first_stop": int32(0, 1, 3, 4), "place": int32(1, 0, 2, 4), "load": int32(0, 1, -1, 0),
            "work": int64(2, 1, 1, 0), "earliest": int64(0, 3, 0, 0),
            "latest": int64(_core.NEVER, _core.NEVER, 30, _core.NEVER),
        }),
        "rules": Part("TourRules", {
            "weight": int64(1, 2, 1), "release": int64(0, 3, 0),
            "due": int64(9, _core.NEVER, _core.NEVER), "begun_by": int32(-1, -1, -1),
            "first_robot": int32(0, 2, 4, 5), "robots": int32(0, 1, 0, 1, 1),
            "first_after": int32(0, 0, 0, 1), "after": int32(0),
        }),
        "batteries": Part("TourBatteries", {
            "full": int64(20), "on": int64(1), "work": int64(0), "charge": int64(4),
            "reserve": int64(2), "table": int32(0), "drive": int64(*spread.ravel()),
            "to_charging": int64(*spread[0]), "first_charging": int32(0, 1), "charging": int32(0),
        }),
    }  # fmt: skip


def _tour_problem(rng: random.Random) -> Arguments:
    spread = np.abs(np.subtract.outer(np.arange(5), np.arange(5)))
    objective = rng.choice((_core.TourObjective.service, _core.TourObjective.makespan))
    return {
        "n_places": 5, "ticks": int32(*spread.ravel()), **_tour_parts(),
        "objective": objective, "unit": 1, "late": rng.randrange(3),
    }  # fmt: skip


def _works() -> Part:
    """Return the works of twelve visits: two of the first robot, the second one after the third."""
    return Part("VisitWorks", {
        "first_work": int32(0, 0, 1, *[1] * 2, *[2] * 4, *[3] * 5), "ticks": int64(1, 1, 1),
        "earliest": int64(0, 0, 0), "planned": int64(1, 1, 1), "first_before": int32(0, 0, 0, 0),
        "before": int32(), "ends_with_work": int32(0, 0, 0),
    })  # fmt: skip


@cache
def _find_neighbourhoods() -> Neighbourhoods:
    return make_neighbourhoods(7, n_robots=2, n_jobs=3)


def _moves_of_jobs(_: random.Random) -> Arguments:
    return make_arguments(_find_neighbourhoods())


PARTS = (
    *_tour_parts().values(), _works(),
    _roads(), problem_arguments("sizes")["robots"], _rules(), _lists().arguments["drawing"],
    _lists(), _turning(0, -1, 1), _closures(1), _work(),
    _trip(_turning(0)), _horizon(), _routes(*[1] * 12), _rows_of_routes(), _closed(),
    _order([0] * 13, []), _delays(),
)  # fmt: skip
"""Objects that others are made of; what is wrong in them is found by those, or at once."""

CALLS: dict[str, Callable[[random.Random], Arguments]] = {
    "compiler": _always(),
    **{name: _always(**arguments) for name, arguments in PARTS},
    "ExcludedRows.n_rows": _always(),
    "ExcludedRows.n_found": _always(),
    "ExcludedRows.of": lambda rng: {"row": rng.randrange(2 * (V + E))},
    "Problem": lambda rng: problem_arguments(rng.choice((*KINDS, "times"))),
    "Problem.rules": _always(),
    "Problem.n_robots": _always(),
    "Problem.n_vertices": _always(),
    "PeriodicBookings": _bookings,
    "PeriodicBookings.reached": _always(),
    "PeriodicBookings.add": lambda rng: _sized(rng, _add(rng)),
    "PeriodicBookings.remove": lambda rng: {"robot": rng.randrange(3)},
    "PeriodicBookings.users": lambda rng: {
        "vertices": int32(0, 1, 5), "begins": rng.randrange(9), "ends": 9 + rng.randrange(50)
    },
    "PeriodicBookings.search": lambda rng: _sized(
        rng, {**visits(rng.randrange(3)), "phase": rng.randrange(50), "time_limit": 0.2}
    ),
    "PeriodicBookings.connect": lambda rng: _sized(
        rng, {**visits(rng.randrange(3)), "begins": 2, "until": 30 + rng.randrange(50), "leave": 90}
    ),
    "PeriodicBookings.find_route": _find_route,
    "DistanceTables": lambda rng: graph(),  # noqa: ARG005
    "DistanceTables.to": lambda rng: {
        "target": rng.randrange(V), "edge_ticks": _ticks_of_edges(rng)
    },
    "DistanceTables.energies_of_quickest_ways": lambda rng: {
        "ticks_to": to_stop(rng.randrange(V)), "edge_ticks": np.ones(E, np.int32),
        "edge_energy": np.ones(E, np.int64), "most": rng.randrange(9),
    },
    "DistanceTables.least_energies": lambda rng: {
        "targets": int32(3, rng.randrange(V)), "edge_energy": np.ones(E, np.int64), "most": 5
    },
    "TourProblem": _tour_problem,
    "TourProblem.n_jobs": _always(),
    "TourSearch": lambda rng: {
        "problem": Part("TourProblem", _tour_problem(rng)), "seed": rng.randrange(99)
    },
    "TourSearch.start": _always(first=int32(0, 3, 4), stops=int32(1, 0, 2, 3)),
    "TourSearch.construct": _timed(),
    "TourSearch.improve": _timed(n_steps=50),
    "TourSearch.tours": _always(),
    "TourSearch.unserved": _always(),
    "TourSearch.cost": _always(),
    "TourSearch.compare_robots": lambda rng: {"job": rng.randrange(2)},
    "RoutedMoves": _moves_of_jobs,
    "RoutedMoves.run": _timed(n_moves=40, most_gains=3),
    "RoutedMoves.n_gains": _always(),
    "RoutedMoves.tracks": _always(),
    "RoutedMoves.items": _always(),
    "ShortestPaths": lambda rng: {**graph(), "edge_ticks": _ticks_of_edges(rng)},
    "ShortestPaths.find": lambda rng: {"start": rng.randrange(V), "target": rng.randrange(V)},
    "find_overlaps": lambda rng: {
        "vertex": int32(0, 0, 1),
        "robot": int32(*(rng.randrange(3) for _ in range(3))),
        "start": np.array([0, rng.randrange(4), 2]),
        "end": np.array([3, 6, rng.randrange(3, 9)]),
        "most": rng.randrange(1, 9),
        "time_limit": None,
    },
    "Congestion": lambda rng: {
        "problem": _problem(rng), "shares": 16, "station": np.full(V, rng.randrange(99), np.int64)
    },
    "Congestion.path": lambda rng: {
        "robot": rng.randrange(3), "start": rng.randrange(V), "target": 11, "to_go": to_stop(11)
    },
    "Congestion.add": lambda rng: {"path": int32(0, 1, 2, 6), "oncoming": rng.randrange(99)},
    "CyclicSimulator": _simulator,
    "CyclicSimulator.advance": _timed(),
    "CyclicSimulator.reset_states": _always(),
    "CyclicSimulator.set_rule": lambda rng: {"rule": rng.randrange(3)},
    "CyclicSimulator.cut": _always(),
    "CyclicSimulator.first_seen": _always(),
    "CyclicSimulator.started": _always(),
    "CyclicSimulator.waits": lambda rng: {"robot": rng.randrange(3)},
    "CyclicSimulator.deadlock": _always(),
    "critical_circuit": _arcs,
    "earliest_times": lambda rng: {**_arcs(rng), "period": rng.randrange(9, 30), "parts": 1},
    "plan_by_lacam": lambda rng: {
        "problem": _problem(rng), "ends_anywhere": np.ones(rng.choice((0, 3)), np.uint8),
        "spreads": rng.random() < 1 / 2, "seed": rng.randrange(99),
        "most_effort": rng.choice((None, 10, 1000, 10**5)), "time_limit": 0.2,
    },
    "ConflictBasedSearch": lambda rng: _conflict_based(rng, _problem(rng)),
    "ConflictBasedSearch.run": _timed(
        upper=_core.NEVER, enough=_core.NEVER, most_nodes=50, most_bytes=2**24
    ),
    "ConflictBasedSearch.search_together": lambda rng: {
        "robots": int32(*rng.sample(range(3), rng.randrange(4))), "most_states": 500,
        "time_limit": 0.2,
    },
    "ConflictBasedSearch.tracks": _always(),
    "fewest_actions": _fewest_actions,
    "ConflictBasedSearch.n_nodes": _always(),
    "ConflictBasedSearch.n_searches": _always(),
    "PriceAscent": lambda rng: {"problem": _problem(rng)},
    "PriceAscent.run": _timed(steps=50),
    "PriceAscent.bound": _always(),
    "PriceAscent.n_steps": _always(),
    "PriceAscent.is_over": _always(),
    "FleetSearch": lambda rng: {
        "problem": _problem(rng, rng.choice((*KINDS, "times"))), "seed": rng.randrange(99),
        "n_threads": rng.randrange(1, 4), "alone": rng.choice((None, int64(14, 17, 7))),
        "horizon": rng.choice((None, 0, 5, 2**62)),
    },
    "FleetSearch.alone": _timed(),
    "FleetSearch.start": _always(**TRACKS),
    "FleetSearch.restore": _always(**TRACKS),
    "FleetSearch.take_over": lambda rng: {
        **TRACKS, "order": int32(*rng.sample(range(3), rng.randrange(4))), "time_limit": 0.2
    },
    "FleetSearch.prioritize": lambda rng: {
        "order": int32(*rng.sample(range(3), 3)), "n_searches": 100, "time_limit": 0.2,
        "with_fallback": 0.1,
    },
    "FleetSearch.compete": lambda rng: {
        "order": int32(*rng.sample(range(3), 3)), "n_searches": 100, "time_limit": 0.1
    },
    "FleetSearch.hurry": lambda rng: {
        "order": int32(*rng.sample(range(3), 3)), "n_searches": 100, "time_limit": 0.1
    },
    "FleetSearch.repair": lambda rng: {
        "order": int32(*rng.sample(range(3), rng.randrange(4))), "n_searches": 50, "time_limit": 0.2
    },
    "FleetSearch.resume": _timed(n_searches=200),
    "FleetSearch.move_one_at_a_time": _timed(),
    "FleetSearch.improve": _timed(n_tasks=40, patience=20, pause=None),
    "FleetSearch.retime": _always(),
    "FleetSearch.tracks": _always(),
    "FleetSearch.cost": _always(),
    "FleetSearch.value": _always(),
    "FleetSearch.n_idle": _always(),
    "FleetSearch.n_expanded": _always(),
    "ActionDependencyGraph": _adg,
    "ActionDependencyGraph.runs": lambda rng: {
        "seed": rng.randrange(99), "first": rng.randrange(9), "count": 3, "time_limit": 0.2
    },
    "ActionDependencyGraph.delay_sample": lambda rng: {"seed": 1, "run": rng.randrange(99)},
    "ActionDependencyGraph.execute": lambda rng: {
        "dwell": int64(*(rng.randrange(4) for _ in range(12))),
        "drive": int64(*([0, 1, 2, 1] * 3)), **_stoppages(), "clock": rng.random() < 1 / 2,
    },
    "ActionDependencyGraph.deadlocked": _always(),
    "ActionDependencyGraph.planned_completions": _always(),
    "PrecedenceGraph": _precedence_graph,
    "PrecedenceGraph.enter_of": lambda rng: {"visit": rng.randrange(12)},
    "PrecedenceGraph.enter": _always(),
    "PrecedenceGraph.completion": lambda rng: {"robot": rng.randrange(3)},
    "PrecedenceGraph.completion_sum": _always(),
    "PrecedenceGraph.critical_rights": lambda rng: {"robot": rng.randrange(3)},
    "PrecedenceGraph.incompatible": lambda rng: {"i": rng.randrange(3), "j": rng.randrange(3)},
    "PrecedenceGraph.conflicts": _always(),
    "PrecedenceGraph.conflicts_of": lambda rng: {
        "robot": rng.randrange(3), "others": np.ones(3, np.uint8)
    },
    "PrecedenceGraph.next_conflict": _always(),
    "PrecedenceGraph.next_conflict_between": lambda rng: {"i": rng.randrange(2), "j": 2},
    "PrecedenceGraph.precede": lambda rng: rng.choice(
        ({"a": 1, "b": 5}, {"a": 5, "b": 1}, {"a": 2, "b": 9}, {"a": 9, "b": 2}, {"a": 5, "b": 10})
    ),
    "PrecedenceGraph.cycle": _always(),
    "PrecedenceGraph.keep_order": lambda rng: {"when": int64(0, 2, 3, 4, 0, 5, 8, 9, 0, 6, 9, 11)},  # noqa: ARG005
    "PrecedenceGraph.take_back": lambda rng: {"a": rng.choice((1, 2)), "b": rng.choice((5, 9))},
    "PrecedenceGraph.checkpoint": _always(),
    "PrecedenceGraph.rollback": lambda rng: {"mark": rng.randrange(3)},
    "PrecedenceGraph.withdraw": lambda rng: {"robot": rng.randrange(3)},
    "PrecedenceGraph.rights_of": lambda rng: {"robot": rng.randrange(3)},
    "PrecedenceGraph.rights_of_way": _always(),
    "BookingTable": lambda rng: {"n_vertices": rng.randrange(V, 20)},
    "BookingTable.book": lambda rng: {
        "vertex": rng.randrange(3), "start": rng.randrange(9), "end": 20, "robot": rng.randrange(3)
    },
    "BookingTable.mark": lambda rng: {
        "row": rng.randrange(3), "start": rng.randrange(9), "end": 20, "robot": rng.randrange(-1, 3)
    },
    "BookingTable.erase": lambda rng: {
        "vertex": rng.randrange(3), "start": rng.randrange(9), "robot": rng.randrange(3)
    },
    "BookingTable.at": lambda rng: {"vertex": rng.randrange(V)},
    "earliest_track": _earliest_track,
}  # fmt: skip


def callables() -> Iterator[str]:
    """Yield the names of all functions, classes, methods and properties of the native core.

    An enumeration is none of them: it is an argument, as a number is.
    """
    for name, value in vars(_core).items():
        if name.startswith("_") or isinstance(value, int | float | str):
            continue
        if isinstance(value, type) and issubclass(value, Enum):
            continue
        yield name
        if isinstance(value, type):
            yield from (f"{name}.{own}" for own in vars(value) if not own.startswith("_"))
