"""Editing as in other drawing programs: curves, pictures, the clipboard, menus, fingers."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from PIL import Image

from tests.builders.browsers import needs_browser
from tests.builders.drawing import StudioPage, studio_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser, CDPSession

    from tests.builders.studios import Client

pytestmark = needs_browser


def wanted(lanes: StudioPage) -> list[Any]:
    """Return the lanes that are drawn."""
    edges: list[Any] = lanes.document["map"]["roadmap"]["edges"]
    return edges


def test_a_lane_is_bent_by_the_handle_at_its_middle_and_straightened(lanes: StudioPage) -> None:
    lanes.button("Select and move").click()
    lanes.press((2, 0))
    lanes.drag((2, 0), (2, -1))
    assert wanted(lanes) == [{"from": "V1", "to": "V2", "curve": [[2, -2]]}]
    lanes.press((2, -1))
    lanes.drag((2, -1), (2, 0))
    assert wanted(lanes) == [["V1", "V2"]]
    lanes.page.keyboard.press("Control+z")
    lanes.settle()
    lanes.page.get_by_label("Shape").select_option("S-curve")
    lanes.settle()
    assert len(wanted(lanes)[0]["curve"]) == 2
    assert lanes.complaints == []


def test_a_curve_goes_with_its_ends_and_is_split_by_a_vertex(lanes: StudioPage) -> None:
    lanes.button("Select and move").click()
    lanes.press((2, 0))
    lanes.drag((2, 0), (2, -1))
    lanes.press((2, -1))
    lanes.page.keyboard.press("Shift+ArrowRight")
    lanes.settle()
    roadmap = lanes.document["map"]["roadmap"]
    (far, _), (control, _) = roadmap["vertices"]["V1"], roadmap["edges"][0]["curve"][0]
    assert far > 0
    assert control == pytest.approx(far + 2)
    lanes.button("Vertex").click()
    lanes.press((far + 2, -1))
    first, second = wanted(lanes)
    assert (first["from"], first["to"], second["to"]) == ("V1", "V3", "V2")
    assert first["curve"][0] == pytest.approx([far + 1, -1], abs=0.15)


def test_a_picture_is_saved_with_the_floor_and_is_there_in_another_browser(
    floor: StudioPage, site: Client, browser: Browser, tmp_path: Path
) -> None:
    picture = tmp_path / "hall plan.png"
    Image.new("L", (240, 160), 180).save(picture)
    floor.tab("Map")
    floor.page.get_by_label("Choose a picture to draw over").set_input_files(picture)
    floor.button("Scale by two places").wait_for()
    assert floor.document["map"]["picture"] == {"file": "hall plan.png"}
    floor.page.get_by_label("Name of the file").fill("pictured.yaml")
    floor.page.get_by_label("Name of the file").press("Enter")
    floor.saved()
    assert (site.folder / "hall plan.png").read_bytes() == picture.read_bytes()
    other = StudioPage(browser.new_context(locale="en-GB").new_page(), floor.page.url)
    other.opened()  # it has the same address
    other.button("Scale by two places").wait_for()
    survey = other.post("survey", {"document": other.document, "inspects": False})
    place = survey["site"]["map"]["background"]
    # 240 x 160 pixels on 12 x 8 m in cells of 0.5 m: half a cell before the middle of the first one
    assert (place["x"], place["width"], place["height"]) == (-0.5, 24, 16)
    other.page.context.close()


def test_a_place_is_closed_for_a_while_from_the_menu_of_the_map(floor: StudioPage) -> None:
    floor.page.mouse.click(*floor.where((2.25, 2.25)), button="right")
    menu = floor.page.get_by_role("menu")
    menu.get_by_label("closed").check()
    menu.get_by_label("from").fill("3")
    menu.get_by_label("until").fill("8")
    menu.get_by_label("until").press("Enter")
    floor.settle()
    assert floor.document["closures"] == [{"at": {"x": 2.25, "y": 2.25}, "from": 3, "until": 8}]
    menu.get_by_label("closed").uncheck()
    floor.settle()
    assert "closures" not in floor.document
    floor.page.keyboard.press("Escape")
    assert menu.count() == 0


def test_what_if_closes_the_place_that_is_pressed_on_the_map(studio: StudioPage) -> None:
    studio.go("file", "door.yaml")
    studio.page.keyboard.press("Control+Enter")
    studio.planned()
    studio.button("Close a place on the map").click()
    studio.page.mouse.click(*studio.where((1.5, 2.5)))
    assert studio.document["closures"] == [{"at": "N7"}]


def test_a_piece_goes_to_another_tab_by_the_clipboard(floor: StudioPage) -> None:
    floor.drag((2.25, 2.25), (2.25, 3.75))
    floor.button("Select and move").click()
    floor.press((2.25, 3.25))
    floor.page.keyboard.press("Control+c")
    other = StudioPage(floor.page.context.new_page(), floor.page.url.split("#")[0])
    other.button("Create the floor").click()
    other.opened()
    other.page.mouse.move(*other.where((8.25, 5.25)))
    other.page.keyboard.press("Control+v")
    other.settle()
    (wall,) = other.document["map"]["floor"]["obstacles"]
    assert wall["rect"] == [8, 4.5, 0.5, 2]
    other.page.keyboard.press("Control+x")
    other.settle()
    assert other.document["map"]["floor"]["obstacles"] == []
    assert other.complaints == []


def test_keys_copy_keep_to_an_axis_nudge_and_turn(floor: StudioPage) -> None:
    def rects() -> list[list[float]]:
        return [each["rect"] for each in floor.document["map"]["floor"]["obstacles"]]

    keyboard = floor.page.keyboard
    floor.drag((2.25, 2.25), (2.25, 3.75))
    floor.button("Select and move").click()
    keyboard.down("Alt")
    floor.drag((2.25, 3.25), (5.25, 3.25))
    keyboard.up("Alt")
    assert rects() == [[2, 2, 0.5, 2], [5, 2, 0.5, 2]]
    keyboard.down("Shift")
    floor.drag((5.25, 3.25), (8.25, 3.75))
    keyboard.up("Shift")
    assert rects()[1] == [8, 2, 0.5, 2]
    keyboard.press("ArrowDown")
    keyboard.press("Shift+ArrowRight")
    floor.settle()
    assert rects()[1] == [10.5, 2.5, 0.5, 2]
    floor.button("Turn").click()
    floor.settle()
    assert rects()[1][2:] == [2, 0.5]
    assert rects()[0] == [2, 2, 0.5, 2]


def readout(floor: StudioPage) -> str | None:
    """Return what stands beside the pointer while something is drawn."""
    floor.settle()
    return floor.page.locator(".holder").get_attribute("data-readout")


def test_a_readout_says_how_long_a_wall_is_while_it_is_drawn(floor: StudioPage) -> None:
    mouse = floor.page.mouse
    mouse.move(*floor.where((2.25, 2.25)))
    mouse.down()
    mouse.move(*floor.where((5.25, 2.25)), steps=4)
    assert readout(floor) == "3.5 m"
    mouse.up()
    floor.settle()
    floor.button("Measure").click()
    mouse.move(*floor.where((2, 2)))
    mouse.down()
    mouse.move(*floor.where((5.5, 2)), steps=4)
    mouse.up()
    assert readout(floor) == "3.5 m"


def test_erasing_over_a_robot_says_how_it_is_deleted(floor: StudioPage) -> None:
    floor.tab("Robots")
    floor.press((1.25, 1.25))
    floor.press((5.25, 1.25))
    floor.tab("Map")
    floor.button("Erase").click()
    floor.press((1.25, 1.25))
    assert "press Delete" in floor.text(".status")


def touched(session: CDPSession, kind: str, *points: tuple[float, float]) -> None:
    """Send where the fingers are."""
    at = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
    session.send("Input.dispatchTouchEvent", {"type": f"touch{kind}", "touchPoints": at})


@pytest.mark.parametrize(("width", "height"), [(1024, 768), (768, 1024)])
def test_fingers_draw_zoom_and_rest_for_the_menu(
    browser: Browser, empty: Client, width: int, height: int
) -> None:
    size = {"width": width, "height": height}
    with studio_page(browser, empty, has_touch=True, viewport=size) as studio:
        studio.button("Create the floor").tap()
        studio.opened()
        session = studio.page.context.new_cdp_session(studio.page)
        (x, y), (end, _) = studio.where((2.25, 2.25)), studio.where((6.25, 2.25))
        touched(session, "Start", (x, y))
        for step in range(1, 5):
            touched(session, "Move", (x + (end - x) * step / 4, y))
        touched(session, "End")
        studio.settle()
        assert studio.document["map"]["floor"]["obstacles"] == [{"rect": [2, 2, 4.5, 0.5]}]
        scale = studio.scale
        x, y = studio.where((6, 5))
        touched(session, "Start", (x - 40, y), (x + 40, y))
        for step in range(1, 5):
            touched(session, "Move", (x - 40 - 10 * step, y), (x + 40 + 10 * step, y))
        touched(session, "End")
        studio.settle()
        assert studio.scale == pytest.approx(2 * scale, rel=0.1)
        touched(session, "Start", studio.where((5.75, 5.25)))
        studio.page.get_by_role("menu").get_by_label("closed").wait_for()
        touched(session, "End")
        assert len(studio.document["map"]["floor"]["obstacles"]) == 1
        small = studio.page.evaluate(
            "[...document.querySelectorAll('button')].filter((each) => each.offsetParent"
            " && each.getBoundingClientRect().height < 44).map((each) => each.textContent)"
        )
        assert small == []


def test_a_brush_keeps_its_pace_on_a_floor_of_38400_cells(studio: StudioPage) -> None:
    floor = {"floor": {"size": [60, 40], "obstacles": []}, "cell_size": 0.25}
    document = {"format": "rightofway-scenario/1", "map": floor, "robots": []}
    studio.draw(document)
    studio.button("Brush").click()
    mouse = studio.page.mouse
    mouse.move(*studio.where((5, 20)))
    mouse.down()
    spent = studio.page.evaluate(
        """async () => {
          const holder = document.querySelector(".holder");
          const { left, top } = holder.getBoundingClientRect();
          let work = 0;
          for (let i = 0; i < 200; i++) {
            const at = performance.now();
            const move = { clientX: left + 100 + 2 * i, clientY: top + 200 + 60 * Math.sin(i / 9),
              pointerId: 1, bubbles: true, buttons: 1 };
            holder.dispatchEvent(new PointerEvent("pointermove", move));
            work += performance.now() - at;
          }
          return work / 200;
        }"""
    )
    assert spent < 2  # milliseconds for each move of the pointer
    mouse.up()
    studio.settle()
    assert studio.page.get_by_role("alert").count() == 0
