"""Plans on the page of the studio: begun, stopped, named, compared, exported, asked."""

from __future__ import annotations

import json
import random
import shlex
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import openpyxl  # type: ignore[import-untyped]  # it ships no types
from PIL import Image

from rightofway import load_plan
from rightofway.io.text import parse_yaml
from tests.builders.browsers import Viewer, needs_browser
from tests.builders.drawing import Opener, StudioPage, begin
from tests.builders.studios import BAY

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


def row(studio: StudioPage, number: int) -> str:
    """Return what the list says of a run."""
    return studio.text(f"[data-run='{number}']")


def test_planners_and_options_are_said_as_the_registry_says_them(opened: Opener) -> None:
    studio = opened(BAY)
    for spec in studio.ask("studio.runs.planners.planners"):
        studio.page.select_option("#planner", spec["name"])
        assert studio.text("#planner-summary") == spec["summary"]
        shown = studio.page.locator(".options .hint").all_text_contents()
        assert shown == [option["summary"] for option in spec["options"]]


def test_a_run_that_is_stopped_keeps_its_best_plan(opened: Opener) -> None:
    studio = opened(crowd())
    begin(studio, seconds=60)
    studio.wait_for("Boolean(document.querySelector('.curve'))")
    before = studio.page.locator(".settings .buttons").bounding_box()
    studio.wait_for("studio.runs.running?.points.length > 1")
    studio.wait_for("Boolean(document.querySelector('.curve .reached'))")
    studio.wait_for("studio.stage.isPlan")  # the plan so far is there to be played
    assert "Running" in studio.text(".curve")
    assert studio.page.locator(".settings .buttons").bounding_box() == before  # nothing moves
    studio.button("Stop, keep the best").click()
    studio.planned()
    assert studio.ask("studio.runs.run.state") == "stopped"
    assert "stopped" in row(studio, 1)
    flowtime, best = studio.ask("[studio.runs.run.figures.flowtime, studio.runs.run.points]")
    assert flowtime == min(cost for _, cost in best)


def test_a_run_that_is_cancelled_ends_at_once(opened: Opener) -> None:
    studio = opened(crowd())
    begin(studio, seconds=60)
    studio.wait_for("studio.runs.running?.state === 'running'")
    studio.button("Cancel").click()
    studio.wait_for("!studio.runs.running")
    assert studio.ask("studio.runs.runs[0].state") == "cancelled"


def test_what_is_proven_impossible_lights_its_places(opened: Opener) -> None:
    studio = opened(PARTS)
    begin(studio)
    studio.wait_for("studio.runs.runs[0]?.state === 'failed'")
    assert "R1 has no way from N0 to N2" in studio.text("tr.why")
    assert "no plan exists" in studio.text(".status")
    studio.ask("studio.light([])")
    studio.page.locator("tr.why button").click()
    lit = "studio.stage.choice.lit.map((vertex) => studio.stage.plan.roadmap.name(vertex))"
    assert studio.ask(lit) == ["N0", "N2"]


def planned_by(studio: StudioPage, *planners: str) -> None:
    """Plan with one planner after the other."""
    for count, planner in enumerate(planners, 1):
        begin(studio, planner=planner)
        studio.wait_for(f"studio.runs.shown === {count}")
        studio.planned()


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
    studio.wait_for("studio.runs.find(1).name === 'first try'")
    assert "prioritized" in row(studio, 1)
    assert "%" in row(studio, 1)
    assert " s" in row(studio, 1)
    assert studio.complaints == []


def test_runs_that_are_selected_are_compared_and_shown_side_by_side(opened: Opener) -> None:
    studio = opened(BAY)
    planned_by(studio, "prioritized", "two-level", "auto")
    check(studio, 1)
    assert "Select another plan" in studio.text(".selection")
    check(studio, 3, shift=True)
    studio.wait_for("studio.runs.compared?.runs.length === 3")
    heads = studio.page.locator(".compared-figures thead button").all_inner_texts()
    assert heads == ["#1", "#2", "#3"]
    robots = studio.page.locator(".robots-compared .row:visible").all_inner_texts()
    assert {text.split("\n")[0] for text in robots} == {"R1", "R2", "R3"}
    assert studio.page.locator(".plot .reached").count() >= 3
    studio.page.locator(".robots-compared .row", has_text="R2").click()
    assert studio.ask("studio.stage.choice.robot.name") == "R2"
    studio.button("Show side by side").click()
    frame = studio.page.frame_locator("dialog.beside iframe")
    frame.get_by_role("tab", name="Compared").wait_for()
    assert frame.locator("section.map").count() == 3
    assert studio.page.frames[1].evaluate("origin") == "null"
    studio.keep("studio-compare")
    studio.page.keyboard.press("Escape")
    studio.page.locator("dialog.beside").wait_for(state="detached")
    check(studio, 2)
    studio.wait_for("studio.runs.compared?.runs.length === 2")
    studio.button("End").click()
    studio.page.locator(".comparison").wait_for(state="detached")
    assert studio.complaints == []


