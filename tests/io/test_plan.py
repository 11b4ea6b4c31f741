"""Plan files: the same plan, the same bytes; and whatever is in one is read with care."""

import copy
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rightofway.errors import InputError
from rightofway.io import dump_plan, load_plan, parse_plan, write_plan
from rightofway.model import (
    Decision,
    Plan,
    PlannerRun,
    Reroute,
    Rules,
    Status,
    SteadyState,
    Tick,
    Track,
)
from rightofway.model.kept_facts import RerouteReason
from rightofway.site import VertexId
from tests.builders.fleets import grid_fleet


def door_plan() -> Plan:
    """Return the paper's first case: R1 waits one tick at home."""
    scenario = grid_fleet(["...", "@.@", "..."], [("N0", "N6"), ("N2", "N8")])
    n0, n1, n2, n4, n6, n7, n8 = range(7)
    decision = Decision(
        tick=Tick(1),
        kind="vertex",
        vertices=(VertexId(n1),),
        robots=(0, 1),
        waits=0,
        waits_at=VertexId(n0),
        ticks=Tick(1),
        level="robot",
        conflicts_left=(0, None),
        completion_sums=(19, 20),
    )
    return Plan(
        scenario=scenario,
        tracks=(
            Track.of([n0, n1, n4, n7, n6, n7, n4, n1, n0], [0, 2, 3, 4, 5, 7, 8, 9, 10]),
            Track.of([n2, n1, n4, n7, n8, n7, n4, n1, n2], [0, 1, 2, 3, 4, 6, 7, 8, 9]),
        ),
        run=PlannerRun(
            name="two-level",
            options={"swaps": "resolve", "depth": 3, "ratio": 0.5, "list": [1, "a", None]},
            seed=7,
            status=Status("waits only"),
            seconds=0.25,
            decisions=(decision,),
            reroutes=(Reroute(robot=1, because=RerouteReason("makes way for", robot="R1")),),
        ),
    )


TEXT = """\
{
  "format": "rightofway-plan/1",
  "scenario": {
    "format": "rightofway-scenario/1",
    "map": {
      "grid": [
        "...",
        "@.@",
        "..."
      ],
      "cell_size": 1
    },
    "robots": [
      {"name": "R1", "home": "N0", "target": "N6", "work": 0, "speed": 1},
      {"name": "R2", "home": "N2", "target": "N8", "work": 0, "speed": 1}
    ],
    "rules": {"occupancy": "one", "headway": 0, "return": "home", "laps": 1, "rotations": true}
  },
  "tick": 1,
  "planner": {
    "name": "two-level",
    "options": {"depth": 3, "list": [1, "a", null], "ratio": 0.5, "swaps": "resolve"},
    "seed": 7,
    "status": {"kind": "waits only", "counts": {}},
    "seconds": null,
    "decisions": [
      {"tick": 1, "kind": "vertex", "vertices": ["N1"], "robots": ["R1", "R2"], "waits": "R1", \
"waits_at": "N0", "ticks": 1, "level": "robot", "conflicts_left": [0, null], \
"completion_sums": [19, 20]}
    ],
    "reroutes": [
      {"robot": "R2", "because": {"kind": "makes way for", "values": {"robot": "R1"}}}
    ]
  },
  "metrics": {METRICS},
  "robots": [
    {"name": "R1", "vertices": ["N0", "N1", "N4", "N7", "N6", "N7", "N4", "N1", "N0"], \
"enter": [0, 2, 3, 4, 5, 7, 8, 9, 10]},
    {"name": "R2", "vertices": ["N2", "N1", "N4", "N7", "N8", "N7", "N4", "N1", "N2"], \
"enter": [0, 1, 2, 3, 4, 6, 7, 8, 9]}
  ]
}
"""


