"""Choosing robots and decisions, and what the page then tells."""

from dataclasses import replace

from rightofway.model import Tick
from rightofway.quantities import Units
from tests.builders.plans import crowd, door, loop
from tests.viewer.conftest import Opener


def test_a_robot_tells_its_times_and_why_it_waits(show: Opener) -> None:
    viewer = show(door())
    viewer.page.click("#robot-list .row:has-text('R1')")
    card = viewer.text("#card")
    # alone it takes 9: eight edges and a turning of one
    assert "Alone\t9\n+\tWaiting\t1\n=\tHome at\t10" in card
    assert "waits 1 time unit in N0 for R2 to leave N1" in card


def test_a_wait_in_the_card_leads_to_its_moment(show: Opener) -> None:
    viewer = show(door(), "#tick=6&robot=R1")
    viewer.page.click("#card .go:has-text('waits 1 time unit')")
    assert viewer.ask("clock.tick") == 0


def test_a_decision_leads_to_its_moment_and_tells_its_reason(show: Opener) -> None:
    viewer = show(door(), "#tick=9")
    viewer.page.click("#tab-decisions")
    viewer.page.click("#decision-list .row")
    assert viewer.ask("clock.tick") == 1
    assert viewer.ask("choice.decision.robots") == [0, 1]
    card = viewer.text("#card")
    assert "R1 and R2 would both have been in N1. R1 waits 1 time unit in N0" in card
    assert "A tie: " in card
    assert [row.split() for row in card.splitlines()[-2:]] == [
        ["Conflicts", "left", "0", "0"],
        ["Sum", "of", "completion", "times", "19", "19"],
    ]


def test_a_decision_by_priority_needs_no_figures(show: Opener) -> None:
    plan = door()
    decision = replace(
        plan.run.decisions[0], level="priority", conflicts_left=(None, None), completion_sums=None
    )
    viewer = show(replace(plan, run=replace(plan.run, decisions=(decision,))))
    viewer.page.click("#tab-decisions")
    assert "at time 1 · loses 1 time unit · by priority" in viewer.text("#decision-list")
    viewer.page.click("#decision-list .row")
    assert "R1 waits because R2 has the higher priority." in viewer.text("#card")
    assert viewer.page.locator("#card table").count() == 0


def test_a_plan_without_decisions_says_why_it_has_none(show: Opener) -> None:
    """A search makes no decisions one by one, though robots wait."""
    plan = door()
    viewer = show(replace(plan, run=replace(plan.run, decisions=())))
    assert viewer.text("#tab-decisions b") == "\u2013"
    viewer.page.click("#tab-decisions")
    assert "a search makes none" in viewer.text("#decision-list")


def test_where_no_robot_loses_time_nothing_had_to_be_decided(show: Opener) -> None:
    viewer = show(crowd(1))
    assert viewer.text("#tab-decisions b") == "0"
    viewer.page.click("#tab-decisions")
    assert "No decision was needed" in viewer.text("#decision-list")


def test_a_reroute_chooses_its_robot(show: Opener) -> None:
    viewer = show(loop())
    viewer.page.click("#tab-decisions")
    viewer.page.click("#decision-list .row")
    assert "Another way\njust so" in viewer.text("#card")


def test_the_map_chooses_the_robot_under_the_pointer(show: Opener) -> None:
    viewer = show(door())
    box = viewer.page.locator("#map").bounding_box()
    assert box
    left, top, scale = viewer.ask("(({left, top, scale}) => [left, top, scale])(mapView.viewport)")
    viewer.page.mouse.click(box["x"] + left + 2 * scale, box["y"] + top)  # R2 at home in N2
    assert viewer.ask("choice.robot.name") == "R2"
    viewer.page.mouse.click(box["x"] + left + scale, box["y"] + top + 2 * scale)  # nobody in N7
    assert viewer.ask("choice.robot") is None