def test_a_what_if_with_another_speed_is_shown_side_by_side(opened: Opener) -> None:
    """The ticks of both plans differ."""
    studio = opened(BAY)
    planned_by(studio, "auto")
    studio.ask("studio.stage.choice.chooseRobot(0)")
    speed = studio.page.locator(".ask").get_by_label("Speed", exact=True)
    speed.fill("1.5")
    speed.press("Tab")
    studio.wait_for("studio.runs.shown === 2 && Boolean(studio.runs.comparison)")
    changed = studio.page.locator(".comparison .compared-changes li").all_inner_texts
    studio.wait_for("Boolean(document.querySelector('.compared-changes'))")
    assert changed() == ["R1: speed 1 \u2192 1.5"]
    studio.button("Show side by side").click()
    frame = studio.page.frame_locator("dialog.beside iframe")
    frame.get_by_role("tab", name="Compared").wait_for()
    assert frame.locator("section.map").count() == 2


def test_a_run_that_is_deleted_is_had_back(opened: Opener) -> None:
    studio = opened(BAY)
    planned_by(studio, "prioritized", "auto")
    studio.page.get_by_role("button", name="Delete: 2 floor.yaml").click()
    assert studio.page.locator("[data-run]").count() == 1
    assert studio.ask("studio.stage.isPlan") is False
    studio.page.locator(".notice").get_by_role("button", name="Undo").click()
    studio.wait_for("studio.runs.shown === 2 && studio.stage.isPlan")
    assert studio.page.locator("[data-run]").count() == 2
    check(studio, 1, 2)
    studio.wait_for("Boolean(studio.runs.compared)")
    studio.page.locator(".selection").get_by_role("button", name="Delete").click()
    assert studio.page.locator("[data-run], .comparison").count() == 0
    studio.page.reload()  # leaving the page ends the undo
    studio.wait_for("Boolean(window.studio?.about.version)")
    studio.wait_for("studio.runs.runs.length === 0")
    assert studio.complaints == []


def test_runs_without_a_plan_are_no_plans_and_stand_behind_one_line(opened: Opener) -> None:
    studio = opened(PARTS)
    for count in (1, 2, 3):
        begin(studio)
        studio.wait_for(f"studio.runs.runs.length === {count} && !studio.runs.running")
    assert studio.text("#tab-plan").strip() == "Plan"
    numbers = "[...document.querySelectorAll('tr[data-run]')].map((row) => Number(row.dataset.run))"
    assert studio.ask(numbers) == [3]  # what has just failed says why
    assert "R1 has no way" in studio.text("tr.why")
    fold = studio.page.get_by_role("button", name="2 without a plan", exact=True)
    fold.click()
    assert studio.ask(numbers) == [3, 2, 1]
    studio.page.reload()
    studio.wait_for("Boolean(document.querySelector('.runs .fold'))")
    assert studio.ask(numbers) == []
    studio.button("Delete: 3 without a plan").click()
    assert studio.page.locator(".runs .fold").count() == 0
    studio.page.locator(".notice").get_by_role("button", name="Undo").click()
    studio.button("3 without a plan").click()
    assert studio.ask(numbers) == [3, 2, 1]
    assert studio.complaints == []


def reloaded(studio: StudioPage) -> None:
    studio.page.reload()
    studio.wait_for("Boolean(window.studio?.about.version) && Boolean(studio.store.site)")


def test_a_reload_shows_the_tab_and_the_latest_plan_of_the_document(opened: Opener) -> None:
    studio = opened(BAY)
    planned_by(studio, "prioritized", "auto")
    studio.requests.clear()
    reloaded(studio)
    studio.wait_for("studio.runs.shown === 2 && studio.stage.isPlan && studio.runs.losses !== null")
    assert studio.ask("studio.tab") == "plan"
    assert studio.page.locator(".aside").count() == 0  # nothing has changed since
    assert [each for each in studio.requests if each.endswith("/payload")] == [
        f"{studio.page.evaluate('origin')}/api/v1/runs/2/payload"
    ]
    studio.button("Files").click()
    studio.page.go_back()
    studio.wait_for("studio.runs.shown === 2 && studio.stage.isPlan && studio.tab === 'plan'")
    assert studio.complaints == []


