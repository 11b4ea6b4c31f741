"""Plans on the page of the studio: begun, stopped, named, compared, exported, asked."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.builders.browsers import needs_browser
from tests.builders.drawing import StudioPage
from tests.builders.studios import running

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = needs_browser

BAY = """\
format: rightofway-scenario/1
map: {grid: [".@.@.", ".....", "@@.@@", "@@.@@"]}
robots:
  - {name: R1, home: N0, target: N17, work: 3}
  - {name: R2, home: N2, target: N17, work: 3}
  - {name: R3, home: N4, target: N17, work: 3}
"""

OPEN = """\
format: rightofway-scenario/1
map: {grid: [".....", ".....", ".....", "....."]}
robots:
  - {name: R1, home: N0, target: N19, work: 3}
  - {name: R2, home: N4, target: N15, work: 1}
"""

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


Opener = Callable[[str], StudioPage]


@pytest.fixture
def opened(browser: Browser, tmp_path: Path) -> Iterator[Opener]:
    """Yield a function that opens a scenario in a studio of its own, at its tab of plans."""
    (tmp_path / "floor.yaml").write_text("")
    with running(tmp_path, keeps=False, file="floor.yaml") as client:
        address = str(client.base_url).removesuffix("api/v1/")
        context = browser.new_context(
            locale="en-GB", reduced_motion="reduce", viewport={"width": 1440, "height": 900}
        )
        context.grant_permissions(["clipboard-read", "clipboard-write"], origin=address)

        def open_studio(text: str) -> StudioPage:
            (tmp_path / "floor.yaml").write_text(text)
            studio = StudioPage(context.new_page(), address)
            studio.opened()
            studio.tab("Plan")
            return studio

        yield open_studio
        context.close()


def begin(studio: StudioPage, *, seconds: float = 1, planner: str = "auto") -> None:
    """Fill the form, which is folded once there is a plan, and begin a run."""
    folded = studio.page.locator(".settings > details:not([open]) > summary")
    if folded.count():
        folded.click()
    studio.page.select_option("#planner", planner)
    studio.page.fill("#limit", str(seconds))
    studio.page.locator(".settings [type=submit]").click()


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
    assert "running" in studio.text(".curve")
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


def test_runs_are_named_compared_and_deleted(opened: Opener) -> None:
    studio = opened(BAY)
    begin(studio, planner="prioritized")
    studio.planned()
    begin(studio)
    studio.wait_for("studio.runs.shown === 2")
    studio.planned()
    name = studio.page.get_by_label("Name of the plan 1")
    name.fill("first try")
    name.press("Tab")
    studio.wait_for("studio.runs.find(1).name === 'first try'")
    assert "prioritized" in row(studio, 1)
    assert "%" in row(studio, 1)
    assert " s" in row(studio, 1)
    studio.page.get_by_role("button", name="Compare: 1 first try").click()
    studio.wait_for("Boolean(studio.runs.comparison)")
    assert "first try" in studio.text(".comparison")
    studio.button("Show side by side").click()
    frame = studio.page.frame_locator("dialog.beside iframe")
    frame.get_by_role("tab", name="Compared").wait_for()
    assert studio.page.frames[1].evaluate("origin") == "null"
    studio.page.keyboard.press("Escape")
    studio.page.locator("dialog.beside").wait_for(state="detached")
    studio.page.locator("[data-run='1'] .show").click()
    studio.wait_for("studio.runs.shown === 1")
    studio.page.get_by_role("button", name="Delete: 1 first try").click()
    studio.wait_for("studio.runs.runs.length === 1")
    assert studio.ask("studio.stage.isPlan") is False
    assert studio.complaints == []


def test_a_plan_is_exported_with_the_command_that_gives_the_same(opened: Opener) -> None:
    studio = opened(BAY)
    begin(studio)
    studio.planned()
    for name, start in (
        ("Plan file", b"{"),
        ("Workbook", b"PK"),
        ("Picture", b"\x89PNG"),
        ("Film", b"GIF8"),
        ("Page as file", b"<!doctype html>"),
    ):
        with studio.page.expect_download() as download:
            studio.page.get_by_role("link", name=name, exact=True).click()
        assert Path(download.value.path()).read_bytes().lower().startswith(start.lower()), name
    command = "rightofway plan floor.yaml --planner auto --seed 0 --time-limit 1"
    assert studio.text(".command code") == command
    studio.button("Copy the command line").click()
    studio.wait_for("document.querySelector('.command button').textContent === 'Copied'")
    assert studio.ask("navigator.clipboard.readText()") == command


def test_the_other_robot_goes_first_and_the_difference_is_shown(opened: Opener) -> None:
    studio = opened(BAY)
    begin(studio)
    studio.planned()
    loss = studio.ask("studio.runs.losses.find((loss) => loss.for)")
    assert loss["sentence"] in studio.text(".waits")
    studio.button(f"Let {loss['robot']} go first").click()
    studio.wait_for("Boolean(studio.runs.comparison)")
    assert studio.ask("[studio.runs.run.kind, studio.runs.beside]") == ["flip", 1]
    before, after = (
        dict(studio.ask(f"studio.runs.comparison.robots.map((r) => [r.name, r.completion[{i}]])"))
        for i in (0, 1)
    )
    assert after[loss["robot"]] <= before[loss["robot"]]
    assert before != after
    assert ("Earlier" in studio.text(".change")) or ("Later" in studio.text(".change"))


def test_a_change_of_a_robot_is_planned_at_once(opened: Opener) -> None:
    studio = opened(BAY)
    begin(studio)
    studio.planned()
    studio.ask("studio.stage.choice.chooseRobot(0)")
    speed = studio.page.locator(".ask").get_by_label("Speed", exact=True)
    speed.fill("2")
    speed.press("Tab")
    studio.wait_for("studio.runs.shown === 2 && Boolean(studio.runs.comparison)")
    assert studio.document["robots"][0]["speed"] == 2
    assert studio.ask("studio.runs.run.request.time_limit") == 1
    assert "R1: speed 1 → 2" in studio.text(".change .edit")
    assert "R1" in studio.text(".change .gain")
    assert "The same route as before: " in studio.text(".change")
    assert studio.ask("studio.runs.run.request.start") == 1
    assert "--start run-1.json" in studio.ask("studio.runs.command")
    assert studio.ask("studio.stage.choice.robot.name") == "R1"  # it stays chosen
    speed.fill("fast")
    speed.press("Tab")
    studio.settle()
    fault = studio.ask("studio.store.faults[0].message")
    assert fault in studio.text(".ask [role=alert]")
    assert speed.get_attribute("aria-invalid") == "true"
    assert studio.ask("studio.runs.runs.length") == 2
    studio.page.locator("[data-run='1'] .show").click()
    studio.wait_for("studio.runs.shown === 1")
    studio.button("Edit what it was planned from").click()
    studio.settle()
    assert "speed" not in studio.document["robots"][0]


def test_a_place_is_closed_planned_and_opened_again(opened: Opener) -> None:
    studio = opened(crowd())
    begin(studio)
    studio.planned()
    place = next(
        f"N{DOOR * WIDTH + x}" for x in range(WIDTH) if f'"N{DOOR * WIDTH + x}"' not in crowd()
    )
    studio.page.fill("#close-at", place)
    studio.button("Close it").click()
    studio.wait_for("studio.store.document.closures?.length === 1")
    studio.wait_for("studio.runs.runs.length === 2 && !studio.runs.running")
    assert studio.document["closures"] == [{"at": place}]
    studio.page.get_by_role("button", name=f"Open again: {place}").click()
    studio.settle()
    assert "closures" not in studio.document


def test_a_lane_is_closed_and_the_former_way_is_dashed(opened: Opener) -> None:
    """No robot drives along a closed lane any more, and its sign is on the map."""
    studio = opened(OPEN)
    begin(studio)
    studio.planned()
    studio.ask("studio.stage.choice.chooseRobot(0)")
    way = "Array.from(studio.stage.choice.robot.vertices, (v) => studio.stage.plan.roadmap.name(v))"
    before = studio.ask(way)
    tail, head = before[1:3]
    studio.page.fill("#close-at", tail)
    studio.page.fill("#close-to", head)
    studio.button("Close it").click()
    studio.wait_for("studio.runs.shown === 2 && studio.runs.comparison?.runs[1] === 2")
    assert studio.document["closures"] == [{"edge": [tail, head]}]
    after = studio.ask(way)
    assert not {(tail, head), (head, tail)} & set(pairwise(after))
    assert f"{tail} to {head}: closed" in studio.text(".change .edit")
    assert studio.ask("studio.former.ways.length") > 0
    assert "Dashed on the map" in studio.text(".change")
    assert studio.complaints == []


def test_what_cannot_be_closed_is_said_at_the_field(opened: Opener) -> None:
    studio = opened(BAY)
    begin(studio)
    studio.planned()
    studio.page.fill("#close-at", "N999")
    studio.button("Close it").click()
    studio.settle()
    assert "closures[0].at" in studio.text(".ask [role=alert]")
    studio.page.get_by_role("button", name="Open again: N999").click()
    studio.settle()
    assert studio.ask("studio.store.survey.ok")


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
