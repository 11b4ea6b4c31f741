"""Valid calls of every callable of the native core, on small problems of every kind.

`CALLS` has an entry for each function, constructor, method and property: it returns the arguments
of a valid call. A fuzz takes them apart (`tests.builders.broken_calls`).
"""

from __future__ import annotations

import os
import random
from collections.abc import Callable, Iterator
from importlib.util import module_from_spec, spec_from_file_location
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from rightofway import _core
elif "CORE" in os.environ:  # the file of another build, as with sanitizers
    _spec = spec_from_file_location("rightofway._core", os.environ["CORE"])
    _core = module_from_spec(_spec)
    _spec.loader.exec_module(_core)
else:
    from rightofway import _core

__all__ = [
    "CALLS", "EXCLUDED", "FIRST", "TRACKS", "Arguments", "_core", "callables", "int32", "int64",
    "real",
]  # fmt: skip

Arguments = dict[str, Any]

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


def _excluded() -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return lists of rows of two sizes: the large one excludes neighbours, too."""
    first, excluded = [0], list[int]()
    for size in range(2):
        for resource in range(V + E):
            if resource < V:
                near = {resource, *(HEADS[INDPTR[resource] : INDPTR[resource + 1]] * size)}
            else:
                tail, head = TAILS[resource - V], HEADS[resource - V]
                near = {V + EDGE[tail, head], V + EDGE[head, tail]}
            excluded += [other * (V + E) + one for other in range(2) for one in sorted(near)]
            first.append(len(excluded))
    return int32(*first), int32(*excluded)


FIRST, EXCLUDED = _excluded()


def graph() -> Arguments:
    """Return the grid in compressed rows."""
    return {"indptr": int32(*INDPTR), "indices": int32(*HEADS)}


def problem_arguments(kind: str) -> Arguments:
    """Return the arguments of a problem: three robots that go to a stop and come home."""
    stages = [vertex for pair in zip(STOPS, HOMES, strict=True) for vertex in pair]
    arguments: Arguments = {
        "indptr": int32(*INDPTR),
        "heads": int32(*HEADS),
        "length_class": int32(*CLASSES),
        "paces": int32(1, 2, 3, 2),
        "pace_of": int32(0, 1, 0),
        "home": int32(*HOMES),
        "first_stage": int32(0, 2, 4, 6),
        "stage_vertex": int32(*stages),
        "stage_work": int64(2, 0, 3, 0, 1, 0),
        "stage_turn": int64(1, 0, 1, 0, 0, 0),
        "n_classes": 2,
        "headway": 0,
        "books_ahead": False,
        "rotations": True,
    }
    if kind == "ahead":
        arguments |= {"headway": 1, "books_ahead": True}
    elif kind == "sizes":
        arguments |= {"books_ahead": True, "size_of": int32(0, 1, 0)}
        arguments |= {"first": FIRST, "excluded": EXCLUDED}
    elif kind == "turns":
        kinds = [CLASSES[one] ^ CLASSES[other] for one in range(E) for other in range(E)]
        arguments |= {"turn_offset": int64(*range(0, E * E, E)), "n_turn_kinds": 2}
        arguments |= {"turn_kind": int32(*kinds), "turn_class": int32(0, -1, 1)}
        arguments |= {"turn_ticks": int32(0, 2, 0, 5)}
    elif kind.startswith("clos"):
        edge = V + EDGE[0, 1] if kind == "closed edges" else 1
        arguments |= {"closed_row": int32(6, edge), "closed_from": int64(2, 0)}
        arguments |= {"closed_until": int64(5, 4)}
    elif kind == "barred":
        arguments |= {"paces": int32(1, 2, 3, -1), "pace_of": int32(0, 0, 0)}
    elif kind == "surcharges":
        arguments |= {"surcharges": int64(0, 7)}
    return arguments


def problem(rng: random.Random, kind: str | None = None) -> _core.Problem:
    """Return a problem of a kind, of any where none is given."""
    return _core.Problem(**problem_arguments(kind or rng.choice(KINDS)))


def tables() -> _core.DistanceTables:
    """Return distance tables of the grid."""
    return _core.DistanceTables(**graph())


def to_stop(vertex: int) -> NDArray[np.int32]:
    """Return the least edges from each vertex."""
    return tables().to(vertex, np.ones(E, np.int32))


def tracks(*, late: int = 0) -> Arguments:
    """Return tracks of the problem of points; they do not overlap."""
    search = _core.FleetSearch(_core.Problem(**problem_arguments("points")), 0, 1)
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


def _bookings(rng: random.Random) -> Arguments:
    kinds: tuple[Arguments, ...] = (
        {"period": 40},
        {"period": None},
        {"period": 60, "headway": 1, "books_ahead": True},
        {"period": 60, "books_ahead": True, "n_vertices": 2 * (V + E), "first": FIRST,
         "excluded": EXCLUDED},
    )  # fmt: skip
    return {"n_vertices": V, "headway": 0, "books_ahead": False} | rng.choice(kinds)


def _add(rng: random.Random) -> Arguments:
    robot = rng.randrange(3)
    enter = int64(0, 4, 5, 8) + rng.randrange(9)
    return {"robot": robot, **visits(robot), "enter": enter, "leave": rng.choice((None, 12 + 9))}


def _sized(rng: random.Random, arguments: Arguments) -> Arguments:
    """Return visits with or without the rows of edges."""
    return _with_edges(arguments, rng.randrange(3)) if rng.random() < 1 / 3 else arguments


def _find_route(rng: random.Random) -> Arguments:
    return {
        **graph(),
        "length_class": int32(*CLASSES),
        "pace": int32(1, 2),
        "stage_vertex": int32(11, 0),
        "stage_work": int64(2, 1),
        "stage_turn": int64(1, 0),
        "stage_tables": [to_stop(11), to_stop(0)],
        "phase": rng.randrange(50),
        "time_limit": 0.2,
        "first_row": 0,
    }


def _simulator(rng: random.Random) -> Arguments:
    arguments: Arguments = {
        "first_place": int32(0, 4, 8, 12),
        "vertex": int32(*(vertex for lap in LAPS for vertex in lap)),
        "least": int64(4, 1, 3, 1, 5, 2, 3, 2, 4, 1, 4, 1),
        "approach": np.zeros(12, np.int64),
        "first_least": int64(3, 4, 3),
        "headway": 0,
        "pacemaker": 0,
        "lag": 9,
        "most_lag": 48,
        "patience": 96,
        "reach": 12,
        "memory": 8,
        "rule": rng.randrange(3),
        "loss": int64(5, 3, 2),
    }
    if rng.random() < 1 / 3:
        edges = [V + EDGE.get((lap[k - 1], lap[k]), 0) for lap in LAPS for k in (1, 2, 3, 0)]
        arguments |= {"vertex_row": arguments["vertex"].copy(), "edge_row": int32(*edges)}
        arguments |= {"first": FIRST, "excluded": EXCLUDED, "approach": np.ones(12, np.int64)}
    return arguments


def _routes() -> Arguments:
    return {"first_visit": int32(0, 4, 8, 12), "vertex": int32(0, 1, 2, 3, 5, 1, 4, 8, 6, 2, 1, 0)}


def _rows() -> Arguments:
    """Return the rows of the visits of `_routes`."""
    vertex = _routes()["vertex"]
    edges = [-1 if k % 4 == 3 else V + EDGE.get((vertex[k], vertex[k + 1]), 0) for k in range(12)]
    return {"vertex_row": vertex, "edge_row": int32(*edges), "excluded": EXCLUDED}


def _precedence_graph(rng: random.Random) -> Arguments:
    kind = rng.choice(("points", "ahead", "sizes", "closures"))
    arguments: Arguments = {
        **_routes(),
        "least": int64(2, 1, 1, 0, 1, 3, 1, 0, 1, 1, 2, 0),
        "approach": np.zeros(12, np.int64),
        "headway": 0,
        "swaps_conflict": True,
        "active": np.ones(3, np.uint8),
    }
    if kind in {"ahead", "sizes"}:
        arguments |= {"headway": 1, "approach": int64(*([0, 1, 1, 1] * 3))}
    if kind == "sizes":
        arguments |= {**_rows(), "first": FIRST}
    if kind == "closures":
        arguments |= _closed() | {"drive": int64(*([0, 1, 1, 1] * 3))}
    return arguments


def _closed() -> Arguments:
    """Return closures of the second visit, and of the edge into the last one."""
    first = [0, 0, 0, *([2] * 20), 2, 3]
    return {"first_closed": int32(*first), "closed_from": int64(0, 9, 4),
            "closed_until": int64(3, 12, 8)}  # fmt: skip


def _adg(rng: random.Random) -> Arguments:
    arguments: Arguments = {
        **_routes(),
        "planned": int64(0, 2, 3, 4, 0, 5, 8, 9, 0, 6, 9, 11),
        "dwell": int64(1, 0, 0, 2, 0, 2, 0, 1, 0, 0, 1, 0),
        "drive": int64(*([0, 1, 1, 1] * 3)),
        "before": int32(-1, -1, -1, -1, -1, 1, -1, -1, -1, 2, 5, 0),
        "since": np.zeros(12, np.int64),
        "headway": 0,
        "books_ahead": rng.random() < 1 / 2,
        "pace": real(1, 1.5, 1),
        "delay_kind": int32(0, 1, 2, 3, 4),
        "delay_a": real(0.2, 0, 0.1, 0.1, 0.05),
        "delay_b": real(0, 0.5, 0.05, 4, 0),
        **_stoppages(),
    }
    if rng.random() < 1 / 3:
        arguments |= {**_rows(), "first_excluded": FIRST, "books_ahead": True}
        arguments |= {"before": np.full(12, -1, np.int32), "rights": int32(1, 2, 5)}
        arguments |= {"first_right": int32(*[0] * 6, 1, 1, 1, 1, 2, 3, 3)}
    if rng.random() < 1 / 3:
        arguments |= _closed()
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
        "problem": problem(rng, kind),
        "robot": robot,
        "bookings": table,
        "stage_tables": [to_stop(STOPS[robot]), to_stop(HOMES[robot])],
        "time_limit": 0.2,
    }


def _timed(**arguments: Any) -> Callable[[random.Random], Arguments]:
    return lambda rng: {**arguments, "time_limit": rng.choice((0.0, 0.05, 0.2))}


def _always(**arguments: Any) -> Callable[[random.Random], Arguments]:
    return lambda rng: dict(arguments)  # noqa: ARG005


CALLS: dict[str, Callable[[random.Random], Arguments]] = {
    "compiler": _always(),
    "Problem": lambda rng: problem_arguments(rng.choice(KINDS)),
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
        "target": rng.randrange(V), "edge_ticks": int32(*(rng.choice((1, 1, 2)) for _ in HEADS))
    },
    "Congestion": lambda rng: {
        "problem": problem(rng), "shares": 16, "station": np.full(V, rng.randrange(99), np.int64)
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
        "problem": problem(rng), "spreads": rng.random() < 1 / 2, "seed": rng.randrange(99),
        "most_effort": rng.choice((10, 1000, 10**5)), "time_limit": 0.2,
    },
    "untimed_lacam": lambda rng: {
        "problem": problem(rng), "ends_anywhere": np.ones(rng.choice((0, 3)), np.uint8),
        "seed": rng.randrange(99), "most_steps": rng.choice((None, 1000)), "time_limit": 0.2,
    },
    "FleetSearch": lambda rng: {
        "problem": problem(rng), "seed": rng.randrange(99), "n_threads": rng.randrange(1, 4),
        "alone": rng.choice((None, int64(14, 17, 7))),
    },
    "FleetSearch.alone": _timed(),
    "FleetSearch.start": _always(**TRACKS),
    "FleetSearch.restore": _always(**TRACKS),
    "FleetSearch.prioritize": lambda rng: {
        "order": int32(*rng.sample(range(3), 3)), "n_searches": 100, "time_limit": 0.2,
        "with_net": 0.1,
    },
    "FleetSearch.repair": lambda rng: {
        "order": int32(*rng.sample(range(3), rng.randrange(4))), "n_searches": 50, "time_limit": 0.2
    },
    "FleetSearch.go_on": _timed(n_searches=200),
    "FleetSearch.improve": _timed(n_tasks=40, patience=20, pause=None),
    "FleetSearch.retime": _always(),
    "FleetSearch.tracks": _always(),
    "FleetSearch.cost": _always(),
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
    """Yield the names of all functions, classes, methods and properties of the native core."""
    for name, value in vars(_core).items():
        if name.startswith("_") or isinstance(value, int | float | str):
            continue
        yield name
        if isinstance(value, type):
            yield from (f"{name}.{own}" for own in vars(value) if not own.startswith("_"))
