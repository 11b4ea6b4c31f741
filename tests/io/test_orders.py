"""Orders of openTCS and Open-RMF, read as jobs, and what is wrong in them with its place."""

from __future__ import annotations

import json
from contextlib import suppress
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import pytest

from rightofway.errors import InputError
from rightofway.io import load, load_with_notes
from rightofway.model import Job
from rightofway.report.facts import write_notes
from tests.builders.pages import ROOT

SITE = """format: rightofway-scenario/1
map:
  roadmap:
    vertices: {A: [0, 0], B: [1, 0], C: [2, 0], D: [3, 0], Gate: [0, 1]}
    edges: [[A, B], [B, C], [C, D], [A, Gate]]
units: {length: m, time: s}
robots:
  - {name: R1, home: A}
  - {name: R2, home: D, type: fork}
"""

XML = """<?xml version="1.0" encoding="UTF-8" standalone="yes"?>
<tcsOrderSet>
    <order xsi:type="transport" deadline="2016-11-24T11:18:39.124+01:00" intendedVehicle="R1"
           id="T1" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">
        <destination locationName="Gate" operation="Load cargo"/>
        <destination locationName="D" operation="Unload cargo"/>
        <property key="waitBefore" value="Unload"/>
    </order>
    <order xsi:type="transport" id="T2" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">
        <destination locationName="B" operation="Drill"/>
        <destination locationName="C" operation="Cut"/>
        <dependency>T1</dependency>
    </order>
</tcsOrderSet>
"""


@pytest.fixture
def site(tmp_path: Path) -> Path:
    path = tmp_path / "site.yaml"
    path.write_text(SITE, encoding="utf-8")
    return path


def read(site: Path, orders: Any, name: str = "orders.json", times: str = "") -> tuple[Job, ...]:
    """Return the jobs of orders: JSON data, or a text."""
    file = site.parent / name
    text = orders if isinstance(orders, str) else json.dumps(orders, indent=1)
    file.write_text(text, encoding="utf-8")
    if not times:
        return load(site, jobs=file).jobs or ()
    whole = site.parent / "whole.yaml"
    whole.write_text(SITE + f"jobs: {{table: {name}, {times}}}\n", encoding="utf-8")
    return load(whole).jobs or ()


def name_stops(site: Path, job: Job) -> list[tuple[str, Any, int]]:
    name = load(site, jobs=site.parent / "orders.json").roadmap.name
    return [(name(stop.at), stop.work, stop.load) for stop in job.stops]


def go(*places: str, **more: Any) -> dict[str, Any]:
    """Return an order of openTCS to some places, each with an operation behind a colon."""
    pairs = [place.partition(":") for place in places]
    stops = [{"locationName": at, "operation": operation or "NOP"} for at, _, operation in pairs]
    return {"destinations": stops, **more}


def test_orders_of_opentcs_are_jobs(site: Path) -> None:
    orders = [
        go("Gate:Load cargo", "D:Unload cargo", name="T1", creationTime="2026-11-28T06:00:00Z",
           deadline="2026-11-28T07:01:00.500+01:00", intendedVehicle="R1", type="-",
           dispensable=False, properties=[{"key": "k", "value": "v"}]),
        go("B", "C", name="T2", type="fork", creationTime="2026-11-28T06:01:00Z",
           deadline="+1000000000-12-31T23:59:59.999999999Z", dependencies=["T1"]),
    ]  # fmt: skip
    first, second = read(site, orders)
    assert name_stops(site, first) == [("Gate", 0, 1), ("D", 0, -1)]
    assert (first.name, first.robot, first.due) == ("T1", "R1", Fraction(121, 2))
    assert name_stops(site, second) == [("B", 0, 0), ("C", 0, 0)]
    assert (second.types, second.after, second.due) == (("fork",), ("T1",), None)


def test_operations_of_opentcs_without_loads_are_actions_of_stops(site: Path) -> None:
    order = go("Gate:Load cargo", "B:Drill", "D:Unload cargo", "C", "C:CHARGE", name="T1")
    (job,) = read(site, [order])
    assert [[action.action for action in stop.actions] for stop in job.stops] == [
        [], ["Drill"], [], [], []
    ]  # fmt: skip