def test_dragging_the_map_pans_and_chooses_nothing(show: Opener) -> None:
    viewer = show(door())
    box = viewer.page.locator("#map").bounding_box()
    assert box
    before = viewer.ask("mapView.viewport.left")
    viewer.page.mouse.move(box["x"] + 200, box["y"] + 200)
    viewer.page.mouse.down()
    viewer.page.mouse.move(box["x"] + 260, box["y"] + 200, steps=6)
    viewer.page.mouse.up()
    assert 40 < viewer.ask("mapView.viewport.left") - before <= 60
    viewer.page.click("#fit")
    assert viewer.ask("mapView.viewport.left") == before


def test_the_wheel_zooms_round_the_pointer(show: Opener) -> None:
    viewer = show(door())
    box = viewer.page.locator("#map").bounding_box()
    assert box
    viewer.page.mouse.move(box["x"] + 300, box["y"] + 200)
    place, scale = (
        "[mapView.viewport.toX(300), mapView.viewport.toY(200)]",
        "mapView.viewport.scale",
    )
    before, small = viewer.ask(place), viewer.ask(scale)
    viewer.page.mouse.wheel(0, -200)
    viewer.wait_for(f"{scale} > {small}")
    assert [round(x, 6) for x in viewer.ask(place)] == [round(x, 6) for x in before]


def test_the_diagram_seeks(show: Opener) -> None:
    viewer = show(door())
    box = viewer.page.locator("#diagram").bounding_box()
    assert box
    viewer.page.mouse.click(box["x"] + viewer.ask("diagram.area.x(6)"), box["y"] + 60)
    assert round(viewer.ask("clock.tick"), 1) == 6


def test_the_heat_map_shows_how_long_vertices_are_held(show: Opener) -> None:
    viewer = show(door())
    viewer.page.keyboard.press("h")
    # N1 is held for 4 ticks in all: a tick by each robot, out and back; N0, N6, N8 for 2
    assert viewer.ask("Array.from(use.held)") == [2, 4, 1, 4, 2, 4, 2]
    scale = viewer.page.locator("#heat-scale span").all_inner_texts()
    assert scale == ["0", "2", "4 time units"]
    # linear: N0 is held half as long as N1, and has the colour in the middle of the scale
    assert viewer.ask("use.heat(0, theme) === blend(theme.heatLow, theme.heatHigh, 0.5)")
    assert viewer.page.get_attribute("#heat", "aria-pressed") == "true"


def test_the_address_keeps_moment_and_choice(show: Opener) -> None:
    viewer = show(door())
    viewer.page.fill("#slider", "4")
    viewer.page.click("#robot-list .row:has-text('R2')")
    viewer.wait_for("location.hash === '#tick=4&robot=R2'")
    again = show(door(), "#tick=4&robot=R2")
    assert (again.ask("clock.tick"), again.ask("choice.robot.name")) == (4, "R2")


def test_a_robot_can_be_found_by_name(show: Opener) -> None:
    viewer = show(crowd(120))
    viewer.page.click("#tab-robots")
    viewer.page.fill("#find-robot", "robot 11")
    # 11, and 110 to 119
    assert viewer.ask("robotList.list.items.length") == 11
    viewer.page.fill("#find-robot", "nobody")
    assert viewer.text("#robot-list") == "No robot has that name."


def test_lists_and_tabs_work_from_the_keyboard(show: Opener) -> None:
    viewer = show(door())
    viewer.page.focus("#robot-list")
    viewer.page.keyboard.press("ArrowDown")
    viewer.page.keyboard.press("ArrowDown")
    assert viewer.ask("choice.robot.name") == "R2"
    assert viewer.ask("clock.tick") == 0
    active = viewer.page.get_attribute("#robot-list", "aria-activedescendant")
    assert viewer.page.get_attribute(f"#{active}", "aria-selected") == "true"
    viewer.page.focus("#tab-robots")
    viewer.page.keyboard.press("ArrowRight")
    assert viewer.page.locator("#decisions").is_visible()
    viewer.page.keyboard.press("Escape")
    assert viewer.ask("choice.robot") is None


