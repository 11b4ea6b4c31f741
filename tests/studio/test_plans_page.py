"""Plans on the page of the studio: begun, stopped, named, compared, exported, asked."""

from __future__ import annotations

import json
import random
import re
import shlex
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urljoin

import openpyxl  # type: ignore[import-untyped]  # it ships no types
from PIL import Image

from rightofway import load_plan
from rightofway.io.yaml_text import parse_yaml
from rightofway.languages import find_text
from tests.builders.browsers import Viewer, expect, needs_browser
from tests.builders.drawing import Opener, StudioPage, begin, nameless
from tests.builders.studios import BAY
from tests.studio.conftest import EXAMPLES

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.builders.studios import Client

pytestmark = needs_browser

PARTS = """\
format: rightofway-scenario/1
map: {grid: [".@.", ".@."]}
robots: [{name: R1, home: N0, target: N2}]
"""

WIDTH, HEIGHT, WALLS, DOOR = 24, 14, (8, 16), 4


def crowd() -> str:
    """Return thirty robots in three rooms with two doors: nobody plans that to the optimum."""
    rows = ["".join("@" if x in WALLS and y != DOOR else "." for x in range(WIDTH))
            for y in range(HEIGHT)]  # fmt: skip
    free = [y * WIDTH + x for y in range(HEIGHT) for x in range(WIDTH) if rows[y][x] == "."]
    places = random.Random(3).sample(free, 60)  # noqa: S311
    robots = [
        {"name": f"R{i}", "home": f"N{home}", "target": f"N{target}", "work": 3}
        for i, (home, target) in enumerate(zip(places[::2], places[1::2], strict=True), 1)
    ]
    return json.dumps({"format": "rightofway-scenario/1", "map": {"grid": rows}, "robots": robots})


def listed(studio: StudioPage) -> list[int]:
    """Return the numbers of the runs that are listed, in their order."""
    rows = studio.page.locator("tr[data-run]").all()
    return [int(row.get_attribute("data-run") or 0) for row in rows]


def tab(studio: StudioPage) -> str:
    """Return which tab is shown, with its count or number."""
    return " ".join(studio.page.get_by_role("tab", selected=True).inner_text().split())


def give(studio: StudioPage, column: str, text: str) -> None:
    """Write a value of R1 into the table of robots, and go back to the plans."""
    studio.tab("Robots")
    field = studio.page.get_by_label(f"{column}, R1", exact=True)
    field.fill(text)
    field.press("Enter")
    studio.settle()
    studio.tab("Plan")


def test_a_press_anywhere_on_a_row_plays_its_plan(opened: Opener) -> None:
    """Also waits are listed in order of time, whichever robot waits."""
    studio = opened(BAY)
    for _ in range(2):
        studio.button("Plan").click()
        studio.planned()
    for number, column in ((1, "flowtime"), (2, "took"), (1, "took")):
        at = {"flowtime": 4, "took": 5}[column]
        studio.page.locator(f"tr[data-run='{number}'] td:nth-child({at})").click()
        studio.shown(number)
    times = [
        int(found[1])
        for text in studio.page.locator(".waits .watch").all_inner_texts()
        if (found := re.search(r"At time (\d+)", text))
    ]
    assert len(times) > 1
    assert times == sorted(times)


def test_the_tab_has_the_number_of_the_plan_that_is_shown(opened: Opener) -> None:
    """It had a count of plans, which reads as another number of a plan."""
    studio = opened(BAY)
    assert tab(studio) == "Plan"
    planned_by(studio, "prioritized", "auto", "two-level")
    for number in (3, 1, 2):
        studio.row(number).locator(".show").click()
        studio.shown(number)
        assert tab(studio) == f"Plan No. {number}"
    studio.row(1).get_by_role("button", name="Delete").click()
    assert tab(studio) == "Plan No. 2"  # two plans are left
    assert studio.complaints == []


