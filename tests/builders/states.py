"""Every state of the studio's page, one after the other, in whatever language it speaks."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path

from tests.builders.crowds import CROWD
from tests.builders.drawing import StudioPage

EXAMPLES = Path(__file__).parents[2] / "examples"


def examples(folder: Path) -> None:
    """Put the files into a folder that `states` opens."""
    shutil.copy(EXAMPLES / "door.yaml", folder)
    (folder / "crowd.yaml").write_text(json.dumps(CROWD))


def states(studio: StudioPage) -> Iterator[str]:
    """Lead a page that shows its start through all states, and yield what is seen then.

    Parameters
    ----------
    studio
        The page of a studio whose folder has the files of `examples`.
    """
    yield from _drawing(studio)
    yield from _planning(studio)
    yield from _asking(studio)


def _drawing(studio: StudioPage) -> Iterator[str]:
    """Draw a floor and a roadmap; make a fault in the table of robots."""
    page = studio.page
    yield "start"
    page.locator(".start form [type=submit]").click()
    studio.opened()
    studio.drag((7.25, 0.25), (7.25, 5.75))
    yield "floor"
    _back(studio)
    page.locator(".start form [type=button]").click()
    studio.opened()
    page.locator("[data-tool=select]").click()
    studio.press((0, 0))
    yield "roadmap"
    _open(studio, "door.yaml")
    page.click("#tab-robots")
    speed = page.locator("td.speed input").first
    speed.fill("-1")
    speed.press("Enter")
    studio.settle()
    page.locator("[aria-invalid=true]").first.wait_for()
    yield "fault of a robot"
    page.keyboard.press("Control+z")
    page.locator("#map").focus()
    page.keyboard.press("Control+z")
    studio.settle()
    page.click("#tab-plan")
    yield "settings"


def _planning(studio: StudioPage) -> Iterator[str]:
    """Plan for long, then plan a door and play it."""
    page = studio.page
    _open(studio, "crowd.yaml")
    _plan(studio, "lns", 600)
    studio.page.locator("#slider").wait_for()  # the plan so far can be played
    yield "planning"
    cancel = studio.page.locator(".settings .buttons button").last
    assert cancel.is_enabled()
    cancel.click()
    studio.page.locator(".settings .buttons button:disabled").last.wait_for()
    _open(studio, "door.yaml")
    _plan(studio, "auto", 1)
    studio.planned()
    page.locator("#play").click()
    studio.poll(studio.moment, "time goes on")
    yield "playing"
    studio.page.locator("#slider").fill("0")  # that ends it


def _asking(studio: StudioPage) -> Iterator[str]:
    """Ask about the plan of the door; ask for help."""
    page = studio.page
    page.locator(".waits .watch").first.click()
    page.locator("#card").wait_for()
    yield "wait explained"
    page.locator(".waits .framed").first.click()
    studio.page.locator(".change[aria-busy=false]").wait_for()
    page.locator("#map").focus()
    page.keyboard.press("Escape")  # no robot is chosen any more
    yield "compared"
    _unfold(studio, "laps")
    page.locator("details.laps [type=submit]").first.click()
    studio.page.locator(".study .pace").wait_for()
    yield "laps"
    plan = next(run["number"] for run in studio.runs if run["kind"] == "plan")
    studio.row(plan).locator(".show").click()
    studio.shown(plan)
    _unfold(studio, "delays")
    page.locator("details.delays [type=submit]").first.click()
    studio.page.locator(".study .ranks").wait_for()
    yield "delays"
    page.locator("#map").focus()
    page.keyboard.press("?")
    page.locator(".keys").wait_for()
    yield "help"


def _plan(studio: StudioPage, planner: str, seconds: int) -> None:
    """Fill the form and begin a run."""
    studio.page.click("#tab-plan")
    studio.page.select_option("#planner", planner)
    studio.page.fill("#limit", str(seconds))
    studio.page.locator(".settings [type=submit]").click()


def _back(studio: StudioPage) -> None:
    """Show the start again."""
    studio.page.locator(".file button").first.click()
    studio.page.locator(".start").wait_for()


def _open(studio: StudioPage, name: str) -> None:
    """Open a file of the folder."""
    _back(studio)
    studio.page.locator(".shelf button.open").filter(has_text=name).last.click()
    studio.opened()


def _unfold(studio: StudioPage, name: str) -> None:
    """Open a part of the panel that is folded."""
    folded = studio.page.locator(f"details.{name}:not([open]) > summary")
    if folded.count():
        folded.first.click()