def test_a_plan_file_is_readable_and_always_the_same(tmp_path: Path) -> None:
    path = tmp_path / "door.json"
    write_plan(door_plan(), path)
    text = path.read_text(encoding="utf-8")
    metrics = json.loads(text)["metrics"]
    # 10 + 9 ticks; alone each would need 9.
    assert (metrics["flowtime"], metrics["makespan"], metrics["lower_bound"]) == (19, 10, 18)
    assert text == TEXT.replace("{METRICS}", json.dumps(metrics))
    write_plan(door_plan(), path)
    assert path.read_text(encoding="utf-8") == text


def test_a_plan_is_read_back_without_the_seconds(tmp_path: Path) -> None:
    plan = door_plan()
    write_plan(plan, tmp_path / "door.json")
    loaded = load_plan(tmp_path / "door.json")
    assert (loaded.scenario, loaded.tracks) == (plan.scenario, plan.tracks)
    assert loaded.run.seconds is None
    assert parse_plan(dump_plan(plan, seconds=True)) == plan
    write_plan(plan, tmp_path / "door.json", seconds=True)
    assert load_plan(tmp_path / "door.json") == plan


def test_a_decision_by_priority_is_read_back_without_counts() -> None:
    plan = door_plan()
    level: dict[str, Any] = {"level": "priority", "conflicts_left": (None, None)}
    decision = replace(plan.run.decisions[0], **level, completion_sums=None)
    plan = replace(plan, run=replace(plan.run, decisions=(decision,)))
    document = dump_plan(plan, seconds=True)
    assert document["planner"]["decisions"][0]["level"] == "priority"
    assert parse_plan(document) == plan


def test_a_plan_may_be_wrong() -> None:
    document = dump_plan(door_plan())
    document["robots"][0] |= {"vertices": ["N0", "N8", "N8"], "enter": [5, -3, 2**53 - 1]}
    track = parse_plan(document).tracks[0]
    assert track.vertices.tolist() == [0, 6, 6]
    assert track.enter.tolist() == [5, -3, 2**53 - 1]
    assert track.enter.dtype == np.int64
    assert dump_plan(parse_plan(document))["robots"][0]["enter"] == [5, -3, 2**53 - 1]


def test_tracks_may_come_in_any_order_and_metrics_are_nobodys_claim() -> None:
    document = dump_plan(door_plan(), seconds=True)
    document["robots"].reverse()
    document["metrics"] = {"flowtime": "much", "mine": 3}
    assert parse_plan(document) == door_plan()
    del document["metrics"]
    assert parse_plan(document) == door_plan()


def test_a_plan_of_a_scenario_that_nobody_can_solve_has_no_metrics() -> None:
    scenario = grid_fleet([".@."], [("N0", "N2")], rules=Rules(ends="none"))
    plan = Plan(
        scenario=scenario, tracks=(Track.of([0, 1], [0, 1]),), run=PlannerRun(name="by hand")
    )
    assert dump_plan(plan)["metrics"] == {}
    assert parse_plan(dump_plan(plan)) == plan


def test_a_track_off_the_roadmap_cannot_be_written(tmp_path: Path) -> None:
    plan = door_plan()
    for vertex in (-1, 7):
        tracks = (Track.of([0, vertex], [0, 1]), plan.tracks[1])
        with pytest.raises(InputError, match=r"robots\[0\]\.vertices: a vertex is not on the road"):
            write_plan(Plan(scenario=plan.scenario, tracks=tracks, run=plan.run), tmp_path / "a")
    assert list(tmp_path.iterdir()) == []


def steady_plan() -> Plan:
    """Return the door, said to repeat itself every 10 ticks; nobody judges that."""
    steady = SteadyState(robots=(1, 0), start=Tick(4), period=Tick(10), critical=((0, 1), (1, 8)))
    return replace(door_plan(), steady=(steady,))