def test_a_decision_shows_both_lists_with_their_sums(opened: Opener) -> None:
    """Case 2 at the door: the paper compares 19 + 28 with 18 + 32 at its second decision."""
    studio = opened((EXAMPLES / "paper" / "door-2.yaml").read_text())
    planned_by(studio, "paper")
    lists = studio.page.locator(".waits details.groups")
    lists.last.locator("summary").click()
    for text in ("List 1: W(R1) + W(R2) = 19 + 28 = 47", "List 2: W(R1) + W(R2) = 18 + 32 = 50"):
        lists.get_by_text(text).wait_for()
    rows = [row.split() for row in lists.last.locator("tr").all_inner_texts()]
    assert rows[0] == ["time", *map(str, range(33))]
    assert rows[3][:3] == ["R1", "list", "1"]
    assert " ".join(rows[3][3:]) == "0 0 1 1 4 4 7 7 6 6 6= 6 6 7 7 4 4 1 1 0"
    studio.page.get_by_label("Language").select_option("de")
    lists.get_by_text("Liste 2: W(R1) + W(R2) = 18 + 32 = 50").wait_for()
    begin(studio, planner="prioritized")
    studio.shown(2)
    assert lists.count() == 0  # its decisions have no movement groups
    assert studio.complaints == []


def heads(studio: StudioPage) -> list[str]:
    """Return the heads of the figures of the list of plans."""
    return [studio.text(f"table.runs th.{column}").strip() for column in ("flowtime", "took")]


def test_heads_of_the_list_of_plans_have_the_unit_of_its_numbers(opened: Opener) -> None:
    """Plans in several units have theirs beside each number; without a unit there is none."""
    studio = opened(BAY)
    planned_by(studio, "prioritized")
    assert heads(studio) == ["Flowtime", "Time [s]"]
    number = studio.row(1).locator("td").nth(3)
    bare = studio.run(1)["figures"]["text"]["flowtime"][1]["number"]
    assert number.inner_text().startswith(bare)
    assert float(studio.row(1).locator("td").nth(4).inner_text()) >= 0
    another(studio)  # in seconds
    studio.tab("Plan")
    begin(studio)
    studio.shown(2)
    assert heads(studio) == ["Flowtime [s]", "Time [s]"]
    number = studio.row(2).locator("td").nth(3)
    assert number.inner_text().split()[0] == bare
    assert "s" not in number.inner_text().split()
    studio.page.get_by_label("Plans to list").select_option("*")
    assert heads(studio) == ["Flowtime", "Time [s]"]
    assert number.inner_text().split()[1] in {"s", "min", "h"}
    assert studio.row(1).locator("td").nth(3).inner_text().startswith(bare)
    assert studio.complaints == []


def another(studio: StudioPage) -> None:
    """Draw another floor, a copy with another unit of time, which has no name."""
    studio.draw({**studio.document, "units": {"time": "s"}}, "new 2026-01-02 03:04:05 006")


def row(studio: StudioPage, number: int) -> str:
    """Return what the list says of a run."""
    return studio.text(f"[data-run='{number}']")


def test_planners_and_options_are_said_as_the_registry_says_them(opened: Opener) -> None:
    studio = opened(BAY)
    for spec in studio.api("planners")["planners"]:
        studio.page.select_option("#planner", spec["name"])
        assert studio.text("#planner-summary") == find_text(f"planner {spec['name']}")
        shown = studio.page.locator(".options .hint").all_text_contents()
        assert shown == [find_text(*option["summary"][:1]) for option in spec["options"]]


def test_a_run_that_is_stopped_keeps_its_best_plan(opened: Opener) -> None:
    studio = opened(crowd())
    begin(studio, seconds=60)
    studio.page.locator(".curve").wait_for()
    before = studio.page.locator(".settings .buttons").bounding_box()
    studio.page.get_by_role("img", name=re.compile("Plan 1: from [0-9]+ at")).wait_for()
    studio.page.locator(".curve .reached").wait_for(state="attached")
    studio.poll(studio.is_plan, "the plan so far is there to be played")
    assert "Running" in studio.text(".curve")
    assert studio.page.locator(".settings .buttons").bounding_box() == before  # nothing moves
    studio.button("Stop, keep the best").click()
    studio.planned()
    assert "stopped" in row(studio, 1)
    run = studio.run(1)
    assert run["state"] == "stopped"
    assert run["figures"]["flowtime"] == min(cost for _, cost in run["points"])


