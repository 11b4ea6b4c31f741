"""Actions of stops and places in files: all forms are read and kept; faults have places."""

from __future__ import annotations

from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest

import rightofway
from rightofway import FleetBuilder, InputError
from rightofway.io import dump_scenario, parse_scenario
from rightofway.model import PlaceActions, StopAction

SCAN: dict[str, Any] = {
    "action": "scan",
    "parameters": {"near": 0.25, "codes": ["A", 7], "of": {"lhd": "2"}},
    "blocking": "soft",
    "retriable": True,
    "description": "reads the label",
}


def document() -> dict[str, Any]:
    """Return a scenario with actions of places and of jobs, one and several."""
    return {
        "format": "rightofway-scenario/1",
        "map": {
            "roadmap": {
                "vertices": {"A": [0, 0], "B": [4, 0], "C": [8, 0]},
                "edges": [["A", "B"], ["B", "C"]],
                "stations": {"rack": "B"},
            }
        },
        "robots": [{"name": "R1", "home": "A"}],
        "actions": {"rack": {"pick": [SCAN, "pick"], "work": "wash"}},
        "jobs": [
            {"name": "J1", "pickup": "rack", "dropoff": "C", "dropoff_actions": "drop",
             "load_id": "17", "load_type": "EPAL"},
            {"name": "J2", "at": "C", "actions": [SCAN]},
            {"name": "J3", "stops": [{"at": "A", "actions": ["one", "two"]}, {"at": "C"}]},
        ],
    }  # fmt: skip


def test_actions_are_the_same_in_files_and_in_python() -> None:
    scenario = parse_scenario(document())
    scan = StopAction(**SCAN)
    assert scenario.actions == (
        PlaceActions(at=1, pick=[scan, "pick"], work="wash"),  # type: ignore[arg-type]
    )
    assert scenario.jobs is not None
    first, second, third = scenario.jobs
    assert (first.load_id, first.load_type) == ("17", "EPAL")
    assert [stop.actions for stop in first.stops] == [(), (StopAction(action="drop"),)]
    assert second.stops[0].actions == (scan,)
    assert [action.action for action in third.stops[0].actions] == ["one", "two"]
    fleet = FleetBuilder().add_vertex("A", 0, 0).add_vertex("B", 4, 0)
    fleet.add_vertex("C", 8, 0).add_edge("A", "B").add_edge("B", "C")
    fleet.add_robot("R1", home="A").add_actions("B", pick=[SCAN, "pick"], work="wash")
    fleet.add_job("J1", pickup="B", dropoff="C", dropoff_actions="drop", load_id="17",
                  load_type="EPAL")  # fmt: skip
    fleet.add_job("J2", at="C", actions=SCAN)
    fleet.add_job("J3", stops=[{"at": "A", "actions": ["one", "two"]}, {"at": "C"}])
    built = fleet.build_scenario()
    assert (built.actions, built.jobs) == (scenario.actions, scenario.jobs)


@pytest.mark.parametrize("ending", ["yaml", "json"])
def test_a_file_keeps_all_actions(tmp_path: Path, ending: str) -> None:
    scenario, file = parse_scenario(document()), tmp_path / f"actions.{ending}"
    rightofway.write_scenario(scenario, file)
    assert rightofway.load(file) == scenario
    assert dump_scenario(scenario)["actions"]["B"]["pick"] == [SCAN, "pick"]


def test_a_workbook_keeps_actions_of_trips_jobs_and_places(tmp_path: Path) -> None:
    fleet = FleetBuilder(grid=["....", "...."])
    fleet.add_robot("R1", home="N0", target="N3", work=1, actions=[SCAN, "pick"])
    fleet.add_robot("R2", home="N4", stops=[("N6", 2, "drop"), "N7"])
    file = tmp_path / "trips.xlsx"
    rightofway.write_scenario(fleet.build_scenario(), file)
    assert rightofway.load(file) == fleet.build_scenario()
    with_jobs = document()
    with_jobs["map"] = {"grid": ["...."]}
    with_jobs["robots"] = [{"name": "R1", "home": "N0"}]
    with_jobs["actions"] = {"N1": with_jobs["actions"]["rack"], "N2": {"drop": ["one", "two"]}}
    for job in with_jobs["jobs"]:
        for stop in job.get("stops", [job]):
            stop.update({key: "N3" for key in ("at", "pickup", "dropoff") if key in stop})
    scenario = parse_scenario(with_jobs)
    rightofway.write_scenario(scenario, file)
    assert rightofway.load(file) == scenario


@pytest.mark.parametrize(
    ("actions", "fault"),
    [
        (3, r"actions: 3 is no list"),
        ({"act": "pick"}, r"actions: .* is no action \(give its type, or a mapping like"),
        ([{"action": "pick", "blockign": "hard"}], r"actions\[0\]: 'blockign' is unknown"),
        ({"action": "pick", "blocking": "HARD"}, r"actions.blocking: .HARD. is unknown"),
        ({"action": "pick", "parameters": ["side"]}, r"actions.parameters: .* no mapping"),
        ({"action": "pick", "parameters": {"side": None}}, r".*None is no value"),
        ({"action": "pick", "parameters": {"x": Decimal("0.1234567890123456789")}}, r".*range"),
        ({"action": "pick", "parameters": {"x": Decimal("0.12345678901234567")}}, r".*15 digits"),
    ],
)  # fmt: skip
def test_faults_of_actions_have_their_place(actions: Any, fault: str) -> None:
    wrong = document()
    wrong["jobs"][1]["actions"] = actions
    with pytest.raises(InputError, match=r"jobs\[1\]\." + fault):
        parse_scenario(wrong)


def test_a_place_has_actions_once_whatever_its_names() -> None:
    wrong = document()
    wrong["actions"] |= {"B": {"drop": "drop"}, "Q": {"drop": "drop"}}
    with pytest.raises(InputError) as caught:
        parse_scenario(wrong)
    assert "actions.B: is another name of a place that has actions already" in str(caught.value)
    assert "actions.Q: no vertex is named 'Q'" in str(caught.value)
