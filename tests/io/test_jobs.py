"""Jobs, states and batteries in scenario files, and tours in plan files."""

from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from rightofway import FleetBuilder, InputError, load
from rightofway.io.plan.reader import parse_plan
from rightofway.io.plan.writer import dump_plan, format_plan
from rightofway.io.scenario.reader import parse_scenario
from rightofway.io.scenario.writer import dump_scenario, format_scenario, write_scenario
from rightofway.io.yaml_text import parse_yaml
from rightofway.model import Battery, Job, JobStop, RobotState, Rules
from rightofway.site import VertexId
from tests.builders.planned_jobs import make_plan

F, V = Fraction, VertexId

TEXT = """
format: rightofway-scenario/1
map: {grid: [".....", "....."]}
robots:
  - {name: R1, home: N0, capacity: 2, battery: large, charging: [N0],
     start: {at: N7, ready: 12, heading: 90, soc: 0.55, begun: {J3: 1}}}
  - {name: R2, home: N4, type: fork, start: {soc: 1/2}}
batteries:
  large: {drive: 1/2000, on: 1/36000, work: 0, charge: 1/1800, reserve: 1/5}
charging: [N0, [1, 1]]
jobs:
  - {name: J1, pickup: N2, dropoff: N9, load: 1, pickup_work: 20, dropoff_work: 15, earliest: 60,
     due: 400}
  - {name: J2, at: N3, work: 30, weight: 3, types: [fork], latest: 900, after: [J1]}
  - {name: J3, stops: [{at: N2, work: 10, load: 2}, {at: N1, load: -1}, {at: N5, load: -1}],
     robot: R1, latest: 500}
rules: {objective: flowtime, late: 1/2, patience: 90}
"""


def read(**changes: Any) -> Any:
    """Return the document, changed; None takes a key out."""
    document = parse_yaml(TEXT) | changes
    return {key: value for key, value in document.items() if value is not None}


def test_all_keys_of_jobs_are_read() -> None:
    scenario = parse_scenario(read())
    first, second = scenario.robots
    assert (first.capacity, first.battery, first.charging) == (2, "large", (0,))
    assert first.start == RobotState(
        at=V(7), ready=F(12), heading=F(90), soc=F(11, 20), begun=(("J3", 1),)
    )
    assert second.start == RobotState(at=V(4), soc=F(1, 2))
    large = Battery(drive=F(1, 2000), on=F(1, 36000), charge=F(1, 1800), reserve=F(1, 5))
    assert scenario.batteries == (("large", large),)
    assert scenario.charging == (0, 6)
    assert scenario.jobs == (
        Job(
            name="J1",
            stops=(
                JobStop(at=V(2), work=F(20), load=1, earliest=F(60)),
                JobStop(at=V(9), work=F(15), load=-1),
            ),
            due=F(400),
        ),
        Job(
            name="J2",
            stops=(JobStop(at=V(3), work=F(30), latest=F(900)),),
            weight=F(3),
            types=("fork",),
            after=("J1",),
        ),
        Job(
            name="J3",
            stops=(
                JobStop(at=V(2), work=F(10), load=2),
                JobStop(at=V(1), load=-1),
                JobStop(at=V(5), load=-1, latest=F(500)),
            ),
            robot="R1",
        ),
    )
    rules = Rules(occupancy="one", objective="flowtime", late=F(1, 2), patience=F(90))
    assert scenario.rules == rules


def test_a_scenario_with_jobs_is_written_and_read_again() -> None:
    scenario = parse_scenario(read())
    assert parse_scenario(dump_scenario(scenario)) == scenario
    text = format_scenario(scenario)
    assert parse_scenario(parse_yaml(text)) == scenario
    assert "- {name: J1, pickup: N2, dropoff: N9, pickup_work: 20, dropoff_work: 15," in text
    empty = parse_scenario(read(jobs=[], robots=[{"name": "R1", "home": "N0"}], batteries=None))
    assert dump_scenario(empty)["jobs"] == []
    assert parse_scenario(dump_scenario(empty)) == empty


def test_the_builder_makes_the_scenario_of_the_file() -> None:
    fleet = FleetBuilder(grid=[".....", "....."], objective="flowtime", late="1/2", patience=90)
    fleet.add_job(
        "J1", pickup="N2", dropoff="N9", pickup_work=20, dropoff_work=15, earliest=60, due=400
    )
    fleet.add_job("J2", at="N3", work=30, weight=3, types=["fork"], latest=900, after=["J1"])
    stops: list[dict[str, Any]] = [{"at": "N2", "work": 10, "load": 2}]
    stops += [{"at": at, "load": -1} for at in ("N1", (1, 0))]
    fleet.add_job("J3", stops=stops, robot="R1", latest=500)
    shares = {"drive": "1/2000", "on": "1/36000", "charge": "1/1800", "reserve": "1/5"}
    fleet.add_battery("large", **shares).add_charging(["N0", (1, 1)])
    state = {"at": "N7", "ready": 12, "heading": 90, "soc": 0.55, "begun": {"J3": 1}}
    fleet.add_robot("R1", home="N0", capacity=2, battery="large", charging=["N0"], start=state)
    fleet.add_robot("R2", home="N4", type="fork", start={"soc": "1/2"})
    assert fleet.build_scenario() == parse_scenario(read())


