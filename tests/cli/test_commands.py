"""The commands as a user meets them: results, messages, files."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path

import pytest
from PIL import Image

from rightofway.cli.main import commands
from tests.cli.conftest import EXAMPLES, SWAP, Cli

DATA = Path(__file__).parents[1] / "data"

STUCK = """format: rightofway-scenario/1
map: {grid: ["...."]}
robots:
  - {name: R1, home: N0, target: N3}
  - {name: R2, home: N3, target: N0}
"""

BEHIND = """format: rightofway-scenario/1
map: {grid: ["........"]}
robots:
  - {name: R1, home: N3, target: N7, speed: 1/2}
  - {name: R2, home: N1, target: N6}
rules: {return: none}
"""


def test_a_plan_is_summed_up_in_80_columns(cli: Cli, door: Path) -> None:
    ended = cli("plan", door)
    assert ended.code == 0
    assert re.search(r"^planner    auto, planned in \d\.\d+ s; optimal, no", ended.out)
    assert "flowtime   19 time units, the least possible" in ended.out
    assert "lost time  1 time unit: waiting 1 time unit" in ended.out
    assert "At time 0, R1 waits 1 time unit in N0 for R2 to leave N1." in ended.out
    assert max(map(len, ended.out.splitlines())) <= 80


def test_lost_time_is_left_out_where_it_would_end_too_late(
    cli: Cli, door: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At 3 s for each visit, even a plan of two visits would be reported on 3.5 s too late."""
    monkeypatch.setattr("rightofway.cli.planning.SECONDS_PER_VISIT", 3)
    late = "lost time  not computed, because the time limit is over"
    assert late in cli("plan", door, "--time-limit", "2").out
    assert late not in cli("plan", door, "--time-limit", "inf").out


def test_json_and_page_show_the_robots_that_block_each_other(cli: Cli) -> None:
    Path("stuck.yaml").write_text(STUCK, encoding="utf-8")
    ended = cli("plan", "stuck.yaml", "--json", "--page", "stuck.html")
    reason = (
        "R1 and R2 block each other: both have to pass N0, N1, N2 and N3 (give more room there)"
    )
    assert ended.code == 1
    assert ended.err.splitlines() == [
        "wrote stuck.html (it shows where robots are blocked)",
        f"no plan exists: {reason}",
    ]
    found = json.loads(ended.out)["no_plan"]
    assert found["robots"] == ["R1", "R2"]
    assert found["vertices"] == ["N0", "N1", "N2", "N3"]
    assert '"noPlan":true' in Path("stuck.html").read_text(encoding="utf-8")


def test_the_log_says_which_level_decided_and_by_which_numbers(cli: Cli, door: Path) -> None:
    ended = cli("plan", door, "--log")
    words = " ".join(ended.out.split())
    assert "R1 and R2 go the same way from N1 to N7 and cannot overtake." in words
    assert "R1 waits 1 time unit in N0 and lets R2 go first." in words
    assert "Robot level: either choice leaves as many conflicts in the whole system" in words
    assert "Then R1 waits by rule. Conflicts left: 0 if R1 waits, 0 if R2 waits." in words


def test_the_log_says_who_goes_first_by_priority(cli: Cli, door: Path) -> None:
    ended = cli("plan", door, "--log", "--planner", "fixed-priority")
    words = " ".join(ended.out.split())
    assert "R2 waits because R1 has the higher priority." in words


def test_the_table_stands_under_the_summary(cli: Cli, door: Path) -> None:
    assert (
        "R1 final     0=  0   1   4   7   6   6   7   4   1   0" in cli("plan", door, "--table").out
    )


def test_the_log_tells_a_robot_that_follows_another_once(cli: Cli) -> None:
    """R2 is twice as fast as R1 before it, and would meet it in N4, N5 and N6."""
    Path("behind.yaml").write_text(BEHIND, encoding="utf-8")
    ended = cli("plan", "behind.yaml", "--log")
    words = " ".join(ended.out.split())
    assert words.count("cannot overtake") == 1
    assert (
        "At time 3: R1 and R2 go the same way from N3 to N6 and cannot overtake. R2 gives way in"
        " N2, at no loss, and lets R1 go first. R1 cannot wait here: with the decisions taken"
        " before, no plan is possible then. Conflicts left: impossible if R1 waits, 0 if R2 waits."
    ) in words


