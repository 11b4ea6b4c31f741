"""The page in the language of the browser, of the address, or that was chosen."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from rightofway.io.sites import Choice, read_sites
from rightofway.metrics import inspect
from rightofway.viz import write_inspection
from tests.builders.browsers import Viewer, needs_browser
from tests.builders.languages import english_on
from tests.builders.planned_jobs import make_plan
from tests.builders.plans import (
    counter,
    counter_late,
    counter_steady,
    crowd,
    door,
    door_shifted,
    yard,
)
from tests.builders.players import Player
from tests.viewer.conftest import Opener

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = needs_browser

NAMES = ("press",)
"""Names of stations."""


def states_of(viewer: Player) -> Iterator[str]:
    """Choose what can be chosen, one thing after the other; yield each time what it was."""
    for tab in viewer.page.get_by_role("tab").all():
        if not tab.is_visible():
            continue
        tab.click()
        shown = viewer.page.get_by_role("tabpanel").get_by_role("option")
        for row in shown.all()[:3]:
            row.click()
            yield f"{tab.inner_text()}: {row.inner_text()}"
    viewer.seek(viewer.end / 2)
    yield "half of the time"
    for key in "hsclbff":
        viewer.press(key)
        yield f"key {key}"
    viewer.lay_on_paper()
    yield "paper"


@pytest.mark.parametrize(
    "opened",
    [
        lambda opener: opener(door(), title="door", locale="de-DE"),
        lambda opener: opener(crowd(80, decisions=3), title="crowd", locale="de-DE"),
        lambda opener: opener(yard(), title="yard", locale="de-DE"),
        lambda opener: opener(counter(), steady=[counter_steady()], title="bay", locale="de-DE"),
        lambda opener: opener(counter(), actual=counter_late(), title="bay", locale="de-DE"),
        lambda opener: opener(make_plan(), title="shift", locale="de-DE"),
        lambda opener: opener(door(), title="A", others=[(door_shifted(2), "B")], locale="de-DE"),
    ],
    ids=["decisions", "many", "sizes", "laps", "floor", "jobs", "compared"],
)
def test_no_state_of_the_page_says_an_english_word_to_a_german(
    show: Opener, opened: Callable[[Opener], Player]
) -> None:
    viewer = opened(show)
    assert viewer.page.locator("html").get_attribute("lang") == "de"
    assert english_on(viewer, *NAMES) == []
    for state in states_of(viewer):
        viewer.painted()
        assert english_on(viewer, *NAMES) == [], state
    assert viewer.complaints == []


def test_the_page_of_an_inspection_says_findings_in_german(
    browser: Browser, tmp_path: Path
) -> None:
    (tmp_path / "nodes.csv").write_text("name,x,y\nA,0,0\nB,8,0\nC,4,-4\nD,4,4\nE,6,4\nF,9,9\n")
    (tmp_path / "edges.csv").write_text("from,to,both_ways\nA,B,true\nC,D,true\nB,D,true\nE,D,0\n")
    found = read_sites(tmp_path / "nodes.csv", Choice())
    levels = [(name, site, inspect(site)) for name, site in found.sites]
    write_inspection(levels, tmp_path / "site.html", title="hall", description=found.description)
    context = browser.new_context(locale="de-DE")
    viewer = Viewer(context.new_page())
    viewer.page.goto((tmp_path / "site.html").as_uri())
    viewer.painted()
    assert english_on(viewer) == []
    assert "kreuzen sich ohne Knoten" in viewer.text("#finding-list")
    context.close()


def test_the_address_and_the_choice_say_the_language(show: Opener) -> None:
    viewer = show(door(), "#tick=3", title="door", locale="en-GB")
    assert viewer.text("#tab-robots").startswith("Robots")
    with viewer.page.expect_navigation(url=re.compile("lang=de")):
        viewer.page.locator("#language").select_option("de")
    assert viewer.text("#tab-robots").startswith("Roboter")
    assert viewer.tick == 3
    assert "lang=de" in viewer.page.url


def test_a_language_that_is_not_known_is_english(show: Opener) -> None:
    viewer = show(door(), title="door", locale="fr-FR")
    assert viewer.text("#tab-robots").startswith("Robots")
