"""The report on a layout, a map or a scenario, before anything is planned."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from tests.cli.conftest import EXAMPLES, Cli

LAYOUTS = Path(__file__).parents[1] / "data" / "layouts"

FLEET = """robots:
- {name: R1, home: dock, target: shelf, radius: 0.5}
"""


@pytest.mark.parametrize(
    ("name", "what"),
    [
        ("hall.lif.json", "a LIF layout with 4 vertices, 8 lanes and 1 station"),
        ("plant.xml", "an openTCS plant model with"),
        ("room.yaml", "a ROS map of"),
        ("two-rooms.map", "a MovingAI map of"),
        ("nodes.csv", "a CSV pair with"),
    ],
)
def test_every_format_is_inspected(cli: Cli, name: str, what: str) -> None:
    ended = cli("inspect", LAYOUTS / name)
    assert (ended.code, ended.err) == (0, "")
    assert what in " ".join(ended.out.split())


def test_places_of_another_graph_are_left_out_with_its_vertices(cli: Cli) -> None:
    """Robots of graph 0 reach neither the charger nor the parking place of graph 1."""
    Path("two.building.yaml").write_text(
        """
coordinate_system: cartesian_meters
levels:
  L1:
    vertices: [[0, 0, 0, a, {is_charger: [4, true]}], [9, 0, 0, b], [0, 9, 0, c],
               [5, 5, 0, d, {is_charger: [4, true]}],
               [6, 5, 0, e, {is_parking_spot: [4, true]}]]
    lanes: [[0, 1, {graph_idx: [2, 0]}], [1, 2, {graph_idx: [2, 0]}], [2, 0, {graph_idx: [2, 0]}],
            [3, 4, {graph_idx: [2, 1]}]]