def test_the_summary_for_programs_has_the_numbers_of_the_one_for_people(
    cli: Cli, door: Path
) -> None:
    text = cli("plan", door).out
    data = json.loads(cli("plan", door, "--json").out)
    metrics = data["metrics"]
    assert f"flowtime   {metrics['flowtime']} time units, the least possible" in text
    assert f"makespan   {metrics['makespan']} time units" in text
    planner = data["planner"]
    assert 0 < planner.pop("first_plan_seconds") <= planner.pop("seconds") < 10
    assert planner == {
        "name": "auto", "seed": 0,
        "options": {"objective": "flowtime", "swaps": "resolve", "iterations": 0, "nodes": 1000},
        "status": {
            "kind": "proven by search",
            "counts": {
                "nodes": 0,
                "status": {
                    "kind": "by planner",
                    "counts": {
                        "planner": "two-level",
                        "status": {"kind": "waits only", "counts": {}},
                    },
                },
            },
        },
        "outcome": {"kind": "optimal", "objective": "flowtime", "bound": 19},
        "forced_losses": [{"robots": ["R1", "R2"], "ticks": 1, "vertex": "N1"}],
    }  # fmt: skip
    assert data["metrics"]["flowtime"] == 19
    assert (data["tick"], data["units"]) == (1, {"length": None, "time": None})
    (loss,) = data["robots"][0].pop("losses")
    assert data["robots"][0] == {
        "name": "R1", "completion": 10, "alone": 9, "detours": 0, "making_room": 0, "waiting": 1
    }  # fmt: skip
    assert loss == {
        "kind": "waits", "robot": "R1", "for_robot": "R2", "vertex": "N0", "until_vertex": "N0",
        "towards": "N1", "freed": "N1", "tick": 0, "end": 1, "ticks": 1, "count": 1,
    }  # fmt: skip
    assert data["waits"] == [{"robot": "R1", "vertex": "N0", "tick": 0, "ticks": 1, "for": "R2"}]


def test_a_plan_goes_to_a_file_or_to_standard_output_and_only_there(cli: Cli, door: Path) -> None:
    cli("plan", door, "-o", "plan.json")
    ended = cli("plan", door, "-o", "-")
    assert ended.out == Path("plan.json").read_text(encoding="utf-8")
    assert json.loads(ended.out)["format"] == "rightofway-plan/1"
    assert ended.err == ""


@pytest.mark.parametrize(
    "example",
    ["door", "crossroad", "floor", "jobs", pytest.param("warehouse", marks=pytest.mark.slow)],
)
def test_every_example_is_planned_checked_and_shown(cli: Cli, example: str) -> None:
    path = EXAMPLES / f"{example}.yaml"
    assert cli("plan", path, "-o", "plan.json", "--page", "page.html").code == 0
    ended = cli("check", "plan.json")
    assert (ended.code, "no fault" in ended.out) == (0, True)
    assert Path("page.html").read_text(encoding="utf-8").startswith("<!doctype html>")


@pytest.mark.parametrize(
    "more", [["--planner", "two-level"], ["--option", "iterations=500", "--option", "nodes=20"]]
)
def test_the_same_input_gives_the_same_bytes(cli: Cli, more: list[str]) -> None:
    for name in ("a", "b"):
        written = ["-o", f"{name}.json", "--page", f"{name}.html", "--time-limit", "100"]
        cli("plan", EXAMPLES / "warehouse.yaml", *written, *more)
    for suffix in (".json", ".html"):
        assert Path(f"a{suffix}").read_bytes() == Path(f"b{suffix}").read_bytes()