def test_bodies_of_requests_have_the_names_under_which_they_are_posted(site: Path) -> None:
    assert [job.name for job in read(site, {"T7": go("B"), "T8": go("C")})] == ["T7", "T8"]
    assert [job.name for job in read(site, go("B"), "T9.json")] == ["T9"]


def test_orders_of_one_sequence_are_done_in_turn(site: Path) -> None:
    orders = [go("B", name=name, wrappingSequence="S") for name in ("T1", "T2", "T3")]
    assert [job.after for job in read(site, orders)] == [(), ("T1",), ("T2",)]


def test_of_orders_in_work_the_rest_is_left_and_others_that_are_no_work_are_left_out(
    site: Path,
) -> None:
    started = go("Gate:Load cargo", "D:Unload cargo", name="T1", processingVehicle="R2")
    started["destinations"][0]["state"] = "FINISHED"
    orders = [
        started,
        go("B", name="T2", state="FAILED"),
        go("B", name="T3", type="Park"),
        {"name": "T4", "destinations": []},
    ]
    (job,) = read(site, orders)
    assert name_stops(site, job) == [("D", 0, 0)]
    assert job.robot == "R2"
    notes = write_notes(load_with_notes(site, jobs=site.parent / "orders.json").notes)
    assert notes == [
        "T1: the loads do not match and are not read",
        "T2: left out, done or failed",
        "T3: left out, to park or to charge",
        "T4: left out, without destinations",
    ]


def test_sets_of_orders_as_xml_are_jobs(site: Path) -> None:
    first, second = read(site, XML, "orders.xml", "begin: '2016-11-24T10:00:00Z', work: 5")
    assert (first.name, first.robot, first.due) == ("T1", "R1", Fraction("1119.124"))
    assert [(int(stop.work), stop.load) for stop in first.stops] == [(5, 1), (5, -1)]
    assert (second.name, second.after, len(second.stops)) == ("T2", ("T1",), 2)


def test_times_are_in_the_unit_of_the_scenario(site: Path) -> None:
    site.write_text(SITE.replace("time: s", "time: min"), encoding="utf-8")
    orders = [go("B", name="T1", creationTime="2026-11-28T06:00:00Z",
                 deadline="2026-11-28T06:00:30Z")]  # fmt: skip
    (job,) = read(site, orders)
    assert job.due == Fraction(1, 2)


def ask(category: str, description: Any, **more: Any) -> dict[str, Any]:
    """Return a request that any robot may serve."""
    request = {"category": category, "description": description, **more}
    return {"type": "dispatch_task_request", "request": request}


def do(*activities: tuple[str, Any], category: str = "tour") -> dict[str, Any]:
    """Return a composed request of a sequence of activities."""
    listed = [{"category": name, "description": what} for name, what in activities]
    sequence = {"category": "sequence", "description": {"activities": listed}}
    return ask("compose", {"category": category, "phases": [{"activity": sequence}]})


def test_requests_of_open_rmf_are_jobs(site: Path) -> None:
    payload = [{"sku": "coke", "quantity": 2}]
    delivery = {
        "pickup": {"place": "Gate", "handler": "h", "payload": payload},
        "dropoff": {"place": {"waypoint": "D", "orientation": 1.5}, "payload": payload},
    }
    requests = [
        ask("delivery", delivery, unix_millis_request_time=1_000_000,
            unix_millis_earliest_start_time=1_060_500, priority={"type": "binary", "value": 1}),
        {"type": "robot_task_request", "robot": "R2", "fleet": "f",
         "request": {"category": "patrol", "description": {"places": ["A", "B"], "rounds": 2}}},
        {"category": "clean", "description": {"zone": "C"}},
    ]  # fmt: skip
    first, second, third = read(site, requests)
    assert name_stops(site, first) == [("Gate", 0, 1), ("D", 0, -1)]
    assert first.earliest == Fraction(121, 2)
    assert first.weight == 10
    assert [at for at, *_ in name_stops(site, second)] == ["A", "B", "A", "B"]
    assert (second.name, second.robot) == ("patrol 1", "R2")
    assert (third.name, name_stops(site, third)) == ("clean 1", [("C", 0, 0)])