def test_a_plan_says_from_when_on_it_repeats_itself() -> None:
    document = dump_plan(steady_plan(), seconds=True)
    assert document["steady"] == [
        {
            "robots": ["R2", "R1"],
            "start": 4,
            "period": 10,
            "critical": [{"robot": "R1", "visit": 1}, {"robot": "R2", "visit": 8}],
        }
    ]
    assert parse_plan(document) == steady_plan()
    assert "steady" not in dump_plan(door_plan())


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"robots": ["R3"]}, "steady[0].robots[0]: no robot is named 'R3' (name one of"),
        ({"robots": []}, "steady[0].robots: "),
        ({"robots": ["R2", "R1", "R2"]}, "steady[0].robots: R2 is there already (give each robot"),
        ({"robots": ["R2"]}, "steady[0].critical[0].robot: 'R1' is not of this group (name one"),
        ({"period": 0}, "steady[0].period: 0 does not fit (give a whole number of 1 or more)"),
        ({"start": -1}, "steady[0].start: -1 does not fit (give a whole number of 0 or more)"),
        ({"start": "soon"}, "steady[0].start: 'soon' is not a whole number"),
        ({"perod": 3}, "steady[0].perod: unknown key (did you mean period?)"),
        (
            {"critical": [{"robot": "R1", "visit": 9}]},
            "steady[0].critical[0]: R1 has no visit 9 (give 0 to 8)",
        ),
        ({"critical": [{"robot": "R9", "visit": 9}]}, "steady[0].critical[0].robot: no robot is"),
    ],
)
def test_what_cannot_repeat_itself_is_refused(change: dict[str, Any], fault: str) -> None:
    document = dump_plan(steady_plan())
    document["steady"][0] |= change
    with pytest.raises(InputError) as caught:
        parse_plan(document)
    assert str(caught.value.faults[0]).startswith(fault), caught.value


def _set(*path: str | int) -> Callable[[dict[str, Any], Any], None]:
    def apply(document: dict[str, Any], value: Any) -> None:
        node: Any = document
        for step in path[:-1]:
            node = node[step]
        node[path[-1]] = value

    return apply