def test_a_pickup_with_a_deadline_is_written_as_stops() -> None:
    stops = [{"at": "N2", "load": 1, "latest": 9}, {"at": "N3", "load": -1}]
    document = read(jobs=[{"name": "J3", "stops": stops}])
    written = dump_scenario(parse_scenario(document))
    assert written["jobs"] == [{"name": "J3", "stops": stops}]


def test_a_workbook_has_sheets_of_jobs_and_batteries(tmp_path: Path) -> None:
    scenario = parse_scenario(read())
    write_scenario(scenario, tmp_path / "hall.xlsx")
    assert load(tmp_path / "hall.xlsx") == scenario


CSV = """
name;at;work;pickup;dropoff;due;types;after;robot;stops
J1;;;N2;N9;400;;;;
J2;N3;0,5;;;;fork, tug;J1;;
J3;;;;;;;;R1;"[{at: N2, load: 2}, {at: N1, load: -2}]"
"""


def test_jobs_are_rows_of_a_csv_file(tmp_path: Path) -> None:
    (tmp_path / "jobs.csv").write_text(CSV.strip())
    first, second, third = parse_scenario(read(jobs={"table": "jobs.csv"}), tmp_path).jobs or ()
    assert first == Job(
        name="J1", stops=(JobStop(at=V(2), load=1), JobStop(at=V(9), load=-1)), due=F(400)
    )
    assert second == Job(
        name="J2",
        stops=(JobStop(at=V(3), work=F(1, 2)),),
        types=("fork", "tug"),
        after=("J1",),
    )
    assert [stop.load for stop in third.stops] == [2, -2]


def test_a_fault_in_a_table_of_jobs_is_named_by_its_line(tmp_path: Path) -> None:
    (tmp_path / "jobs.csv").write_text(CSV.strip().replace("N9", "N99"))
    with pytest.raises(InputError) as refused:
        parse_scenario(read(jobs={"table": "jobs.csv"}), tmp_path)
    message = "jobs.csv:2: dropoff: 'N99' is outside the map (cells are N0 to N9)"
    assert str(refused.value).endswith(message)


JOB = {"name": "J3", "pickup": "N2", "dropoff": "N3"}

FAULTS: list[tuple[dict[str, Any], str]] = [
    (
        {"jobs": 5},
        (
            "jobs: 5 is no list (give a list of {name, at or pickup and dropoff or stops, …}, or"
            " {table: file})"
        ),
    ),
    ({"charging": "N1"}, "charging: 'N1' is no list (give a list of places)"),
    (
        {"batteries": ["large"]},
        (
            "batteries: ['large'] is no mapping of names to batteries (give for each battery"
            " its name and {drive, on, work, charge, reserve})"
        ),
    ),
    (
        {"jobs": [{"name": "J3"}]},
        "jobs[0]: has no place to work at (give at, pickup and dropoff, or stops)",
    ),
    (
        {"jobs": [JOB | {"at": "N4"}]},
        "jobs[0]: has both at and pickup (give at, pickup and dropoff, or stops)",
    ),
    (
        {"jobs": [{"name": "J3", "pickup": "N4"}]},
        "jobs[0]: has no dropoff (give at, pickup and dropoff, or stops)",
    ),
    (
        {"jobs": [{"name": "J3", "load": 2, "stops": [{"at": "N4"}]}]},
        "jobs[0]: has both load and stops (give at, pickup and dropoff, or stops)",
    ),
    (
        {"jobs": [{"name": "J3", "earliest": 2, "stops": [{"at": "N4", "earliest": 1}]}]},
        "jobs[0]: has earliest, and its first stop, too (give one of them)",
    ),
    ({"jobs": [JOB | {"dropoff": "N99"}]}, "jobs[0].dropoff: 'N99' is outside the map"),
    ({"jobs": [JOB | {"load": -1}]}, "jobs[0].load: -1 "),
    (
        {"jobs": [JOB | {"dropoff_work": 5, "latest": 4}]},
        ("jobs[0].latest: 4 is before earliest and work, 0 + 5 (give 5 or more, or leave it out)"),
    ),
    (
        {"jobs": [JOB | {"at": "N1"}, JOB | {"after": ["J4"], "robot": "R2"}]},
        "jobs[1].after[0]: no job is named 'J4'",
    ),
    (
        {"robots": [{"name": "R1", "home": "N0", "target": "N1", "work": 2}]},
        (
            "robots[0].target: is given beside jobs (take it out; a fixed trip is a job with"
            " robot: R1)"
        ),
    ),
    (
        {"robots": [{"name": "R1", "home": "N0", "start": {"at": "N77"}}]},
        "robots[0].start.at: 'N77' is outside the map",
    ),
    (
        {"robots": [{"name": "R1", "home": "N0", "battery": "small"}]},
        "robots[0].battery: no battery is named 'small'",
    ),
    (
        {"jobs": None, "rules": None, "batteries": None, "charging": None},
        "robots[0]: has nowhere to go (give target, or stops)",
    ),
]


