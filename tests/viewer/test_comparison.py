"""Plans side by side: one clock, one choice, a map and a diagram for each."""

import pytest

from tests.builders.plans import door, door_shifted, loop
from tests.builders.players import Player
from tests.viewer.conftest import Opener

MINUS, NONE = "\u2212", "\u2013"
BESIDE = "comparison.beside[0]"


@pytest.fixture
def both(show: Opener) -> Player:
    """In the other plan R1 waits a tick longer than it must."""
    return show(
        door(),
        title="A.json",
        others=[(door_shifted(1), "B.json")],
        viewport={"width": 1600, "height": 1000},
    )


@pytest.fixture
def many(show: Opener) -> Player:
    """The third plan is of other robots on another map, in ticks of a half."""
    return show(
        door(),
        title="A.json",
        others=[(door_shifted(1), "B.json"), (loop(), "C.json")],
        viewport={"width": 1280, "height": 720},
    )


def rows(viewer: Player) -> list[list[str]]:
    """Return the rows of robots as they are read: the name, the time in the base, the changes."""
    found = viewer.page.locator("#compared-list .row:visible").all_inner_texts()
    return [row.split("\n") for row in found]


def figures(viewer: Player) -> dict[str, list[str]]:
    """Return the table of figures by the heads of its rows."""
    found = viewer.ask(
        "[...document.querySelectorAll('.compared-figures tbody tr')]"
        ".map((row) => [...row.cells].map((cell) => cell.textContent))"
    )
    return {head: cells for head, *cells in found}


def test_the_head_compares_both_plans(both: Player) -> None:
    assert both.text("#headline").split() == ["A.json", "→", "B.json", "2", "robots"]
    assert both.text("#figures").split("\n") == [
        "All home at", "10 → 11", "Time lost", "1 → 2", "Earlier", "0", "Later", "1",
    ]  # fmt: skip
    assert both.page.title() == "A.json, B.json"


def test_all_maps_show_the_same_moment(many: Player) -> None:
    """At tick 3 R1 is in N4 in the first plan, in N1 in the second; both clocks of C go on."""
    many.page.fill("#slider", "3")
    many.wait_for(f"clock.tick === 3 && motion.y[0] === 1 && {BESIDE}.motion.y[0] === 0")
    assert many.ask("comparison.beside.map(({ clock }) => clock.tick)") == [3, 6]
    assert many.ask("comparison.plans.map(({ end }) => end)") == [11, 11, 22]


def test_a_table_has_the_figures_and_marks_the_best(both: Player) -> None:
    found = figures(both)
    assert found["Sum of arrivals"] == ["19 (the best)", "20"]
    assert found["Last arrival"] == ["10 (the best)", "11"]
    assert found["Each alone"] == ["18", "18"]
    assert found["Extra"] == ["5.6% (the best)", "11.1%"]
    assert found["Planner"] == ["two-level", "two-level"]


def test_the_list_says_which_robots_gain_or_lose_the_largest_change_first(both: Player) -> None:
    assert rows(both) == [["R1", "10", "+1"], ["R2", "9", "="]]
    said = both.page.locator("#compared-list .row:visible").first.get_attribute("aria-label")
    assert said == "R1: A.json 10, B.json 1 later"
    bars = both.ask(
        "[...document.querySelectorAll('#compared-list .row:not([hidden]) .amount')]"
        ".map((bar) => bar.style.getPropertyValue('--by'))"
    )
    assert bars == ["1", "0"]


def test_another_plan_is_the_base(both: Player) -> None:
    both.page.get_by_role("button", name="B.json", exact=True).first.click()
    assert rows(both) == [["R1", "11", f"{MINUS}1"], ["R2", "9", "="]]
    assert both.page.locator("thead [aria-pressed=true]").inner_text() == "B.json"


def test_a_press_on_a_head_sorts(both: Player) -> None:
    both.page.get_by_role("button", name="Robot", exact=True).click()
    both.page.fill("#find-compared", "r")
    assert [name for name, *_ in rows(both)] == ["R1", "R2"]
    both.page.locator(".compared-head").get_by_role("button", name="B.json").click()
    assert [name for name, *_ in rows(both)] == ["R1", "R2"]
    both.page.fill("#find-compared", "r2")
    assert rows(both) == [["R2", "9", "="]]


def test_plans_of_different_scenarios_are_compared_by_names(many: Player) -> None:
    assert [row for row in rows(many) if row[0] == "R1"] == [["R1", "10", "+1", NONE]]
    assert ["Cart", NONE, NONE, NONE] in rows(many)
    assert figures(many)["Robots"] == ["2", "2", "1"]
    changes = many.page.locator(".compared-changes").all_inner_texts()
    assert len(changes) == 1
    assert changes[0].startswith("C.json beside A.json\nCart: added\nR1 and R2: removed")
    assert many.complaints == []


def test_each_plan_has_a_diagram_on_one_axis(many: Player) -> None:
    many.wait_for("!frames.asked && comparison.diagrams.at(-1).area !== undefined")
    captions = many.page.locator(".stack figcaption").all_inner_texts()
    assert captions == ["A.json", "B.json", "C.json"]
    places = many.ask(
        "[diagram, ...comparison.diagrams].map(({ area, plan }) => area.x(plan.end / 2))"
    )
    assert places[0] == pytest.approx(places[1])
    assert places[0] == pytest.approx(places[2])
    assert many.ask("[diagram, ...comparison.diagrams].map(({ hasLabels }) => hasLabels)") == [
        False, False, True,
    ]  # fmt: skip


