"""Plans for programs on the site: metres, seconds and radians in the site's frame."""

from __future__ import annotations

import csv
import io
import json
import math
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from rightofway import check, solve
from rightofway.io import (
    SITE_PLAN_FORMATS,
    format_site_plan,
    load,
    parse_scenario,
    write_scenario,
)
from rightofway.model import Plan, PlannedItem, PlannerRun, Scenario, Tick, Track, find_stays


def planned(**keys: Any) -> Plan:
    return solve(parse_scenario({"format": "rightofway-scenario/1", **keys}), planner="two-level")


def written(plan: Plan, name: str) -> Any:
    text, _ = format_site_plan(plan, name)
    return list(csv.DictReader(io.StringIO(text))) if name == "events" else json.loads(text)


def crossing() -> Plan:
    """Return a plan of R1 from a over m to b, and R2 from c to d, on lanes of 4 m, at 2 m/s.

    R2 waits until R1 has left m. A tick is 2 s, a thirtieth of a minute.
    """
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {
                "roadmap": {
                    "vertices": {"a": [-4000, 0], "m": [0, 0], "b": [4000, 0], "c": [0, -4000],
                                 "d": [0, 4000]},
                    "edges": [["a", "m"], ["m", "b"], ["c", "m"], ["m", "d"]],
                },
                "y": "up",
            },
            "units": {"length": "mm", "time": "min"},
            "robots": [
                {"name": "R1", "home": "a", "target": "b", "work": 1, "speed": 120000},
                {"name": "R2", "home": "c", "target": "d", "speed": 120000},
            ],
            "rules": {"return": "none", "occupancy": "both"},
        }
    )  # fmt: skip
    at = {name: vertex for vertex, name in enumerate("ambcd")}
    first = Track.of([at["a"], at["m"], at["b"]], [0, 1, 2])
    second = Track.of([at["c"], at["m"], at["d"]], [0, 3, 4])
    plan = Plan(scenario=scenario, tracks=(first, second), run=PlannerRun())
    assert scenario.problem.clock.tick == Fraction(1, 30)
    assert not check(plan).faults
    return plan


def test_events_have_metres_seconds_and_reasons() -> None:
    """Lanes of 4 m take 2 s. R2 may drive to m once R1 has left it, at 4 s."""
    rows = written(crossing(), "events")
    told = [(float(row["time"]), row["robot"], row["event"], row["place"]) for row in rows]
    assert told == [
        (0, "R1", "start", "a"),
        (0, "R1", "depart", "a"),
        (0, "R2", "start", "c"),
        (0, "R2", "wait", "c"),
        (2, "R1", "arrive", "m"),
        (2, "R1", "depart", "m"),
        (4, "R1", "arrive", "b"),
        (4, "R1", "work", "b"),
        (4, "R2", "depart", "c"),
        (6, "R2", "arrive", "m"),
        (6, "R2", "depart", "m"),
        (8, "R2", "arrive", "d"),
        (8, "R2", "done", "d"),
        (64, "R1", "done", "b"),
    ]
    wait = rows[3]
    assert wait["waits_for"] == "R1"
    assert (float(wait["x"]), float(wait["y"])) == (0, -4)
    assert float(wait["heading"]) == pytest.approx(math.pi / 2, abs=1e-6)


def test_a_path_of_ros_has_a_pose_for_each_arrival_and_departure() -> None:
    found = written(crossing(), "nav2")
    assert found["frame_id"] == "map"
    second = found["robots"]["R2"]
    assert second["nodes"] == ["c", "c", "m", "d"]
    poses = second["path"]["poses"]
    assert {pose["header"]["frame_id"] for pose in poses} == {"map"}
    assert [pose["header"]["stamp"]["sec"] for pose in poses] == [0, 4, 6, 8]
    assert poses[2]["pose"]["position"] == {"x": 0.0, "y": 0.0, "z": 0.0}
    north = poses[1]["pose"]["orientation"]
    assert (north["z"], north["w"]) == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)))


def test_nodes_of_a_route_server_are_numbers() -> None:
    plan = planned(
        map={"roadmap": {"vertices": {"7": [0, 0], "8": [3, 4]}, "edges": [["7", "8"]]}},
        robots=[{"name": "R1", "home": "7", "target": "8"}],
    )
    assert written(plan, "nav2")["robots"]["R1"]["nodes"] == [7, 8, 7]