@pytest.mark.parametrize(("changes", "message"), FAULTS, ids=[message for _, message in FAULTS])
def test_a_fault_of_jobs_is_named_at_its_place(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as refused:
        parse_scenario(read(**changes))
    assert any(line.startswith(message) for line in str(refused.value).splitlines()), refused.value


def test_a_job_with_a_fault_is_known_to_other_jobs() -> None:
    robots = [{"name": "R3", "home": "N77"}, {"name": "R4", "home": "N0"}]
    jobs = [JOB | {"at": "N1"}, {"name": "J4", "at": "N1", "after": ["J3"], "robot": "R3"}]
    with pytest.raises(InputError) as refused:
        parse_scenario(read(jobs=jobs, robots=robots))
    assert len(str(refused.value).splitlines()) == 2


def test_a_plan_with_jobs_is_written_and_read_again() -> None:
    plan = make_plan()
    document = json.loads(format_plan(plan))
    assert document["format"] == "rightofway-plan/2"
    assert document["robots"][0]["tour"] == [
        {"visit": 1, "job": "J1", "stop": 0, "begin": 3, "end": 5},
        {"visit": 3, "job": "J1", "stop": 1, "begin": 8, "end": 9},
        {"visit": 6, "charge": True, "begin": 13, "end": 15},
    ]
    assert document["unserved"] == [{"job": "J4", "reason": "not found"}]
    assert parse_plan(document) == plan


def test_figures_of_jobs_have_no_weights() -> None:
    # J1 ends at 9 and may begin at 3, J2 ends at 12, J3 is begun and ends at 4.
    metrics = dump_plan(make_plan())["metrics"]
    assert (metrics["service_time"], metrics["lateness"], metrics["unserved"]) == (22, 0, 1)


PLAN_FAULTS: list[tuple[Callable[[Any], Any], str]] = [
    (
        lambda plan: plan["robots"][0].pop("tour"),
        "robots[0].tour: is missing (give a list of what the robot does, that may be empty)",
    ),
    (
        lambda plan: plan.update(format="rightofway-plan/1"),
        "format: 'rightofway-plan/1' is not for a scenario with jobs (give rightofway-plan/2)",
    ),
    (
        lambda plan: plan["robots"][0]["tour"][0].update(visit=7),
        "robots[0].tour[0].visit: 7 is none of 7 (give 0 to 6)",
    ),
    (
        lambda plan: plan["robots"][0]["tour"][0].update(stop=2),
        "robots[0].tour[0].stop: 2 is none of 2 (give 0 to 1)",
    ),
    (
        lambda plan: plan["robots"][0]["tour"][0].update(job="J9"),
        "robots[0].tour[0].job: no job is named 'J9' (name one of the scenario's jobs)",
    ),
    (
        lambda plan: plan["robots"][0]["tour"][2].update(job="J1"),
        "robots[0].tour[2]: is a charge with a job or stop (take one out)",
    ),
    (
        lambda plan: plan["robots"][0]["tour"][0].pop("stop"),
        "robots[0].tour[0]: has not both job and stop (give both, or charge: true)",
    ),
    (
        lambda plan: plan.update(unserved=[{"job": "J4", "reason": "lazy"}]),
        (
            "unserved[0].reason: 'lazy' does not fit (give robot, way, battery, latest, after"
            " or not found)"
        ),
    ),
]


@pytest.mark.parametrize(("change", "message"), PLAN_FAULTS, ids=[text for _, text in PLAN_FAULTS])
def test_a_fault_of_tours_is_named_at_its_place(change: Callable[[Any], Any], message: str) -> None:
    document = json.loads(format_plan(make_plan()))
    change(document)
    with pytest.raises(InputError) as refused:
        parse_plan(document)
    assert str(refused.value) == message
