"""The page plays what became of a plan on the floor, against the plan."""

from __future__ import annotations

import numpy as np
import pytest

from rightofway.model import ExecutionTrace, Tick, Track
from tests.builders.plans import counter, counter_late, counter_steady, crowd, delayed, door
from tests.builders.players import Player
from tests.viewer.conftest import Opener, pixel


@pytest.fixture
def late(show: Opener) -> Player:
    return show(counter(), "#tick=8", actual=counter_late())


def test_robots_are_where_they_were_and_ghosts_where_the_plan_has_them(late: Player) -> None:
    """At 8 R1 still works in N1, where R2 should be; R2 waits in N2, and R1 should be at home."""
    assert late.ask("[[...motion.x], [...ghosts.x]]") == [[1, 2], [0, 1]]
    viewport = "mapView.viewport.left + {} * mapView.viewport.scale"
    radius = late.ask("1.14 * mapView.sizes.robot / mapView.viewport.scale")
    top = late.ask("mapView.viewport.top")
    blue = [*late.ask("channels(plan.robots[0].colour)"), 255]
    x = late.ask(viewport.format(0 + radius))
    ring = [pixel(late, "map", x, top + down) for down in range(-8, 9)]
    assert blue in ring


def test_a_switch_shows_plan_floor_or_both(late: Player) -> None:
    assert late.ask("choice.mode") == "both"
    late.page.click("#mode label:has-text('Plan')")
    late.wait_for("!frames.asked")
    assert late.ask("[choice.mode, choice.ghosts, motion.x[0]]") == ["plan", False, 0]
    late.page.keyboard.press("ArrowRight")  # as in every group of radio buttons
    assert late.ask("[choice.mode, choice.ghosts, clock.tick]") == ["floor", False, 8]
    late.page.evaluate("document.activeElement.blur()")
    late.page.keyboard.press("f")
    assert late.ask("choice.mode") == "both"
    assert late.page.is_checked("#mode input[value=both]")


def test_what_is_shown_is_in_the_address(show: Opener) -> None:
    viewer = show(counter(), "#tick=8&show=floor", actual=counter_late())
    assert viewer.ask("choice.mode") == "floor"
    viewer.page.keyboard.press("f")
    viewer.wait_for("location.hash === '#tick=8&show=both'")


def test_the_clock_runs_over_the_longer_of_both(show: Opener) -> None:
    # the plan ends at 41; alone and late, robots take longer
    assert show(counter(), actual=counter_late()).ask("clock.end") == 41
    plan = crowd(4)
    viewer = show(plan, actual=delayed(plan))
    assert viewer.ask("clock.end > Math.max(...plan.planned.map((robot) => robot.completion))")


@pytest.mark.parametrize(
    ("tick", "lateness"),
    [
        (0, ["on time", "on time"]),
        (6, ["on time", "on time"]),
        (7, ["1 late", "1 late"]),  # R1 should have left N1 at 6, and R2 N2
        (12, ["4 late", "4 late"]),
        (21, ["4 late", "4 late"]),
        (24, ["", ""]),  # for ever
    ],
)
def test_lateness_is_told_as_it_grows(show: Opener, tick: int, lateness: list[str]) -> None:
    viewer = show(counter(), f"#tick={tick}", actual=counter_late())
    rows = viewer.page.locator("#robot-list .late").all_inner_texts()
    assert rows[:2] == lateness


def test_who_breaks_down_is_marked_and_who_is_stuck_is_told_why(late: Player) -> None:
    late.ask("clock.seek(30)")
    late.wait_for("frames.written === 30")
    assert late.page.locator("#robot-list .state").all_inner_texts()[:2] == ["stuck", "broken down"]
    assert late.ask("motion.counts[BROKEN]") == 1
    late.page.click("#robot-list .row:has-text('R1')")
    assert "never: stuck behind R2, which breaks down" in late.text("#card")
    late.page.click("#robot-list .row:has-text('R2')")
    assert "at 22" in late.text("#card")
    assert late.text("#headline") == "2 robots\n2 of them never home"


