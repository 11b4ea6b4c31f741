"""What the bindings of the native core refuse, with the place and the value."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.builders.binding_calls import (
    CALLS,
    TRACKS,
    _core,
    build,
    int32,
    int64,
    made_of,
    problem_arguments,
    real,
    with_changes,
)

Arguments = dict[str, Any]


def valid(name: str, **changes: Any) -> Arguments:
    """Return arguments of a valid call, and some others."""
    rng = random.Random(0)  # noqa: S311 - the same each time
    return with_changes(CALLS[name](rng), **changes)


def made(name: str, **changes: Any) -> Any:
    return build(name, valid(name, **changes))


def problem(kind: str, **changes: Any) -> Any:
    return build("Problem", with_changes(problem_arguments(kind), **changes))


def fleet(**changes: Any) -> _core.FleetSearch:
    """Return a search for the fleet of points, whose tracks are `TRACKS`."""
    return _core.FleetSearch(problem("points", **changes), seed=0, n_threads=1)


def with_entry(array: Any, index: int, value: float) -> Any:
    changed = array.copy()
    changed[index] = value
    return changed


LIMBS = problem_arguments("sizes")["lists"].arguments["drawing"].arguments["limbs"]
HEADS = problem_arguments("points")["roads"].arguments["heads"]

PROBLEMS = [
    ("sizes", {"size_of": None}, "size_of: is needed with lists"),
    ("sizes", {"x": real(*[0] * 11)}, "x: its length is 11, but must be 12"),
    ("sizes", {"y": real(*[0] * 3, math.nan, *[0] * 8)}, r"y\[3\]: nan is no length"),
    ("sizes", {"x": real(-1, *[0] * 11)}, r"x\[0\]: -1.0+ is no length"),
    ("sizes", {"limbs": LIMBS[:-1]}, "limbs: its length is 23, but must be 24"),
    ("sizes", {"distance": real(1, 1, 1)}, "distance: its length is 3, but must be 4"),
    ("sizes", {"distance": real(1, 1, 1, math.inf)}, r"distance\[3\]: inf is no length"),
    ("sizes", {"distance_limbs": LIMBS[:3]}, "distance_limbs: its length is 3, but must be 4"),
    ("sizes", {"zone_first": int32(0, 3)}, r"zone_first\[1\]: 3 is not the number of"),
    ("sizes", {"zone_member": int32(0, 46)}, r"zone_member\[1\]: 46 is not in 0\.\.45"),
    ("sizes", {"size_of": int32(0, 2, 0)}, r"size_of\[1\]: 2 is not in 0\.\.1"),
    ("turns", {"n_kinds": -1}, "n_turn_kinds: -1 is negative"),
    ("turns", {"class_of": int32()}, "class_of: its length is 0, but must be 3"),
    (
        "turns",
        {"offset": np.full(34, 2**63 - 1)},
        r"turn_offset\[0\]: 9223372036854775807 leads out of turn_kind",
    ),
    ("surcharges", {"surcharges": int64()}, "surcharges: its length is 0, but must be 2"),
    ("points", {"first_stage": int32(0, 2, 2, 6)}, r"first_stage\[2\]: 2 is not at least 1 above"),
    ("points", {"heads": with_entry(HEADS, 4, 12)}, r"heads\[4\]: 12 is not in"),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "changes", "message"), PROBLEMS)
def test_problems_whose_arrays_do_not_fit_are_refused(
    kind: str, changes: Arguments, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        problem(kind, **changes)


def test_the_problems_that_are_broken_here_are_fine_otherwise() -> None:
    for kind in ("points", "sizes", "turns", "surcharges"):
        assert problem(kind).n_robots == 3


FIRST_VISIT, VERTICES, ENTER = TRACKS["first_visit"], TRACKS["vertices"], TRACKS["enter"]

TRACKS_REFUSED = [
    ({"first_visit": FIRST_VISIT[:-1]}, "first_visit: its length is 3, but must be 4"),
    ({"first_visit": with_entry(FIRST_VISIT, 1, 99)}, r"first_visit\[2\]: \d+ is less than"),
    ({"first_visit": with_entry(FIRST_VISIT, 3, 99)}, r"first_visit\[3\]: 99 is not the number of"),
    ({"vertices": VERTICES[:-1]}, r"first_visit\[3\]: 27 is not the number of visits, 26"),
    ({"enter": ENTER[:-1]}, "enter: its length is 26, but must be 27"),
    ({"vertices": with_entry(VERTICES, 1, 12)}, r"vertices\[1\]: 12 is not in 0\.\.11"),
    ({"vertices": with_entry(VERTICES, 0, 1)}, r"vertices\[0\]: 1 is not the home of robot 0, 0"),
    ({"vertices": with_entry(VERTICES, 1, 6)}, r"vertices\[1\]: 6 is not next to the one before"),
    ({"enter": with_entry(ENTER, 0, 1)}, r"enter\[0\]: 1 must be 0 on a first visit"),
    (
        {"enter": with_entry(ENTER, 1, 1)},
        r"enter\[1\]: 1 is sooner than robot 0 can turn and drive",
    ),
    ({"enter": with_entry(ENTER, 1, -1)}, r"enter\[1\]: -1 is not in 0"),
    ({"enter": with_entry(ENTER, -1, 2**63 - 1)}, r"enter\[26\]: 9223372036854775807 is not in 0"),
]


@pytest.mark.parametrize("method", ["start", "restore"])
@pytest.mark.parametrize(("changes", "message"), TRACKS_REFUSED)
def test_tracks_that_are_none_are_refused(method: str, changes: Arguments, message: str) -> None:
    search = fleet()
    search.start(**TRACKS)
    with pytest.raises(ValueError, match=message):
        getattr(search, method)(**TRACKS | changes)


def test_a_restore_needs_tracks_of_all_robots_that_do_not_overlap() -> None:
    search = fleet()
    with pytest.raises(ValueError, match="restore: 0 is a robot without a track"):
        search.restore(**TRACKS)
    search.start(**TRACKS)
    empty: Arguments = {"first_visit": int32(0, 0, 0, 0), "vertices": int32(), "enter": int64()}
    with pytest.raises(ValueError, match="robot: 0 has an empty track"):
        search.restore(**empty)
    # Robot 1 passes the home of robot 0 at tick 9, which leaves it at tick 2; here at tick 10.
    late = ENTER.copy()
    late[1 : FIRST_VISIT[1]] += 8
    with pytest.raises(ValueError, match="robot: 1 has a track that breaks the rules: it overlaps"):
        search.restore(FIRST_VISIT, VERTICES, late)


def test_what_needs_a_plan_is_refused_without_one() -> None:
    search = fleet()
    with pytest.raises(ValueError, match="improve: 0 is a robot without a track"):
        search.improve(n_tasks=3, patience=3, time_limit=None, pause=None)
    with pytest.raises(ValueError, match="retime: 0 is a robot without a track"):
        search.retime()
    with pytest.raises(ValueError, match="resume: there is no attempt to continue"):
        search.resume(n_searches=3, time_limit=None)


@pytest.mark.parametrize(
    ("method", "order", "message"),
    [
        ("prioritize", int32(0, 1), "order: its length is 2, but must be 3"),
        ("prioritize", int32(0, 1, 3), r"order\[2\]: 3 is not in 0\.\.2"),
        ("prioritize", int32(0, 1, 1), r"order\[2\]: 1 is there twice"),
        ("repair", int32(0, -1), r"order\[1\]: -1 is not in 0\.\.2"),
        ("repair", int32(0, 1), "order: 2 is a robot without a track, and left out"),
    ],
)
def test_orders_that_are_none_are_refused(method: str, order: Any, message: str) -> None:
    limits = {"n_searches": 9, "time_limit": None}
    if method == "prioritize":
        limits |= {"with_fallback": None}
    with pytest.raises(ValueError, match=message):
        getattr(fleet(), method)(order, **limits)


def test_a_robot_with_a_track_needs_no_repair() -> None:
    search = fleet()
    search.start(**TRACKS)
    with pytest.raises(ValueError, match=r"order\[0\]: 1 is a robot that has a track"):
        search.repair(int32(1), 9, None)
    assert search.repair(int32(), 9, None)


def test_a_fleet_of_nobody_is_planned() -> None:
    empty = {"indptr": int32(0), "first_stage": int32(0)} | {
        name: int64() if name in {"stage_work", "stage_turn"} else int32()
        for name in ("heads", "length_class", "pace_of", "home", "stage_vertex", "stage_work",
                     "stage_turn")
    }  # fmt: skip
    search = fleet(**empty)
    alone = search.alone()
    assert alone is not None
    assert alone.tolist() == []
    assert search.prioritize(int32(), 9, None, None)
    assert search.improve(9, 9, None, None) == 0


@pytest.mark.parametrize(
    ("name", "changes", "message"),
    [
        ("FleetSearch", {"n_threads": 0}, r"n_threads: 0 is not in 1\.\.1024"),
        ("FleetSearch", {"n_threads": 2**40}, r"n_threads: 1099511627776 is not in 1\.\.1024"),
        ("FleetSearch", {"alone": int64(1, -2, 1)}, r"alone\[1\]: -2 is not in -1\.\."),
        ("BookingTable", {"n_vertices": 2**31 - 1}, "n_vertices: 2147483647 is not in 0"),
        ("PeriodicBookings", {"n_rows": 2**31 - 1}, "n_rows: 2147483647 is not in 0"),
        ("CyclicSimulator", {"pacemaker": 3}, r"pacemaker: 3 is not in 0\.\.2"),
        ("CyclicSimulator", {"lag": 0}, r"lag: 0 is not in 1\.\."),
        ("CyclicSimulator", {"memory": 0}, "memory: 0 is not above 0"),
        ("critical_circuit", {"n_nodes": 2**31 - 1}, "n_nodes: 2147483647 is not in 0"),
        ("earliest_times", {"parts": 0}, "parts: 0 is not above 0"),
        ("earliest_times", {"period": -1}, "period: -1 is negative"),
        ("ActionDependencyGraph", {"pace": real(1, math.nan, 1)}, r"pace\[1\]: nan is not in 0"),
        (
            "ActionDependencyGraph",
            {"first_visit": int32(0, 99, 8, 12)},
            r"first_visit\[2\]: 8 is not at least 1 above the entry before it",
        ),
    ],
)
def test_arguments_of_constructors_and_functions_are_refused(
    name: str, changes: Arguments, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        made(name, **changes)


@pytest.mark.parametrize(
    ("name", "changes", "message"),
    [
        ("users", {"vertices": int32(0, 99)}, "vertex: 99 is not in 0"),
        ("add", {"robot": -1}, "robot: -1 is negative"),
        ("add", {"enter": int64(0, 4, 5, 2**62)}, r"enter\[3\]: 4611686018427387904 is not in"),
        ("search", {"phase": 2**62}, "phase: 4611686018427387904 is not in"),
        ("find_route", {"first_row": 1}, r"first_row: 1 is not in 0\.\.0"),
        ("find_route", {"pace": int32(1, 0)}, r"pace\[1\]: 0 is neither positive nor -1"),
        ("find_route", {"heads": int32(*range(34))}, r"heads\[12\]: 12 is not in 0\.\.11"),
        ("find_route", {"stage_work": int64(2, -1)}, r"stage_work\[1\]: -1 is not in 0"),
        ("find_route", {"time_limit": math.nan}, "time_limit: nan is no number of seconds"),
    ],
)
def test_arguments_of_periodic_bookings_are_refused(
    name: str, changes: Arguments, message: str
) -> None:
    bookings = _core.PeriodicBookings(_core.BookingRules(0, False), 12, 40)
    arguments = valid(f"PeriodicBookings.{name}", **changes)
    if name in {"add", "search"}:
        arguments |= {"edge": None}
    with pytest.raises(ValueError, match=message):
        getattr(bookings, name)(**made_of(arguments))


def test_a_table_that_hides_the_target_is_refused() -> None:
    congestion = made("Congestion")
    hidden = with_entry(valid("Congestion.path")["to_go"], 11, -1)
    with pytest.raises(ValueError, match="target: 11 cannot be reached from 0"):
        congestion.path(0, 0, 11, hidden)


def test_a_simulation_without_a_deadlock_has_none_to_tell() -> None:
    with pytest.raises(ValueError, match="deadlock: the latest advance"):
        made("CyclicSimulator").deadlock()


def alone_in(seconds: float | None) -> Any:
    return fleet().alone(seconds)


@pytest.mark.parametrize("seconds", [None, 1e10, 1e300, math.inf, 60.0])
def test_a_limit_far_away_is_none(seconds: float | None) -> None:
    """10^10 s are more nanoseconds than 64 bits number."""
    assert alone_in(seconds).tolist() == [17, 30, 7]


@pytest.mark.parametrize("seconds", [0.0, -0.0, -1.0, -1e300, -math.inf])
def test_a_limit_of_nothing_or_less_is_over_at_once(seconds: float) -> None:
    assert alone_in(seconds) is None


@pytest.mark.parametrize(
    "call",
    [
        lambda search, nan: search.alone(nan),
        lambda search, nan: search.prioritize(int32(0, 1, 2), 9, None, nan),
        lambda search, nan: search.improve(9, 9, None, nan),
    ],
)
def test_a_limit_that_is_no_number_is_refused(call: Callable[[Any, float], object]) -> None:
    search = fleet()
    search.start(**TRACKS)
    with pytest.raises(
        ValueError, match=r"^(time_limit|with_fallback|pause): nan is no number of seconds"
    ):
        call(search, math.nan)