def test_a_trajectory_of_open_rmf_goes_on_where_the_robot_does() -> None:
    """R1 drives through m at 2 m/s; after its work it is at b still."""
    (route,) = written(crossing(), "open-rmf")["itineraries"]["R1"]
    waypoints = route["trajectory"]["waypoints"]
    assert [each["time"] for each in waypoints] == [0, 2 * 10**9, 4 * 10**9, 64 * 10**9]
    assert [each["position"] for each in waypoints] == [[-4, 0, 0], [0, 0, 0], [4, 0, 0], [4, 0, 0]]
    assert [each["velocity"] for each in waypoints] == [[0, 0, 0], [2, 0, 0], [0, 0, 0], [0, 0, 0]]


def test_turned_maps_come_out_to_the_millimetre() -> None:
    """A map of 0.5 m cells, its lower left corner at (10, -3), turned by 0.3 rad."""
    plan = planned(
        map={"grid": ["...", "..."], "cell_size": 0.5, "y": "up", "origin": [10, -3], "yaw": 0.3},
        units={"length": "m", "time": "s"},
        robots=[{"name": "R1", "home": [1, 0], "target": [0, 2]}],
    )
    cos, sin = math.cos(0.3), math.sin(0.3)
    (route,) = written(plan, "open-rmf")["itineraries"]["R1"]
    first, *_ = route["trajectory"]["waypoints"]
    assert first["position"] == pytest.approx(
        [10 + 0.25 * cos - 0.25 * sin, -3 + 0.25 * sin + 0.25 * cos, 0.3], abs=1e-6
    )
    stop = next(row for row in written(plan, "events") if row["event"] == "work")
    assert [float(stop["x"]), float(stop["y"])] == pytest.approx(
        [10 + 1.25 * cos - 0.75 * sin, -3 + 1.25 * sin + 0.75 * cos], abs=1e-6
    )


def test_y_that_grows_downwards_is_negated_for_ros_and_said() -> None:
    plan = planned(
        map={"grid": ["..", ".."]}, robots=[{"name": "R1", "home": "N0", "target": "N3"}]
    )
    _, notes = format_site_plan(plan, "nav2")
    assert notes == (
        "lengths count as metres and times count as seconds, because the scenario names no units",
        "y is negated: it grows downwards in the scenario, and upwards in ROS",
    )
    first = written(plan, "nav2")["robots"]["R1"]["path"]["poses"][0]["pose"]["position"]
    assert (first["x"], first["y"]) == (0.5, -0.5)
    assert [float(written(plan, "events")[0][key]) for key in "xy"] == [0.5, 0.5]
    assert len(format_site_plan(plan, "events")[1]) == 1


@pytest.mark.parametrize("name", SITE_PLAN_FORMATS)
def test_a_robot_that_stays_at_home_is_written(name: str) -> None:
    plan = planned(map={"grid": [".."]}, robots=[{"name": "R1", "home": "N0", "target": "N0"}])
    assert written(plan, name)


def test_splines_between_waypoints_stay_on_the_lane_and_go_forward() -> None:
    """Open-RMF draws a cubic spline through positions and velocities."""
    scenario = grid_scenario()
    plan = solve(scenario, planner="lacam", seed=1)
    for robot, (track, stays) in enumerate(
        zip(plan.tracks, find_stays(scenario, plan.tracks), strict=True)
    ):
        (route,) = written(plan, "open-rmf")["itineraries"][scenario.robots[robot].name]
        waypoints = route["trajectory"]["waypoints"]
        assert arrivals(track, scenario) <= {each["time"] for each in waypoints}
        assert waypoints[-1]["time"] == int(stays.completion * scenario.problem.clock.tick * 10**9)
        for one, two in pairwise(waypoints):
            assert one["time"] < two["time"]
            for axis in (0, 1):
                points = list(spline(one, two, axis))
                assert points == sorted(points) or points == sorted(points, reverse=True)


def grid_scenario() -> Scenario:
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": [".....", ".@.@.", "....."], "y": "up"},
            "robots": [
                {"name": "A", "home": "N0", "target": "N14", "speed": 1},
                {"name": "B", "home": "N14", "target": "N0", "speed": "1/2"},
                {"name": "C", "home": "N4", "target": "N10", "work": 3},
            ],
        }
    )


def arrivals(track: Track, scenario: Scenario) -> set[int]:
    tick = scenario.problem.clock.tick * 10**9
    return {int(Fraction(enter) * tick) for enter in track.enter.tolist()}