def test_who_was_planned_anew_goes_another_way(show: Opener) -> None:
    """R2 of the door breaks down in N4 at 3; R1 turns back in N1 and is home at 6."""
    actual = ExecutionTrace(
        tracks=(Track.of([0, 1, 0], [0, 2, 6]), Track.of([2, 1, 3], [0, 1, 2])),
        dwell=(np.zeros(3, np.int64), np.zeros(3, np.int64)),
        drive=(np.array([0, 1, 1]), np.array([0, 1, 1])),
        completion=(None, None),
        stoppages=((), ((Tick(3), None),)),
    )
    viewer = show(door(), "#tick=2", actual=actual)
    first = viewer.page.locator("#robot-list .late").first
    assert first.inner_text() == "on time"
    viewer.ask("clock.seek(5)")
    viewer.wait_for("frames.written === 5")
    assert first.inner_text() == "2 late"  # by plan it leaves N1 at 3
    viewer.ask("clock.seek(6)")
    viewer.wait_for("frames.written === 6")
    assert viewer.ask("plan.robots[0].lateness(6, 2)") is None
    assert viewer.complaints == []


def test_what_holds_a_robot_up_interrupts_its_work(late: Player) -> None:
    """R1 works from 1, stands still from 3 to 7, works on until 8, turns, and drives home at 9."""
    phases = late.ask(
        "(({ begin, activity }) => [[...begin], [...activity]])(plan.happened[0].phases)"
    )
    found = [(int(tick), kind) for tick, kind in zip(*phases, strict=True)]
    drive, wait, work, turn, held = 0, 1, 2, 3, 5
    assert found[:7] == [
        (0, drive), (1, work), (3, held), (7, work), (8, turn), (9, drive), (10, turn),
    ]  # fmt: skip
    assert found[-2:] == [(20, turn), (21, wait)]


def test_waiting_for_a_late_robot_is_told_and_marked(late: Player) -> None:
    """R2 waits from 0 to 9 instead of 5: the last 4 ticks are not in the plan."""
    late.page.click("#robot-list .row:has-text('R2')")
    assert "waits 9 time units in N2 for R1 to leave N1, 4 more than planned" in late.text("#card")
    late.page.keyboard.press("Escape")
    late.wait_for("!frames.asked")
    orange = [*late.ask("channels(theme.wait)"), 255]
    middle = "diagram.spaceTime.axis.spots(2)[0].y + 2"  # N2
    for tick, is_marked in ((4, False), (6, True), (8.5, True), (9.5, False)):
        x, y = late.ask(f"[diagram.area.x({tick}), {middle}]")
        assert (pixel(late, "diagram", x, y) == orange) is is_marked, tick


def test_the_plan_is_drawn_thin_beside_what_happened(late: Player) -> None:
    """By plan R1 is at home from 6 on; the line of that is gone without the plan."""
    x, y = late.ask("[diagram.area.x(8), diagram.spaceTime.axis.spots(0)[0].y]")

    def darkness() -> float:
        seen = [pixel(late, "diagram", x, y + off) for off in (-1, 0, 1)]
        return max((765 - sum(colour)) * opacity / 255 for *colour, opacity in seen)

    with_plan = darkness()
    late.ask("choice.show('floor')")
    late.wait_for("!frames.asked")
    assert with_plan > darkness() + 100


def test_laps_that_were_delayed_cannot_be_looped_but_their_plan_can(show: Opener) -> None:
    viewer = show(counter(), "#tick=8", actual=counter_late(), steady=[counter_steady()])
    viewer.page.keyboard.press("l")
    assert viewer.ask("[choice.mode, clock.loop.to]") == ["plan", 16]
    viewer.page.keyboard.press("f")
    assert viewer.ask("[choice.mode, clock.loop]") == ["floor", None]


def test_a_thousand_late_robots_are_drawn_once_each(show: Opener) -> None:
    plan = crowd(1000)
    viewer = show(plan, "#tick=50", actual=delayed(plan))
    arcs = viewer.ask(
        """() => {
          let arcs = 0;
          const draw = CanvasRenderingContext2D.prototype.arc;
          CanvasRenderingContext2D.prototype.arc = function (...args) {
            arcs++;
            draw.apply(this, args);
          };
          mapView.paint();
          return arcs;
        }"""
    )
    assert arcs <= 3 * 1000
    assert viewer.complaints == []


def test_every_control_has_a_name(show: Opener) -> None:
    viewer = show(counter(), actual=counter_late(), steady=[counter_steady()])
    nameless = viewer.ask(
        "[...document.querySelectorAll('button, input, select, canvas')]"
        ".filter((it) => !(it.ariaLabel || it.textContent.trim() || it.labels?.length))"
        ".map((it) => it.id)"
    )
    assert nameless == []
    assert viewer.complaints == []