def test_composed_requests_are_jobs_of_their_activities(site: Path) -> None:
    action = {"category": "scan", "description": {}, "unix_millis_action_duration_estimate": 60_500}
    requests = [
        do(("go_to_place", "C"), ("perform_action", action), category="scan"),
        do(("go_to_place", {"one_of": [{"waypoint": "B"}]}), ("go_to_place", {"place": "C"})),
        do(("pickup", {"place": "A"}), ("pickup", {"place": "B"}), ("dropoff", {"place": "D"})),
        do(("perform_action", action | {"expected_finish_location": "B"})),
    ]
    jobs = read(site, requests)
    assert [job.name for job in jobs] == ["scan 1", "tour 1", "tour 2", "tour 3"]
    assert [name_stops(site, job) for job in jobs] == [
        [("C", Fraction(121, 2), 0)],
        [("B", 0, 0), ("C", 0, 0)],
        [("A", 0, 1), ("B", 0, 1), ("D", 0, -2)],
        [("B", Fraction(121, 2), 0)],
    ]


def test_lists_of_jobs_are_read_from_files_of_their_own(site: Path) -> None:
    jobs = [{"name": "J1", "pickup": "A", "dropoff": "D"}]
    assert [job.name for job in read(site, jobs)] == ["J1"]
    assert read(site, {"jobs": jobs}) == read(site, jobs)
    assert read(site, "- {name: J1, pickup: A, dropoff: D}\n", "jobs.yaml") == read(site, jobs)
    assert read(site, "name,pickup,dropoff\nJ1,A,D\n", "jobs.csv") == read(site, jobs)


def test_orders_are_read_onto_a_plant_model(tmp_path: Path) -> None:
    plant = ROOT / "tests/data/samples/opentcs/Demo-01.xml"
    site = tmp_path / "plant.json"
    robots = [{"name": "V1", "home": "Point-0026"}]
    document = {"format": "rightofway-scenario/1", "map": {"layout": str(plant)}, "robots": robots}
    site.write_text(json.dumps(document), encoding="utf-8")
    orders = [go("Goods in north 01:Load cargo", "Storage 01:Unload cargo", name="T1")]
    (job,) = read(site, orders)
    assert [stop.load for stop in job.stops] == [1, -1]


LATE = "2026-11-28T06:10:00Z"


@pytest.mark.parametrize(
    ("orders", "fault"),
    [
        ([go("Q", name="T1")], "5: [0] (T1): destinations[0].locationName: no vertex is named 'Q'"),
        ([go("B", name="T1", deadline=LATE)], "[0] (T1): deadline: needs the instant of time 0"),
        ([go("B", name="T1", deadline="soon")], "deadline: 'soon' is no instant (give one like"),
        ([go("B")], "[0].name: is missing"),
        ([go("B", name="T1", intendedVehicle="R9")], "intendedVehicle: no robot is named 'R9'"),
        ([go("B", name="T1", dependencies=["T9"])], "dependencies[0]: no job is named 'T9'"),
        ([go("B", name="T1"), go("C", name="T1")], "[1] (T1): name"),
        ([{"destinations": [{}], "name": "T1"}], "destinations[0].locationName: is missing"),
        ([ask("fly", {})], "[0].request.category: 'fly' is not read (known: delivery, patrol,"),
        ([ask("patrol", {"places": [3]})], "places[0]: 3 is no name of a place (give the name of"),
        ([ask("patrol", {"places": []})], "description: has no place to go to"),
        ([do(("perform_action", {}))], "has no place (give a go_to_place before it)"),
        (
            [do(("go_to_place", {"one_of": ["A", "B"]}))],
            "one_of: has 2 places to choose from (give one: jobs have no choice)",
        ),
        ([ask("patrol", {"places": ["A"], "rounds": 0})], "rounds: 0 does not fit"),
        (
            [ask("clean", {"zone": "C"}, unix_millis_earliest_start_time="now")],
            "unix_millis_earliest_start_time: 'now' does not fit",
        ),
        ([{"type": "cancel_task_request", "category": "", "description": 1}], "is no request"),
        ({"orders": 3}, "orders.json: has no list of jobs (give a .csv file, a list of jobs"),
    ],
)
def test_what_is_wrong_in_orders_is_named_with_its_place(
    site: Path, orders: Any, fault: str
) -> None:
    with pytest.raises(InputError) as error:
        read(site, orders)
    assert fault in str(error.value)
    assert "orders.json" in str(error.value)


