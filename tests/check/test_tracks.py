"""The judge of one robot: its drives, its home, its work, its end; every fault is planted here."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import pytest

from rightofway.check import Report, check
from rightofway.model import Plan, PlannerRun, Robot, Rules, Scenario, Stop, Track
from rightofway.model.problem import MAX_TICKS
from rightofway.site import Edge, VertexId, make_grid_roadmap, make_roadmap

# The rows 0 1 2 and 3 4 5; robots drive an edge in one tick and turn at stops in another.
GRID = ["...", "..."]


def judged(
    stops: Sequence[tuple[int, int]],
    vertices: Sequence[int],
    enter: Sequence[int],
    *,
    speed: Fraction = Fraction(1),
    rules: Rules | None = None,
) -> Report:
    """Judge R1 with its home at N0 and stops of (vertex, work)."""
    robot = Robot(
        name="R1",
        home=VertexId(0),
        stops=tuple(Stop(at=VertexId(at), work=Fraction(work)) for at, work in stops),
        speed=speed,
    )
    scenario = Scenario(roadmap=make_grid_roadmap(GRID), robots=(robot,), rules=rules or Rules())
    track = Track.of(vertices, enter)
    return check(Plan(scenario=scenario, tracks=(track,), run=PlannerRun(name="by hand")))


def kinds(report: Report) -> list[str]:
    return [fault.kind for fault in report.faults]


ONE_WAY = Rules(ends="none")


def test_a_round_trip_is_passed() -> None:
    # There in 2 ticks, 1 of turning, back in 2: home at tick 5.
    report = judged([(2, 0)], [0, 1, 2, 1, 0], [0, 1, 2, 4, 5])
    assert report.ok
    assert report.faults == ()


def test_work_and_turning_come_before_the_edge_that_leaves_the_stop() -> None:
    # In N1 from tick 1: 3 working, 1 turning, 1 driving: home at tick 6, not sooner.
    assert judged([(1, 3)], [0, 1, 0], [0, 1, 6]).ok
    assert kinds(judged([(1, 3)], [0, 1, 0], [0, 1, 5])) == ["work cut short"]


def test_work_cut_short_tells_how_long_to_stay() -> None:
    fault = judged([(1, 3)], [0, 1, 0], [0, 1, 4]).faults[0]
    assert (fault.kind, fault.robots, fault.vertices, fault.tick) == (
        "work cut short",
        (0,),
        (1,),
        1,
    )
    assert fault.message == (
        "R1 has 2 time units at N1, it needs 3 time units working and 1 time unit turning"
        " (stay 2 time units longer)"
    )


def test_of_several_visits_that_are_too_short_the_longest_is_told() -> None:
    # 0, 2 and 1 ticks beyond the drive.
    report = judged([(1, 3)], [0, 1, 2, 1, 4, 1, 0], [0, 1, 2, 3, 6, 7, 9])
    assert [(fault.kind, fault.tick) for fault in report.faults] == [("work cut short", 3)]


def test_the_last_visit_needs_no_turning_and_never_ends() -> None:
    assert judged([(1, 3)], [0, 1], [0, 1], rules=ONE_WAY).ok


def test_a_robot_may_pass_its_stop_and_work_there_later() -> None:
    assert judged([(1, 1)], [0, 1, 2, 1, 0], [0, 1, 2, 3, 6]).ok


def test_stops_that_follow_each_other_at_one_vertex_share_a_visit() -> None:
    # Work of 2 and 3, one turn after both: 6 ticks and 1 of driving.
    assert judged([(1, 2), (1, 3)], [0, 1, 0], [0, 1, 8]).ok
    assert kinds(judged([(1, 2), (1, 3)], [0, 1, 0], [0, 1, 7])) == ["work cut short"]


def test_between_two_stops_at_one_vertex_a_robot_may_drive_away_without_turning() -> None:
    # N1 from 1 to 4: work of 2 and a drive; again from 5 to 10: work of 3, a turn and a drive.
    assert judged([(1, 2), (1, 3)], [0, 1, 2, 1, 0], [0, 1, 4, 5, 10]).ok
    too_soon = judged([(1, 2), (1, 3)], [0, 1, 2, 1, 0], [0, 1, 4, 5, 9])
    assert kinds(too_soon) == ["work cut short"]


def test_stops_are_visited_in_their_order() -> None:
    # N1 and N2 both long enough, but N1 first and never again.
    report = judged([(2, 0), (1, 1)], [0, 1, 2, 5, 4, 3, 0], [0, 1, 4, 6, 7, 8, 9])
    assert [(fault.kind, fault.vertices, fault.tick) for fault in report.faults] == [
        ("stop missed", (1,), 4)
    ]
    assert report.faults[0].message == (
        "R1 does not come to N1 at time 4 or later (visit its stops in their order)"
    )


def test_each_missed_stop_is_told() -> None:
    report = judged([(2, 0), (4, 0), (5, 0)], [0, 1, 4, 1, 0], [0, 1, 2, 4, 5])
    assert [(fault.kind, fault.vertices) for fault in report.faults] == [
        ("stop missed", (2,)),
        ("stop missed", (5,)),
    ]


def test_between_laps_a_robot_turns_at_home() -> None:
    laps = Rules(laps=2)
    # N1 at tick 1, turn, N0 at 3, turn, N1 at 5, turn, N0 at 7.
    assert judged([(1, 0)], [0, 1, 0, 1, 0], [0, 1, 3, 5, 7], rules=laps).ok
    report = judged([(1, 0)], [0, 1, 0, 1, 0], [0, 1, 3, 4, 6], rules=laps)
    # Without turning in N0 the first lap ends at tick 6, and nothing is left of the second.
    assert [(fault.kind, fault.tick) for fault in report.faults] == [("stop missed", 6)]


def test_a_lap_too_few_is_a_stop_missed() -> None:
    report = judged([(1, 0)], [0, 1, 0], [0, 1, 3], rules=Rules(laps=2))
    assert [(fault.kind, fault.vertices) for fault in report.faults] == [("stop missed", (1,))]


def test_work_cut_short_in_every_lap_is_told_of_every_lap() -> None:
    report = judged([(1, 2)], [0, 1, 0, 1, 0], [0, 1, 4, 6, 8], rules=Rules(laps=2))
    assert [(fault.kind, fault.tick) for fault in report.faults] == [
        ("work cut short", 1),
        ("work cut short", 6),
    ]


def test_work_at_home_needs_no_move() -> None:
    assert judged([(0, 4)], [0], [0]).ok


def test_a_robot_that_never_moves_misses_its_stop() -> None:
    assert kinds(judged([(1, 0)], [0], [0])) == ["stop missed"]


def test_a_wrong_home_is_told() -> None:
    report = judged([(2, 0)], [1, 2, 1, 0], [0, 1, 3, 4])
    assert [(fault.kind, fault.message) for fault in report.faults] == [
        ("wrong home", "R1 starts at N1 at time 0 (start at its home, N0, at time 0)")
    ]


@pytest.mark.parametrize("start", [-1, 1])
def test_home_counts_from_tick_0(start: int) -> None:
    report = judged([(1, 0)], [0, 1, 0], [start, 2, 4])
    assert [(fault.kind, fault.tick) for fault in report.faults] == [("wrong home", start)]


def test_a_round_trip_ends_at_home() -> None:
    report = judged([(2, 0)], [0, 1, 2, 1], [0, 1, 2, 4])
    assert [(fault.kind, fault.vertices, fault.message) for fault in report.faults] == [
        ("wrong end", (1,), "R1 ends at N1 (end at N0)")
    ]


def test_a_trip_one_way_ends_at_its_stop() -> None:
    assert kinds(judged([(1, 0)], [0, 1, 0], [0, 1, 3], rules=ONE_WAY)) == ["wrong end"]


def test_a_jump_is_told() -> None:
    fault = judged([(5, 0)], [0, 5, 2, 1, 0], [0, 1, 3, 4, 5]).faults[0]
    assert (fault.kind, fault.vertices, fault.tick) == ("jump", (0, 5), 1)
    assert fault.message == "R1 goes from N0 to N5, no edge leads there (use edges)"


def test_a_vertex_entered_twice_in_a_row_is_a_jump() -> None:
    fault = judged([(1, 0)], [0, 1, 1, 0], [0, 1, 3, 4]).faults[0]
    assert (fault.kind, fault.vertices, fault.tick) == ("jump", (1, 1), 3)
    assert fault.message == "R1 enters N1 twice in a row (make it one visit)"


def test_a_drive_that_is_too_fast_is_told() -> None:
    # At speed 1/2 an edge takes 2 units of time; with all durations even, the tick is 2 units, so
    # work of 1 is there to make a tick one unit.
    report = judged([(1, 1)], [0, 1, 0], [0, 1, 6], speed=Fraction(1, 2))
    assert [(fault.kind, fault.vertices, fault.tick, fault.message) for fault in report.faults] == [
        (
            "too fast",
            (0, 1),
            1,
            (
                "R1 drives from N0 to N1 in 1 time unit, it needs 2 time units"
                " (enter at time 2 or later)"
            ),
        )
    ]


def test_leaving_at_the_instant_of_entering_is_too_fast() -> None:
    report = judged([(2, 0)], [0, 1, 2, 1, 0], [0, 1, 1, 3, 4])
    assert [(fault.kind, fault.tick) for fault in report.faults] == [("too fast", 1)]


def test_time_that_goes_backwards_is_told() -> None:
    report = judged([(2, 0)], [0, 1, 2, 1, 0], [0, 5, 4, 6, 7])
    assert [(fault.kind, fault.vertices, fault.tick) for fault in report.faults] == [
        ("backwards", (1, 2), 4)
    ]


@pytest.mark.parametrize("vertex", [6, -1, 2**31 - 1, -(2**31)])
def test_a_vertex_outside_the_roadmap_is_told(vertex: int) -> None:
    report = judged([(1, 0)], [0, 1, vertex, 1, 0], [0, 1, 3, 4, 5])
    assert [(fault.kind, fault.vertices, fault.tick) for fault in report.faults] == [
        ("unknown vertex", (vertex,), 3)
    ]


def test_the_largest_numbers_are_judged_exactly() -> None:
    """Differences of such ticks do not fit into 64 bits."""
    late, early = 2**63 - 1, -(2**63)
    assert judged([(1, 0)], [0, 1, 0], [0, late - 2, late]).ok
    assert kinds(judged([(1, 0)], [0, 1, 0], [0, late - 1, late])) == ["work cut short"]
    report = judged([(1, 0)], [0, 1, 0], [early, late, early])
    assert kinds(report) == ["backwards", "wrong home", "work cut short"]


def test_the_longest_work_of_a_scenario_is_judged_exactly() -> None:
    """The latest ticks: work that begins later than its length before 2**63 ends beyond 64 bits."""
    work, latest = MAX_TICKS - 2, 2**63 - 1  # turning and the drive take one tick each
    arrival = latest - MAX_TICKS
    assert judged([(1, work)], [0, 1, 0], [0, arrival, latest]).ok
    for late in (1, MAX_TICKS // 2, MAX_TICKS - 2):
        report = judged([(1, work)], [0, 1, 0], [0, arrival + late, latest])
        assert kinds(report) == ["work cut short"]


def two_way_and_one_way() -> Scenario:
    """A to B is 1 long, B to C is 3 long and one way, C to A is 2 long."""
    roadmap = make_roadmap(
        {"A": (0, 0), "B": (1, 0), "C": (4, 0)},
        [
            Edge(tail="A", head="B", length=Fraction(1)),
            Edge(tail="B", head="A", length=Fraction(1)),
            Edge(tail="B", head="C", length=Fraction(3)),
            Edge(tail="C", head="A", length=Fraction(2)),
        ],
    )
    robot = Robot(
        name="R1", home=roadmap.get_vertex("A"), stops=(Stop(at=roadmap.get_vertex("C")),)
    )
    return Scenario(roadmap=roadmap, robots=(robot,))


def judged_on_edges(vertices: Sequence[int], enter: Sequence[int]) -> Report:
    track = Track.of(vertices, enter)
    plan = Plan(scenario=two_way_and_one_way(), tracks=(track,), run=PlannerRun(name="by hand"))
    return check(plan)


def test_each_edge_takes_as_long_as_it_is() -> None:
    assert judged_on_edges([0, 1, 2, 0], [0, 1, 4, 6]).ok
    assert kinds(judged_on_edges([0, 1, 2, 0], [0, 1, 3, 5])) == ["too fast"]


def test_driving_against_a_one_way_edge_is_a_jump() -> None:
    report = judged_on_edges([0, 1, 2, 1, 0], [0, 1, 4, 7, 8])
    assert [(fault.kind, fault.message) for fault in report.faults] == [
        ("jump", "R1 goes from C to B, no edge leads there (use edges)")
    ]