def test_a_run_that_is_cancelled_ends_at_once(opened: Opener) -> None:
    studio = opened(crowd())
    begin(studio, seconds=60)
    studio.page.locator(".curve").get_by_text("running").wait_for()
    studio.button("Cancel").click()
    expect(studio.button("Cancel")).to_be_disabled()
    assert studio.run(1)["state"] == "cancelled"


def test_what_is_proven_impossible_lights_its_places(opened: Opener) -> None:
    studio = opened(PARTS)
    begin(studio)
    studio.failed(1)
    assert studio.run(1)["state"] == "failed"
    assert "R1 has no way from N0 to N2" in studio.text("tr.why")
    assert "no plan exists" in studio.text(".status")
    assert studio.lit() == ["N0", "N2"]
    studio.reload()
    studio.button("1 without a plan").click()
    assert studio.lit() == []
    studio.page.locator("tr.why button").click()
    assert studio.lit() == ["N0", "N2"]


def planned_by(studio: StudioPage, *planners: str) -> None:
    """Plan with one planner after the other."""
    for count, planner in enumerate(planners, 1):
        begin(studio, planner=planner)
        studio.shown(count)


def check(studio: StudioPage, *numbers: int, shift: bool = False) -> None:
    """Press the boxes of runs in the list."""
    for number in numbers:
        modifiers = ["Shift"] if shift else []
        studio.page.locator(f"[data-run='{number}'] [type=checkbox]").click(modifiers=modifiers)  # type: ignore[arg-type]


def test_runs_are_named_in_place(opened: Opener) -> None:
    studio = opened(BAY)
    planned_by(studio, "prioritized", "auto")
    name = studio.page.get_by_label("Name of the plan 1")
    name.fill("first try")
    name.press("Tab")
    studio.settle()
    assert studio.run(1)["name"] == "first try"
    assert "prioritized" in row(studio, 1)
    assert "%" in row(studio, 1)
    assert re.search(r"\t\d+\.\d\t", row(studio, 1))  # the head has the unit
    assert studio.complaints == []


def test_runs_that_are_selected_are_compared_and_shown_side_by_side(opened: Opener) -> None:
    studio = opened(BAY)
    planned_by(studio, "prioritized", "two-level", "auto")
    check(studio, 1)
    assert "Select another plan" in studio.text(".selection")
    check(studio, 3, shift=True)
    studio.settle()
    heads = studio.page.locator(".compared-figures thead button").all_inner_texts()
    assert heads == ["#1", "#2", "#3"]
    robots = studio.page.locator(".robots-compared .row:visible").all_inner_texts()
    assert {text.split("\n")[0] for text in robots} == {"R1", "R2", "R3"}
    assert studio.page.locator(".plot .reached").count() >= 3
    studio.page.locator(".robots-compared .row", has_text="R2").click()
    studio.chosen("R2").wait_for()
    studio.button("Show side by side").click()
    frame = studio.page.frame_locator("dialog.beside iframe")
    frame.get_by_role("tab", name="Compared").wait_for()
    assert frame.locator("section.map").count() == 3
    assert studio.page.frames[1].evaluate("origin") == "null"
    studio.keep("studio-compare")
    studio.page.keyboard.press("Escape")
    studio.page.locator("dialog.beside").wait_for(state="detached")
    check(studio, 2)
    studio.settle()
    assert studio.page.locator(".compared-figures thead button").count() == 2
    studio.button("End").click()
    studio.page.locator(".comparison").wait_for(state="detached")
    assert studio.complaints == []