def test_a_draft_that_is_opened_again_has_its_plan_until_it_differs(opened: Opener) -> None:
    """A crash of the browser leaves the draft; another floor was looked at before."""
    studio = opened(BAY)
    edit = (
        "studio.store.change((document) => ({ ...document, robots: document.robots.map("
        "(robot, i) => (i ? robot : { ...robot, work: WORK })) }))"
    )
    studio.ask(edit.replace("WORK", "7"))
    studio.settle()
    planned_by(studio, "prioritized")
    studio.tab("Map")
    studio.ask("studio.open({ document: { ...studio.store.document, units: { time: 's' } } })")
    studio.settle()
    assert studio.ask("studio.runs.shown") is None  # another document has no plan
    studio.ask("studio.shelf.list().then(() => studio.shelf.openDraft('floor.yaml'))")
    studio.wait_for("studio.runs.shown === 1")
    assert studio.ask("studio.tab") == "map"
    assert not studio.ask("studio.stage.isPlan")
    studio.ask(edit.replace("WORK", "8"))
    studio.settle()
    studio.wait_for("studio.store.isKept")
    reloaded(studio)
    studio.settle()
    assert studio.ask("studio.runs.shown") is None
    assert studio.complaints == []


def test_a_floor_that_was_planned_before_it_had_a_name_keeps_its_plans(opened: Opener) -> None:
    studio = opened(BAY)
    studio.ask("studio.open({ document: { ...studio.store.document, units: { time: 's' } } })")
    studio.settle()
    studio.tab("Plan")
    planned_by(studio, "prioritized", "auto")
    studio.button("Save").click()
    studio.wait_for("location.hash === '#file=floor2.yaml'")
    reloaded(studio)
    studio.wait_for("studio.runs.shown === 2 && studio.stage.isPlan")
    assert studio.page.locator("[data-run]").count() == 2
    assert studio.ask("studio.tab") == "plan"


def test_a_run_of_another_document_goes_on_unseen(opened: Opener) -> None:
    studio = opened(crowd())
    begin(studio, seconds=60)
    studio.wait_for("studio.runs.running?.has_plan")
    reloaded(studio)
    studio.wait_for(
        "studio.runs.running && studio.stage.isPlan"
    )  # whoever reloads goes on watching
    studio.ask(f"studio.open({{ document: {json.dumps(parse_yaml(BAY))} }})")
    studio.settle()
    assert studio.ask("[studio.runs.running ?? null, studio.runs.shown]") == [None, None]
    studio.ask("fetch('/api/v1/runs/1/stop', { method: 'POST',"
               " headers: { 'content-type': 'application/json' }, body: '{}' })")  # fmt: skip
    studio.wait_for("studio.runs.find(1).state === 'stopped'")
    studio.settle()
    assert studio.ask("studio.runs.shown") is None


def test_runs_are_sorted_and_say_what_is_new_in_each(opened: Opener) -> None:
    studio = opened(BAY)
    planned_by(studio, "prioritized", "prioritized")
    studio.ask(
        "studio.store.change((document) => ({ ...document, robots: document.robots.map("
        "(robot, i) => (i ? robot : { ...robot, speed: 2 })) }))"
    )
    studio.settle()
    begin(studio, planner="prioritized")
    studio.wait_for("studio.runs.shown === 3")
    studio.planned()
    studio.wait_for("studio.runs.notes.on({ number: 3 }).length > 0")
    assert "as good as 1" in row(studio, 2)
    assert "R1: speed 1 \u2192 2" in row(studio, 3)
    order = "[...document.querySelectorAll('tr[data-run]')].map((row) => Number(row.dataset.run))"
    assert studio.ask(order) == [3, 2, 1]
    costs = studio.ask("studio.runs.runs.map(({ number, figures: { flowtime, tick } }) =>"
                       " [flowtime * tick[0] / tick[1], -number]).sort((a, b) => a[0] - b[0] ||"
                       " a[1] - b[1]).map(([, number]) => -number)")  # fmt: skip
    studio.page.locator("th.flowtime button").click()
    assert studio.ask(order) == costs


