"""Drawing in the browser: walls, robots, lanes, undo, keys, tables, drafts; nothing is planned."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote, urljoin

import pytest

from rightofway import load, solve, write_plan
from tests.builders.browsers import needs_browser
from tests.builders.drawing import StudioPage, studio_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Route

    from tests.builders.studios import Client

pytestmark = needs_browser

LAYOUTS = Path(__file__).parents[1] / "data" / "layouts"


def obstacles(studio: StudioPage) -> list[list[float]]:
    """Return the rectangles that are blocked."""
    return [each["rect"] for each in studio.document["map"]["floor"]["obstacles"]]


def test_a_wall_is_one_rectangle_and_a_door_splits_it(floor: StudioPage) -> None:
    floor.drag((7.25, 0.25), (7.25, 7.75))
    assert obstacles(floor) == [[7, 0, 0.5, 8]]
    floor.button("Door").click()
    floor.press((7.25, 3.75))
    assert obstacles(floor) == [[7, 0, 0.5, 3.5], [7, 4, 0.5, 4]]


def test_a_block_is_moved_copied_and_deleted(floor: StudioPage) -> None:
    floor.button("Block").click()
    floor.drag((2.25, 2.25), (3.25, 2.75))
    assert obstacles(floor) == [[2, 2, 1.5, 1]]
    floor.button("Select and move").click()
    floor.drag((2.75, 2.25), (4.75, 5.25))
    assert obstacles(floor) == [[4, 5, 1.5, 1]]
    floor.page.keyboard.press("Control+d")
    floor.settle()
    assert obstacles(floor) == [[4, 5, 1.5, 1], [4.5, 5.5, 1.5, 1]]
    floor.page.keyboard.press("Delete")
    floor.settle()
    assert obstacles(floor) == [[4, 5, 1.5, 1]]


def test_everything_is_undone_and_done_again(floor: StudioPage) -> None:
    empty = floor.document
    floor.drag((1.25, 1.25), (3.25, 1.25))
    floor.drag((1.25, 3.25), (3.25, 3.25))
    full = floor.document
    for _ in range(2):
        floor.page.keyboard.press("Control+z")
    floor.settle()
    assert floor.document == empty
    for _ in range(2):
        floor.page.keyboard.press("Control+Shift+z")
    floor.settle()
    assert floor.document == full


def test_an_adaptive_floor_is_drawn_on_in_steps_of_its_smallest_cell(studio: StudioPage) -> None:
    studio.page.get_by_label("Larger cells in open space").check()
    studio.button("Create the floor").click()
    studio.opened()
    studio.drag((6.25, 0.25), (6.25, 4.75))
    assert obstacles(studio) == [[6, 0, 0.5, 5]]
    assert "fault" not in studio.text(".status")


def test_walls_and_robots_are_made_with_the_keyboard_alone(floor: StudioPage) -> None:
    page = floor.page
    page.locator("canvas#map").focus()
    for key in ("ArrowDown", "ArrowDown", "Enter", "ArrowRight", "ArrowRight", "Enter"):
        page.keyboard.press(key)
    floor.settle()
    assert obstacles(floor) == [[0, 0.5, 1.5, 0.5]]
    page.keyboard.press("a")  # place robots
    for key in ("ArrowUp", "Enter", "Shift+ArrowRight", "Enter"):
        page.keyboard.press(key)
    floor.settle()
    (robot,) = floor.document["robots"]
    assert robot == {
        "name": "R1", "home": {"x": 1.25, "y": 0.25}, "target": {"x": 3.75, "y": 0.25},
    }  # fmt: skip


def test_a_robot_is_dragged_and_a_wall_over_its_home_is_a_fault_on_the_map(
    floor: StudioPage,
) -> None:
    floor.tab("Robots")
    floor.press((1.25, 1.25))
    floor.press((5.25, 1.25))
    floor.button("Select and move").click()
    floor.drag((1.25, 1.25), (2.25, 3.25))
    assert floor.document["robots"][0]["home"] == {"x": 2.25, "y": 3.25}
    floor.button("Wall").click()
    floor.drag((2.25, 2.25), (2.25, 4.25))
    assert floor.page.get_by_label("Home, R1").get_attribute("aria-invalid") == "true"
    assert "1 fault" in floor.text(".status")


def test_rows_of_a_spreadsheet_become_robots(floor: StudioPage) -> None:
    floor.tab("Robots")
    floor.page.get_by_label("Name, new robot").evaluate(
        """(area) => {
          const clipboardData = new DataTransfer();
          clipboardData.setData("text", "name\\thome\\tstops\\twork\\tspeed\\n"
            + "porter\\t0.75, 0.75\\t10.75, 3.25\\t5\\t1\\n"
            + "runner\\t0.75, 7.25\\t2.25, 4.25; 8.25, 6.25\\t2\\t1/2\\n");
          area.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true }));
        }"""
    )
    floor.settle()
    assert floor.document["robots"] == [
        {
            "name": "porter", "home": {"x": 0.75, "y": 0.75}, "target": {"x": 10.75, "y": 3.25},
            "work": 5, "speed": 1,
        },
        {
            "name": "runner", "home": {"x": 0.75, "y": 7.25}, "speed": "1/2",
            "stops": [
                {"at": {"x": 2.25, "y": 4.25}, "work": 2},
                {"at": {"x": 8.25, "y": 6.25}, "work": 2},
            ],
        },
    ]  # fmt: skip
    assert floor.page.get_by_role("alert").count() == 0


def test_a_column_is_filled_down_and_sorted(floor: StudioPage) -> None:
    floor.tab("Robots")
    floor.page.get_by_text("Robots at random").click()
    floor.button("Add them").click()
    assert len(floor.document["robots"]) == 5
    speed = floor.page.get_by_label("Speed, R1", exact=True)
    speed.fill("2")
    speed.press("Enter")
    floor.page.get_by_label("Speed, R1", exact=True).press("Control+d")
    floor.settle()
    assert [robot["speed"] for robot in floor.document["robots"]] == [2] * 5
    for _ in range(2):
        floor.page.locator("table.robots thead").get_by_role("button", name="Name").click()
    assert [robot["name"] for robot in floor.document["robots"]] == ["R5", "R4", "R3", "R2", "R1"]


def test_a_random_fleet_is_the_same_for_the_same_seed(floor: StudioPage) -> None:
    floor.tab("Robots")
    floor.page.get_by_text("Robots at random").click()
    floor.button("Add them").click()
    first = floor.document["robots"]
    floor.page.locator("h1").click()
    floor.page.keyboard.press("Control+z")
    floor.settle()
    floor.page.get_by_label("Seed").fill("1")
    floor.button("Add them").click()
    assert floor.document["robots"] == first
    assert len(first) == 5
    assert floor.page.get_by_role("alert").count() == 0


def test_lanes_stations_limits_zones_and_closures_are_drawn(lanes: StudioPage) -> None:
    lanes.press((4, 0))
    lanes.press((4, 3))
    lanes.press((4, 3))  # ends the chain
    lanes.button("Station").click()
    lanes.press((4, 3))
    lanes.press((0, 0), "Shift")
    lanes.button("Select and move").click()
    lanes.press((4, 1.5))
    page = lanes.page
    page.get_by_label("Speed limit").fill("0.5")
    page.get_by_label("Speed limit").press("Enter")
    lanes.settle()
    page.get_by_label("closed").check()
    lanes.button("Make a zone of the selection").click()
    lanes.settle()
    document = lanes.document
    assert document["map"]["roadmap"] == {
        "vertices": {"V1": [0, 0], "V2": [4, 0], "V3": [4, 3]},
        "edges": [["V1", "V2"], {"from": "V2", "to": "V3", "max_speed": 0.5}],
        "stations": {"S1": "V3"},
        "parking": ["V1"],
        "zones": [{"name": "zone 1", "vertices": [], "edges": [["V2", "V3"], ["V3", "V2"]]}],
    }
    assert document["closures"] == [{"edge": ["V2", "V3"]}]
    assert "fault" not in lanes.text(".status")


def test_a_vertex_is_moved_renamed_and_deleted_with_all_that_names_it(lanes: StudioPage) -> None:
    lanes.press((4, 0))
    lanes.press((4, 3))
    lanes.button("Select and move").click()
    lanes.drag((4, 3), (2, 3))
    lanes.page.get_by_label("Name", exact=True).fill("Dock")
    lanes.page.get_by_label("Name", exact=True).press("Enter")
    lanes.settle()
    roadmap = lanes.document["map"]["roadmap"]
    assert roadmap["vertices"] == {"V1": [0, 0], "V2": [4, 0], "Dock": [2, 3]}
    assert roadmap["edges"] == [["V1", "V2"], ["V2", "Dock"]]
    lanes.button("Delete").click()
    lanes.settle()
    assert lanes.document["map"]["roadmap"]["edges"] == [["V1", "V2"]]


def test_what_is_not_saved_is_there_after_the_page_was_closed(floor: StudioPage) -> None:
    floor.drag((1.25, 1.25), (3.25, 1.25))
    drawn = floor.document
    floor.settle()  # and the draft is kept
    floor.page.goto(urljoin(floor.page.url, "/"))
    floor.page.locator("section[aria-labelledby=drafts-title] button").first.click()
    floor.opened()
    assert floor.document == drawn


def drafts(studio: StudioPage) -> dict[str, Any]:
    """Return the documents of all drafts that are kept."""
    names = [draft["name"] for draft in studio.api("drafts")["drafts"]]
    return {name: studio.api(f"drafts/{quote(name)}")["document"] for name in names}


def test_two_pages_on_one_draft_lose_nothing(floor: StudioPage) -> None:
    """The second page draws first; the first one is asked, keeps its own, then loads the other."""
    floor.drag((1.25, 1.25), (3.25, 1.25))
    floor.settle()  # and the draft is kept
    (name,) = drafts(floor)
    other = StudioPage(floor.page.context.new_page(), floor.page.url)
    other.opened()  # it has the same address
    other.page.locator("[data-tool=line]").click()
    other.drag((1.25, 3.25), (3.25, 3.25))
    other.settle()  # and the draft is kept
    floor.drag((1.25, 5.25), (3.25, 5.25))
    choice = floor.page.get_by_role("alert").filter(has=floor.button("Keep mine as a copy"))
    choice.wait_for()
    floor.button("Keep mine as a copy").click()
    choice.wait_for(state="detached")
    floor.settle()
    kept = drafts(floor)
    assert len(kept) == 2
    assert kept[name] == other.document
    assert floor.document in kept.values()
    other.drag((1.25, 6.25), (3.25, 6.25))
    assert not other.page.get_by_role("alert").count()
    floor.go("draft", name)
    assert len(obstacles(floor)) == 3


def test_saving_leaves_the_draft_of_another_page(floor: StudioPage) -> None:
    floor.drag((1.25, 1.25), (3.25, 1.25))
    floor.settle()  # and the draft is kept
    (name,) = drafts(floor)
    other = {"map": {"grid": ["..."]}}
    floor.put(f"drafts/{quote(name)}", {"document": other})
    floor.button("Save").click()
    floor.saved()
    assert drafts(floor) == {name: other}


def test_a_floor_is_saved_under_a_name(floor: StudioPage, site: Client) -> None:
    floor.page.get_by_label("Name of the file").fill("drawn.yaml")
    floor.page.get_by_label("Name of the file").press("Enter")
    floor.button("Save").click()
    floor.saved()
    assert "size: [12, 8]" in (site.folder / "drawn.yaml").read_text()


def test_findings_are_listed_and_lit_on_the_map(studio: StudioPage) -> None:
    studio.page.get_by_role("button", name="bay.yaml").click()
    studio.opened()
    studio.page.locator(".findings button").first.click()
    assert studio.lit()


def _hold_one(held: list[Route], route: Route) -> None:
    """Keep the first request of a page waiting, and no other one."""
    if held:
        route.continue_()
    else:
        held.append(route)


def test_a_picture_below_a_roadmap_gets_scale_and_origin_by_presses(lanes: StudioPage) -> None:
    png = LAYOUTS.parents[2] / "docs" / "images" / "door.png"

    held: list[Route] = []
    lanes.page.route("**/files/door.png", lambda route: _hold_one(held, route))
    lanes.tab("Map")
    lanes.page.get_by_label("Choose a picture to draw over").set_input_files(png)
    lanes.poll(lambda: held, "the page asks for the picture")
    lanes.settle()  # all else has been said of the map
    held[0].continue_()
    lanes.button("Scale by two places").wait_for()
    lanes.settle()
    before = lanes.document["map"]["picture"]
    assert before["file"] == "door.png"
    lanes.button("Scale by two places").click()
    lanes.press((1, 0))
    lanes.press((3, 0))
    lanes.page.get_by_label("Their distance").fill("4")
    lanes.button("Apply").click()
    lanes.settle()
    scaled = lanes.document["map"]["picture"]
    assert scaled["scale"] == pytest.approx(2 * before["scale"], rel=0.02)
    lanes.button("Set the origin").click()
    lanes.press((1, 0))
    moved = lanes.document["map"]["picture"]["origin"]
    assert moved[0] == pytest.approx(scaled["origin"][0] - 1, abs=0.02)
    assert lanes.complaints == []


def test_a_plan_file_is_opened_played_and_its_scenario_changed(
    studio: StudioPage, site: Client
) -> None:
    write_plan(solve(load(site.folder / "door.yaml"), time_limit=2), site.folder / "door-plan.json")
    studio.page.reload()
    studio.page.get_by_role("button", name="door-plan.json").click()
    studio.planned()
    slider = studio.page.get_by_role("slider", name="Time")
    assert float(slider.get_attribute("max") or 0) > 0
    studio.tab("Map")
    assert studio.document["map"]["grid"] == ["...", "@.@", "..."]
    assert studio.complaints == []


def test_a_finger_draws_and_a_floor_in_cells_of_the_paper_is_erased(
    browser: Browser, site: Client
) -> None:
    site.studio.file = "floor.yaml"
    size = {"width": 1024, "height": 768}
    with studio_page(browser, site, has_touch=True, viewport=size) as studio:
        studio.opened()
        studio.button("Erase").tap()
        studio.page.touchscreen.tap(*studio.where((7.25, 6.25)))
        studio.settle()
        walls = [each["rect"] for each in studio.document["map"]["floor"]["obstacles"][:3]]
        assert walls == [[7, 0, 0.5, 3], [7, 4, 0.5, 2], [7, 6.5, 0.5, 1.5]]
        assert studio.complaints == []


def test_blocked_cells_of_a_grid_are_moved_copied_and_deleted(studio: StudioPage) -> None:
    grid = {"grid": ["@@....", "......", "......", "......"]}
    document = {"format": "rightofway-scenario/1", "map": grid, "robots": []}
    studio.draw(document)
    studio.drag((0.1, 1.9), (2.4, 0.1))  # a box round both
    studio.drag((0.5, 0.5), (3.5, 2.5))
    assert studio.document["map"]["grid"] == ["......", "......", "...@@.", "......"]
    studio.page.keyboard.press("Control+d")
    studio.settle()
    assert studio.document["map"]["grid"] == ["......", "......", "...@@.", "....@@"]
    studio.page.keyboard.press("Delete")
    studio.settle()
    assert studio.document["map"]["grid"] == ["......", "......", "...@@.", "......"]


def test_undo_in_a_field_that_is_written_undoes_the_last_change(floor: StudioPage) -> None:
    floor.tab("Robots")
    floor.press((1.25, 1.25))
    floor.press((5.25, 1.25))
    speed = floor.page.get_by_label("Speed, R1")
    speed.fill("2")
    speed.press("Tab")
    floor.settle()
    assert floor.document["robots"][0]["speed"] == 2
    floor.page.keyboard.press("Control+z")
    floor.settle()
    assert "speed" not in floor.document["robots"][0]
