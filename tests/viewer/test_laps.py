"""The page plays work that repeats: periods marked, one played for ever, the bottleneck lit."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rightofway.model import SteadyState, Tick
from rightofway.viz.palette import LIGHT
from tests.builders.plans import counter, counter_late, counter_steady, door
from tests.builders.players import Player
from tests.viewer.conftest import Opener, pixel


def lit(_: Player) -> list[int]:
    return [*bytes.fromhex(LIGHT.lit[1:]), 255]


@pytest.fixture
def steady(show: Opener) -> Player:
    return show(counter(), "#tick=0", steady=[counter_steady()])


def in_band(viewer: Player, tick: float) -> list[int]:
    """Return the colour of the band at a tick, above the letters in it."""
    return pixel(viewer, "diagram", viewer.diagram_x(tick), 12)  # the band is 11 to 28 from the top


def test_the_band_begins_where_everything_comes_again(steady: Player) -> None:
    nothing = [0, 0, 0, 0]
    assert in_band(steady, 5.6) == nothing
    assert nothing not in (in_band(steady, 6.4), in_band(steady, 35.6))


def test_the_band_ends_where_the_repetition_does(show: Opener) -> None:
    """With what happened beside it, the plan is shown to its end at 41."""
    viewer = show(counter(), steady=[counter_steady()], actual=counter_late())
    assert in_band(viewer, 36.5) == [0, 0, 0, 0] != in_band(viewer, 35.5)


def test_periods_can_be_told_apart(steady: Player) -> None:
    first, second, third = (in_band(steady, tick) for tick in (8, 18, 28))
    assert first == third != second


def test_the_first_period_is_played_for_ever(steady: Player) -> None:
    steady.seek(20)
    steady.press("l")
    assert steady.page.get_attribute("#loop", "aria-pressed") == "true"
    steady.page.get_by_role("button", name="Pause").click()
    assert 6 <= steady.tick <= 16
    for _ in range(12):
        steady.press("ArrowRight")
        assert 6 <= steady.tick <= 16


def test_the_loop_is_left_by_going_beyond(steady: Player) -> None:
    steady.page.click("#loop")
    steady.seek(20)
    assert steady.tick == 20
    assert steady.page.get_attribute("#loop", "aria-pressed") == "false"


def test_laps_are_counted(steady: Player) -> None:
    """R1 comes home at 6, 16, 26 and 36."""
    first = steady.page.locator("#robot-list .row").first
    for tick, lap in ((5, "lap 1"), (17, "lap 3"), (26, "lap 4")):
        steady.seek(tick)
        assert lap in first.inner_text()


def test_the_loop_is_that_of_the_group_of_the_robot_chosen(show: Opener) -> None:
    """R2's group is told to repeat from 11 on with 20, as two of its laps do; R1's has 10."""
    own = counter_steady()
    groups = [
        replace(own, robots=(0,), critical=()),
        SteadyState(robots=(1,), start=Tick(11), period=Tick(20)),
    ]
    viewer = show(counter(), "#tick=6", steady=groups)
    viewer.press("l")
    viewer.page.get_by_role("button", name="Pause").click()
    viewer.robot("R2").click()
    viewer.seek(30)  # beyond the loop of R1, which ends at 16
    viewer.press("ArrowRight")
    assert viewer.tick == 11
    assert viewer.page.get_attribute("#loop", "aria-pressed") == "true"


def test_a_plan_that_ends_within_the_first_period_cannot_be_looped(show: Opener) -> None:
    viewer = show(counter(1), steady=[replace(counter_steady(), critical=())])
    assert viewer.page.is_disabled("#loop")
    viewer.page.keyboard.press("l")
    assert viewer.page.get_attribute("#loop", "aria-pressed") == "false"


def test_the_bottleneck_is_lit_in_every_period(steady: Player) -> None:
    """The time in N1 is critical, by turns of R1 and R2; the time at home between is not."""
    home, counter = "N0", "N1"
    ticks = ((3, counter, False), (8, counter, True), (13, counter, True), (34, counter, True))
    for tick, row, is_lit in (*ticks, (8, home, False), (18, home, False)):
        below = steady.diagram_y(row) + 5  # the line
        found = pixel(steady, "diagram", steady.diagram_x(tick), below)
        assert (found == lit(steady)) is is_lit, (tick, row)


def test_the_bottleneck_is_lit_on_the_map_until_switched_off(steady: Player) -> None:
    x, y = steady.on_map((2, 0.62))  # between N1 and N2, 0.12 below the middle
    assert pixel(steady, "map", x, y) == lit(steady)
    assert steady.text("#bottleneck-legend") == "Bottleneck: R1 and R2, 10 time units a period"
    steady.page.keyboard.press("b")
    steady.painted()
    assert pixel(steady, "map", x, y) != lit(steady)
    assert not steady.page.locator("#bottleneck-legend").is_visible()
    assert steady.page.get_attribute("#bottleneck", "aria-pressed") == "false"


@pytest.mark.parametrize(("tick", "robots"), [(5, []), (8, [1]), (12, [0]), (18, [1]), (28, [1])])
def test_the_robot_on_the_circuit_is_lit(steady: Player, tick: int, robots: list[int]) -> None:
    """R2 is in N1 from 6 to 11 and R1 from 11 to 16."""
    steady.seek(tick)
    discs = [disc for disc in steady.discs() if disc.is_filled and disc.colour == LIGHT.lit]
    assert len(discs) == len(robots)
    if discs:
        assert (discs[0].x, discs[0].y) == pytest.approx(steady.on_map((1.5, 0.5)))  # N1


def test_a_plan_that_does_not_repeat_has_none_of_this(show: Opener) -> None:
    viewer = show(door())
    for control in ("#loop", "#bottleneck", "#bottleneck-legend", "#mode"):
        assert not viewer.page.locator(control).is_visible()
    viewer.page.keyboard.press("l")
    viewer.page.keyboard.press("b")
    viewer.page.keyboard.press("f")
    assert viewer.page.get_attribute("#loop", "aria-pressed") == "false"
    assert viewer.complaints == []