def test_swaps_that_were_left_in_are_told_and_the_plan_is_written(cli: Cli) -> None:
    Path("swap.yaml").write_text(SWAP, encoding="utf-8")
    ended = cli("plan", "swap.yaml", "-o", "plan.json", "--option", "swaps=leave")
    assert ended.code == 1
    assert "the plan still has 1 fault: 1 swap conflict" in ended.err
    report = cli("check", "plan.json", "--json")
    assert report.code == 1
    fault = json.loads(report.out)["faults"][0]
    assert (fault["kind"], fault["robots"], fault["tick"]) == ("swap conflict", ["R1", "R2"], 7)
    assert cli("check", "plan.json", "--limit", "0").out.splitlines() == [
        "plan.json: 1 fault: 1 swap conflict",
        "and 1 more (raise the limit to list them)",
    ]


def test_what_is_impossible_ends_with_1_and_leaves_files_alone(cli: Cli) -> None:
    Path("stuck.yaml").write_text(STUCK, encoding="utf-8")
    Path("plan.json").write_text("precious", encoding="utf-8")
    ended = cli("plan", "stuck.yaml", "-o", "plan.json")
    assert (ended.code, ended.out) == (1, "")
    assert ended.err.startswith("no plan exists: ")
    assert Path("plan.json").read_text(encoding="utf-8") == "precious"


def test_time_that_runs_out_ends_with_3(cli: Cli) -> None:
    ended = cli("plan", EXAMPLES / "warehouse.yaml", "--time-limit", "0.000001")
    assert ended.code == 3
    assert "time ran out" in ended.err
    assert "give a longer time limit" in ended.err


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["plan", "nowhere.yaml"], "nowhere.yaml: there is no such file"),
        (["plan", EXAMPLES], "this is a directory"),
        (["plan", EXAMPLES / "door.yaml", "--planner", "twolevel"], "did you mean 'two-level'?"),
        (["plan", EXAMPLES / "door.yaml", "--planner", "CBS"], "did you mean 'cbs'?"),
        (["plan", EXAMPLES / "door.yaml", "--option", "swap=leave"], "did you mean 'swaps'?"),
        (["plan", EXAMPLES / "door.yaml", "--option", "swaps"], "'swaps' is not name=value"),
        (["plan", EXAMPLES / "door.yaml", "--time-limit", "0"], "0 is not positive (give"),
        (["plan", "nowhere.yaml", "--time-limit", "soon"], "'soon' is not a number (give seconds"),
        (
            ["plan", "nowhere.yaml", "--seed", "x"],
            "'x' does not fit (give a whole number from 0 to",
        ),
        (["plan", "nowhere.yaml", "-k", "0"], "0 does not fit (give a whole number of 1 or more)"),
        (["paper", "12"], "12 does not fit (give a whole number from 1 to 11)"),
        (["plan", EXAMPLES / "door.yaml", "--time-limit", "nan"], "nan is not positive (give"),
        (["plan", "nowhere.yaml", "-o", "no/plan.json"], "there is no directory 'no'"),
        (["plan", "nowhere.yaml", "-o", "."], "'.' is a directory"),
        (["improve", "nowhere.json", "-o", "./nowhere.json"], "would replace nowhere.json"),
        (["plan", "nowhere.yaml", "--page", "page.png"], "'page.png' does not end in .html or"),
        (["plan", "nowhere.yaml", "-o", "-", "--log"], "--log and -o - both go to standard output"),
        (["plan", "nowhere.yaml", "-o", "-", "--json"], "--json and -o - both go to"),
        (["plan", "nowhere.yaml", "--json", "--table"], "--table is for people, --json for"),
        (
            ["show", "nowhere.yaml", "-o", "a.gif", "--tick", "3"],
            "--at and --tick are",
        ),
        (["show", "nowhere.yaml", "-o", "a.png", "--tick", "3", "--at", "3"], "choose one"),
        (["show", "nowhere.yaml", "-o", "a.gif", "--background", "b.png"], "is for pages (give"),
        (["show", "nowhere.yaml", "--page", "a.html", "--background-scale", "2"], "needs --back"),
        (["plan", EXAMPLES / "door.yaml", "--page", "no/page.html"], "no/page.html"),
        (["show", EXAMPLES / "door.yaml", "-o", "door.jpg"], "'door.jpg' does not end in .html,"),
        (["table", EXAMPLES / "door.yaml"], "is a scenario, not a plan (plan it first)"),
        (["schema", "robot"], "'robot' is not one of"),
        (["plot"], "No such command 'plot'"),
    ],
)
def test_bad_use_ends_with_2_and_one_message(cli: Cli, args: list[object], message: str) -> None:
    ended = cli(*args)
    assert ended.code == 2
    assert message in ended.err
    assert "Traceback" not in ended.err
    assert ended.out == ""
    assert list(Path.cwd().iterdir()) == []


