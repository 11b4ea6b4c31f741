"""Plans side by side: one clock, one choice, a map and a diagram for each."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import pytest
from PIL import Image

from rightofway.viz.palette import LIGHT
from tests.builders.canvases import Disc
from tests.builders.plans import door, door_shifted, loop
from tests.builders.players import Player
from tests.viewer.conftest import Opener

if TYPE_CHECKING:
    from playwright.sync_api import Locator

MINUS, NONE = "\u2212", "\u2013"


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


def widths_of_maps(viewer: Player) -> list[float]:
    """Return how wide the maps are [pixels]."""
    return [viewer.box(each)["width"] for each in maps(viewer)]


def rows(viewer: Player) -> list[list[str]]:
    """Return the rows of robots as they are read: the name, the time in the base, the changes."""
    found = viewer.page.locator("#compared-list .row:visible").all_inner_texts()
    return [row.split("\n") for row in found]


def figures(viewer: Player) -> dict[str, list[str]]:
    """Return the table of figures by the heads of its rows."""
    found = viewer.page.locator(".compared-figures tbody").get_by_role("row").all()
    return {
        row.get_by_role("rowheader").inner_text(): row.get_by_role("cell").all_text_contents()
        for row in found
    }


def maps(viewer: Player) -> list[Locator]:
    """Return the maps, that of the first plan first."""
    return viewer.page.locator("section.map").get_by_role("img").all()


def diagrams(viewer: Player) -> list[Locator]:
    """Return the diagrams, that of the first plan first."""
    return viewer.page.get_by_role("figure").get_by_role("img").all()


def views(viewer: Player) -> list[tuple[float, ...]]:
    """Return how each map shows places of its site, see `data-view` in ``map_view.js``."""
    viewer.painted()
    found = [each.get_attribute("data-view") for each in viewer.page.locator("section.map").all()]
    return [tuple(map(float, str(view).split())) for view in found]


def places(viewer: Player, index: int, is_shown: Callable[[Disc], object]) -> list[Any]:
    """Return where some discs of a map are on its site [length unit]."""
    discs = viewer.discs(maps(viewer)[index])
    a, _, _, d, e, f = views(viewer)[index]
    found = [((disc.x - e) / a, (disc.y - f) / d) for disc in discs if is_shown(disc)]
    return [pytest.approx(place, abs=0.001) for place in found]


def robots(viewer: Player, index: int) -> list[Any]:
    """Return where robots drive, work or turn on a map."""
    return places(viewer, index, lambda disc: disc.is_filled and disc.colour != LIGHT.floor)


def chosen(viewer: Player, index: int) -> list[Any]:
    """Return where the robot is that is chosen on a map."""
    return places(viewer, index, lambda disc: disc.colour == LIGHT.ink and not disc.is_filled)


def test_the_head_compares_both_plans(both: Player) -> None:
    assert both.text("#headline").split() == ["A.json", "→", "B.json", "2", "robots"]
    assert both.text("#figures").split("\n") == [
        "All home at", "10 → 11", "Time lost", "1 → 2", "Earlier", "0", "Later", "1",
    ]  # fmt: skip
    assert both.page.title() == "A.json, B.json"


def test_all_maps_show_the_same_moment(many: Player) -> None:
    """At 3 R1 is in N4 in the first plan, in N1 in the second; C has half ticks.

    Its cart drives 2 length units in the first unit of time, and then as far; then it works.
    """
    many.seek(3)
    n1, n4, end = (1.5, 0.5), (1.5, 1.5), (2, 2)
    assert (n4 in robots(many, 0), n1 in robots(many, 0)) == (True, False)
    assert (n4 in robots(many, 1), n1 in robots(many, 1)) == (False, True)
    assert end in robots(many, 2)
    many.seek(0.5)
    assert (1, 0) in robots(many, 2)
    assert many.end == 11


def test_a_table_has_the_figures_and_marks_the_best(both: Player) -> None:
    found = figures(both)
    assert found["Flowtime"] == ["19 (the best)", "20"]
    assert found["Makespan"] == ["10 (the best)", "11"]
    assert found["Lower bound"] == ["18", "18"]
    assert found["Gap"] == ["5.6% (the best)", "11.1%"]
    assert found["Planner"] == ["two-level", "two-level"]


def test_the_list_says_which_robots_gain_or_lose_the_largest_change_first(both: Player) -> None:
    assert rows(both) == [["R1", "10", "+1"], ["R2", "9", "="]]
    said = both.page.locator("#compared-list .row:visible").first.get_attribute("aria-label")
    assert said == "R1: A.json 10, B.json 1 later"
    bars = both.page.locator("#compared-list .row:visible .amount").all()
    sizes = [bar.evaluate("(it) => getComputedStyle(it).backgroundSize") for bar in bars]
    assert [size.split()[0] for size in sizes] == ["100%", "0%"]


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
    assert changes[0].startswith("C.json compared with A.json\nCart: added\nR1 and R2: removed")
    assert many.complaints == []


def test_each_plan_has_a_diagram_on_one_axis(many: Player) -> None:
    captions = many.page.get_by_role("figure").locator("figcaption").all_inner_texts()
    assert captions == ["A.json", "B.json", "C.json"]
    written = [{each.text for each in many.texts(diagram)} for diagram in diagrams(many)]
    assert ["4" in texts for texts in written] == [False, False, True]
    boxes = [many.box(diagram) for diagram in diagrams(many)]
    assert len({(box["x"], box["width"]) for box in boxes}) == 1
    # R1 comes to N6 at 5, in the second plan at 6; the cart to c at 2
    for diagram, time in zip(diagrams(many), (5, 6, 2), strict=True):
        begins = [field.box[0] for field in many.fields(diagram)]
        assert pytest.approx(many.diagram_x(time, diagrams(many)[-1])) in begins


def test_paper_has_a_table_of_all_plans(both: Player) -> None:
    both.lay_on_paper()
    assert both.text("#paper-robots").splitlines() == [
        "Robot\tHome at, A.json\tHome at, B.json\tIn B.json",
        "R1\t10\t11\t1 later",
        "R2\t9\t9\tthe same",
    ]


def test_one_choice_holds_for_all(both: Player) -> None:
    both.page.click("#compared-list .row:has-text('R1')")
    assert [chosen(both, index) for index in (0, 1)] == [[(0.5, 0.5)]] * 2
    assert "In B.json\n1 later" in both.text("#card")
    other = both.box(maps(both)[1])
    x, y = both.on_map((2.5, 0.5))  # the home of R2
    both.page.mouse.click(other["x"] + x, other["y"] + y)
    assert both.chosen == "R2"
    assert [chosen(both, index) for index in (0, 1)] == [[(2.5, 0.5)]] * 2


def test_a_robot_of_one_plan_alone_is_chosen_there(many: Player) -> None:
    many.page.click("#compared-list .row:has-text('Cart')")
    assert [chosen(many, index) for index in range(3)] == [[], [], [(0, 0)]]
    assert many.chosen is None


def test_maps_of_one_size_show_the_same_part(many: Player) -> None:
    before = views(many)
    many.page.get_by_role("button", name="Zoom in").click()
    first, second, third = views(many)
    assert first == second
    assert first[0] == pytest.approx(1.5 * before[0][0])
    assert third == before[2]  # another map: it stays as it is
    assert many.complaints == []


def test_a_faulty_plan_gains_nothing(show: Opener) -> None:
    viewer = show(door(), title="A.json", others=[(door_shifted(-1), "bad.json")])
    assert "bad.json has 6 faults: do not run it" in viewer.text("#headline")
    assert viewer.text("#figures") == ""
    assert viewer.text(".map.other .map-title").split("\n") == ["bad.json", "6 faults"]


def test_the_tip_of_each_map_stands_on_it(both: Player) -> None:
    box = both.page.locator(".map.other canvas").bounding_box()
    assert box
    x, y = both.on_map((0.5, 2.5))
    both.page.mouse.move(box["x"] + x, box["y"] + y)  # N6 of the other plan
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
    _, top = both.on_map((0, 0))
    assert title["y"] + title["height"] <= box["y"] + top


def test_the_picture_has_all_maps_and_diagrams(many: Player) -> None:
    many.painted()
    with many.page.expect_download() as download:
        many.page.get_by_role("button", name="Picture").click()
    with Image.open(download.value.path()) as picture:
        wide, high = picture.size
    heights = [many.box(each)["height"] for each in (maps(many)[0], *diagrams(many))]
    assert wide == 3 * round(many.box()["width"])
    assert high == 48 + sum(round(height) + 24 for height in heights)


def test_maps_are_below_each_other_on_a_small_screen(show: Opener) -> None:
    viewer = show(
        door(),
        title="A",
        others=[(door_shifted(1), "B")],
        viewport={"width": 420, "height": 900},
    )
    first, second = (viewer.box(each) for each in viewer.page.locator("section.map").all())
    assert second["y"] > first["y"] + 100
    assert viewer.size[0] <= 420


def test_three_plans_fit_at_1280_pixels(many: Player) -> None:
    wide = many.page.locator(".compared-wide, #compared-list")
    hidden = wide.evaluate_all("(boxes) => boxes.map((it) => it.scrollWidth - it.clientWidth)")
    assert hidden == [0, 0, 0]
    assert many.is_as_wide_as(1280)


def test_heads_and_names_stay_where_many_plans_are_scrolled(show: Opener) -> None:
    viewer = show(
        door(),
        title="A",
        others=[(door_shifted(late), f"B{late}") for late in range(1, 8)],
        viewport={"width": 1280, "height": 720},
    )
    table = viewer.page.locator("#compared-figures")
    table.evaluate("(it) => { it.style.maxHeight = '90px'; }")
    for box in viewer.page.locator(".compared-wide").all():
        box.evaluate("(it) => it.scrollTo(150, 40)")
    viewer.painted()
    lists = viewer.page.locator("#compared-robots")
    for within, *staying in (
        (table, "tbody th", "thead td"),
        (lists, ".compared-head > *", ".compared-row .robot"),
    ):
        for each in staying:
            left = viewer.box(within.locator(each).first)["x"] - viewer.box(within)["x"]
            assert 0 <= left <= 25, each
    assert viewer.box(table.locator("thead th").first)["y"] == viewer.box(table)["y"]
    assert min(widths_of_maps(viewer)) >= 150


def test_maps_are_beside_each_other_on_a_low_screen(show: Opener) -> None:
    viewer = show(
        door(),
        title="A",
        others=[(door_shifted(late), f"B{late}") for late in range(1, 8)],
        viewport={"width": 900, "height": 420},
    )
    assert min(widths_of_maps(viewer)) >= 150