def test_a_what_if_with_another_speed_is_shown_side_by_side(opened: Opener) -> None:
    """The ticks of both plans differ."""
    studio = opened(BAY)
    planned_by(studio, "auto")
    studio.press((0.5, 0.5))  # R1 at its home
    speed = studio.chosen("R1").get_by_label("Speed", exact=True)
    speed.fill("1.5")
    speed.press("Tab")
    studio.shown(2)
    changed = studio.page.locator(".comparison .compared-changes li")
    expect(changed).to_have_text(["R1: speed 1 \u2192 1.5"])
    studio.button("Show side by side").click()
    frame = studio.page.frame_locator("dialog.beside iframe")
    frame.get_by_role("tab", name="Compared").wait_for()
    assert frame.locator("section.map").count() == 2


def test_a_run_that_is_deleted_is_had_back(opened: Opener) -> None:
    studio = opened(BAY)
    planned_by(studio, "prioritized", "auto")
    studio.page.get_by_role("button", name="Delete: 2 floor.yaml").click()
    assert studio.page.locator("[data-run]").count() == 1
    assert not studio.is_plan()
    studio.page.locator(".notice").get_by_role("button", name="Undo").click()
    studio.shown(2)
    assert studio.is_plan()
    assert studio.page.locator("[data-run]").count() == 2
    check(studio, 1, 2)
    studio.settle()
    studio.page.locator(".selection").get_by_role("button", name="Delete").click()
    assert studio.page.locator("[data-run], .comparison").count() == 0
    studio.reload()  # leaving the page ends the undo
    studio.poll(lambda: not studio.runs, "the server has forgotten them")
    assert studio.page.locator("[data-run]").count() == 0
    assert studio.complaints == []


def test_runs_without_a_plan_are_no_plans_and_stand_behind_one_line(opened: Opener) -> None:
    studio = opened(PARTS)
    for count in (1, 2, 3):
        begin(studio)
        studio.failed(count)
    assert studio.text("#tab-plan").strip() == "Plan"
    assert listed(studio) == [3]  # what has just failed says why
    assert "R1 has no way" in studio.text("tr.why")
    fold = studio.page.get_by_role("button", name="2 without a plan", exact=True)
    fold.click()
    assert listed(studio) == [3, 2, 1]
    studio.reload()
    studio.page.locator(".runs .fold").wait_for()
    assert listed(studio) == []
    studio.button("Delete: 3 without a plan").click()
    assert studio.page.locator(".runs .fold").count() == 0
    studio.page.locator(".notice").get_by_role("button", name="Undo").click()
    studio.button("3 without a plan").click()
    assert listed(studio) == [3, 2, 1]
    assert studio.complaints == []


def test_a_reload_shows_the_tab_and_the_latest_plan_of_the_document(opened: Opener) -> None:
    studio = opened(BAY)
    planned_by(studio, "prioritized", "auto")
    studio.requests.clear()
    studio.reload()
    studio.shown(2)
    assert studio.is_plan()
    assert tab(studio) == "Plan No. 2"
    assert studio.page.locator(".aside").count() == 0  # nothing has changed since
    assert [each for each in studio.requests if each.endswith("/payload")] == [
        urljoin(studio.page.url, "/api/v1/runs/2/payload")
    ]
    studio.button("Files").click()
    studio.page.go_back()
    studio.shown(2)
    assert studio.is_plan()
    assert tab(studio) == "Plan No. 2"
    assert studio.complaints == []


def test_a_draft_that_is_opened_again_has_its_plan_until_it_differs(opened: Opener) -> None:
    """A crash of the browser leaves the draft; another floor was looked at before."""
    studio = opened(BAY)
    give(studio, "Work", "7")
    planned_by(studio, "prioritized")
    studio.tab("Map")
    another(studio)
    studio.tab("Plan")
    assert not studio.is_plan()  # another document has no plan
    studio.go("draft", "floor.yaml")
    assert tab(studio).startswith("Map")
    assert not studio.is_plan()
    studio.tab("Plan")
    studio.shown(1)
    assert studio.is_plan()
    give(studio, "Work", "8")
    studio.reload()
    studio.tab("Plan")
    assert not studio.is_plan()
    assert studio.complaints == []