def test_every_control_has_a_name(show: Opener) -> None:
    viewer = show(door(), "#decision=1")
    controls = "[...document.querySelectorAll('button, input, select, canvas, [role=listbox]')]"
    nameless = viewer.ask(
        f"{controls}.filter((it) => !(it.ariaLabel || it.textContent.trim() || it.labels?.length))"
        ".map((it) => it.id)"
    )
    assert nameless == []


def test_the_page_is_usable_on_a_telephone(show: Opener) -> None:
    viewer = show(crowd(30), viewport={"width": 360, "height": 740}, has_touch=True)
    assert viewer.ask("document.documentElement.scrollWidth") == 360
    viewer.page.tap("#tab-robots")
    viewer.page.tap("#robot-list .row:has-text('Robot 3')")
    assert viewer.ask("choice.robot.name") == "Robot 3"
    height = viewer.ask("document.querySelector('#play').getBoundingClientRect().height")
    assert height >= 36


def test_enter_chooses_the_first_robot_found_and_arrows_move_on(show: Opener) -> None:
    viewer = show(crowd(120))
    viewer.page.click("#tab-robots")
    viewer.page.fill("#find-robot", "12")
    viewer.page.keyboard.press("Enter")
    assert viewer.ask("choice.robot.name") == "Robot 12"
    viewer.page.keyboard.press("ArrowDown")
    assert viewer.ask("choice.robot.name") == "Robot 112"
    viewer.page.keyboard.press("ArrowUp")
    assert viewer.ask("choice.robot.name") == "Robot 12"
    viewer.page.keyboard.press("Escape")
    assert viewer.ask("robotList.list.items.length") == 120


def test_a_tie_is_called_a_tie_and_nothing_is_lost_by_nothing(show: Opener) -> None:
    plan = door()
    free = replace(plan.run.decisions[0], ticks=Tick(0), completion_sums=(18, 19))
    viewer = show(replace(plan, run=replace(plan.run, decisions=(*plan.run.decisions, free))))
    viewer.page.click("#tab-decisions")
    first, second = viewer.page.locator("#decision-list .row:visible").all_inner_texts()
    assert "a tie: either choice costs the same" in first
    assert "no time lost · both done sooner in all" in second


def test_the_head_says_in_plain_words_what_the_plan_does(show: Opener) -> None:
    viewer = show(door(), title="door.yaml", viewport={"width": 1600, "height": 1000})
    assert viewer.text("#headline").split("\n") == ["door.yaml", "2 robots"]
    assert viewer.text("#figures").split("\n") == [
        "All home at", "10", "Latest", "R1", "Time lost", "1 (waiting)", "Loses most", "R1, 1",
    ]  # fmt: skip
    assert viewer.page.title() == "door.yaml: 2 robots"
    viewer.page.click("#figures >> text=R1")
    assert viewer.ask("choice.robot.name") == "R1"


def test_how_the_plan_was_made_is_in_the_details(show: Opener) -> None:
    viewer = show(door())
    viewer.page.click("#about-open")
    details = viewer.text("#about").split("\n")
    assert details[details.index("Flowtime") + 1] == "19"
    assert details[details.index("Lower bound") + 1] == "18"
    viewer.page.keyboard.press("Escape")
    assert not viewer.page.locator("#about").is_visible()


def test_times_are_written_in_the_units_of_the_scenario(show: Opener) -> None:
    plan = door()
    scenario = replace(plan.scenario, units=Units(length="m", time="min"))
    viewer = show(replace(plan, scenario=scenario), "#tick=0.5&robot=R1")
    assert viewer.text("#readout") == "30 s of 10 min"
    card = viewer.text("#card")
    assert "waits 1 min in the home of R1 (N0) for R2 to leave N1 (1.5,\u00a00.5)" in card
    assert "1 m/min" in card
