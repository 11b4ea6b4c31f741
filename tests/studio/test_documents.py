"""Files of the folder and documents in them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import httpx
import pytest

from rightofway import load, load_plan, solve, write_plan
from rightofway.io import dump_scenario
from tests.builders.studios import DOOR


def test_a_scenario_opens_as_the_document_that_stands_in_the_file(client: httpx.Client) -> None:
    opened = client.get("/documents/floor.yaml").json()
    assert opened["kind"] == "scenario"
    assert "floor" in opened["document"]["map"]


def test_a_scenario_with_faults_opens_so_that_it_can_be_mended(
    client: httpx.Client, folder: Path
) -> None:
    (folder / "faulty.yaml").write_text(
        "format: rightofway-scenario/1\nmap: {grid: ['...']}\nrobots: [{name: R1, home: N9}]\n"
    )
    opened = client.get("/documents/faulty.yaml").json()
    verdict = client.post("/validate", json={"document": opened["document"]}).json()
    assert not verdict["ok"]
    assert {fault["named"] for fault in verdict["faults"]} >= {"robots[0] (R1): home"}


def test_a_layout_opens_as_the_map_of_a_new_scenario(client: httpx.Client, folder: Path) -> None:
    (folder / "hall.map").write_text("type octile\nheight 2\nwidth 3\nmap\n...\n.@.\n")
    opened = client.get("/documents/hall.map").json()
    assert opened["kind"] == "layout"
    assert opened["document"]["map"]["layout"] == "hall.map"
    assert opened["document"]["robots"] == []
    assert (opened["save_as"], opened["revision"]) == ("hall.yaml", "")
    body = {"document": opened["document"], "revision": opened["revision"]}
    assert client.put("/documents/hall.yaml", json=body).status_code == 200
    assert client.put("/documents/hall.yaml", json=body).status_code == 412
    assert client.get("/documents/hall.map").json()["save_as"] == "hall2.yaml"


def test_a_plan_opens_as_a_run_that_is_done(client: httpx.Client, folder: Path) -> None:
    plan = solve(load(folder / "door.yaml"), planner="two-level")
    write_plan(plan, folder / "plan.json")
    opened = client.get("/documents/plan.json").json()
    assert opened["run"]["state"] == "done"
    assert opened["run"]["figures"]["flowtime"] == plan.flowtime


def test_a_file_that_is_no_document_is_refused_in_the_words_of_its_reader(
    client: httpx.Client, folder: Path
) -> None:
    (folder / "broken.yaml").write_text("a: [1\n")
    refused = client.get("/documents/broken.yaml")
    assert refused.status_code == 422
    assert refused.json()["error"]["faults"][0]["line"] == 2


@pytest.mark.parametrize("name", ["saved.yaml", "saved.json", "saved.xlsx"])
def test_what_is_saved_is_read_again(client: httpx.Client, folder: Path, name: str) -> None:
    saved = client.put(f"/documents/{name}", json={"document": DOOR})
    assert saved.status_code == 200
    assert [robot.name for robot in load(folder / name).robots] == ["R1", "R2"]
    assert client.get(f"/documents/{name}").json()["revision"] == saved.json()["revision"]


def test_a_document_that_was_changed_elsewhere_is_not_overwritten(client: httpx.Client) -> None:
    first = client.put("/documents/shared.yaml", json={"document": DOOR}).json()["revision"]
    other = {**DOOR, "rules": {"headway": 1}}
    body = {"document": other, "revision": first}
    second = client.put("/documents/shared.yaml", json=body)
    assert second.status_code == 200
    assert client.put("/documents/shared.yaml", json=body).status_code == 412


def test_a_scenario_in_a_folder_names_files_beside_it(client: httpx.Client, folder: Path) -> None:
    (folder / "maps").mkdir()
    (folder / "maps" / "small.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n")
    robots = [{"name": "R1", "home": "N0", "target": "N2"}]
    document = {**DOOR, "map": {"file": "small.map"}, "robots": robots}
    beside = client.post("/validate", json={"document": document, "folder": "maps"}).json()
    above = client.post("/validate", json={"document": document}).json()
    assert (beside["ok"], above["ok"]) == (True, False)


def test_faults_are_the_words_of_the_library(client: httpx.Client) -> None:
    document = {**DOOR, "robots": [{"name": "R1", "home": "N0", "target": "N6", "sped": 2}]}
    verdict = client.post("/validate", json={"document": document}).json()
    assert verdict["faults"] == [
        {
            "place": "robots[0].sped",
            "path": ["robots", 0, "sped"],
            "message": "unknown key (did you mean speed?)",
            "line": None,
            "named": "robots[0] (R1): sped",
            "about": "R1: sped",
        }
    ]


def test_a_body_that_does_not_fit_is_refused_in_the_same_words(client: httpx.Client) -> None:
    refused = client.post("/validate", json={"dokument": DOOR})
    assert refused.status_code == 422
    assert {fault["place"]: fault["message"] for fault in refused.json()["error"]["faults"]} == {
        "document": "is missing (give a scenario, as in a YAML or JSON file)",
        "dokument": "unknown key (did you mean document?)",
    }


def test_a_document_is_inspected_drawn_and_converted(client: httpx.Client) -> None:
    body = {"document": DOOR}
    assert client.post("/inspect", json=body).json()["places"] == 4
    site = client.post("/survey", json=body).json()["site"]
    assert site["map"]["rows"] == ["...", "@.@", "..."]
    assert [robot["name"] for robot in site["robots"]] == ["R1", "R2"]
    written = client.post("/convert", json={**body, "name": "door.yaml"}).text
    assert written.startswith("format: rightofway-scenario/1")


def test_a_draft_that_another_page_has_changed_is_kept(client: httpx.Client) -> None:
    def put(document: dict[str, Any], revision: str | None) -> httpx.Response:
        return client.put("/drafts/shared", json={"document": document, "revision": revision})

    first = put({"walls": 1}, "").json()["revision"]
    second = put({"walls": 2}, first).json()["revision"]
    assert client.get("/drafts/shared").json()["revision"] == second
    for stale in (first, ""):
        refused = put({"walls": 3}, stale)
        assert refused.status_code == 412
        assert "was changed on another page" in refused.json()["error"]["message"]
    assert client.delete("/drafts/shared", params={"revision": first}).status_code == 412
    assert client.get("/drafts/shared").json()["document"] == {"walls": 2}
    assert client.delete("/drafts/shared", params={"revision": second}).status_code == 200
    assert put({"walls": 4}, second).status_code == 412
    assert put({"walls": 4}, None).status_code == 200
    client.delete("/drafts/shared")


def test_a_draft_is_kept_until_it_is_deleted(client: httpx.Client) -> None:
    unfinished: dict[str, Any] = {"map": {"grid": ["."]}}
    assert client.put("/drafts/new floor", json={"document": unfinished}).status_code == 200
    assert client.get("/drafts/new floor").json()["document"] == unfinished
    assert [each["name"] for each in client.get("/drafts").json()["drafts"]] == ["new floor"]
    assert client.delete("/drafts/new floor").status_code == 200
    assert client.get("/drafts/new floor").status_code == 404


def test_a_file_is_uploaded_once_unless_it_is_to_be_replaced(
    client: httpx.Client, folder: Path
) -> None:
    kind = {"content-type": "application/octet-stream"}
    path = "/files/dropped.map"
    assert client.put(path, content=b"one", headers=kind).status_code == 200
    assert client.put(path, content=b"two", headers=kind).status_code == 412
    replaced = client.put(path, content=b"two", headers=kind, params={"replace": True})
    assert replaced.status_code == 200
    assert client.get(path).content == (folder / "dropped.map").read_bytes() == b"two"


def test_the_list_of_files_has_no_hidden_file_and_no_link(client: httpx.Client) -> None:
    listed = {each["path"] for each in client.get("/files").json()["files"]}
    assert "door.yaml" in listed
    assert not listed & {".hidden.yaml", "link.yaml", "out/secret.yaml"}


def test_an_exported_plan_is_the_plan(client: httpx.Client, folder: Path, tmp_path: Path) -> None:
    del folder
    from tests.builders.studios import planned

    run = planned(client, planner="two-level")
    file = tmp_path / "plan.json"
    file.write_bytes(client.get(f"/runs/{run['number']}/export/json").content)
    assert dump_scenario(load_plan(file).scenario)["robots"][1]["work"] == 1


def test_a_fleet_is_dealt_over_places_that_reach_each_other(client: httpx.Client) -> None:
    """The last column cannot be reached, so five places are left for five robots."""
    document = {"map": {"grid": ["...@.", "..@@."]}}
    body = {"document": document, "robots": 5, "seed": 7, "speeds": [1, "1/2"], "work": [2, 3]}
    dealt = client.post("/deal", json=body).json()["robots"]
    assert client.post("/deal", json=body).json()["robots"] == dealt
    assert {robot["home"] for robot in dealt} == {"N0", "N1", "N2", "N5", "N6"}
    assert len({robot["target"] for robot in dealt}) == 5
    assert [robot["speed"] for robot in dealt] == [1, "1/2", 1, "1/2", 1]
    assert {robot["work"] for robot in dealt} <= {2, 3}
    scenario = {"format": "rightofway-scenario/1", **document, "robots": dealt}
    assert client.post("/validate", json={"document": scenario}).json()["faults"] == []


@pytest.mark.parametrize(
    ("wrong", "place"),
    [
        ({"robots": 6}, "robots"),
        ({"speeds": [0]}, "speeds"),
        ({"speeds": ["fast"]}, "speeds"),
        ({"work": [3, 2]}, "work"),
        ({"document": {"map": {"grid": ["?", ".."]}}}, "map.grid[1]"),
    ],
)
def test_a_fleet_that_cannot_be_dealt_is_refused(
    client: httpx.Client, wrong: dict[str, Any], place: str
) -> None:
    body = {"document": {"map": {"grid": ["...@.", "..@@."]}}, "robots": 5, **wrong}
    refused = client.post("/deal", json=body)
    assert refused.status_code == 422
    assert refused.json()["error"]["faults"][0]["place"] == place


def test_a_survey_has_the_faults_and_the_robots_without_one(client: httpx.Client) -> None:
    """R1 is at no place and has no target: both are said at once."""
    document = {**DOOR, "robots": [{"name": "R1", "home": "N99"}, *DOOR["robots"]]}
    found = client.post("/survey", json={"document": document}).json()
    assert not found["ok"]
    assert [fault["place"] for fault in found["faults"]] == ["robots[0].home", "robots[0]"]
    assert [robot["index"] for robot in found["site"]["robots"]] == [1, 2]


@pytest.mark.parametrize(
    "wrong", [{"speed": "abc"}, {"speed": 0}, {"target": "N99"}, {"work": -1}, {"colour": "red"}]
)
def test_a_robot_with_one_wrong_key_is_still_drawn_at_home(
    client: httpx.Client, wrong: dict[str, Any]
) -> None:
    first, second = DOOR["robots"]
    document = {**DOOR, "robots": [{**first, **wrong}, second]}
    found = client.post("/survey", json={"document": document}).json()
    assert not found["ok"]
    assert [robot["index"] for robot in found["site"]["robots"]] == [0, 1]


def test_a_survey_of_a_map_without_robots_has_the_map(client: httpx.Client) -> None:
    found = client.post("/survey", json={"document": {**DOOR, "robots": []}}).json()
    assert found["site"]["map"]["rows"] == DOOR["map"]["grid"]
    assert found["site"]["robots"] == []


def test_an_inlined_document_needs_no_other_file(client: httpx.Client, folder: Path) -> None:
    (folder / "door.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n")
    robots = [{"name": "R1", "home": "N0", "target": "N2"}]
    document = {"format": DOOR["format"], "map": {"file": "door.map"}, "robots": robots}
    found = client.post("/inline", json={"document": document}).json()["document"]
    assert found["map"]["grid"] == ["..."]
    assert found["robots"][0]["target"] == "N2"


def test_a_survey_without_inspection_has_the_map_and_no_findings(client: httpx.Client) -> None:
    request = {"document": DOOR, "inspects": False}
    found = client.post("/survey", json=request).json()
    assert found["ok"]
    assert len(found["site"]["robots"]) == 2
    assert found["findings"] == []
    assert client.post("/survey", json={"document": DOOR}).json()["findings"] != []


def test_every_example_is_a_document_that_names_no_other_file(client: httpx.Client) -> None:
    names = [each["name"] for each in client.get("/examples").json()["examples"]]
    cases = {f"paper/door-{case}" for case in range(1, 6)}
    cases |= {f"paper/cross-{case}" for case in range(1, 4)}
    assert {"door", "floor", "warehouse", *cases} <= set(names)
    for name in names:
        document = client.get(f"/examples/{name}").json()["document"]
        assert client.post("/validate", json={"document": document}).json()["ok"], name
    assert client.get("/examples/secret").status_code == 404


def test_a_glance_has_robots_extent_and_a_picture(client: httpx.Client) -> None:
    found = client.get("/glances/files/floor.yaml").json()
    about = {key: found[key] for key in ("kind", "robots", "extent", "unit")}
    assert about == {"kind": "scenario", "robots": 4, "extent": ["12", "8"], "unit": "m"}
    assert found["picture"].startswith("data:image/png;base64,")
    dark = client.get("/glances/files/floor.yaml", params={"dark": True}).json()
    assert dark["picture"] != found["picture"]


def test_a_glance_at_a_draft_without_robots_and_at_a_layout(
    client: httpx.Client, folder: Path
) -> None:
    client.put("/drafts/hall", json={"document": {**DOOR, "robots": []}})
    assert client.get("/glances/drafts/hall").json()["robots"] == 0
    (folder / "gate.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n")
    assert client.get("/glances/files/gate.map").json()["kind"] == "layout"
    (folder / "gate.map").unlink()


@pytest.mark.parametrize(
    "path",
    ["files/../secret.yaml", "files/link.yaml", "files/none.yaml", "drafts/no", "examples/x"],
)
def test_a_glance_at_nothing_is_refused(client: httpx.Client, path: str) -> None:
    assert client.get(f"/glances/{path}").status_code in {400, 403, 404}


def test_robots_are_dealt_out_between_stations(client: httpx.Client) -> None:
    roadmap = {
        "vertices": {"P": [0, 0], "A": [4, 0], "S": [8, 0], "T": [8, 4]},
        "edges": [["P", "A"], ["A", "S"], ["A", "T"]],
        "stations": {"Press": "S", "Oven": "T"},
        "parking": ["P"],
    }
    body = {"document": {"map": {"roadmap": roadmap}}, "robots": 2, "between": "stations"}
    robots = client.post("/deal", json=body).json()["robots"]
    assert [robot["home"] for robot in robots] == ["P", "A"]
    assert {robot["target"] for robot in robots} == {"S", "T"}