def test_every_fault_of_a_scenario_is_told_with_its_file(cli: Cli) -> None:
    Path("bad.yaml").write_text(
        STUCK.replace("home: N3", "home: N9").replace("target: N3", "target: N3, speed: 0"),
        encoding="utf-8",
    )
    lines = cli("plan", "bad.yaml").err.splitlines()
    assert len(lines) == 2
    assert lines[0].startswith("bad.yaml:4: robots[0] (R1): speed: 0 is not positive")
    assert lines[1].startswith("bad.yaml:5: robots[1] (R2): home: ")


def test_show_puts_plans_on_one_page(cli: Cli, door: Path) -> None:
    for name in ("A.json", "B.json", "C.json"):
        cli("plan", door, "-o", name)
    assert cli("show", "A.json", "B.json", "C.json", "--page", "both.html").code == 0
    page = Path("both.html").read_text(encoding="utf-8")
    assert "<title>A.json: 2 robots</title>" in page
    assert '"others":[{"title":"B.json"' in page
    assert '{"title":"C.json"' in page
    refused = cli("show", "A.json", "B.json", "-o", "both.png")
    assert refused.code == 2
    assert "plans are compared on a page (give --page FILE)" in refused.err
    refused = cli("show", "A.json", *["B.json"] * 8, "--page", "many.html")
    assert refused.code == 2
    assert "9 plans are too many to compare (give at most 8)" in refused.err


def test_show_lays_a_picture_under_the_map_of_the_page(cli: Cli, door: Path) -> None:
    cli("show", door, "-o", "hall.png")
    options = ("--background", "hall.png", "--background-scale", "0.01")
    assert cli("show", door, "--page", "a.html", *options).code == 0
    assert '"href":"data:image/png;base64,' in Path("a.html").read_text("utf-8")


def test_show_puts_a_ros_map_where_its_file_says(cli: Cli, door: Path) -> None:
    Image.new("L", (60, 60), 255).save("hall.pgm")
    Path("hall.yaml").write_text(
        "image: hall.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.2\n"
    )
    ended = cli("show", door, "--page", "a.html", "--background", "hall.yaml")
    assert ended.code == 0
    assert '"href":"data:image/png;base64,' in Path("a.html").read_text("utf-8")
    scaled = cli(
        "show", door, "--page", "a.html", "--background", "hall.yaml", "--background-scale", "1"
    )
    assert (scaled.code, "hall.yaml says its own scale" in scaled.err) == (2, True)


def test_a_layout_without_a_picture_is_no_background(cli: Cli, door: Path) -> None:
    Path("nav.yaml").write_text(
        "levels:\n  L1:\n    vertices: [[0, 0, {name: a}], [1, 0, {name: b}]]\n"
        "    lanes: [[0, 1, {}]]\n"
    )
    ended = cli("show", door, "--page", "a.html", "--background", "nav.yaml")
    assert ended.code == 2
    assert "nav.yaml: names 0 pictures (give a ROS map, or a building of one level)" in ended.err


def test_show_makes_pictures_and_films_of_scenarios_and_plans(cli: Cli, door: Path) -> None:
    cli("plan", door, "-o", "plan.json")
    assert cli("show", "plan.json", "-o", "a.png", "--at", "3").code == 0
    ended = cli("show", door, "-o", "a.gif")
    assert "auto, planned in " in ended.err
    assert Path("a.png").read_bytes().startswith(b"\x89PNG")
    assert Path("a.gif").read_bytes().startswith(b"GIF89a")


