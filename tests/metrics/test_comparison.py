"""Plans beside each other: one tick for all, robots by their names, what changed in words."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from operator import attrgetter
from typing import Any

import pytest

from rightofway.errors import InputError
from rightofway.facts import Fact
from rightofway.io.scenario.reader import parse_scenario
from rightofway.io.yaml_text import parse_yaml
from rightofway.metrics import compare, find_changes
from rightofway.model import (
    Closure,
    Plan,
    PlannedItem,
    PlannerRun,
    Robot,
    Scenario,
    Stop,
    Tick,
    Track,
    UnservedReason,
)
from rightofway.model.attributes import Attribute
from rightofway.model.robot import ROBOT_ATTRIBUTES, RULE_ATTRIBUTES
from rightofway.site import VertexId, make_grid_roadmap
from rightofway.units import Units
from tests.builders.plans import door, door_shifted, loop


def stop(at: int, work: int = 0) -> Stop:
    return Stop(at=VertexId(at), work=Fraction(work))


def scenario(rows: tuple[str, ...] = ("....", "...."), **robot: Any) -> Scenario:
    """Return a scenario of R1, which drives from the first place to the third."""
    one = Robot(name="R1", home=VertexId(0), stops=(stop(2, 3),), **robot)
    units = Units(length="m", time="s")
    return Scenario(roadmap=make_grid_roadmap(rows), robots=(one,), units=units)


def test_robots_are_compared_by_their_names_in_one_tick() -> None:
    """The third plan has ticks of a half, the others of one time unit."""
    plan, late = door(), door_shifted(1)
    found = compare([plan, late, loop()]).as_dict()
    assert found["scales"] == [2, 2, 1]
    assert found["robots"][:3] == [
        {"name": "R1", "completion": [20, 22, None]},
        {"name": "R2", "completion": [18, 18, None]},
        {"name": "Cart", "completion": [None, None, found["plans"][2]["makespan"]]},
    ]


def test_the_best_figures_are_marked_where_the_robots_are_the_same() -> None:
    plan, late = door(), door_shifted(1)
    assert compare([late, plan]).as_dict()["best"]["flowtime"] == [1]
    assert compare([plan, plan]).as_dict()["best"]["flowtime"] == []  # the same
    assert compare([late, plan, loop()]).as_dict()["best"]["flowtime"] == []


def test_units_of_time_are_converted() -> None:
    plan = door()
    seconds, minutes = (
        replace(plan, scenario=replace(plan.scenario, units=Units(time=unit)))
        for unit in ("s", "min")
    )
    found = compare([seconds, minutes]).as_dict()
    assert found["scales"] == [1, 60]
    assert found["robots"][0]["completion"] == [10, 600]


def test_a_tick_divides_the_ticks_of_all_plans() -> None:
    """Ticks of 1/2 and 1/3 of the unit are 3 and 2 ticks of 1/6."""
    ticks = [Fraction(1, 2), Fraction(1, 3)]
    plans = []
    for tick in ticks:
        fast = replace(door().scenario.robots[0], speed=1 / tick)
        others = door().scenario.robots[1:]
        made = replace(door().scenario, robots=(fast, *others))
        assert made.problem.clock.tick == tick
        plans.append(replace(door(), scenario=made))
    found = compare(plans)
    assert (found.tick, found.scales) == (Fraction(1, 6), (3, 2))


def test_times_in_a_unit_and_in_none_are_not_compared() -> None:
    plan = door()
    timed = replace(plan, scenario=replace(plan.scenario, units=Units(time="s")))
    with pytest.raises(InputError, match="plan 2: its times are in s, those of the first plan in"):
        compare([plan, timed])


def test_too_many_plans_are_refused() -> None:
    with pytest.raises(InputError, match=r"9 plans are too many to compare \(give at most 8\)"):
        compare([door()] * 9)


def test_changes_of_a_robot_are_in_its_units() -> None:
    faster = scenario(speed=Fraction(3, 2), radius=Fraction(1, 5))
    found = [str(change) for change in find_changes(scenario(), faster)]
    assert found[:2] == ["R1: speed 1 m/s → 1.5 m/s", "R1: radius 0 m → 0.2 m"]


def test_the_same_values_in_another_unit_are_no_change() -> None:
    """1 m/s is 1000 mm/s; a radius of 0.2 m is 200 mm, and one of 300 mm is another one."""
    metres = scenario(radius=Fraction(1, 5), speed=Fraction(1))
    small = replace(metres.robots[0], speed=Fraction(1000), radius=Fraction(200))
    millimetres = replace(metres, units=Units(length="mm", time="s"), robots=(small,))
    keys = {change.key for change in find_changes(metres, millimetres)}
    assert not keys & {"speed", "radius"}
    other = replace(millimetres, robots=(replace(small, radius=Fraction(300)),))
    (change,) = [each for each in find_changes(metres, other) if each.key == "radius"]
    assert str(change) == "R1: radius 0.2 m → 300 mm"
    assert change.before == Fact("length", value=Fraction(1, 5))


@pytest.mark.parametrize("attribute", [*ROBOT_ATTRIBUTES, *RULE_ATTRIBUTES], ids=attrgetter("key"))
def test_an_attribute_without_a_value_is_a_known_fact(attribute: Attribute) -> None:
    assert str(Fact(attribute.unset)) == attribute.unset


def test_changes_of_places_and_work_name_them() -> None:
    before = scenario()
    moved = replace(before.robots[0], home=VertexId(4), stops=(stop(3, 5),))
    found = [str(change) for change in find_changes(before, replace(before, robots=(moved,)))]
    assert found == [
        "R1: home (0.5, 0.5) → (0.5, 1.5)",
        "R1: stops (2.5, 0.5) → (3.5, 0.5)",
        "R1: work 3 s → 5 s",
    ]


def test_robots_that_change_in_the_same_way_are_one_entry() -> None:
    before = scenario()
    first = before.robots[0]
    fleet = tuple(replace(first, name=f"R{i}", home=VertexId(i)) for i in range(1, 4))
    added = find_changes(before, replace(before, robots=(first, *fleet[1:])))
    assert [str(change) for change in added] == ["R2 and R3: added"]
    slow = tuple(replace(robot, speed=Fraction(1, 2)) for robot in fleet)
    found = find_changes(replace(before, robots=fleet), replace(before, robots=slow))
    assert [str(change) for change in found] == ["3 robots: speed 1 m/s → 0.5 m/s"]
    gone = find_changes(replace(before, robots=fleet), replace(before, robots=fleet[:2]))
    assert [str(change) for change in gone] == ["R3: removed"]


def test_changes_of_map_rules_and_closures_are_said() -> None:
    before = scenario()
    walled = scenario(("....", "...@"))
    assert [str(change) for change in find_changes(before, walled)] == [
        "map: 8 free cells → 7 free cells"
    ]
    closed = replace(
        before,
        closures=(
            Closure(at=VertexId(1), until=Fraction(4)),
            Closure(edge=(VertexId(5), VertexId(6))),
        ),
    )
    assert [str(change) for change in find_changes(before, closed)] == [
        "(1.5, 0.5): closed", "(1.5, 1.5) to (2.5, 1.5): closed",
    ]  # fmt: skip
    assert [str(change) for change in find_changes(closed, before)] == [
        "(1.5, 0.5): open", "(1.5, 1.5) to (2.5, 1.5): open",
    ]  # fmt: skip
    later = replace(before, rules=replace(before.rules, headway=Fraction(1), rotations=False))
    assert [str(change) for change in find_changes(before, later)] == [
        "rules: headway 0 s → 1 s", "rules: rotations yes → no",
    ]  # fmt: skip


def test_a_finer_grid_of_one_floor_keeps_the_places() -> None:
    """A cell of 1 m at 0 and four cells of 0.5 m there: their middles are less than 1 m apart."""
    coarse = Scenario(
        roadmap=make_grid_roadmap(("..",)),
        robots=(Robot(name="R", home=VertexId(0), stops=(stop(1),)),),
    )
    fine = Scenario(
        roadmap=make_grid_roadmap(("....", "...."), cell_size=Fraction(1, 2)),
        robots=(Robot(name="R", home=VertexId(0), stops=(stop(2),)),),
    )
    assert [change.subject for change in find_changes(coarse, fine)] == ["map"]


STREET = """
format: rightofway-scenario/1
map: {grid: ["......"]}
units: {time: s}
robots: [{name: R1, home: N0}, {name: R2, home: N5}]
rules: {turn: 0}
jobs:
  - {name: J1, at: N1, work: 1}
  - {name: J2, at: N4, work: 1}
  - {name: J3, at: N3, work: 1, robot: R2}