@pytest.mark.parametrize(
    ("change", "value", "faults"),
    [
        (_set("tick"), "1/2", ["tick: 1/2, but the scenario's is 1 (plan the scenario again;"]),
        (_set("tick"), "soon", ["tick: 'soon' is not a number"]),
        (_set("format"), "rightofway-plan/9", ["format: 'rightofway-plan/9' is not known here"]),
        (_set("robot"), 3, ["robot: unknown key (did you mean robots?)"]),
        (
            _set("robots", 0, "name"),
            "R3",
            ["robots[0].name: no robot is named 'R3' (name one of"],
        ),
        (_set("robots", 1, "name"), "R1", ["robots[1].name: 'R1' has a track already"]),
        (_set("robots", 0, "enter"), [0], ["robots[0]: 9 vertices and 1 times"]),
        (_set("robots", 0, "enter"), [], ["robots[0].enter: [] does not fit (give for each"]),
        (_set("robots", 0, "enter", 3), 2**53, ["robots[0].enter[3]: 9007199254740992 does not"]),
        (_set("robots", 0, "enter", 3), 1.5, ["robots[0].enter[3]: 1.5 is not a whole number"]),
        (_set("robots", 0, "enter", 3), True, ["robots[0].enter[3]: true is not a whole number"]),
        (
            _set("robots", 0, "vertices", 3),
            "N3",
            ["robots[0].vertices[3]: N3, row 1, column 0, is blocked by '@' (N0 is free)"],
        ),
        (_set("robots", 0, "vertices", 3), 3, ["robots[0].vertices[3]: 3 is not text"]),
        (_set("robots"), {}, ["robots: a mapping of 0 is not a list (give one track for each"]),
        (_set("robots"), [], ["robots: 'R1' has no track (give one for each robot)"]),
        (_set("planner"), None, ["planner: is empty (give keys name, options"]),
        (_set("planner", "seed"), "x", ["planner.seed: 'x' is not a whole number"]),
        (_set("planner", "seconds"), -1, ["planner.seconds: -1 is negative"]),
        (
            _set("planner", "status"),
            "waits only",
            ["planner.status: 'waits only' is not a mapping"],
        ),
        (
            _set("planner", "status", "kind"),
            "wait only",
            ["planner.status.kind: 'wait only' is unknown (did you mean 'waits only'?)"],
        ),
        (
            _set("planner", "status", "counts"),
            {"robots": ["R1"]},
            ["planner.status.counts.robots: is no value of 'waits only' (take it out)"],
        ),
        (
            _set("planner", "status"),
            {"kind": "re-routed", "counts": {}},
            ["planner.status.counts.robots: is missing"],
        ),
        (
            _set("planner", "status"),
            {"kind": "other", "counts": {"text": "a\nb"}},
            ["planner.status.counts.text: 'a\\nb' cannot be shown"],
        ),
        (
            _set("planner", "status"),
            {"kind": "interrupted", "counts": {"status": {"kind": 3, "counts": {}}}},
            ["planner.status.counts.status.kind: 3 is unknown"],
        ),
        (
            _set("planner", "status"),
            {"kind": "interrupted", "counts": {"status": 3}},
            ["planner.status.counts.status: 3 is no status (give {kind, counts})"],
        ),
        (
            _set("planner", "decisions", 0, "waits"),
            "R9",
            ["planner.decisions[0].waits: no robot is named 'R9'"],
        ),
        (
            _set("planner", "decisions", 0, "robots"),
            ["R2", "R2"],
            ["planner.decisions[0].waits: 'R1' is none of the two robots (name one of them)"],
        ),
        (
            _set("planner", "decisions", 0, "vertices"),
            ["N9"],
            ["planner.decisions[0].vertices: 'N9' is outside the map"],
        ),
        (
            _set("planner", "decisions", 0, "conflicts_left"),
            [1],
            ["planner.decisions[0].conflicts_left: [1] does not fit (give two counts"],
        ),
        (
            _set("planner", "reroutes", 0, "robot"),
            "R9",
            ["planner.reroutes[0].robot: no robot is named 'R9'"],
        ),
        (
            _set("scenario", "robots", 0, "speed"),
            0,
            ["scenario.robots[0].speed: 0 is not positive (give a number above 0)"],
        ),
        (
            _set("scenario", "map"),
            {"file": "door.map"},
            ["scenario.map.file: 'door.map' is relative to no file"],
        ),
        (_set("scenario"), [], ["scenario: [] is no scenario (begin with format: rightofway-sc"]),
    ],
)
def test_what_cannot_be_a_plan_is_told_with_its_place(
    change: Callable[[dict[str, Any], Any], None], value: Any, faults: list[str]
) -> None:
    document = copy.deepcopy(dump_plan(door_plan()))
    change(document, value)
    with pytest.raises(InputError) as caught:
        parse_plan(document, source="door.json")
    told = str(caught.value).splitlines()
    assert len(told) == len(faults)
    for line, fault in zip(told, faults, strict=True):
        assert line.startswith(f"door.json: {fault}")


def test_faults_in_all_parts_are_told_together() -> None:
    document = dump_plan(door_plan())
    document["scenario"]["robots"][1]["home"] = "N3"
    document["planner"]["name"] = ""
    document["robots"][1]["enter"][2] = None
    del document["tick"]
    with pytest.raises(InputError) as caught:
        parse_plan(document)
    assert [fault.place for fault in caught.value.faults] == [
        "scenario.robots[1].home",
        "planner.name",
        "robots[1].enter[2]",
        "tick",
    ]


def test_a_missing_part_is_told_once() -> None:
    with pytest.raises(InputError) as caught:
        parse_plan({"format": "rightofway-plan/1"})
    assert [fault.place for fault in caught.value.faults] == [
        "scenario",
        "tick",
        "robots",
    ]


def test_a_plan_of_an_unknown_planner_is_a_plan() -> None:
    document = dump_plan(door_plan())
    del document["planner"]
    assert parse_plan(document).run.name == "unknown"


def test_a_scenario_is_no_plan() -> None:
    with pytest.raises(InputError, match="is a scenario, not a plan"):
        parse_plan(dump_plan(door_plan())["scenario"])
