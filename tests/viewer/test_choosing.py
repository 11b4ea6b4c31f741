"""Choosing robots and decisions, and what the page then tells."""

from dataclasses import replace

import pytest

from rightofway.model import Tick
from rightofway.units import Units
from tests.builders.plans import crowd, door, loop
from tests.builders.players import nameless_on
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
    assert viewer.tick == 0


def test_a_decision_leads_to_its_moment_and_tells_its_reason(show: Opener) -> None:
    viewer = show(door(), "#tick=9")
    viewer.page.click("#tab-decisions")
    viewer.page.click("#decision-list .row")
    assert viewer.tick == 1
    assert viewer.page.locator("#decision-list [aria-selected=true]").count() == 1
    card = viewer.text("#card")
    assert "R1 and R2 would both have been in N1. R1 waits 1 time unit in N0" in card
    assert "the completion times add up to the same. Then R1 waits by rule." in card
    assert [row.split("\t") for row in card.splitlines()[-2:]] == [
        ["Conflicts left", "0", "0"],
        ["Sum of completion times", "19 time units", "19 time units"],
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
    assert "a search found it" in viewer.text("#decision-list")


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
    viewer.page.mouse.click(*viewer.at((2.5, 0.5)))  # R2 at home in N2
    assert viewer.chosen == "R2"
    viewer.page.mouse.click(*viewer.at((1.5, 2.5)))  # nobody in N7
    assert viewer.chosen is None


def test_dragging_the_map_pans_and_chooses_nothing(show: Opener) -> None:
    viewer = show(door())
    box = viewer.box()
    before, _ = viewer.on_map((0, 0))
    viewer.page.mouse.move(box["x"] + 200, box["y"] + 200)
    viewer.page.mouse.down()
    viewer.page.mouse.move(box["x"] + 260, box["y"] + 200, steps=6)
    viewer.page.mouse.up()
    assert 40 < viewer.on_map((0, 0))[0] - before <= 60
    assert viewer.chosen is None
    viewer.page.get_by_role("button", name="Fit the map").click()
    assert viewer.on_map((0, 0))[0] == before


def test_the_wheel_zooms_round_the_pointer(show: Opener) -> None:
    viewer = show(door())
    left, top = viewer.at((1.5, 1.5))  # N4
    below, scale = (left + 40, top + 30), viewer.view[0]
    viewer.page.mouse.move(*below)
    viewer.page.mouse.wheel(0, -200)
    viewer.poll(lambda: viewer.view[0] > scale, "a larger scale")
    grown = viewer.view[0] / scale
    place = viewer.at((1.5, 1.5))  # a browser says where the pointer is in whole pixels
    assert place == pytest.approx((below[0] - 40 * grown, below[1] - 30 * grown), abs=1)


def test_the_diagram_seeks(show: Opener) -> None:
    viewer = show(door())
    slider, box = viewer.box(viewer.slider), viewer.box("#diagram")
    thumb = 16  # its middle moves over the slider's width less its own, above the diagram's moments
    middle = slider["x"] + thumb / 2 + 0.6 * (slider["width"] - thumb)
    viewer.page.mouse.click(middle, box["y"] + 60)
    assert viewer.tick == pytest.approx(6, abs=0.05)


def test_the_heat_map_shows_how_long_vertices_are_held(show: Opener) -> None:
    viewer = show(door())
    viewer.page.keyboard.press("h")
    # N1 is held for 4 ticks in all: a tick by each robot, out and back
    scale = viewer.page.locator("#heat-scale span").all_inner_texts()
    assert scale == ["0", "2", "4 time units"]
    viewer.painted()
    # linear: N4, held for 4 ticks, has the last colour at its corner, N0 the middle one at its edge
    low, high = (0xF7, 0xEA, 0xD0), (0xA4, 0x48, 0x0D)
    middle = [(one + other) / 2 for one, other in zip(low, high, strict=True)]
    for place, colour in (((1.1, 1.1), high), ((0.5, 0.07), middle)):
        assert viewer.colour(viewer.on_map(place))[:3] == pytest.approx(colour, abs=1.5)
    assert viewer.page.get_attribute("#heat", "aria-pressed") == "true"


def test_the_address_keeps_moment_and_choice(show: Opener) -> None:
    viewer = show(door())
    viewer.page.fill("#slider", "4")
    viewer.page.click("#robot-list .row:has-text('R2')")
    viewer.page.wait_for_url("**#tick=4&robot=R2")
    again = show(door(), "#tick=4&robot=R2")
    assert (again.tick, again.chosen) == (4, "R2")


def test_a_robot_can_be_found_by_name(show: Opener) -> None:
    viewer = show(crowd(120))
    viewer.page.click("#tab-robots")
    viewer.page.fill("#find-robot", "robot 11")
    # 11, and 110 to 119
    assert viewer.robot("Robot").first.get_attribute("aria-setsize") == "11"
    viewer.page.fill("#find-robot", "nobody")
    assert viewer.text("#robot-list") == "No robot has that name."


def test_lists_and_tabs_work_from_the_keyboard(show: Opener) -> None:
    viewer = show(door())
    viewer.page.focus("#robot-list")
    viewer.page.keyboard.press("ArrowDown")
    viewer.page.keyboard.press("ArrowDown")
    assert viewer.chosen == "R2"
    assert viewer.tick == 0
    active = viewer.page.get_attribute("#robot-list", "aria-activedescendant")
    assert viewer.page.get_attribute(f"#{active}", "aria-selected") == "true"
    viewer.page.focus("#tab-robots")
    viewer.page.keyboard.press("ArrowRight")
    assert viewer.page.locator("#decisions").is_visible()
    viewer.page.keyboard.press("Escape")
    assert viewer.chosen is None


def test_every_control_has_a_name(show: Opener) -> None:
    viewer = show(door(), "#decision=1")
    assert nameless_on(viewer) == []


def test_the_page_is_usable_on_a_telephone(show: Opener) -> None:
    viewer = show(crowd(30), viewport={"width": 360, "height": 740}, has_touch=True)
    assert viewer.is_as_wide_as(360)
    viewer.page.tap("#tab-robots")
    viewer.page.tap("#robot-list .row:has-text('Robot 3')")
    assert viewer.chosen == "Robot 3"
    assert viewer.box("#play")["height"] >= 36


def test_enter_chooses_the_first_robot_found_and_arrows_move_on(show: Opener) -> None:
    viewer = show(crowd(120))
    viewer.page.click("#tab-robots")
    viewer.page.fill("#find-robot", "12")
    viewer.page.keyboard.press("Enter")
    assert viewer.chosen == "Robot 12"
    viewer.page.keyboard.press("ArrowDown")
    assert viewer.chosen == "Robot 112"
    viewer.page.keyboard.press("ArrowUp")
    assert viewer.chosen == "Robot 12"
    viewer.page.keyboard.press("Escape")
    assert viewer.robot("Robot").first.get_attribute("aria-setsize") == "120"


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
    assert viewer.chosen == "R1"


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
    assert "waits 1 min in the home of R1 (N0) for R2 to leave N1 (1.5, 0.5)" in card
    assert "1 m/min" in card