"""


def plan_street(*tours: list[tuple[int, int, int]], **changes: Any) -> Plan:
    """Return a plan in which robots do jobs, each at its visit and begin; they stay where it is."""
    scenario = parse_scenario({**parse_yaml(STREET), **changes})
    tracks = [
        Track.of([robot.home] * (1 + max((visit for _, visit, _ in tour), default=0)),
                 range(1 + max((visit for _, visit, _ in tour), default=0)))
        for robot, tour in zip(scenario.robots, tours, strict=True)
    ]  # fmt: skip
    items = tuple(
        tuple(PlannedItem(visit=visit, begin=Tick(begin), end=Tick(begin + 1), job=job, stop=0)
              for job, visit, begin in tour)
        for tour in tours
    )  # fmt: skip
    done = {job for tour in tours for job, _, _ in tour}
    numbers = range(len(scenario.jobs or ()))
    late: UnservedReason = "latest"
    left = tuple((job, late) for job in numbers if job not in done)
    return Plan(
        scenario=scenario, tracks=tuple(tracks), run=PlannerRun(), tours=items, unserved=left
    )


def tell_jobs(before: Plan, after: Plan) -> list[str]:
    return [str(change) for change in compare([before, after]).changes[1]]


def test_jobs_that_change_robots_or_end_at_other_times_are_told() -> None:
    before = plan_street([(0, 1, 1)], [(1, 1, 1), (2, 2, 3)])
    after = plan_street([(0, 1, 1), (1, 2, 5)], [(2, 1, 2)])
    assert tell_jobs(before, after) == [
        "J2: robot R2 → R1",
        "J2: later 2 s → 6 s",
        "J3: earlier 4 s → 3 s",
    ]
    assert tell_jobs(before, before) == []


def test_jobs_that_are_served_or_not_are_told_with_the_reason() -> None:
    before = plan_street([(0, 1, 1)], [(1, 1, 1)])
    after = plan_street([(0, 1, 1)], [(2, 1, 1)])
    assert tell_jobs(before, after) == [
        "J2: unserved no robot would end it in time",
        "J3: served",
    ]


def test_jobs_with_the_same_change_are_one_entry() -> None:
    before = plan_street([(0, 1, 1)], [(1, 1, 1), (2, 2, 3)])
    after = plan_street([(0, 1, 2)], [(1, 1, 2), (2, 2, 4)])
    assert tell_jobs(before, after) == ["3 jobs: later"]


def test_jobs_that_are_added_removed_or_changed_are_told() -> None:
    before, jobs = plan_street([], []), parse_yaml(STREET)["jobs"]
    changed = [{**jobs[0], "due": 9}, jobs[1], {"name": "J4", "at": "N2"}]
    assert tell_jobs(before, plan_street([], [], jobs=changed)) == [
        "J1: changed", "J4: added", "J3: removed",
    ]  # fmt: skip
    hours = plan_street([], [], units={"time": "min"}, jobs=[
        {**job, "work": "1/60"} for job in jobs
    ])  # fmt: skip
    assert not [text for text in tell_jobs(before, hours) if text.startswith("J")]
