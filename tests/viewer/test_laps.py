"""The page plays work that repeats: periods marked, one played for ever, the bottleneck lit."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from rightofway.model import SteadyState, Tick
from tests.builders.plans import counter, counter_late, counter_steady, door
from tests.builders.players import Player
from tests.viewer.conftest import Opener, pixel


def lit(viewer: Player) -> list[int]:
    return [*viewer.ask("channels(theme.lit)"), 255]


@pytest.fixture
def steady(show: Opener) -> Player:
    return show(counter(), "#tick=0", steady=[counter_steady()])


def in_band(viewer: Player, tick: float) -> list[int]:
    """Return the colour of the band at a tick, above the letters in it."""
    x, top = viewer.ask(f"[diagram.area.x({tick}), diagram.area.top - 20]")
    return pixel(viewer, "diagram", x, top)


def test_the_band_begins_where_everything_comes_again(steady: Player) -> None:
    nothing = [0, 0, 0, 0]
    assert in_band(steady, 5.6) == nothing
    assert nothing not in (in_band(steady, 6.4), in_band(steady, 35.6))


def test_laps_are_shown_until_the_first_robot_makes_no_more(steady: Player) -> None:
    """R1 comes home at 36 and stays there."""
    assert steady.ask("clock.end") == 36


def test_the_band_ends_where_the_repetition_does(show: Opener) -> None:
    """With what happened beside it, the plan is shown to its end at 41."""
    viewer = show(counter(), steady=[counter_steady()], actual=counter_late())
    assert in_band(viewer, 36.5) == [0, 0, 0, 0] != in_band(viewer, 35.5)


def test_periods_can_be_told_apart(steady: Player) -> None:
    first, second, third = (in_band(steady, tick) for tick in (8, 18, 28))
    assert first == third != second


def test_the_first_period_is_played_for_ever(steady: Player) -> None:
    steady.page.keyboard.press("l")
    steady.ask("clock.pause(), clock.seek(15.5), clock.advance(1 / clock.rate)")  # one tick on
    assert steady.ask("clock.tick") == pytest.approx(6.5)
    steady.ask("clock.advance(25 / clock.rate)")
    assert steady.ask("clock.tick") == pytest.approx(11.5)
    assert steady.page.get_attribute("#loop", "aria-pressed") == "true"


def test_robots_are_where_the_next_period_has_them(steady: Player) -> None:
    places = "motion.moveTo({}), [...motion.x, ...motion.activity]"
    for tick in (6, 7.5, 10.25, 15.9):
        assert steady.ask(places.format(tick)) == pytest.approx(
            steady.ask(places.format(tick + 10))
        )


def test_the_loop_is_entered_from_the_transient_and_left_by_going_beyond(steady: Player) -> None:
    steady.page.click("#loop")
    steady.ask("clock.pause(), clock.seek(2), clock.advance(3 / clock.rate)")
    assert steady.ask("[clock.tick, clock.loop.from, clock.loop.to]") == [5, 6, 16]
    steady.page.fill("#slider", "20")
    assert steady.ask("[clock.tick, clock.loop]") == [20, None]


def test_laps_are_counted_and_go_on_in_the_loop(steady: Player) -> None:
    """R1 comes home at 6, 16, 26 and 36."""
    first = steady.page.locator("#robot-list .row").first
    for tick, lap in ((5, "lap 1"), (17, "lap 3"), (26, "lap 4")):
        steady.ask(f"clock.seek({tick})")
        steady.wait_for(f"frames.written === {tick}")
        assert lap in first.inner_text()
    steady.ask("clock.seek(6), loop.toggle(), clock.pause(), clock.advance(103 / clock.rate)")
    steady.wait_for("clock.turns === 10 && frames.written === 9")
    assert "lap 12" in first.inner_text()


def test_groups_keep_their_own_periods_in_the_loop(show: Opener) -> None:
    """R2's group is told to repeat from 11 on with 20, as two of its laps do."""
    own = counter_steady()
    groups = [
        replace(own, robots=(0,), critical=()),
        SteadyState(robots=(1,), start=Tick(11), period=Tick(20)),
    ]
    viewer = show(counter(), "#tick=6", steady=groups)
    viewer.ask("loop.toggle(), clock.pause(), clock.advance(27 / clock.rate)")
    assert viewer.ask("[clock.tick, clock.running]") == [13, 33]
    viewer.wait_for("!frames.asked")
    # R2 at 33 is where it is at 13: on the way, waiting in N2
    assert viewer.ask("[plan.steady.tickOf(0, 33), plan.steady.tickOf(1, 33)]") == [13, 13]
    viewer.page.click("#robot-list .row:has-text('R2')")
    assert viewer.ask("[clock.tick, clock.running, clock.loop.from]") == [13, 33, 11]