""",
        encoding="utf-8",
    )
    ended = cli("inspect", "two.building.yaml")
    assert (ended.code, ended.err) == (0, "")
    assert "2 vertices left out: only lanes of other vehicle types lead there" in ended.out
    assert "3 vertices, 3 directed edges, 3 of them one-way, 9 x 9 m; 1 place." in ended.out


def test_json_has_notes_as_facts_with_all_pieces(cli: Cli) -> None:
    text = (LAYOUTS / "hall.lif.json").read_text("utf-8")
    Path("hall.lif.json").write_text(text.replace('"nodeId"', '"region": 1, "nodeId"'), "utf-8")
    data = json.loads(cli("inspect", "hall.lif.json", "--json").out)
    assert data["what"]["kind"] == "layout"
    notes = [note["values"] for note in data["notes"] if note["kind"] == "note on pieces"]
    typeless = {"kind": "edge without vehicle type", "values": {}}
    repeated = {"kind": "several times", "values": {"count": 2, "repair": typeless}}
    assert {"sentence": repeated, "names": ["P1-A", "A-P1"]} in notes
    said = cli("inspect", "hall.lif.json").out
    assert "4 times: region has no effect on plans: P1, A, B and C" in said


def test_all_examples_are_inspected(cli: Cli, door: Path) -> None:
    for path in sorted(EXAMPLES.glob("*.yaml")):
        assert cli("inspect", path).code == 0
    report = cli("inspect", door).out  # lines end where the path to the file lets them
    assert "a scenario of 2 robots on 3 x 3 cells" in " ".join(report.split())


def test_findings_have_places_in_json(cli: Cli) -> None:
    Path("nodes.csv").write_text("name,x,y\nA,0,0\nB,4,0\nC,4,4\n", encoding="utf-8")
    Path("edges.csv").write_text("from,to\nA,B\nB,A\nB,C\n", encoding="utf-8")
    data = json.loads(cli("inspect", "nodes.csv", "--json").out)
    (level,) = data["levels"]
    assert (level["vertices"], level["edges"], level["one_way"]) == (3, 3, 1)
    assert (level["parts"], level["units"]["length"]) == ([2, 1], "m")
    (finding,) = level["findings"]
    assert (finding["kind"], finding["severity"]) == ("trap", "warning")
    assert (finding["vertices"], finding["robots"]) == (["C"], [])
    place = {"kind": "places", "values": {"places": ["C"]}}
    assert finding["fact"] == {"kind": "no way out", "values": {"places": place}}
    assert finding["remedy"] == {"kind": "add a lane back", "values": {"number": 1}}
    assert finding["sentence"].startswith("C can be entered and not left again (add")


def test_a_site_without_findings_says_so(cli: Cli) -> None:
    Path("open.map").write_text("type octile\nheight 2\nwidth 2\nmap\n..\n..\n", encoding="utf-8")
    assert cli("inspect", "open.map").out.endswith("No problems found.\n")


def test_a_scenario_may_come_from_standard_input(
    cli: Cli, door: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = io.TextIOWrapper(io.BytesIO(door.read_bytes()), encoding="utf-8")
    monkeypatch.setattr("sys.stdin", text)
    assert "a scenario of 2 robots on 3 x 3 cells" in cli("inspect", "-").out


def test_a_workbook_has_robots_of_its_own(cli: Cli) -> None:
    cli("new", "hall.xlsx")
    ended = cli("inspect", "hall.xlsx", "--robots", "fleet.csv")
    assert (ended.code, "hall.xlsx: has robots of its own (give" in ended.err) == (2, True)


@pytest.mark.parametrize("name", ["fleet.yaml", "fleet.csv"])
def test_a_fleet_is_judged_on_a_layout(cli: Cli, name: str) -> None:
    Path("fleet.yaml").write_text(FLEET, encoding="utf-8")
    Path("fleet.csv").write_text("name,home,target,radius\nR1,dock,shelf,0.5\n", encoding="utf-8")
    data = json.loads(cli("inspect", LAYOUTS / "nodes.csv", "--robots", name, "--json").out)
    assert data["levels"][0]["places"] == 2


def test_a_fleet_is_judged_on_the_map_of_a_scenario(cli: Cli, door: Path) -> None:
    Path("fleet.yaml").write_text("- {name: R9, home: N0, target: N8}\n", encoding="utf-8")
    ended = cli("inspect", door, "--robots", "fleet.yaml")
    assert "a scenario of 1 robot on 3 x 3 cells" in " ".join(ended.out.split())


def test_robots_at_unknown_places_are_named_with_their_line(cli: Cli) -> None:
    Path("fleet.yaml").write_text(FLEET.replace("dock", "dokc"), encoding="utf-8")
    ended = cli("inspect", LAYOUTS / "nodes.csv", "--robots", "fleet.yaml")
    assert ended.code == 2
    assert ended.err == (
        "fleet.yaml:2: robots[0] (R1): home: no vertex is named 'dokc' (did you mean 'dock'?)\n"
    )


def test_long_lists_are_cut_and_counted(cli: Cli) -> None:
    rows = ["".join(".@"[(row + column) % 2] for column in range(6)) for row in range(6)]
    Path("dots.map").write_text(
        "type octile\nheight 6\nwidth 6\nmap\n" + "\n".join(rows) + "\n", encoding="utf-8"
    )
    out = cli("inspect", "dots.map", "--limit", "2").out
    assert "Notes: 17\n" in out
    assert "  and 15 more: cut off (see --limit)\n" in out


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (
            [LAYOUTS / "hall.lif.json", "--level", "9"],
            "hall.lif.json: level: no level is named '9'",
        ),
        ([LAYOUTS / "hall.lif.json", "--cell-size", "1"], "a layout of lanes, which has no cells"),
        (["nowhere.json"], "there is no such file"),
        (["door", "--level", "0"], "level is for layouts, and this is none (leave it out)"),
        (["door", "--cell-size", "0"], "'0' is no length (give metres, like 0.5)"),
    ],
)
def test_wrong_input_is_refused_with_a_remedy(
    cli: Cli, door: Path, args: list[str | Path], message: str
) -> None:
    ended = cli("inspect", *(door if arg == "door" else arg for arg in args))
    assert (ended.code, message in ended.err) == (2, True)


def test_the_report_is_written_and_shown_on_a_page(cli: Cli) -> None:
    ended = cli("inspect", LAYOUTS / "plant.xml", "-o", "report.txt", "--page", "plant.html")
    assert (ended.code, ended.out) == (0, "")
    report = Path("report.txt").read_text(encoding="utf-8")
    assert report == cli("inspect", LAYOUTS / "plant.xml").out
    assert "an openTCS plant model" in Path("plant.html").read_text(encoding="utf-8")


def test_a_report_that_ends_in_json_is_that_of_programs(cli: Cli) -> None:
    ended = cli("inspect", LAYOUTS / "plant.xml", "-o", "report.json")
    assert (ended.code, ended.out) == (0, "")
    written = Path("report.json").read_text(encoding="utf-8")
    assert written == cli("inspect", LAYOUTS / "plant.xml", "--json").out


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["-o", "report.pdf"], "does not end in .json or .txt"),
        (["--page", "report.json"], "does not end in .html or .htm"),
        (["-o", "-", "--json"], "both go to standard output"),
    ],
)
def test_outputs_that_do_not_fit_are_refused(cli: Cli, options: list[str], message: str) -> None:
    ended = cli("inspect", LAYOUTS / "plant.xml", *options)
    assert ended.code == 2
    assert message in ended.err


SITE = """format: rightofway-scenario/1
map: {grid: [".....", "@@.@@"]}
robots:
- {name: R1, home: N0}
- {name: R2, home: N2}
"""


def test_jobs_of_a_file_are_inspected(cli: Cli) -> None:
    """R1 does not pass R2, which stays at home in the middle of the row."""
    Path("site.yaml").write_text(SITE, encoding="utf-8")
    Path("jobs.csv").write_text("name,at,robot\nJ1,N4,R1\nJ2,N1,R1\n", encoding="utf-8")
    ended = cli("inspect", "site.yaml", "--jobs", "jobs.csv")
    words = " ".join(ended.out.split())
    assert "R1 has a way to N4 (stop of J1) for J1 and back home only through homes" in words
    assert "for J2" not in words
    data = json.loads(cli("inspect", "site.yaml", "--jobs", "jobs.csv", "--json").out)
    (level,) = data["levels"]
    assert level["well_formed"] is False
    (finding,) = [each for each in level["findings"] if each["kind"] == "job"]
    values = {"job": "J1", "robot": "R1", "place": "N4"}
    assert finding["fact"] == {"kind": "job through homes", "values": values}
    Path("near.csv").write_text("name,at\nJ1,N1\n", encoding="utf-8")
    assert "The fleet is well formed" in cli("inspect", "site.yaml", "--jobs", "near.csv").out


def test_jobs_are_inspected_on_a_layout_with_the_robots_of_a_file(cli: Cli) -> None:
    fleet = "robots:\n- {name: R1, home: P1}\njobs:\n- {name: J1, at: A, robot: R1}\n"
    Path("fleet.yaml").write_text(fleet, encoding="utf-8")
    Path("jobs.json").write_text('[{"name": "J2", "at": "A", "load": 2}]', encoding="utf-8")
    layout = LAYOUTS / "hall.lif.json"
    assert cli("inspect", layout, "--robots", "fleet.yaml").code == 0
    wrong = cli("inspect", layout, "--robots", "fleet.yaml", "--jobs", "jobs.json")
    assert "jobs.json" in wrong.err
    alone = cli("inspect", layout, "--jobs", "jobs.json")
    assert "jobs: has no robots to do them (give --robots, too)" in alone.err