def test_a_table_goes_to_csv_and_xlsx(cli: Cli, door: Path) -> None:
    cli("plan", door, "-o", "plan.json")
    assert cli("table", "plan.json", "-o", "t.csv", "--robots", "R2", "--to", "3").code == 0
    with Path("t.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    assert [row[2:] for row in rows[1:] if "marks" not in row[1]] == [["2", "1", "4", "7"]] * 2
    assert cli("table", "plan.json", "-o", "t.xlsx").code == 0
    assert Path("t.xlsx").read_bytes().startswith(b"PK")


def test_a_table_for_programs_has_a_run_for_each_stretch_of_equal_cells(
    cli: Cli, door: Path
) -> None:
    cli("plan", door, "-o", "plan.json")
    data = json.loads(cli("table", "plan.json", "--json", "--robots", "R1", "--to", "2").out)
    assert (data["first_tick"], data["last_tick"], data["tick"]) == (0, 2, 1)
    assert data["rows"][1] == {
        "robot": "R1",
        "kind": "final",
        "runs": [
            {"start": 0, "end": 1, "place": 0, "mark": "wait"},
            {"start": 1, "end": 2, "place": 0, "mark": None},
            {"start": 2, "end": 3, "place": 1, "mark": None},
        ],
    }


def test_convert_there_and_back_keeps_the_scenario(cli: Cli, door: Path) -> None:
    cli("convert", door, "door.json")
    cli("convert", "door.json", "again.yaml")
    cli("convert", "again.yaml", "twice.json")
    assert Path("door.json").read_bytes() == Path("twice.json").read_bytes()


def test_convert_writes_a_plan_for_a_program_on_the_site(cli: Cli, door: Path) -> None:
    assert cli("plan", str(door), "-o", "plan.json").code == 0
    done = cli("convert", "plan.json", "--to", "nav2", "-o", "paths.json")
    assert done.code == 0
    assert set(json.loads(Path("paths.json").read_text("utf-8"))["robots"]) == {"R1", "R2"}
    assert "paths.json: y is negated" in done.err


def test_convert_names_what_was_mended_and_which_part_of_a_layout_was_chosen(cli: Cli) -> None:
    layouts = Path(__file__).parents[1] / "data" / "layouts"
    done = cli("convert", layouts / "hall.lif.json", "-o", "hall.yaml")
    notes = [line.partition("hall.lif.json: ")[2] for line in done.err.splitlines()]
    chosen = "the map has the lanes of vehicle type tugger, which has the most (1 other type)"
    assert chosen in notes
    planned = cli("plan", "hall.yaml", "--planner", "prioritized").err.splitlines()
    for note in notes[notes.index(chosen) + 1 :]:
        assert f"hall.yaml: {note}" in planned
    done = cli("convert", layouts / "hall.nav.yaml", "-o", "-")
    assert "the map is level L1, which has the most lanes (1 other level)" in done.err


def test_convert_writes_robots_with_a_radius_for_a_layout(cli: Cli) -> None:
    Path("nodes.csv").write_text("name,x,y\na,0,0\nb,5,0\n", encoding="utf-8")
    Path("edges.csv").write_text("from,to,both_ways\na,b,yes\n", encoding="utf-8")
    done = cli("convert", "nodes.csv", "--radius", "0.3", "-o", "-")
    assert (done.code, done.out.splitlines()[-1]) == (
        0,
        "- {name: R1, home: a, target: b, work: 10, radius: 3/10}",
    )
    assert (
        "'wide' is not a number" in cli("convert", "nodes.csv", "--radius", "wide", "-o", "-").err
    )
    lif = cli("convert", "nodes.csv", "--radius", "1", "--to", "lif", "-o", "-")
    assert "--radius is for a scenario" in lif.err


@pytest.mark.parametrize(
    ("ending", "begins"),
    [(".geojson", '{"type": "FeatureCollection"'), (".graphml", "<?xml"), (".lif.json", "{")],
)
def test_convert_writes_a_layout_in_the_format_of_its_ending(
    cli: Cli, ending: str, begins: str
) -> None:
    """The content is that of --to; a file that ends in .json only is a scenario."""
    source = DATA / "layouts" / "hall.lif.json"
    name = {".geojson": "nav2", ".graphml": "graphml", ".lif.json": "lif"}[ending]
    assert cli("convert", source, "-o", f"site{ending}").code == 0
    assert cli("convert", source, "--to", name, "-o", "other.txt").code == 0
    written = Path(f"site{ending}").read_text("utf-8")
    assert written == Path("other.txt").read_text("utf-8")
    assert " ".join(written.split()).replace("{ ", "{").startswith(begins)
    assert cli("convert", source, "-o", "site.json").code == 0
    assert "rightofway-scenario/1" in Path("site.json").read_text("utf-8")


def test_convert_writes_no_scenario_to_an_ending_of_layouts(cli: Cli, door: Path) -> None:
    done = cli("convert", door, "-o", "door.geojson")
    assert done.code == 2
    assert f"'door.geojson' ends as layouts do, and {door} is none" in " ".join(done.err.split())


def test_a_plan_of_another_program_and_an_own_one_are_shown_and_checked_together(cli: Cli) -> None:
    """The map and the .scen file are for the other one; own plans hold theirs."""
    folder = DATA / "bad"
    files = ("--map", folder / "hall.map", "--scen", "own.scen")
    row = "0\thall.map\t3\t2\t0\t0\t1\t0\t1\n"
    Path("own.scen").write_text(f"version 1\n{row}", encoding="utf-8")
    Path("paths.txt").write_text("Agent 0: (0,0)->(0,1)->\n", encoding="utf-8")
    assert cli("convert", "paths.txt", *files, "-o", "own.json").code == 0
    for plans in (("paths.txt", "own.json"), ("own.json", "paths.txt")):
        shown = cli("show", *plans, *files, "--page", "both.html")
        assert (shown.code, shown.err.splitlines()[-1]) == (0, "wrote both.html")
        checked = cli("check", *plans, *files)
        assert (checked.code, checked.out.count("no fault in 1 robot")) == (0, 2)
    alone = cli("check", "own.json", "own.json", *files)
    assert "leave out --map and --scen" in " ".join(alone.err.split())


def test_convert_refuses_an_unknown_format_before_it_asks_for_a_file(cli: Cli) -> None:
    done = cli("convert", "plan.json", "--to", "event")
    assert (done.code, done.out) == (2, "")
    assert "'event' is no format (did you mean events?)" in done.err


def test_convert_to_a_scen_names_what_it_leaves_out(cli: Cli, door: Path) -> None:
    ended = cli("convert", door, "door.scen")
    assert ended.code == 0
    assert "ways back and laps are left out" in ended.err
    assert Path("door.map").read_text(encoding="utf-8").startswith("type octile\nheight 3")
    assert cli("plan", "door.scen").code == 0


def test_convert_to_a_scen_names_the_file_that_cannot_hold_it(cli: Cli) -> None:
    ended = cli("convert", EXAMPLES / "floor.yaml", "floor.scen")
    assert ended.code == 2
    assert "floor.scen: robots[1].stops: 2 stops" in ended.err
    assert list(Path.cwd().iterdir()) == []


@pytest.mark.parametrize("name", sorted(commands.commands))
def test_every_command_has_help_with_an_example(cli: Cli, name: str) -> None:
    ended = cli(name, "--help")
    assert ended.code == 0
    assert f"rightofway {name} " in ended.out.split("Example")[1]
    assert max(map(len, ended.out.splitlines())) <= 80


def test_help_lists_the_planners_with_their_options(cli: Cli) -> None:
    words = " ".join(cli("plan", "--help").out.split())
    assert "two-level The paper's method, swaps resolved" in words
    assert "swaps=resolve|leave Keep robots that meet head-on apart" in words


def test_a_plan_is_improved_and_the_page_of_planners_lists_only_those_that_can(cli: Cli) -> None:
    Path("scenario.yaml").write_text(BEHIND, encoding="utf-8")
    cli("plan", "scenario.yaml", "-o", "plan.json")
    ended = cli("improve", "plan.json", "--planner", "local-search", "-o", "better.json")
    assert (ended.code, ended.err) == (0, "wrote better.json\n")
    assert re.search(r"^planner    local-search, planned in [\d.]+ s; attempts to", ended.out)
    assert cli("check", "better.json").code == 0
    assert "two-level" not in cli("improve", "--help").out.partition("Planners and")[2]


def test_a_plan_is_not_replaced_by_its_improvement(cli: Cli, door: Path) -> None:
    cli("plan", door, "-o", "plan.json")
    ended = cli("improve", "plan.json", "-o", "plan.json")
    assert (ended.code, "would replace plan.json" in ended.err) == (2, True)


def test_a_workbook_of_a_floor_says_that_names_of_obstacles_are_left_out(cli: Cli) -> None:
    cli("examples", "floor", "-o", "floor.yaml")
    ended = cli("convert", "floor.yaml", "-o", "floor.xlsx")
    assert ended.code == 0
    assert "floor.xlsx: the names of obstacles are left out" in ended.err
    assert "names of obstacles" not in cli("convert", "floor.yaml", "-o", "floor.json").err


def test_the_jobs_of_a_file_are_planned(cli: Cli) -> None:
    site = "format: rightofway-scenario/1\nmap: {grid: [...]}\nrobots: [{name: R1, home: N0}]\n"
    Path("site.yaml").write_text(site, encoding="utf-8")
    orders = '{"T1": {"destinations": [{"locationName": "N2", "operation": "NOP"}]}}'
    Path("orders.json").write_text(orders, encoding="utf-8")
    ended = cli("plan", "site.yaml", "--jobs", "orders.json", "-o", "plan.json")
    assert (ended.code, ended.err) == (0, "wrote plan.json\n")
    assert "1 of 1 done" in ended.out
    assert cli("check", "plan.json").code == 0
    wrong = cli("plan", "site.yaml", "--jobs", "nothing.csv")
    assert wrong.code == 2
    assert "nothing.csv: there is no such file (check the path)" in wrong.err


def test_stops_that_the_league_does_not_count_are_counted_when_a_plan_is_written_for_it(
    cli: Cli,
) -> None:
    """Both jobs are at N2, where the robot stays for an instant only; a step counts one errand."""
    site = (
        "format: rightofway-scenario/1\nmap: {grid: [....]}\n"
        "robots: [{name: R1, home: N0, start: {at: N0, heading: 0}}]\n"
        "jobs: [{name: J1, at: N2}, {name: J2, at: N2, after: [J1]}, {name: J3, at: N3}]\n"
        "rules: {turn: 0, turn_rate: 90, return: none}\n"
    )
    Path("site.yaml").write_text(site, encoding="utf-8")
    assert cli("plan", "site.yaml", "-o", "plan.json").code == 0
    ended = cli("convert", "plan.json", "--to", "planviz", "-o", "result.json")
    assert ended.code == 0
    words = "stops that are not finished there: 2, because the League counts one errand of an"
    assert words in ended.err
    assert "work, turning and ways back are left out" not in ended.err


def test_what_robots_have_done_in_a_shift_is_written_for_other_programs(cli: Cli) -> None:
    site = (
        "format: rightofway-scenario/1\nmap: {grid: [....]}\n"
        "robots: [{name: R1, home: N0, start: {at: N0, heading: 0}}]\n"
        "jobs: [{name: J1, at: N2}]\nrules: {turn: 0, turn_rate: 90, return: none}\n"
    )
    Path("site.yaml").write_text(site, encoding="utf-8")
    assert cli("shift", "site.yaml", "--lead", "0", "--round-time", "0.1", "-o", "s.json").code == 0
    ended = cli("convert", "s.json", "--to", "planviz", "-o", "result.json")
    assert (ended.code, ended.err) == (0, "wrote result.json\n")
    result = json.loads(Path("result.json").read_text("utf-8"))
    assert (result["actualPaths"], result["numTaskFinished"]) == (["F,F"], 1)
    assert cli("convert", "s.json", "plan.json").code == 0
    assert cli("check", "plan.json").code == 0