def spline(one: dict[str, Any], two: dict[str, Any], axis: int) -> Any:
    """Yield the coordinates of a cubic Hermite spline."""
    lasts = (two["time"] - one["time"]) / 10**9
    p, q = one["position"][axis], two["position"][axis]
    u, v = one["velocity"][axis] * lasts, two["velocity"][axis] * lasts
    for k in range(21):
        s = k / 20
        yield round(
            (2 * s**3 - 3 * s**2 + 1) * p + (s**3 - 2 * s**2 + s) * u
            + (3 * s**2 - 2 * s**3) * q + (s**3 - s**2) * v, 9
        )  # fmt: skip


def test_a_robot_drives_on_through_a_small_turn() -> None:
    """Two lanes of 5 m that meet at 8 degrees, and one at a right angle."""
    away = math.radians(8)
    bend = [round(5 + 5 * math.cos(away), 6), round(5 * math.sin(away), 6)]
    plan = planned(
        map={
            "roadmap": {
                "vertices": {"a": [0, 0], "b": [5, 0], "c": bend, "d": [bend[0] - 1, bend[1] + 7]},
                "edges": [["a", "b"], ["b", "c"], ["c", "d"]],
            },
            "y": "up",
        },
        units={"length": "m", "time": "s"},
        robots=[{"name": "R1", "home": "a", "target": "d"}],
        rules={"return": "none"},
    )
    (route,) = written(plan, "open-rmf")["itineraries"]["R1"]
    _, bent, corner, _ = route["trajectory"]["waypoints"]
    assert bent["position"][2] == pytest.approx(away / 2, abs=1e-6)
    assert math.hypot(*bent["velocity"]) == pytest.approx(1, abs=0.01)
    assert corner["velocity"] == [0, 0, 0]


def shift() -> Plan:
    """Return a plan of R1, which charges and does J1, and R2, which does J2 and then J3."""
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {
                "roadmap": {"vertices": {"a": [0, 0], "b": [2, 0], "c": [4, 0], "d": [6, 0]},
                            "edges": [["a", "b"], ["b", "c"], ["c", "d"]]},
                "y": "up",
            },
            "units": {"length": "m", "time": "s"},
            "robots": [{"name": "R1", "home": "a", "battery": "tank"}, {"name": "R2", "home": "d"}],
            "batteries": {"tank": {"charge": 1}},
            "charging": ["a"],
            "jobs": [
                {"name": "J1", "at": "b", "work": 3, "robot": "R1"},
                {"name": "J2", "pickup": "d", "dropoff": "c", "dropoff_work": 1, "robot": "R2"},
                {"name": "J3", "at": "d", "after": ["J1"], "robot": "R2", "earliest": 9},
            ],
            "rules": {"turn": 0},
        }
    )  # fmt: skip
    first = Track.of([0, 1, 0], [0, 3, 8])
    second = Track.of([3, 2, 3], [0, 2, 5])
    tours = (
        (PlannedItem(visit=0, begin=Tick(0), end=Tick(1)),
         PlannedItem(visit=1, begin=Tick(3), end=Tick(6), job=0, stop=0)),
        (PlannedItem(visit=0, begin=Tick(0), end=Tick(0), job=1, stop=0),
         PlannedItem(visit=1, begin=Tick(2), end=Tick(3), job=1, stop=1),
         PlannedItem(visit=2, begin=Tick(9), end=Tick(9), job=2, stop=0)),
    )  # fmt: skip
    plan = Plan(scenario=scenario, tracks=(first, second), tours=tours, run=PlannerRun())
    assert not check(plan).faults
    return plan


def test_events_name_the_job_and_the_stop_of_each_work() -> None:
    rows = written(shift(), "events")
    done = [row for row in rows if row["event"] in {"work", "charge"}]
    assert [
        (float(row["time"]), row["robot"], row["event"], row["place"], row["job"], row["stop"])
        for row in done
    ] == [
        (0, "R1", "charge", "a", "", ""),
        (0, "R2", "work", "d", "J2", "1"),
        (2, "R2", "work", "c", "J2", "2"),
        (3, "R1", "work", "b", "J1", "1"),
        (9, "R2", "work", "d", "J3", "1"),
    ]
    assert {row["job"] for row in rows if row["event"] == "arrive"} == {""}
    assert "job" not in written(crossing(), "events")[0]


