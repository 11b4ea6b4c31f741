"""What if: homes are dragged on a plan, values changed, places closed; planned at once."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import pytest

from tests.builders.browsers import expect, needs_browser
from tests.builders.drawing import Opener, StudioPage, begin, studio_page
from tests.builders.studios import BAY

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.builders.studios import Client

pytestmark = needs_browser

OPEN = """\
format: rightofway-scenario/1
map: {grid: [".....", ".....", ".....", "....."]}
robots:
  - {name: R1, home: N0, target: N19, work: 3}
  - {name: R2, home: N4, target: N15, work: 1}
"""

CORRIDOR = """\
format: rightofway-scenario/1
map: {grid: ["....."]}
robots: [{name: R1, home: N0, target: N4}]
closures: [{at: N2, until: 9}]
"""


AISLE = """\
format: rightofway-scenario/1
map: {grid: [".......", "@@@.@@@", "......."]}
robots:
  - {name: R1, home: N1, target: N18}
  - {name: R2, home: N4, target: N17}
  - {name: R3, home: N14, target: N3}
"""


def test_a_wait_has_all_its_decisions_with_their_figures(opened: Opener) -> None:
    """R1 waits 7 in N2: by the first decision 5 for R2, by the second one 2 more for R3."""
    studio = opened(AISLE)
    begin(studio, planner="two-level")
    wait = studio.page.get_by_role("listitem").filter(has_text="R1 waits 7 time units in N2")
    expect(wait).to_contain_text("R1 waits 5 time units in N2 and lets R2 go first")
    expect(wait).to_contain_text("R1 waits 2 time units in N2 and lets R3 go first")
    expect(wait.get_by_text("Conflicts left: ")).to_have_count(2)
    studio.tab("Map")
    expect(studio.page.get_by_role("heading", name="Faults and findings")).to_be_visible()


def test_the_other_robot_goes_first_and_the_difference_is_shown(opened: Opener) -> None:
    studio = opened(BAY)
    begin(studio)
    studio.planned()
    offered = studio.page.locator(".waits .framed").first
    robot = offered.inner_text().removeprefix("Let ").removesuffix(" go first")
    assert f"{robot} waits" in studio.text(".waits")
    offered.click()
    compared(studio, 2)
    assert studio.run(2)["kind"] == "flip"
    robots = studio.api("compare?run=1&run=2")["robots"]
    before, after = ({r["name"]: r["completion"][i] for r in robots} for i in (0, 1))
    assert after[robot] <= before[robot]
    assert before != after
    assert ("Earlier" in studio.text(".change")) or ("Later" in studio.text(".change"))


def test_a_change_of_a_robot_is_planned_at_once(opened: Opener) -> None:
    studio = opened(BAY)
    begin(studio)
    studio.planned()
    choose(studio, 0)
    speed = studio.chosen("R1").get_by_label("Speed", exact=True)
    speed.fill("2")
    speed.press("Tab")
    compared(studio, 2)
    assert studio.document["robots"][0]["speed"] == 2
    assert studio.run(2)["request"]["time_limit"] == 1
    assert "R1: speed 1 → 2" in studio.text(".change .edit")
    assert "R1" in studio.text(".change .gain")
    assert "The same route as before: " in studio.text(".change")
    assert studio.run(2)["request"]["start"] == 1
    studio.page.locator(".exports summary").click()
    assert "--start run-1.json" in studio.text(".command code")
    assert studio.chosen("R1").is_visible()  # it stays chosen
    speed.fill("fast")
    speed.press("Tab")
    studio.settle()
    fault = studio.post("validate", {"document": studio.document})["faults"][0]["message"]
    assert fault in studio.text(".ask [role=alert]")
    assert speed.get_attribute("aria-invalid") == "true"
    assert len(studio.runs) == 2
    studio.page.locator("[data-run='1'] .show").click()
    studio.shown(1)
    studio.button("Edit the scenario of this plan").click()
    studio.settle()
    assert "speed" not in studio.document["robots"][0]


def asked(opened: Opener, text: str, robot: int = 0) -> StudioPage:
    """Return the page with a plan, and a robot chosen on it."""
    studio = opened(text)
    begin(studio)
    studio.planned()
    choose(studio, robot)
    return studio


def choose(studio: StudioPage, robot: int) -> None:
    """Choose a robot of the plan by a press at its home, where it is at the start."""
    home = studio.document["robots"][robot]["home"]
    if isinstance(home, str):
        columns = len(studio.document["map"]["grid"][0])
        row, column = divmod(int(home[1:]), columns)
        place = (column + 0.5, row + 0.5)
    else:
        place = (home["x"], home["y"])
    studio.press(place)
    studio.chosen(f"R{robot + 1}").wait_for()


def compared(studio: StudioPage, run: int) -> None:
    """Wait until a run is shown, and its plan compared with the one before."""
    studio.shown(run)
    studio.page.locator(".change[aria-busy=false]").first.wait_for()


def cursor(studio: StudioPage, place: tuple[float, float]) -> str:
    """Return how the pointer looks over a place of the map."""
    studio.page.mouse.move(*studio.where(place))
    return looks(studio, "#map")


def looks(studio: StudioPage, selector: str) -> str:
    """Return how the pointer looks over an element."""
    studio.settle()
    style = "(it) => getComputedStyle(it).cursor"
    return str(studio.page.locator(selector).evaluate(style))


def test_a_home_that_is_dragged_on_a_plan_is_planned_at_once(opened: Opener) -> None:
    studio = asked(opened, BAY)
    before = studio.view()
    studio.drag((0.5, 0.5), (4.5, 1.5))
    compared(studio, 2)
    assert studio.document["robots"][0]["home"] == "N9"
    assert studio.run(2)["request"]["start"] == 1
    assert studio.run(2)["request"]["time_limit"] == 1
    assert "R1: home N0 → N9" in studio.text(".change .edit")
    assert studio.chosen("R1").is_visible()  # it stays chosen
    assert studio.view() == before  # the map has not moved
    expect(studio.page.locator(".change").first).to_be_in_viewport()
    studio.button("Put it back").click()
    studio.shown(1)
    assert studio.document["robots"][0]["home"] == "N0"
    assert studio.complaints == []


def test_an_undo_beside_a_plan_shows_the_plan_of_before(opened: Opener) -> None:
    studio = asked(opened, BAY)
    studio.drag((0.5, 0.5), (4.5, 1.5))
    compared(studio, 2)
    studio.page.keyboard.press("Control+z")
    studio.shown(1)
    expect(studio.page.locator(".change")).to_have_count(0)
    assert studio.document["robots"][0]["home"] == "N0"
    assert studio.chosen("R1").is_visible()
    studio.page.keyboard.press("Control+Shift+z")
    studio.shown(2)
    assert studio.document["robots"][0]["home"] == "N9"
    studio.settle()
    assert len(studio.runs) == 2
    assert studio.complaints == []


def test_each_stop_is_dragged_and_a_place_of_a_floor_is_a_point(opened: Opener) -> None:
    text = (
        "format: rightofway-scenario/1\n"
        "map: {floor: {size: [6, 4]}, cell_size: 1}\n"
        "units: {length: m, time: s}\n"
        "robots: [{name: R1, home: {x: 0.5, y: 0.5}, stops:"
        " [{at: {x: 2.5, y: 0.5}, work: 2}, {at: {x: 4.5, y: 0.5}}]}]\n"
    )
    studio = asked(opened, text)
    studio.drag((4.5, 0.5), (4.5, 2.5))
    compared(studio, 2)
    stops = [{"at": {"x": 2.5, "y": 0.5}, "work": 2}, {"at": {"x": 4.5, "y": 2.5}}]
    assert studio.document["robots"][0]["stops"] == stops
    expect(studio.chosen("R1").get_by_label("Stops")).to_have_value("2.5, 0.5 (2); 4.5, 2.5")


@pytest.mark.parametrize(
    ("place", "words"),
    [
        ((1.5, 0.5), "lies in N1, row 0, column 1, which is blocked by '@'"),
        ((2.5, 0.5), "N2 is the home of R1 already"),
        ((-2.5, 0.5), "is outside the map"),
    ],
    ids=["blocked", "taken", "outside"],
)
def test_a_place_that_no_home_can_be_at_is_refused_in_the_words_of_the_library(
    opened: Opener, place: tuple[float, float], words: str
) -> None:
    studio = asked(opened, BAY)
    before = studio.document
    studio.drag((0.5, 0.5), place)
    studio.page.locator(".status [role=alert]").wait_for()
    assert words in studio.text(".status")
    assert studio.document == before
    expect(studio.button("Undo")).to_be_disabled()
    assert len(studio.runs) == 1


def test_only_the_places_of_the_robot_that_is_chosen_are_dragged(opened: Opener) -> None:
    """All other drags move the map, and a press is one."""
    studio = asked(opened, BAY)
    assert cursor(studio, (0.5, 0.5)) == "move"
    assert cursor(studio, (2.5, 3.5)) == "move"  # its stop
    assert cursor(studio, (2.5, 0.5)) == "grab"  # the home of another one
    before, view = studio.document, studio.view()
    studio.drag((2.5, 0.5), (3.5, 1.5))
    assert studio.view() != view
    studio.page.keyboard.press("0")
    assert looks(studio, "#map")  # it is painted
    assert studio.view() == view
    studio.press((4.5, 0.5))
    assert studio.chosen("R3").is_visible()
    assert cursor(studio, (0.5, 0.5)) == "grab"
    studio.press((4.5, 0.5))
    assert studio.chosen("R3").is_visible()
    mouse = studio.page.mouse
    mouse.move(*studio.where((4.5, 0.5)))
    mouse.down()
    mouse.move(*studio.where((4.5, 1.5)), steps=4)
    assert looks(studio, ".holder") == "grabbing"
    studio.page.keyboard.press("Escape")
    mouse.up()
    studio.settle()
    assert studio.chosen("R3").is_visible()
    assert studio.document == before
    assert len(studio.runs) == 1
    assert studio.view() == view


def test_a_finger_chooses_a_robot_and_drags_its_home(browser: Browser, empty: Client) -> None:
    empty.studio.file = "floor.yaml"
    (empty.folder / "floor.yaml").write_text(BAY)
    with studio_page(browser, empty, has_touch=True) as studio:
        studio.opened()
        studio.tab("Plan")
        begin(studio)
        studio.planned()
        studio.page.touchscreen.tap(*studio.where((2.5, 0.5)))
        studio.chosen("R2").wait_for()
        fingers = studio.page.context.new_cdp_session(studio.page)

        def touch(kind: str, *places: tuple[float, float]) -> None:
            points = [dict(zip("xy", studio.where(place), strict=True)) for place in places]
            fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

        touch("touchStart", (2.5, 0.5))
        touch("touchMove", (2.5, 1.0))
        touch("touchMove", (4.5, 1.5))
        touch("touchEnd")
        compared(studio, 2)
        assert studio.document["robots"][1]["home"] == "N9"
        assert studio.complaints == []


def test_a_home_is_typed_instead_of_dragged(opened: Opener) -> None:
    studio = asked(opened, BAY)
    home = studio.page.locator(".ask").get_by_label("Home", exact=True)
    home.fill("N1")
    home.press("Enter")
    studio.page.locator(".ask [role=alert]").wait_for()
    assert home.get_attribute("aria-invalid") == "true"
    assert "blocked" in studio.text(".ask [role=alert]")
    home.fill("N9")
    home.press("Enter")
    compared(studio, 2)
    assert "R1: home N0 → N9" in studio.text(".change .edit")


def test_a_place_is_closed_for_a_while_and_opened_again(opened: Opener) -> None:
    studio = asked(opened, OPEN.replace("robots:", "units: {time: s}\nrobots:"))
    form = studio.page.locator(".close-place")
    assert "s" in form.get_by_label("until").locator("..").inner_text()
    form.get_by_label("Close the place").fill("N7")
    form.get_by_label("from").fill("1,5")
    form.get_by_label("until").fill("30")
    form.get_by_label("until").press("Enter")
    compared(studio, 2)
    assert studio.document["closures"] == [{"at": "N7", "from": 1.5, "until": 30}]
    assert form.get_by_label("until").input_value() == ""
    until = studio.page.get_by_label("N7: until")
    until.fill("1")
    until.press("Enter")
    studio.page.locator(".closures [role=alert]").wait_for()
    assert until.get_attribute("aria-invalid") == "true"
    assert studio.page.get_by_label("N7: from").get_attribute("aria-invalid") == "false"
    assert "1 is not after from, 3/2" in studio.text(".closures [role=alert]")
    until.fill("")
    until.press("Enter")
    compared(studio, 3)
    assert studio.document["closures"] == [{"at": "N7", "from": 1.5}]
    studio.page.get_by_role("button", name="Open again: N7").click()
    compared(studio, 4)
    assert "closures" not in studio.document
    assert studio.complaints == []


def test_a_robot_that_waits_for_a_closed_place_says_so(opened: Opener) -> None:
    studio = opened(CORRIDOR)
    begin(studio)
    studio.planned()
    assert "N2 is closed until time 9" in studio.text(".waits")


def way(studio: StudioPage, run: int) -> list[str]:
    """Return the places that R1 drives through, in order, by the plan file of a run."""
    robots = studio.api(f"runs/{run}/export/json")["robots"]
    return list(robots[0]["vertices"])


def test_a_lane_is_closed_and_the_former_way_is_dashed(opened: Opener) -> None:
    """No robot drives along a closed lane any more, and its sign is on the map."""
    studio = opened(OPEN)
    begin(studio)
    studio.planned()
    choose(studio, 0)
    before = way(studio, 1)
    tail, head = before[1:3]
    studio.page.fill("#close-at", tail)
    studio.page.fill("#close-to", head)
    studio.button("Close it").click()
    compared(studio, 2)
    assert studio.document["closures"] == [{"edge": [tail, head]}]
    after = way(studio, 2)
    assert not {(tail, head), (head, tail)} & set(pairwise(after))
    assert f"{tail} to {head}: closed" in studio.text(".change .edit")
    assert "Dashed on the map" in studio.text(".change")
    studio.button("Put it back").click()
    studio.shown(1)
    assert "closures" not in studio.document
    assert studio.complaints == []


@pytest.mark.parametrize(
    ("typed", "wrong"),
    [
        (("N999", "", "", "-3"), {"Close the place", "until"}),
        (("N0", "N17", "", ""), {"Close the place", "or the lane to"}),
        (("N5", "", "soon", ""), {"from"}),
        (("N5", "", "5", "3"), {"until"}),
    ],
    ids=["place", "lane", "from", "until"],
)
def test_what_cannot_be_closed_is_marked_at_its_field_and_changes_nothing(
    opened: Opener, typed: tuple[str, ...], wrong: set[str]
) -> None:
    studio = opened(BAY)
    begin(studio)
    studio.planned()
    form = studio.page.locator(".close-place")
    names = ["Close the place", "or the lane to", "from", "until"]
    for name, text in zip(names, typed, strict=True):
        form.get_by_label(name).fill(text)
    studio.button("Close it").click()
    form.locator("[role=alert]").first.wait_for()
    found = {n for n in names if form.get_by_label(n).get_attribute("aria-invalid") == "true"}
    assert found == wrong
    assert [form.get_by_label(name).input_value() for name in names] == list(typed)
    assert "closures" not in studio.document
    assert len(studio.runs) == 1


def test_what_waits_for_a_press_on_the_map_looks_so_until_it_is_given_up(opened: Opener) -> None:
    studio = asked(opened, BAY)
    button = studio.button("Close a place on the map")

    def shows(is_waiting: bool) -> None:
        """Wait until button, sentence and pointer say whether a press is waited for."""
        expect(button).to_have_attribute("aria-pressed", str(is_waiting).lower())
        hint = studio.page.locator(".close-place").get_by_text("Press the place or the lane")
        expect(hint).to_have_count(int(is_waiting))
        cursors = ("grab", "crosshair")
        studio.page.mouse.move(*studio.where((2.5, 2.5)))
        expect(studio.page.locator("#map")).to_have_css("cursor", cursors[is_waiting])

    shows(is_waiting=False)
    button.click()
    shows(is_waiting=True)
    assert button.is_enabled()
    studio.page.keyboard.press("Escape")
    shows(is_waiting=False)
    assert studio.chosen("R1").is_visible()
    button.click()
    shows(is_waiting=True)
    button.click()
    shows(is_waiting=False)
    button.click()
    studio.tab("Map")
    studio.tab("Plan")
    shows(is_waiting=False)
    choose(studio, 0)
    button.click()
    studio.page.get_by_label("until").fill("4")
    studio.page.mouse.click(*studio.where((2.5, 1.5)))
    compared(studio, 2)
    assert studio.document["closures"] == [{"at": "N7", "until": 4}]
    assert studio.chosen("R1").is_visible()  # the press was not for the map
    assert studio.complaints == []