def test_a_plan_that_ends_within_the_first_period_cannot_be_looped(show: Opener) -> None:
    viewer = show(counter(1), steady=[replace(counter_steady(), critical=())])
    assert viewer.page.is_disabled("#loop")
    viewer.page.keyboard.press("l")
    assert viewer.ask("clock.loop") is None


def test_the_bottleneck_is_lit_in_every_period(steady: Player) -> None:
    """The time in N1 is critical, by turns of R1 and R2; the time at home between is not."""
    below_the_line = "diagram.spaceTime.axis.spots({})[0].y + 5"
    home, counter = 0, 1
    ticks = ((3, counter, False), (8, counter, True), (13, counter, True), (34, counter, True))
    for tick, row, is_lit in (*ticks, (8, home, False), (18, home, False)):
        x, y = steady.ask(f"[diagram.area.x({tick}), {below_the_line.format(row)}]")
        assert (pixel(steady, "diagram", x, y) == lit(steady)) is is_lit, (tick, row)


def test_the_bottleneck_is_lit_on_the_map_until_switched_off(steady: Player) -> None:
    x, y = steady.ask(
        "(({left, top, scale}) => [left + 1.5 * scale, top + 0.12 * scale])(mapView.viewport)"
    )
    assert pixel(steady, "map", x, y) == lit(steady)
    assert steady.text("#bottleneck-legend") == "Bottleneck: R1 and R2, 10 a period"
    steady.page.keyboard.press("b")
    steady.wait_for("!frames.asked")
    assert pixel(steady, "map", x, y) != lit(steady)
    assert not steady.page.locator("#bottleneck-legend").is_visible()
    assert steady.page.get_attribute("#bottleneck", "aria-pressed") == "false"


@pytest.mark.parametrize(("tick", "robots"), [(5, []), (8, [1]), (12, [0]), (18, [1]), (28, [1])])
def test_the_robot_on_the_circuit_is_lit(steady: Player, tick: int, robots: list[int]) -> None:
    """R2 is in N1 from 6 to 11 and R1 from 11 to 16."""
    assert steady.ask(f"bottleneck.robotsNow({tick})") == robots


def test_the_circuit_takes_whole_periods(steady: Player) -> None:
    # R1 to N1 at 11, to N0 at 16, when R2 comes to N1; it goes to N2 at 21, when R1 comes to N1
    steps: Any = steady.ask("bottleneck.circuit.map(({begin, next}) => [begin, next])")
    assert steps == [[11, 16], [16, 16], [16, 21], [21, 21]]


def test_a_plan_that_does_not_repeat_has_none_of_this(show: Opener) -> None:
    viewer = show(door())
    for control in ("#loop", "#bottleneck", "#bottleneck-legend", "#mode"):
        assert not viewer.page.locator(control).is_visible()
    viewer.page.keyboard.press("l")
    viewer.page.keyboard.press("b")
    viewer.page.keyboard.press("f")
    assert viewer.ask("clock.loop") is None
    assert viewer.complaints == []
