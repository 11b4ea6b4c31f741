"""A player is a part that a page makes any number of times, and takes away again."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from rightofway.metrics import Site, inspect
from rightofway.viz import make_inspection_page
from rightofway.viz.page.document import make_payload_text, make_style_sheet
from rightofway.viz.page.scripts import make_classic_script, order_scripts
from rightofway.viz.page.widget import WIDGET_STYLE
from tests.builders.browsers import expect
from tests.builders.payloads import payload_text_in
from tests.builders.plans import door, loop

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

PAGE = """<!doctype html><title>two</title>
<style>STYLE</style>
<button>End the first</button><button>Make the first</button>
<section class="page" aria-label="first" tabindex="-1"></section>
<section class="page" aria-label="second" tabindex="-1"></section>
<script type="module">
MODULES
const [one, other] = document.querySelectorAll(".page");
const [end, make] = document.querySelectorAll("body > button");
let first = createPlayer(one, FIRST);
createPlayer(other, SECOND);
end.addEventListener("click", () => first.destroy());
make.addEventListener("click", () => (first = createPlayer(one, FIRST)));
</script>"""
"""A page with two plans, as anyone would write it who has the modules."""


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1200, "height": 1500}, reduced_motion="reduce")
    page = context.new_page()
    complaints: list[str] = []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    parts = {
        "STYLE": re.sub(r":root|\bbody\b", ".page", make_style_sheet()) + WIDGET_STYLE,
        "MODULES": "\n".join(make_classic_script(name) for name in order_scripts("player/player")),
        "FIRST": json.dumps(json.loads(make_payload_text(door()))),
        "SECOND": json.dumps(json.loads(make_payload_text(loop()))),
    }
    page.set_content(re.sub("|".join(parts), lambda found: parts[found[0]], PAGE))
    yield page
    assert complaints == []
    context.close()


def test_players_of_two_plans_in_one_page_know_nothing_of_each_other(page: Page) -> None:
    first, second = (page.get_by_role("region", name=name) for name in ("first", "second"))
    robots = [each.get_by_role("listbox", name="Robots") for each in (first, second)]
    expect(robots[0].get_by_role("option")).to_have_count(2)
    before = second.get_by_role("status").all_inner_texts()
    assert before
    robots[0].get_by_role("option", name=re.compile("R1")).click()
    first.get_by_role("slider").fill("4")
    expect(first.get_by_role("heading", name="R1", exact=True)).to_be_visible()
    expect(first.get_by_text("4 of 10")).to_be_visible()
    assert second.get_by_role("status").all_inner_texts() == before
    assert robots[1].get_by_role("option", selected=True).count() == 0
    first.get_by_role("tab", name=re.compile("Decisions")).click()
    expect(first.get_by_role("tabpanel", name=re.compile("Decisions"))).to_be_visible()
    expect(second.get_by_role("tabpanel", name=re.compile("Robots"))).to_be_visible()


def test_names_of_one_player_are_given_by_its_own_parts(page: Page) -> None:
    expect(page.get_by_role("listbox", name="Robots")).to_have_count(2)
    names = [each.get_attribute("id") for each in page.locator("[id]").all()]
    assert len(names) > 80  # both players have them
    assert len(set(names)) == len(names)


def test_a_player_that_ends_leaves_its_element_empty_and_the_other_one_goes_on(page: Page) -> None:
    first, second = (page.get_by_role("region", name=name) for name in ("first", "second"))
    first.get_by_role("button", name="Play", exact=True).click()
    page.get_by_role("button", name="End the first").click()
    assert first.locator("*").count() == 0
    page.set_viewport_size({"width": 700, "height": 1500})  # nobody lays out what is gone
    second.get_by_role("listbox", name="Robots").focus()
    before = second.get_by_role("status").all_inner_texts()
    page.keyboard.press("ArrowRight")
    expect(second.get_by_role("status").first).not_to_have_text(before[0])
    page.get_by_role("button", name="Make the first").click()
    expect(first.get_by_text("0 of 10")).to_be_visible()
    first.get_by_role("slider").fill("4")
    expect(first.get_by_text("4 of 10")).to_be_visible()


INSPECTIONS = """<!doctype html><title>two</title>
<style>STYLE</style>
<button>End the first</button>
<section class="page" aria-label="first"></section>
<section class="page" aria-label="second"></section>
<script type="module">
MODULES
const [one, other] = document.querySelectorAll(".page");
const first = createInspection(one, PAYLOAD);
createInspection(other, PAYLOAD);
document.querySelector("button").addEventListener("click", () => first.destroy());
</script>"""


def test_an_inspection_is_a_part_too(browser: Browser) -> None:
    scenario = door().scenario
    site = Site(roadmap=scenario.roadmap, robots=scenario.robots, rules=scenario.rules)
    text = make_inspection_page([("", site, inspect(site))], title="door")
    scripts = order_scripts("player/inspection")
    parts = {
        "STYLE": re.sub(r":root|\bbody\b", ".page", make_style_sheet()) + WIDGET_STYLE,
        "MODULES": "\n".join(map(make_classic_script, scripts)),
        "PAYLOAD": payload_text_in(text),
    }
    context = browser.new_context(viewport={"width": 1200, "height": 1500})
    page = context.new_page()
    complaints: list[str] = []
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.set_content(re.sub("|".join(parts), lambda found: parts[found[0]], INSPECTIONS))
    first, second = (
        page.get_by_role("region", name=name, exact=True) for name in ("first", "second")
    )
    expect(first.get_by_role("heading", name="door")).to_be_visible()
    expect(second.get_by_role("heading", name="door")).to_be_visible()
    ids = page.locator("[id]").evaluate_all("all => all.map(({ id }) => id)")
    assert len(ids) == len(set(ids))
    page.get_by_role("button", name="End the first").click()
    expect(first).to_be_empty()
    expect(second.get_by_role("heading", name="door")).to_be_visible()
    assert complaints == []
    context.close()
