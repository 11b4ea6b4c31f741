"""Where two routes run together."""

import pytest

from rightofway.model import Route, Tick
from rightofway.precedence import find_shared_segment, make_crossing
from rightofway.site import VertexId


def route(*vertices: int) -> Route:
    n = len(vertices)
    drive = (Tick(0), *(Tick(1),) * (n - 1))
    return Route(vertices=tuple(map(VertexId, vertices)), dwell=(Tick(0),) * n, drive=drive)


def test_head_on_the_segment_is_what_one_visits_in_reverse_order() -> None:
    one, other = route(9, 1, 2, 3, 8), route(7, 3, 2, 1, 6)
    segment = find_shared_segment(one, 2, other, 2)
    assert (segment.kind, segment.i_vertices) == ("head-on", (1, 2, 3))
    assert segment.list_meetings() == [(1, 3), (2, 2), (3, 1)]
    # The other one enters it at 3 when i has left 3, and i at 1 when the other has left 1.
    assert segment.list_rights_of_i() == [(3, 1)]
    assert segment.list_rights_of_j() == [(1, 3)]


def test_the_same_way_the_first_stays_ahead_at_every_vertex() -> None:
    one, other = route(9, 1, 2, 3, 8), route(7, 1, 2, 3, 6)
    segment = find_shared_segment(one, 3, other, 3)
    assert (segment.kind, segment.i_vertices) == ("following", (1, 2, 3))
    assert segment.list_rights_of_i() == segment.list_rights_of_j() == [(1, 1), (2, 2), (3, 3)]


def test_routes_that_only_cross_share_one_vertex() -> None:
    segment = find_shared_segment(route(9, 1, 8), 1, route(7, 1, 6), 1)
    assert (segment.kind, segment.i_vertices, segment.list_rights_of_j()) == (
        "vertex",
        (1,),
        [(1, 1)],
    )


def test_the_published_method_sees_a_crossing_only() -> None:
    segment = make_crossing(route(1, 2, 3), 1, route(3, 2, 1), 1)
    assert (segment.kind, segment.i_vertices, segment.j_vertices) == ("vertex", (2,), (2,))


@pytest.mark.parametrize("visit", [0, 1, 2])
def test_it_is_one_segment_wherever_in_it_they_meet(visit: int) -> None:
    one, other = route(1, 2, 3), route(3, 2, 1)
    assert find_shared_segment(one, visit, other, 2 - visit) == find_shared_segment(
        one, 0, other, 2
    )


def test_where_it_could_be_both_they_are_head_on() -> None:
    """The other turns in 1: it comes from 2 and goes back to 2, and i goes from 2 to 1."""
    assert find_shared_segment(route(2, 1), 1, route(2, 1, 2), 1).kind == "head-on"