def test_a_floor_that_was_planned_before_it_had_a_name_keeps_its_plans(opened: Opener) -> None:
    studio = opened(BAY)
    another(studio)
    studio.tab("Plan")
    planned_by(studio, "prioritized", "auto")
    studio.button("Save").click()
    studio.saved()
    assert studio.place == ("file", "floor2.yaml")
    studio.reload()
    studio.shown(2)
    assert studio.is_plan()
    assert studio.page.locator("[data-run]").count() == 2
    assert tab(studio) == "Plan No. 2"


def test_a_run_of_another_document_goes_on_unseen(opened: Opener) -> None:
    studio = opened(crowd())
    begin(studio, seconds=60)
    studio.poll(studio.is_plan, "the plan so far is there to be played")
    studio.reload()
    studio.poll(studio.is_plan, "whoever reloads goes on watching")
    expect(studio.button("Cancel")).to_be_enabled()
    studio.draw(parse_yaml(BAY))
    studio.tab("Plan")
    expect(studio.button("Cancel")).to_be_disabled()
    assert not studio.is_plan()
    studio.page.get_by_label("Plans to list").select_option("*")
    studio.post("runs/1/stop", {})
    studio.failed(1)
    assert studio.run(1)["state"] == "stopped"
    assert not studio.is_plan()


def test_runs_are_sorted_and_say_what_is_new_in_each(opened: Opener) -> None:
    studio = opened(BAY)
    planned_by(studio, "prioritized", "prioritized")
    give(studio, "Speed", "2")
    begin(studio, planner="prioritized")
    studio.shown(3)
    expect(studio.row(2)).to_contain_text("as good as 1")
    expect(studio.row(3)).to_contain_text("R1: speed 1 \u2192 2")
    assert listed(studio) == [3, 2, 1]
    cost = {run["number"]: run["figures"]["flowtime"] * Fraction(*run["figures"]["tick"])
            for run in studio.runs}  # fmt: skip
    studio.page.locator("th.flowtime button").click()
    assert listed(studio) == sorted(cost, key=lambda number: (cost[number], -number))


def test_the_list_is_of_this_floor_and_others_on_request(opened: Opener) -> None:
    studio = opened(BAY)
    planned_by(studio, "auto")
    assert studio.page.get_by_label("Plans to list").count() == 0
    another(studio)
    studio.tab("Plan")
    assert studio.page.locator("[data-run]").count() == 0
    assert studio.text("#tab-plan").strip() == "Plan"
    studio.page.get_by_label("Plans to list").select_option("floor.yaml")
    assert studio.page.locator("[data-run]").count() == 1
    begin(studio)
    studio.page.get_by_label("Plans to list").select_option("*")
    studio.shown(2)
    check(studio, 1, 2)
    alert = studio.page.get_by_role("alert")
    expect(alert).to_contain_text("times are in s, those of the first plan in no unit")


def test_a_plan_that_is_opened_is_in_the_list(opened: Opener, empty: Client) -> None:
    studio = opened(BAY)
    planned_by(studio, "auto")
    exported(studio, "Plan file", empty.folder)
    studio.go("file", "floor-plan-1.json")
    studio.shown(2)
    expect(studio.page.locator("[data-run]")).to_have_count(2)  # it is of the same floor
    assert "opened" in row(studio, 2)
    studio.reload()
    studio.shown(2)
    assert studio.is_plan()
    assert len(studio.runs) == 2  # the same file is the same plan


def test_the_curve_has_axes_and_says_the_same_in_words(opened: Opener) -> None:
    studio = opened(crowd())
    begin(studio, seconds=2)
    studio.shown(1)
    plot, run = studio.page.locator(".plot"), studio.run(1)
    first, best = run["points"][0][1], run["points"][-1][1]
    assert best < first
    said = plot.get_attribute("aria-label") or ""
    assert f"from {first} at" in said
    assert f"to {best} at" in said
    assert f"lower bound {run['figures']['lower_bound']}" in said
    assert studio.text(".plot .label >> nth=0") == str(first)
    assert studio.text(".seconds.last").endswith(" s")