def test_paths_and_trajectories_have_the_work_of_each_robot() -> None:
    work = [
        {"job": "J2", "stop": 1, "place": "d", "begin": 0.0, "end": 0.0},
        {"job": "J2", "stop": 2, "place": "c", "begin": 2.0, "end": 3.0},
        {"job": "J3", "stop": 1, "place": "d", "begin": 9.0, "end": 9.0},
    ]
    robots = written(shift(), "nav2")["robots"]
    assert robots["R2"]["work"] == work
    assert robots["R1"]["work"][0] == {"charge": True, "place": "a", "begin": 0.0, "end": 1.0}
    of_rmf = written(shift(), "open-rmf")["work"]["R2"]
    assert [(item["job"], item["begin"], item["end"]) for item in of_rmf] == [
        ("J2", 0, 0),
        ("J2", 2 * 10**9, 3 * 10**9),
        ("J3", 9 * 10**9, 9 * 10**9),
    ]
    assert "work" not in written(crossing(), "open-rmf")


def test_jobs_are_transport_orders_of_vehicles_in_the_order_of_their_tours() -> None:
    orders = written(shift(), "opentcs")
    assert orders == {
        "J1": {
            "intendedVehicle": "R1",
            "destinations": [{"locationName": "b", "operation": "MOVE"}],
        },
        "J2": {
            "intendedVehicle": "R2",
            "destinations": [
                {"locationName": "d", "operation": "Load cargo"},
                {"locationName": "c", "operation": "Unload cargo"},
            ],
        },
        "J3": {
            "intendedVehicle": "R2",
            "destinations": [{"locationName": "d", "operation": "MOVE"}],
            "dependencies": ["J2", "J1"],
        },
    }
    assert written(crossing(), "opentcs")["R1"]["destinations"][0]["locationName"] == "b"


def test_transport_orders_that_are_written_are_read_as_the_jobs_of_the_plan(tmp_path: Path) -> None:
    plan = shift()
    write_scenario(plan.scenario, tmp_path / "site.json")
    text, _ = format_site_plan(plan, "opentcs")
    (tmp_path / "orders.json").write_text(text, encoding="utf-8")
    jobs = load(tmp_path / "site.json", jobs=tmp_path / "orders.json").jobs or ()
    assert [(job.name, job.robot, job.after) for job in jobs] == [
        ("J1", "R1", ()),
        ("J2", "R2", ()),
        ("J3", "R2", ("J2", "J1")),
    ]
    stops = [[(stop.at, stop.load) for stop in job.stops] for job in plan.scenario.jobs or ()]
    assert [[(stop.at, stop.load) for stop in job.stops] for job in jobs] == stops


def test_only_nodes_of_the_site_are_named() -> None:
    """R1 follows R2 on a lane of 12 in five pieces, and waits there while R2 works at its end.

    Names that are numbers stay numbers for Nav2. R3 has its target between two pieces.
    """
    at = {"1": [0, 0], "2": [12, 0], "3": [14, 0], "4": [0, 20], "5": [12, 20]}
    plan = solve(
        parse_scenario(
            {
                "format": "rightofway-scenario/1",
                "map": {"roadmap": {"vertices": at, "edges": [["1", "2"], ["2", "3"], ["4", "5"]]}},
                "robots": [
                    {"name": "R1", "home": "1", "target": "2", "radius": 0.4},
                    {
                        "name": "R2",
                        "home": "2",
                        "stops": [{"at": "2", "work": 60}, {"at": "3"}],
                        "radius": 0.4,
                    },
                    {"name": "R3", "home": "4", "target": "4-5/2", "radius": 0.4},
                ],
                "rules": {"return": "none"},
            }
        ),
        time_limit=5,
    )
    text, _ = format_site_plan(plan, "nav2")
    robots = json.loads(text)["robots"]
    nodes = {name: [node for node in own["nodes"] if node is not None]
             for name, own in robots.items()}  # fmt: skip
    assert {name: list(dict.fromkeys(own)) for name, own in nodes.items()} == {
        "R1": [1, 2],
        "R2": [2, 3],
        "R3": ["4", "4-5/2"],
    }
    assert all(len(own["nodes"]) == len(own["path"]["poses"]) for own in robots.values())
    rows = list(csv.DictReader(io.StringIO(format_site_plan(plan, "events")[0])))
    assert {row["place"] for row in rows} <= {*at, "4-5/2", ""}
    assert {row["event"] for row in rows if not row["place"]} <= {"arrive", "wait", "depart"}
