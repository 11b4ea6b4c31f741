"""The border of the native core: what it takes, what it hands back, what it refuses."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from rightofway import _core
from rightofway._core import CONFLICT_CAP, DistanceTables, PrecedenceGraph
from rightofway.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray


def int32(*values: int) -> NDArray[np.int32]:
    return np.array(values, np.int32)


def line() -> DistanceTables:
    """Return tables of 0 -> 1 -> 2."""
    return DistanceTables(int32(0, 1, 2, 2), int32(1, 2))


def int64(*values: int) -> NDArray[np.int64]:
    return np.array(values, np.int64)


def crossing(*, headway: int = 0, **changes: Any) -> PrecedenceGraph:
    """Return two robots, 0 9 1 and 2 9 3, that are both at 9 during [1, 2)."""
    arrays: dict[str, Any] = {
        "first_visit": int32(0, 3, 6),
        "vertex": int32(0, 9, 1, 2, 9, 3),
        "dwell": np.ones(6, np.int64),
        "drive": np.zeros(6, np.int64),
    }
    rules, routes = _core.BookingRules(headway, True), _core.Routes(**(arrays | changes))
    return PrecedenceGraph(rules, routes, swaps_conflict=True)


def test_read_only_arrays_are_taken() -> None:
    arrays = int32(0, 1, 2, 2), int32(1, 2), int32(3, 4)
    for array in arrays:
        array.flags.writeable = False
    indptr, indices, ticks = arrays

    assert DistanceTables(indptr, indices).to(2, ticks).tolist() == [7, 4, 0]


def test_arrays_of_another_type_are_refused_and_not_converted() -> None:
    """A conversion would hide a copy, or wrap a number that does not fit."""
    with pytest.raises(TypeError, match="int32"):
        line().to(2, np.array([3, 4], np.int64))
    with pytest.raises(TypeError, match="int64"):
        crossing(dwell=np.ones(6))


def test_arrays_with_gaps_are_refused() -> None:
    with pytest.raises(TypeError):
        line().to(2, int32(3, 0, 4, 0)[::2])


def test_arrays_are_read_and_not_kept() -> None:
    dwell = np.full(6, 5, np.int64)
    graph = crossing(dwell=dwell)

    dwell[:] = 1

    assert graph.precede(1, 4)
    assert graph.enter().tolist() == [0, 5, 10, 0, 10, 15]


def test_arrays_that_come_out_are_new_and_free() -> None:
    graph = crossing()

    enter = graph.enter()
    enter[:] = -1

    assert graph.enter().tolist() == [0, 1, 2, 0, 1, 2]


def test_arrays_that_come_out_outlive_what_they_came_from() -> None:
    graph = crossing()
    enter = graph.enter()

    del graph

    assert enter.tolist() == [0, 1, 2, 0, 1, 2]


def test_types_and_shapes_are_as_documented_even_when_empty() -> None:
    graph = crossing()
    arrays: dict[str, NDArray[Any]] = {
        "enter": graph.enter(),
        "cycle": graph.cycle(),
        "rights_of_way": graph.rights_of_way(),
        "to": line().to(0, int32(1, 1)),
    }

    assert {name: (array.dtype.name, array.shape) for name, array in arrays.items()} == {
        "enter": ("int64", (6,)),
        "cycle": ("int32", (0,)),
        "rights_of_way": ("int32", (0, 2)),
        "to": ("int32", (3,)),
    }


def test_a_crossing_is_resolved_through_the_binding() -> None:
    graph = crossing()
    assert graph.next_conflict() == (1, 0, 1, 4)

    mark = graph.checkpoint()
    assert graph.precede(1, 4)
    assert not graph.precede(4, 1)

    assert graph.cycle().tolist() == [1, 2, 4, 5]
    assert graph.rights_of_way().tolist() == [[1, 4]]
    assert graph.completion(1) == 3
    assert graph.next_conflict() is None
    graph.rollback(mark)
    assert graph.conflicts_of(0, np.array([0, 1], np.uint8)) == 1


def test_two_robots_that_stay_at_one_vertex_count_forever() -> None:
    graph = crossing(vertex=int32(0, 1, 9, 2, 3, 9))

    assert graph.conflicts() == CONFLICT_CAP == 2**32


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"first_visit": int32(0, 3, 7)}, r"first_visit\[2\]: 7 is not the number of visits, 6"),
        ({"vertex": int32(0, 9, 1, 2, 2, 3)}, r"vertex\[4\]: 2 is the vertex of the visit before"),
        ({"vertex": int32(0, 9, 1, 2, -9, 3)}, r"vertex\[4\]: -9 is negative"),
        ({"dwell": int64(1, 0, 1, 1, 1, 1)}, r"least\[1\]: 0 is not positive"),
        ({"dwell": int64(1, -1, 1, 1, 1, 1)}, r"least\[1\]: -1 is not positive"),
        ({"drive": int64(0, 2**62, 1, 1, 1, 1)}, r"drive\[1\]: 4611686018427387904 is not in 0"),
        ({"dwell": np.ones(5, np.int64)}, "dwell: its length is 5, but must be 6"),
        ({"drive": int64(0, 0, 0, 2, 0, 0)}, r"approach\[3\]: 2 must be 0 on a first"),
        ({"headway": -1}, "headway: -1 is not in 0"),
    ],
)
def test_bad_routes_are_value_errors_with_index_and_value(
    changes: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        crossing(**changes)


def test_bad_questions_are_value_errors_with_the_value() -> None:
    graph = crossing()
    with pytest.raises(ValueError, match=r"b: 6 is not in 0\.\.5"):
        graph.precede(1, 6)
    with pytest.raises(ValueError, match="b: 3 is at vertex 2, but a, 1, is at vertex 9"):
        graph.precede(1, 3)
    withdrawn = crossing()
    withdrawn.withdraw(1)
    with pytest.raises(ValueError, match="not active"):
        withdrawn.precede(1, 4)
    with pytest.raises(ValueError, match=r"robot: 2 is not in 0\.\.1"):
        graph.completion(2)
    with pytest.raises(ValueError, match=r"mark: 1 is not in 0\.\.0"):
        graph.rollback(1)


def test_bad_tables_are_value_errors_and_too_long_ways_overflow_errors() -> None:
    with pytest.raises(ValueError, match=r"indices\[1\]: 3 is not in 0\.\.2"):
        DistanceTables(int32(0, 1, 2, 2), int32(1, 3))
    with pytest.raises(ValueError, match=r"edge_ticks\[0\]: 0 is neither positive nor -1"):
        line().to(2, int32(0, 4))
    with pytest.raises(OverflowError, match="4294967294 ticks do not fit int32") as refused:
        line().to(2, int32(2**31 - 1, 2**31 - 1))
    assert isinstance(refused.value, InputError)


def test_threads_may_share_distance_tables() -> None:
    tables = line()
    answers: list[list[int]] = []

    threads = [
        threading.Thread(target=lambda: answers.append(tables.to(2, int32(3, 4)).tolist()))
        for _ in range(8)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

    assert answers == [[7, 4, 0]] * 8


@pytest.mark.parametrize("bound", [DistanceTables, PrecedenceGraph])
def test_everything_bound_is_documented(bound: type) -> None:
    public = [value for name, value in vars(bound).items() if not name.startswith("_")]

    assert _core.__doc__
    assert bound.__doc__
    assert all(value.__doc__ for value in public)
