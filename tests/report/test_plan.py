"""What the report on a plan says, read as a stranger would."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from rightofway.model import Improvement, Plan, PlannerRun, Reroute, Rules, Tick, Track
from rightofway.model.kept_facts import RerouteReason
from rightofway.report.plan import describe_planning, report_decisions, summarize_plan
from rightofway.report.quantities import Quantities
from rightofway.units import Units
from tests.builders.fleets import grid_fleet
from tests.builders.plans import counter, door

Trip = tuple[Sequence[int], Sequence[int]]


def in_seconds(plan: Plan) -> Plan:
    scenario = replace(plan.scenario, units=Units(time="s"))
    return replace(plan, scenario=scenario)


def report(plan: Plan) -> list[str]:
    text = summarize_plan(plan, Quantities.of(plan.scenario))
    assert max(map(len, text.splitlines())) <= 80
    return text.splitlines()


def make_plan(grid: Sequence[str], *trips: Trip, speeds: Sequence[str] = ("1",)) -> Plan:
    ends = [(f"N{vertices[0]}", f"N{vertices[-1]}") for vertices, _ in trips]
    scenario = grid_fleet(
        grid, ends, rules=Rules(ends="none"), speeds=[Fraction(speed) for speed in speeds]
    )
    tracks = tuple(Track.of(vertices, enter) for vertices, enter in trips)
    return in_seconds(Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand")))


def test_times_are_in_the_units_of_the_scenario() -> None:
    assert report(in_seconds(door())) == [
        "planner    two-level",
        "flowtime   19 s, 5.6% above the lower bound of 18 s",
        "makespan   10 s",
        "lost time  1 s: waiting 1 s",
        "",
        "times of each robot [s]",
        "robot  completes  alone  detours  makes room  waits",
        "R1            10      9        0           0      1",
        "R2             9      9        0           0      0",
        "",
        "At 0 s, R1 waits 1 s in N0 for R2 to leave N1.",
    ]


def test_after_the_time_limit_only_costs_are_reported() -> None:
    plan = in_seconds(door())
    assert summarize_plan(
        plan, Quantities.of(plan.scenario), with_lost_time=False
    ).splitlines() == [
        "planner    two-level",
        "flowtime   19 s, 5.6% above the lower bound of 18 s",
        "makespan   10 s",
        "lost time  not computed, because the time limit is over",
    ]


def test_on_request_times_are_in_ticks_and_the_length_of_a_tick_is_given() -> None:
    plan = in_seconds(door())
    lines = summarize_plan(plan, replace(Quantities.of(plan.scenario), in_ticks=True)).splitlines()
    assert lines[3:5] == ["lost time  1 tick: waiting 1 tick", "tick       1 s"]
    assert lines[6] == "times of each robot [ticks]"
    assert lines[-1] == "At tick 0, R1 waits 1 tick in N0 for R2 to leave N1."


def test_a_robot_behind_a_slower_one_follows_it() -> None:
    slow = ([1, 2, 3, 4, 5], [0, 2, 4, 6, 8])
    quick = ([0, 1, 2, 3, 4], [0, 2, 4, 6, 8])
    plan = make_plan(["......"], slow, quick, speeds=["1/2", "1"])
    assert report(plan)[-1] == "At 0 s, R2 follows R1 from N0 to N3, loses 4 s."


def test_a_wait_for_a_place_further_on_names_that_place() -> None:
    plan = make_plan(["....", "...."], ([7, 3, 7], [0, 1, 6]), ([0, 1, 2, 3], [0, 4, 5, 6]))
    sentence = "At 0 s, R2 waits 3 s in N0 for R1 to leave N3, further on its way."
    assert sentence in report(plan)


def test_a_wait_that_nothing_compels_says_so() -> None:
    plan = make_plan(["..."], ([0, 1, 2], [0, 1, 4]))
    assert report(plan)[-1] == (
        "At 1 s, R1 waits 2 s in N1, though no place on its way becomes free just then."
    )


def test_a_detour_and_a_robot_that_makes_room_each_have_a_sentence() -> None:
    aside = ([0, 1, 4, 1, 2], [0, 1, 2, 4, 5])
    lines = report(make_plan(["...", "..."], aside, ([3, 0, 1], [0, 2, 3])))
    room = "At 2 s, R1 leaves N1 to make room for R2 and comes back, loses 2 s."
    assert room in lines
    assert report(make_plan(["...", "..."], ([0, 3, 4, 5, 2], range(5))))[-1] == (
        "Detours: R1 2 s."
    )


def test_waits_of_several_laps_are_summed_up() -> None:
    words = " ".join(" ".join(report(in_seconds(counter()))).split())
    assert "R1 loses 9 s to R2, 3 times; first, at 7 s, it waits" in words


def test_a_home_on_the_way_of_another_robot_is_named_with_a_remedy() -> None:
    """R1 comes home to N1 only after R2 has come through it."""
    scenario = grid_fleet([".....", "@@@.@"], [("N1", "N3"), ("N0", "N8")])
    plan = Plan(
        scenario=scenario,
        tracks=(
            Track.of([1, 2, 3, 2, 1], [0, 1, 2, 4, 5]),
            Track.of([0, 1, 2, 3, 5, 3, 2, 1, 0], [0, 3, 4, 5, 6, 8, 9, 10, 11]),
        ),
        run=PlannerRun(name="by hand"),
    )
    assert not any("is on the way" in line for line in report(plan))
    waits = ([1, 2, 3, 2, 1], [0, 1, 2, 4, 11])
    plan = replace(plan, tracks=(Track.of(*waits), plan.tracks[1]))
    words = " ".join(report(in_seconds(plan)))
    assert "At 4 s, R1 waits 6 s in N2 for R2 to leave N1." in words
    assert (
        "N1, the home of R1, is on the way of R2 and costs R1 6 s: a home or a parking place off"
        " that way would help."
    ) in " ".join(words.split())


def test_a_robot_that_waits_far_from_its_home_because_that_is_on_the_way_of_another() -> None:
    """R1 waits in N5 for R2 to leave N1, because R2 has to come through N2 twice before."""
    scenario = grid_fleet(["....", "@.@@"], [("N2", "N5"), ("N0", "N3")])
    tracks = (
        Track.of([2, 1, 4, 1, 2], [0, 1, 2, 8, 9]),
        Track.of([0, 1, 2, 3, 2, 1, 0], [0, 2, 3, 4, 6, 7, 8]),
    )
    plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))
    lines = report(in_seconds(plan))
    assert "At 3 s, R1 waits 4 s in N5 for R2 to leave N1." in lines
    assert lines[-2].startswith("N2, the home of R1, is on the way of R2 and costs R1 4 s: a home")


def test_a_tie_is_called_a_tie() -> None:
    words = " ".join(report_decisions(door(), Quantities.of(door().scenario)).split())
    assert "the completion times add up to the same. Then R1 waits by rule." in words
    figures = "19 time units if R1 waits, 19 time units if R2 waits."
    assert f"Sum of completion times: {figures}" in words


def test_a_log_tells_no_decisions_from_no_meetings() -> None:
    plan = door()
    searched = replace(plan, run=replace(plan.run, decisions=()))
    words = " ".join(report_decisions(searched, Quantities.of(plan.scenario)).split())
    assert words == (
        "The search that found this plan records no decisions, so no wait has a reason here"
        " (`--planner two-level` plans with a reason for each decision;"
        " `rightofway table PLAN --events` lists each wait and the robot waited for)."
    )
    apart = make_plan(["...", "..."], ([0, 1], [0, 1]), ([3, 4], [0, 1]))
    assert report_decisions(apart, Quantities.of(apart.scenario)).startswith(
        "No decision was needed"
    )


def test_what_a_planner_did_needs_no_knowledge_of_its_method() -> None:
    plan = in_seconds(door())

    def words(**run: object) -> str:
        changed = replace(plan.run, **run)  # type: ignore[arg-type]
        return describe_planning(replace(plan, run=changed), Quantities.of(plan.scenario))

    assert words(seconds=0.4213) == "two-level, planned in 0.42 s"
    assert words(improvement=Improvement(saved=Tick(0), tries=2000)) == (
        "two-level; 2000 attempts to improve the first plan found no better plan"
    )
    assert words(improvement=Improvement(saved=Tick(75), tries=1, interrupted=True)) == (
        "two-level; interrupted: 1 attempt to improve the first plan saved 1 min 15 s"
    )
    assert (
        words(reroutes=(Reroute(robot=1, because=RerouteReason("makes way")),))
        == "two-level; rerouted: R2"
    )


def test_of_a_large_fleet_the_robots_that_lose_time_are_listed() -> None:
    """R22 is one tick late; of the others, each is as fast as alone."""
    rows = [[3 * row, 3 * row + 1, 3 * row + 2] for row in range(22)]
    trips = [(row, [0, 1, 2]) for row in rows[:21]]
    lines = report(make_plan(["..."] * 22, *trips, (rows[21], [0, 1, 3])))
    table = lines.index("times of the robots that lose most [s]")
    assert [line.split()[0] for line in lines[table + 1 : table + 4]] == ["robot", "R22", "…"]
    assert lines[table + 3] == "… and 21 more robots that lose less time (--json lists all)"


def test_of_many_robots_that_lose_time_ten_are_listed() -> None:
    """Each of twelve robots waits a tick for nobody, on a row of its own."""
    rows = [[3 * row, 3 * row + 1, 3 * row + 2] for row in range(12)]
    lines = report(make_plan(["..."] * 12, *((row, [0, 1, 3]) for row in rows)))
    table = lines.index("times of the robots that lose most [s]")
    assert [line.split()[0] for line in lines[table + 2 : table + 12]] == [
        f"R{robot}" for robot in range(1, 11)
    ]
    assert lines[table + 12] == "… and 2 more robots that lose less time (--json lists all)"
    assert lines[-1] == "… and 2 more (--json lists all)"


def test_a_plan_without_lost_time_is_called_optimal() -> None:
    lines = report(make_plan(["..."], ([0, 1, 2], [0, 1, 2])))
    assert lines[:4] == [
        "planner    by hand; optimal, no robot loses time",
        "flowtime   2 s, the least possible",
        "makespan   2 s",
        "lost time  none",
    ]
