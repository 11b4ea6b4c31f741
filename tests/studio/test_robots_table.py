"""The table of robots as a spreadsheet: arrows, blocks, fill, faults, columns, many rows."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from tests.builders.browsers import expect, needs_browser
from tests.builders.drawing import StudioPage, studio_page
from tests.builders.studios import DOOR

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator

    from tests.builders.studios import Client

pytestmark = needs_browser

PASTE = """(field, text) => {
  const clipboardData = new DataTransfer();
  clipboardData.setData("text", text);
  field.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true }));
}"""

COPIED = """(field) => {
  const clipboardData = new DataTransfer();
  field.dispatchEvent(new ClipboardEvent("copy", { clipboardData, bubbles: true }));
  return clipboardData.getData("text");
}"""


@pytest.fixture
def table(browser: Browser, empty: Client) -> Iterator[StudioPage]:
    """Return the page with a floor of 12 x 8 m and three robots, at their table."""
    with studio_page(browser, empty) as studio:
        studio.button("Create the floor").click()
        studio.opened()
        studio.tab("Robots")
        studio.button("Add 3 at random").click()
        studio.settle()
        assert len(studio.document["robots"]) == 3
        field(studio, "Work", "R1").evaluate(PASTE, "5\t1\n5\t1\n5\t1\n")
        studio.settle()
        yield studio


def field(table: StudioPage, column: str, robot: str) -> Locator:
    """Return the field of a robot in a column."""
    return table.page.get_by_label(f"{column}, {robot}", exact=True)


def focused(table: StudioPage) -> str:
    """Return which field has the focus."""
    return table.page.locator(":focus").get_attribute("aria-label") or ""


def test_control_and_enter_plan_from_any_cell_with_what_is_written_in_it(
    table: StudioPage,
) -> None:
    for count, (column, text) in enumerate((("Work", "7"), ("Speed", "0.5"), ("Name", "R9")), 1):
        table.tab("Robots")
        cell = field(table, column, "R1")
        cell.click()
        cell.fill(text)
        cell.press("Control+Enter")
        table.page.locator(f"tr[data-run='{count}']").wait_for()
        robot = table.api(f"runs/{count}/document")["document"]["robots"][0]
        key = {"Work": "work", "Speed": "speed", "Name": "name"}[column]
        assert str(robot.get(key, robot.get("stops", [{}])[0].get(key))) == text
        table.planned()


def test_heads_have_the_units_of_the_document_and_cells_their_whole_text(
    table: StudioPage,
) -> None:
    heads = [
        head.split(" ↑")[0] for head in table.page.locator("table.robots th").all_inner_texts()
    ]
    assert heads[:5] == ["Name", "Home", "Stops", "Work [s]", "Speed [m/s]"]
    home = field(table, "Home", "R1")
    assert home.get_attribute("title") == home.input_value() != ""


def test_arrows_and_enter_go_through_the_cells(table: StudioPage) -> None:
    keys = table.page.keyboard
    field(table, "Work", "R1").click()
    keys.press("ArrowDown")
    assert focused(table) == "Work, R2"
    keys.press("End")
    keys.press("ArrowRight")
    assert focused(table) == "Speed, R2"
    keys.type("2")
    keys.press("Enter")
    assert focused(table) == "Speed, R3"
    keys.press("Shift+Enter")
    assert focused(table) == "Speed, R2"


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        (["2", "Tab"], ["2", "5", "5"]),  # pressed and typed
        (["1", "2", "Tab"], ["12", "5", "5"]),
        (["ArrowDown", "8", "Tab"], ["5", "8", "5"]),  # reached by an arrow key
        (["1", "Enter", "9", "Tab"], ["1", "9", "5"]),  # reached by Enter behind a value
        (["Enter", "2", "Tab"], ["52", "5", "5"]),  # Enter edits what stands there
        (["F2", "2", "Enter"], ["52", "5", "5"]),
        (["2", "Escape", "Tab"], ["5", "5", "5"]),  # Escape restores
        (["2", "Escape", "3", "Enter"], ["3", "5", "5"]),  # and the cell is selected again
        (["F2", "2", "Escape", "Enter", "3", "Enter"], ["53", "5", "5"]),
        (["Backspace", "Enter"], ["", "5", "5"]),
    ],
)
def test_typing_replaces_a_cell_and_editing_is_asked_for(
    table: StudioPage, keys: list[str], expected: list[str]
) -> None:
    """The work of R1, R2 and R3 is 5; the cell of R1 is pressed first."""
    field(table, "Work", "R1").click()
    for key in keys:
        table.page.keyboard.press(key)
    found = [field(table, "Work", name).input_value() for name in ("R1", "R2", "R3")]
    assert found == expected


def test_a_second_press_keeps_a_cell_selected_and_a_double_press_edits_it(
    table: StudioPage,
) -> None:
    work = field(table, "Work", "R1")
    work.click()
    work.click()  # not as part of a double press
    table.page.keyboard.press("7")
    table.page.keyboard.press("Enter")
    assert work.input_value() == "7"
    work.dblclick()
    table.page.keyboard.press("2")
    table.page.keyboard.press("Enter")
    assert work.input_value() == "72"


def test_a_robot_has_no_work_before_somebody_gives_it_some(table: StudioPage) -> None:
    """As in a file: the cell is empty, and the 0 in it is faint."""
    table.button("Add 3 at random").click()
    work = field(table, "Work", "R4")
    work.wait_for()
    assert (work.input_value(), work.get_attribute("placeholder")) == ("", "0")
    assert "work" not in table.document["robots"][3]


def test_a_block_is_copied_pasted_and_cleared(table: StudioPage) -> None:
    keys = table.page.keyboard
    field(table, "Work", "R1").focus()
    keys.press("Shift+ArrowDown")
    keys.press("Shift+ArrowRight")
    assert field(table, "Work", "R1").evaluate(COPIED) == "5\t1\n5\t1"
    field(table, "Work", "R2").evaluate(PASTE, "7\t2\n8\t3\n")
    table.settle()
    robots = table.document["robots"]
    assert [(robot["work"], robot["speed"]) for robot in robots] == [(5, 1), (7, 2), (8, 3)]
    keys.press("Delete")
    table.settle()
    assert ["work" in robot for robot in table.document["robots"]] == [False, False, True]


def test_a_value_is_dragged_down(table: StudioPage) -> None:
    speed = field(table, "Speed", "R1")
    speed.fill("2")
    speed.press("Tab")
    field(table, "Speed", "R1").focus()
    table.page.locator(".handle").drag_to(field(table, "Speed", "R3"))
    table.settle()
    assert [robot["speed"] for robot in table.document["robots"]] == [2, 2, 2]


def test_a_robot_is_added_in_the_last_row(table: StudioPage) -> None:
    home = field(table, "Home", "new robot")
    home.fill("0.25, 0.25")
    home.press("Tab")
    table.settle()
    assert table.document["robots"][3] == {"name": "R4", "home": {"x": 0.25, "y": 0.25}}
    fault = table.page.get_by_role("alert").get_by_text("nowhere to go")
    fault.wait_for()
    table.page.get_by_role("application", name="Map with 4 robots").wait_for()  # it stands at home


def test_a_wrong_number_is_marked_and_the_robot_stays_on_the_map(table: StudioPage) -> None:
    speed = field(table, "Speed", "R2")
    speed.fill("abc")
    speed.press("Enter")
    table.settle()
    assert speed.get_attribute("aria-invalid") == "true"
    assert table.page.get_by_role("application", name="Map with 3 robots").is_visible()
    table.page.get_by_role("button", name="R2: speed").click()
    expect(field(table, "Speed", "R2")).to_be_focused()


def test_columns_come_when_they_are_asked_for(table: StudioPage) -> None:
    assert not field(table, "Radius", "R1").is_visible()
    table.button("+ Radius").click()
    field(table, "Radius", "R1").fill("0.2")
    field(table, "Radius", "R1").press("Enter")
    table.settle()
    assert table.document["robots"][0]["radius"] == 0.2


def test_a_robot_that_was_deleted_is_taken_back(table: StudioPage) -> None:
    before = table.document["robots"]
    table.page.locator("tr[data-row='1']").hover()
    table.page.get_by_label("Delete R2").click()
    assert len(table.document["robots"]) == 2
    table.page.locator(".notice").get_by_role("button", name="Undo").click()
    table.settle()
    assert table.document["robots"] == before


def test_a_robot_is_found_among_many_and_its_row_stays_its_own(table: StudioPage) -> None:
    table.page.get_by_text("Robots at random").click()
    table.page.get_by_label("Robots", exact=True).fill("60")
    table.button("Add them").click()
    assert len(table.document["robots"]) == 63
    table.page.get_by_label("Find a robot or place").fill("R42")
    assert table.page.locator("tr[data-row]").count() == 1
    speed = field(table, "Speed", "R42")
    speed.fill("2")
    speed.press("Enter")
    table.settle()
    assert [it["name"] for it in table.document["robots"] if it["speed"] == 2] == ["R42"]


def test_no_table_is_wider_than_its_place(table: StudioPage) -> None:
    sheet = ".sheet"
    assert table.page.locator(sheet).evaluate("(it) => it.scrollWidth <= it.clientWidth")


ENDED = """async (number) => {
    const run = await (await fetch(`/api/v1/runs/${number}`)).json();
    return !["queued", "running"].includes(run.state);
}"""
"""Whether a run has ended, in the page."""


def test_what_is_typed_stays_until_it_is_done_or_given_up(table: StudioPage) -> None:
    """Events write the page anew at any time: a plan that becomes better, an answer that comes."""
    speed = table.page.get_by_label("Speed, R1")
    for end, expected in (("Escape", 1), ("Enter", 2)):
        speed.focus()
        speed.press("Control+a")
        table.page.keyboard.type("2")
        run = table.post("runs", {"document": DOOR, "source": table.place[1]})
        table.page.wait_for_function(ENDED, arg=run["number"])  # the page has heard of it, too
        assert speed.input_value() == "2"
        speed.press(end)
        table.settle()
        assert table.document["robots"][0]["speed"] == expected
