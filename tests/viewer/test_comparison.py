"""Two plans of one scenario side by side: one clock, one choice, two maps."""

import pytest

from tests.builders.browsers import Viewer
from tests.builders.plans import door, door_shifted
from tests.viewer.conftest import Opener, pixel


@pytest.fixture
def both(show: Opener) -> Viewer:
    """In the other plan R1 waits a tick longer than it must."""
    return show(
        door(),
        title="A.json",
        other=(door_shifted(1), "B.json"),
        viewport={"width": 1600, "height": 1000},
    )


def test_the_head_compares_both_plans(both: Viewer) -> None:
    assert both.text("#headline").split() == ["A.json", "→", "B.json", "2", "robots"]
    assert both.text("#figures").split("\n") == [
        "All home at", "10 → 11", "Time lost", "1 → 2", "Earlier", "0", "Later", "1",
    ]  # fmt: skip
    assert both.page.title() == "A.json and B.json"


def test_both_maps_show_the_same_moment(both: Viewer) -> None:
    """At tick 3 R1 is in N4 in the first plan, in N1 in the other one; R2 is in N7 in both."""
    both.page.fill("#slider", "3")
    both.wait_for("comparison.motion.y[1] === 2")
    assert both.ask("[motion.y[0], comparison.motion.y[0]]") == [1, 0]


def test_the_list_says_which_robots_gain_or_lose(both: Viewer) -> None:
    rows = both.page.locator("#compared-list .row:visible").all_inner_texts()
    assert [row.split("\n") for row in rows] == [
        ["R2", "the same", "9 → 9"],
        ["R1", "1 later", "10 → 11"],
    ]


def test_the_diagram_shows_both_plans(both: Viewer) -> None:
    """At tick 10 R1 is home in N0; in the other plan it is on its way there, from N1."""
    both.wait_for("!frames.asked")
    assert both.text("#diagram-title") == "Place over time: strong lines A.json, thin lines B.json"
    line = both.ask(
        "(([here], [there]) => [diagram.area.x(10.5), (here.y + there.y) / 2])"
        "(...[0, 1].map((vertex) => diagram.spaceTime.axis.spots(vertex)))"
    )
    assert pixel(both, "diagram", *line) != pixel(both, "diagram", line[0] + 4, line[1])


def test_paper_has_a_table_of_both_plans(both: Viewer) -> None:
    both.ask("paper.lay(true)")
    both.page.emulate_media(media="print")
    assert both.text("#paper-robots").splitlines() == [
        "Robot\tHome at, A.json\tHome at, B.json\tIn B.json\tTime lost, A.json\tTime lost, B.json",
        "R1\t10\t11\t1 later\t1\t2",
        "R2\t9\t9\tthe same\t\t",
    ]


def test_one_choice_holds_for_both(both: Viewer) -> None:
    both.page.click("#compared-list .row:has-text('R1')")
    assert both.ask("comparison.otherChoice.robot.name") == "R1"
    assert "In B.json\n1 later" in both.text("#card")
    both.ask("comparison.otherChoice.chooseRobot(1)")
    assert both.ask("choice.robot.name") == "R2"


def test_both_maps_show_the_same_part(both: Viewer) -> None:
    both.page.click("#zoom-in")
    scales = both.ask("[mapView.viewport.scale, comparison.view.viewport.scale]")
    assert scales[0] == scales[1]
    assert both.complaints == []


def test_a_faulty_plan_gains_nothing(show: Opener) -> None:
    viewer = show(door(), title="A.json", other=(door_shifted(-1), "bad.json"))
    assert "bad.json has 6 faults: do not run it" in viewer.text("#headline")
    assert viewer.text("#figures") == ""
    assert viewer.text("#other-title").split("\n") == ["bad.json", "6 faults"]


def test_the_tip_of_each_map_stands_on_it(both: Viewer) -> None:
    box = both.page.locator("#other-map").bounding_box()
    assert box
    left, top, scale = both.ask("(({left, top, scale}) => [left, top, scale])(mapView.viewport)")
    both.page.mouse.move(box["x"] + left, box["y"] + top + 2 * scale)  # N6 of the other plan
    tip = both.page.locator(".map.other .hover")
    assert tip.inner_text().startswith("N6, stop of R1")
    assert not both.page.locator("#hover").is_visible()
    at = tip.bounding_box()
    assert at
    assert at["x"] > box["x"]


def test_titles_stand_above_the_maps(both: Viewer) -> None:
    title = both.page.locator("#map-title").bounding_box()
    box = both.page.locator("#map").bounding_box()
    assert title
    assert box
    top = both.ask("mapView.viewport.top - mapView.viewport.scale / 2")
    assert title["y"] + title["height"] <= box["y"] + top