def test_the_list_is_of_this_floor_and_others_on_request(opened: Opener) -> None:
    studio = opened(BAY)
    planned_by(studio, "auto")
    assert studio.page.get_by_label("Whose plans are listed").count() == 0
    studio.ask("studio.open({ document: { ...studio.store.document, units: { time: 's' } } })")
    studio.settle()
    studio.tab("Plan")
    assert studio.page.locator("[data-run]").count() == 0
    assert studio.text("#tab-plan").strip() == "Plan"
    studio.page.get_by_label("Whose plans are listed").select_option("floor.yaml")
    assert studio.page.locator("[data-run]").count() == 1
    begin(studio)
    studio.wait_for("studio.runs.shown === 2")
    studio.planned()
    studio.page.get_by_label("Whose plans are listed").select_option("*")
    check(studio, 1, 2)
    studio.wait_for("studio.complaints.length > 0")
    assert "times are in s, those of the first plan in no unit" in studio.text(".status")


def test_a_plan_that_is_opened_is_in_the_list(opened: Opener, empty: Client) -> None:
    studio = opened(BAY)
    planned_by(studio, "auto")
    exported(studio, "Plan file", empty.folder)
    studio.ask("studio.shelf.open('floor-plan-1.json')")
    studio.wait_for("studio.runs.shown === 2 && studio.runs.losses !== null")
    studio.wait_for(
        "document.querySelectorAll('[data-run]').length === 2"
    )  # it is of the same floor
    assert "opened" in row(studio, 2)
    reloaded(studio)
    studio.wait_for("studio.runs.shown === 2 && studio.stage.isPlan")
    assert len(studio.ask("studio.runs.runs")) == 2  # the same file is the same plan


def test_the_curve_has_axes_and_says_the_same_in_words(opened: Opener) -> None:
    studio = opened(crowd())
    begin(studio, seconds=2)
    studio.wait_for("studio.runs.shown === 1")
    studio.planned()
    plot = studio.page.locator(".plot")
    first, best = studio.ask("[studio.runs.run.points[0][1], studio.runs.run.points.at(-1)[1]]")
    assert best < first
    said = plot.get_attribute("aria-label") or ""
    assert f"from {first} at" in said
    assert f"to {best} at" in said
    assert f"each alone {studio.ask('studio.runs.run.figures.lower_bound')}" in said
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
    flowtime = studio.ask("studio.runs.run.figures.flowtime")
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
    page.wait_for("clock.playing && clock.tick > 0")
    assert "floor.yaml #1" in page.text("#headline")
    assert page.complaints == []
    page.page.context.close()


def test_the_command_line_gives_the_same_flowtime(opened: Opener, empty: Client) -> None:
    studio = opened(BAY)
    begin(studio)
    studio.planned()
    studio.page.locator(".exports summary").click()
    command = "rightofway plan floor.yaml --planner auto --seed 0 --time-limit 1"
    assert studio.text(".command code") == command
    studio.button("Copy the command line").click()
    studio.wait_for("document.querySelector('.command button').textContent === 'Copied'")
    copied = studio.ask("navigator.clipboard.readText()")
    assert copied == command
    program = Path(sys.executable).with_name("rightofway")
    words = [str(program), *shlex.split(copied)[1:], "--json", "-o", "again.json"]
    done = subprocess.run(words, cwd=empty.folder, capture_output=True, text=True, check=True)
    report = json.loads(done.stdout)
    assert report["metrics"]["flowtime"] == studio.ask("studio.runs.run.figures.flowtime")


def test_the_page_of_a_comparison_is_a_file_too(
    opened: Opener, browser: Browser, tmp_path: Path
) -> None:
    studio = opened(BAY)
    planned_by(studio, "prioritized", "auto")
    check(studio, 1, 2)
    studio.wait_for("Boolean(studio.runs.compared)")
    with studio.page.expect_download() as download:
        studio.page.locator(".comparison").get_by_role("link", name="Web page").click()
    assert download.value.suggested_filename == "floor-plan-1-2.html"
    path = tmp_path / "both.html"
    download.value.save_as(path)
    page = Viewer(browser.new_context(offline=True).new_page())
    page.page.goto(path.as_uri())
    page.wait_for("clock.playing && comparison.plans.length === 2")
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
    nameless = studio.ask(
        "[...document.querySelectorAll('#panel :is(button, input, select, a)')].filter((each) =>"
        " !(each.ariaLabel || each.textContent.trim() || each.labels?.length))"
        ".map((each) => each.outerHTML)"
    )
    assert nameless == []
    out_of_reach = studio.ask(
        "[...document.querySelectorAll('#panel :is(button, input, select, a, code, pre)')]"
        ".filter((each) => each.tabIndex < 0).length"
    )
    assert out_of_reach == 0
