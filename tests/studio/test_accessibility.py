"""What axe finds on the pages: nothing serious, in both themes and both languages."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from rightofway.io import load
from rightofway.solve import solve
from rightofway.viz import write_page
from tests.builders.accessibility import PACKAGE, serious
from tests.builders.browsers import Viewer, needs_browser
from tests.builders.drawing import studio_page
from tests.builders.states import EXAMPLES, examples, states

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.builders.studios import Client

pytestmark = [
    needs_browser,
    pytest.mark.skipif(not find_spec(PACKAGE), reason="there is no axe"),
]

THEMES, LANGUAGES = ("light", "dark"), ("en", "de")


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("theme", THEMES)
def test_no_state_of_the_studio_has_a_serious_fault(
    browser: Browser, empty: Client, theme: Any, language: str
) -> None:
    examples(empty.folder)
    with studio_page(browser, empty, locale=language, color_scheme=theme) as studio:
        found = {state: serious(studio) for state in states(studio)}
    assert {state: faults for state, faults in found.items() if faults} == {}
    assert len(found) == 12
    assert studio.complaints == []


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("theme", THEMES)
def test_no_state_of_the_single_page_has_a_serious_fault(
    browser: Browser, tmp_path: Path, theme: Any, language: str
) -> None:
    write_page(solve(load(EXAMPLES / "bay.yaml")), tmp_path / "plan.html", title="bay")
    context = browser.new_context(
        locale=language, color_scheme=theme, reduced_motion="reduce",
        viewport={"width": 1280, "height": 800},
    )  # fmt: skip
    viewer = Viewer(context.new_page())
    viewer.page.goto((tmp_path / "plan.html").as_uri())
    viewer.page.locator("#slider").wait_for()
    found = {"overview": serious(viewer)}
    viewer.page.locator("#robots .row").first.click()
    viewer.page.locator("#card").wait_for()
    found["robot"] = serious(viewer)
    viewer.page.locator("#heat").click()
    viewer.page.locator("#heat-legend").wait_for()
    found["heat"] = serious(viewer)
    for tab in viewer.page.get_by_role("tab").all():
        tab.click()
        found[f"tab {tab.inner_text()}"] = serious(viewer)
    context.close()
    assert {state: faults for state, faults in found.items() if faults} == {}
    assert len(found) > 3
    assert viewer.complaints == []


def test_axe_sees_a_fault_that_is_there(browser: Browser, tmp_path: Path) -> None:
    (tmp_path / "wrong.html").write_text(
        "<!doctype html><html lang=en><title>x</title><main><h1>x</h1><button></button>"
        "<p style='color:#bbb;background:#fff'>faint</p></main></html>"
    )
    context = browser.new_context()
    viewer = Viewer(context.new_page())
    viewer.page.goto((tmp_path / "wrong.html").as_uri())
    assert [fault.split(":")[0] for fault in serious(viewer)] == ["button-name", "color-contrast"]
    context.close()


def test_a_floor_is_drawn_planned_and_exported_with_the_keyboard_alone(
    browser: Browser, empty: Client
) -> None:
    """A wall of two metres, two robots that pass it; no pointer is moved."""
    with studio_page(browser, empty) as studio:
        keyboard = studio.page.keyboard

        def press(*keys: str) -> None:
            for key in keys:
                keyboard.press(key)

        def go_to(selector: str) -> None:
            for _ in range(200):
                if studio.page.locator(":focus").and_(studio.page.locator(selector)).count():
                    return
                press("Tab")
            pytest.fail(f"Tab does not lead to {selector}")

        go_to(".start [type=submit]")
        press("Enter")
        studio.opened()
        go_to("#map")
        press("w", *["ArrowRight"] * 9, "Enter", *["ArrowDown"] * 4, "Enter")
        studio.settle()
        assert len(studio.document["map"]["floor"]["obstacles"]) == 1
        press("2")
        go_to("#map")
        for _ in range(2):
            press(*["ArrowLeft"] * 3, "Enter", *["ArrowRight"] * 6, "Enter")
            studio.settle()
            press("ArrowUp", *["ArrowLeft"] * 3)
        assert len(studio.document["robots"]) == 2
        press("Control+Enter")
        studio.planned()
        assert studio.is_plan()
        go_to("a[download][href*='export/html'], a[href*='export/html']")
        with studio.page.expect_download() as download:
            press("Enter")
        assert Path(download.value.path()).read_bytes().startswith(b"<!doctype html>")
        assert studio.complaints == []
