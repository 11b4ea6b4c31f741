"""The page as a live part of a notebook."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from rightofway.viz.page.document import make_payload_text
from rightofway.viz.page.widget import make_widget_module
from tests.builders.browsers import expect
from tests.builders.plans import door

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

RENDER = """async ([code, payload]) => {
  const module = await import(URL.createObjectURL(new Blob([code], { type: "text/javascript" })));
  for (let cell = 0; cell < 2; cell++) {
    const el = document.body.appendChild(document.createElement("div"));
    module.default.render({ model: { get: () => payload }, el });
  }
}"""
"""Show a plan in two cells of a notebook."""


@pytest.fixture
def notebook(browser: Browser) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1200, "height": 1500}, reduced_motion="reduce")
    page = context.new_page()
    complaints: list[str] = []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.evaluate(RENDER, [make_widget_module(), make_payload_text(door())])
    page.wait_for_selector(".row:has-text('R2') >> nth=0")
    yield page
    assert complaints == []
    context.close()


def test_cells_show_the_page_without_a_frame(notebook: Page) -> None:
    assert notebook.locator("iframe").count() == 0
    assert notebook.locator("#headline").all_inner_texts() == ["2 robots", "2 robots"]
    boxes = [notebook.locator("canvas#map").nth(cell).bounding_box() for cell in (0, 1)]
    assert [box["width"] > 500 and box["height"] > 200 for box in boxes if box] == [True, True]


def test_each_cell_has_its_own_time_and_choice(notebook: Page) -> None:
    first, second = (notebook.locator(".page").nth(cell) for cell in (0, 1))
    first.locator("#robot-list .row:has-text('R1')").click()
    first.locator("#slider").fill("4")
    assert first.locator("#card h2").inner_text() == "R1"
    assert not second.locator("#card").is_visible()
    assert second.locator("#readout").inner_text() == "0 of 10"


def test_keys_work_in_the_cell_that_has_the_focus(notebook: Page) -> None:
    first, second = (notebook.locator(".page").nth(cell) for cell in (0, 1))
    second.locator("#robot-list").focus()
    notebook.keyboard.press("ArrowRight")
    expect(second.locator("#readout")).to_have_text("1 of 10")
    assert first.locator("#readout").inner_text() == "0 of 10"