def test_paper_has_a_table_of_all_plans(both: Player) -> None:
    both.ask("paper.lay(true)")
    both.page.emulate_media(media="print")
    assert both.text("#paper-robots").splitlines() == [
        "Robot\tHome at, A.json\tHome at, B.json\tIn B.json",
        "R1\t10\t11\t1 later",
        "R2\t9\t9\tthe same",
    ]


def test_one_choice_holds_for_all(both: Player) -> None:
    both.page.click("#compared-list .row:has-text('R1')")
    assert both.ask(f"{BESIDE}.choice.robot.name") == "R1"
    assert "In B.json\n1 later" in both.text("#card")
    both.ask(f"{BESIDE}.choice.chooseRobot(1)")
    assert both.ask("choice.robot.name") == "R2"


def test_a_robot_of_one_plan_alone_is_chosen_there(many: Player) -> None:
    many.page.click("#compared-list .row:has-text('Cart')")
    assert many.ask("comparison.beside[1].choice.robot.name") == "Cart"
    assert many.ask("[choice.robot, comparison.beside[0].choice.robot]") == [None, None]


def test_maps_of_one_size_show_the_same_part(many: Player) -> None:
    many.page.click("#zoom-in")
    scales = many.ask(
        "[mapView, ...comparison.views].map(({ viewport }) => [viewport.scale, viewport.fitted])"
    )
    assert scales[0] == scales[1]
    assert scales[2][1] is True  # another map: it stays as it is
    assert many.complaints == []


def test_a_faulty_plan_gains_nothing(show: Opener) -> None:
    viewer = show(door(), title="A.json", others=[(door_shifted(-1), "bad.json")])
    assert "bad.json has 6 faults: do not run it" in viewer.text("#headline")
    assert viewer.text("#figures") == ""
    assert viewer.text(".map.other .map-title").split("\n") == ["bad.json", "6 faults"]


def test_the_tip_of_each_map_stands_on_it(both: Player) -> None:
    box = both.page.locator(".map.other canvas").bounding_box()
    assert box
    left, top, scale = both.ask("(({left, top, scale}) => [left, top, scale])(mapView.viewport)")
    both.page.mouse.move(box["x"] + left, box["y"] + top + 2 * scale)  # N6 of the other plan
    tip = both.page.locator(".map.other .hover")
    assert tip.inner_text().startswith("N6, stop of R1")
    assert not both.page.locator("#hover").is_visible()
    at = tip.bounding_box()
    assert at
    assert at["x"] > box["x"]


def test_titles_stand_above_the_maps(both: Player) -> None:
    title = both.page.locator("#map-title").bounding_box()
    box = both.page.locator("#map").bounding_box()
    assert title
    assert box
    top = both.ask("mapView.viewport.top - mapView.viewport.scale / 2")
    assert title["y"] + title["height"] <= box["y"] + top


def test_the_picture_has_all_maps_and_diagrams(many: Player) -> None:
    many.wait_for("!frames.asked")
    made, map_width, heights = many.ask(
        "[(({ width, height }) => [width, height])(share.picture()), mapView.canvas.width,"
        " [mapView, diagram, ...comparison.diagrams].map(({ canvas }) => canvas.height + 24)]"
    )
    assert made == [3 * map_width, 48 + sum(heights)]


def test_maps_are_below_each_other_on_a_small_screen(show: Opener) -> None:
    viewer = show(
        door(),
        title="A",
        others=[(door_shifted(1), "B")],
        viewport={"width": 420, "height": 900},
    )
    tops = viewer.ask(
        "[...document.querySelectorAll('.map')].map((map) => map.getBoundingClientRect().top)"
    )
    assert tops[1] > tops[0] + 100
    assert viewer.ask("document.documentElement.scrollWidth") <= 420


def test_three_plans_fit_at_1280_pixels(many: Player) -> None:
    wide = "[...document.querySelectorAll('.compared-wide, #compared-list')]"
    assert many.ask(f"{wide}.map((box) => box.scrollWidth - box.clientWidth)") == [0, 0, 0]
    assert many.ask("document.documentElement.scrollWidth") == 1280


def test_heads_and_names_stay_where_many_plans_are_scrolled(show: Opener) -> None:
    viewer = show(
        door(),
        title="A",
        others=[(door_shifted(late), f"B{late}") for late in range(1, 8)],
        viewport={"width": 1280, "height": 720},
    )
    viewer.ask("document.getElementById('compared-figures').style.maxHeight = '90px'")
    viewer.ask("document.querySelectorAll('.compared-wide').forEach((it) => it.scrollTo(150, 40))")
    viewer.painted()
    stay = (
        "['.compared-figures tbody th', '.compared-figures thead td', '.compared-head > *',"
        " '.compared-row .robot'].map((each) => { const it = document.querySelector(each);"
        " const box = it.closest('.compared-wide').getBoundingClientRect();"
        " return it.getBoundingClientRect().left - box.left; })"
    )
    assert all(0 <= left <= 25 for left in viewer.ask(stay))
    top = (
        "document.querySelector('.compared-figures thead th').getBoundingClientRect().top"
        " - document.getElementById('compared-figures').getBoundingClientRect().top"
    )
    assert viewer.ask(top) == 0
    widths = viewer.ask("[...document.querySelectorAll('.map')].map((map) => map.clientWidth)")
    assert min(widths) >= 150


def test_maps_are_beside_each_other_on_a_low_screen(show: Opener) -> None:
    viewer = show(
        door(),
        title="A",
        others=[(door_shifted(late), f"B{late}") for late in range(1, 8)],
        viewport={"width": 900, "height": 420},
    )
    widths = viewer.ask("[...document.querySelectorAll('.map')].map((map) => map.clientWidth)")
    assert min(widths) >= 150