@pytest.mark.parametrize(
    ("xml", "fault"),
    [
        (XML.replace('"D"', '"Q"'), "orders.xml:6: locationName: no vertex is named 'Q'"),
        (
            XML.replace("<dependency>T1", "<dependency>T9"),
            "orders.xml:9: [0]: no job is named 'T9'",
        ),
        ("<plan/>", "orders.xml:1: <plan> has no jobs (give a tcsOrderSet of openTCS)"),
        (XML.replace(' operation="Cut"/>', ">"), "orders.xml:13: this is no XML"),
    ],
)
def test_what_is_wrong_in_xml_is_named_with_its_line(site: Path, xml: str, fault: str) -> None:
    with pytest.raises(InputError) as error:
        read(site, xml, "orders.xml", "begin: '2016-11-24T10:00:00Z'")
    assert fault in str(error.value)


def test_times_of_orders_are_refused_for_jobs_of_ours(site: Path) -> None:
    with pytest.raises(InputError, match="work: is for orders of openTCS and Open-RMF"):
        read(site, "name,at\nJ1,A\n", "jobs.csv", "work: 5")


def test_a_file_of_jobs_is_refused_for_a_scen_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="jobs: is for a scenario as YAML or JSON"):
        load(tmp_path / "hall.scen", jobs=tmp_path / "jobs.csv")


ORDERS = json.dumps(
    [
        go("Gate:Load cargo", "D:Unload cargo", name="T1", creationTime="2026-11-28T06:00:00Z",
           deadline="2026-11-28T07:00:00Z", intendedVehicle="R1", type="fork", state="RAW",
           wrappingSequence="S", dependencies=["T2"], properties={"key": "value"}),
        {"name": "T2", "driveOrders": [{"state": "PRISTINE", "destination": {"destination": "B"}}]},
    ],
    indent=1,
)  # fmt: skip
TASKS = json.dumps(
    [
        ask("delivery", {"pickup": {"place": "Gate"}, "dropoff": {"place": {"waypoint": "D"}}},
            unix_millis_earliest_start_time=60_000, priority={"type": "binary", "value": 1}),
        do(("go_to_place", {"one_of": ["B"]}), ("perform_action", {"category": "x"})),
    ],
    indent=1,
)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "name"), [(ORDERS, "orders.json"), (TASKS, "tasks.json"), (XML, "orders.xml")]
)
def test_a_text_with_random_changes_is_orders_or_a_fault(site: Path, text: str, name: str) -> None:
    draw = Random(7)  # noqa: S311
    for _ in range(60):
        spoiled = list(text)
        for _ in range(draw.randint(1, 4)):
            place = draw.randrange(len(spoiled))
            match draw.randrange(3):
                case 0:
                    spoiled[place] = draw.choice("(){}[]:,->\n 019Tx\"'é")
                case 1:
                    del spoiled[place]
                case _:
                    spoiled.insert(place, draw.choice(text))
        with suppress(InputError):
            read(site, "".join(spoiled), name)


@pytest.mark.parametrize("text", [ORDERS, TASKS])
@pytest.mark.parametrize("value", [None, 3, "A", [], {}, [[]], True, 1e300])
def test_each_value_of_another_kind_is_read_or_a_fault(site: Path, text: str, value: Any) -> None:
    data = json.loads(text)
    for path in list_paths(data):
        changed = json.loads(text)
        inner = changed
        for step in path[:-1]:
            inner = inner[step]
        inner[path[-1]] = value
        with suppress(InputError):
            read(site, changed)


def list_paths(data: Any) -> list[tuple[Any, ...]]:
    """Return the keys and indices that lead to each value of JSON data."""
    paths: list[tuple[Any, ...]] = []
    if not isinstance(data, dict | list):
        return paths
    for step, value in data.items() if isinstance(data, dict) else enumerate(data):
        paths += [(step,), *((step, *path) for path in list_paths(value))]
    return paths