def exported(studio: StudioPage, name: str, folder: Path) -> Path:
    """Download what a link exports, under the name that it is given."""
    with studio.page.expect_download() as download:
        studio.page.get_by_role("link", name=name, exact=True).click()
    path = folder / download.value.suggested_filename
    download.value.save_as(path)
    return path


def test_what_is_exported_opens_in_the_programs_it_is_for(
    opened: Opener, browser: Browser, tmp_path: Path
) -> None:
    studio = opened(BAY)
    begin(studio)
    studio.planned()
    studio.page.locator(".exports summary").click()
    flowtime = studio.run(1)["figures"]["flowtime"]
    plan = exported(studio, "Plan file", tmp_path)
    assert plan.name == "floor-plan-1.json"
    assert load_plan(plan).flowtime == flowtime
    book = openpyxl.load_workbook(exported(studio, "Workbook", tmp_path))
    assert {"R1", "R2", "R3"} <= {
        str(cell.value) for sheet in book for line in sheet.iter_rows() for cell in line
    }
    with Image.open(exported(studio, "Film", tmp_path)) as film:
        assert getattr(film, "n_frames", 1) > 10
    with Image.open(exported(studio, "Picture", tmp_path)) as picture:
        assert min(picture.size) > 100
    page = Viewer(browser.new_context(offline=True).new_page())
    page.page.goto(exported(studio, "Web page", tmp_path).as_uri())
    slider = page.page.get_by_role("slider", name="Time")
    page.poll(lambda: float(slider.input_value()) > 0, "it plays by itself")
    assert "floor.yaml #1" in page.text("#headline")
    assert page.complaints == []
    page.page.context.close()


def test_the_command_line_gives_the_same_flowtime(opened: Opener, empty: Client) -> None:
    """The planner ends when its plan is proven; a busy machine does not reach the limit."""
    studio = opened(BAY)
    begin(studio, seconds=60)
    studio.planned()
    studio.page.locator(".exports summary").click()
    command = "rightofway plan floor.yaml --planner auto --seed 0 --time-limit 60"
    assert studio.text(".command code") == command
    studio.button("Copy the command line").click()
    studio.page.locator(".command").get_by_text("Copied").wait_for()
    copied = studio.page.evaluate("navigator.clipboard.readText()")
    assert copied == command
    program = Path(sys.executable).with_name("rightofway")
    words = [str(program), *shlex.split(copied)[1:], "--json", "-o", "again.json"]
    done = subprocess.run(words, cwd=empty.folder, capture_output=True, text=True, check=True)
    report = json.loads(done.stdout)
    assert report["metrics"]["flowtime"] == studio.run(1)["figures"]["flowtime"]


def test_the_page_of_a_comparison_is_a_file_too(
    opened: Opener, browser: Browser, tmp_path: Path
) -> None:
    studio = opened(BAY)
    planned_by(studio, "prioritized", "auto")
    check(studio, 1, 2)
    studio.settle()
    with studio.page.expect_download() as download:
        studio.page.locator(".comparison").get_by_role("link", name="Web page").click()
    assert download.value.suggested_filename == "floor-plan-1-2.html"
    path = tmp_path / "both.html"
    download.value.save_as(path)
    page = Viewer(browser.new_context(offline=True).new_page())
    page.page.goto(path.as_uri())
    page.page.get_by_role("button", name="Pause").wait_for()  # it plays by itself
    assert page.page.locator("section.map").count() == 2
    assert page.complaints == []
    page.page.context.close()


def test_everything_about_plans_has_a_name_and_is_reached_by_keys(opened: Opener) -> None:
    studio = opened(BAY)
    studio.page.keyboard.press("Control+Enter")
    studio.planned()
    closed = studio.page.locator("#panel details:not([open]) > summary")
    while closed.count():
        left = closed.count()
        closed.first.press("Enter")
        assert closed.count() < left
    panel = studio.page.get_by_role("tabpanel")
    assert nameless(panel) == []
    reached = panel.locator(":is(button, input, select, a, code, pre)")
    assert {int(each.evaluate("(it) => it.tabIndex")) for each in reached.all()} == {0}
