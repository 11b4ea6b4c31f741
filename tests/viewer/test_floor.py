"""The page plays what became of a plan on the floor, against the plan."""

from __future__ import annotations

import re

import numpy as np
import pytest

from rightofway.model import ExecutionTrace, Tick, Track
from rightofway.viz.palette import LIGHT
from tests.builders.plans import counter, counter_late, counter_steady, crowd, delayed, door
from tests.builders.players import Player, nameless_on
from tests.viewer.conftest import Opener, pixel


@pytest.fixture
def late(show: Opener) -> Player:
    return show(counter(), "#tick=8", actual=counter_late())


def colour_of(viewer: Player, robot: str) -> str:
    """Return a robot's colour, as its row has it."""
    found: str = (
        viewer.robot(robot)
        .locator(".swatch")
        .evaluate("(swatch) => getComputedStyle(swatch).backgroundColor")
    )
    return "#" + bytes(map(int, re.findall("[0-9]+", found))).hex()


def ghosts(viewer: Player) -> dict[str, tuple[float, float]]:
    """Return where dashed rings are on the site, by their colours."""
    return {ring.colour: (ring.x, ring.y) for ring in viewer.discs() if ring.is_dashed}


def mode(viewer: Player) -> str | None:
    """Return what the switch says that is shown."""
    checked = viewer.page.get_by_role("group", name="Show").get_by_role("radio", checked=True)
    return checked.locator("..").inner_text()


def test_robots_are_where_they_were_and_ghosts_where_the_plan_has_them(late: Player) -> None:
    """At 8 R1 still works in N1, where R2 should be; R2 waits in N2, and R1 should be at home."""
    r1, r2 = (colour_of(late, name) for name in ("R1", "R2"))
    n0, n1, n2 = (pytest.approx(late.on_map((0.5 + x, 0.5))) for x in range(3))
    assert ghosts(late) == {r1: n0, r2: n1}
    discs = [disc for disc in late.discs() if disc.is_filled and disc.colour == r1]
    assert [(disc.x, disc.y) for disc in discs] == [n1]  # it works
    rings = [ring for ring in late.discs() if not ring.is_filled and not ring.is_dashed]
    assert [(ring.x, ring.y) for ring in rings if ring.colour == r2] == [n2]  # it waits


def test_a_switch_shows_plan_floor_or_both(late: Player) -> None:
    assert mode(late) == "Both"
    late.page.get_by_text("Plan", exact=True).click()
    assert (mode(late), ghosts(late)) == ("Plan", {})
    home = late.on_map((0.5, 0.5))  # where R1 should be
    assert any((disc.x, disc.y) == pytest.approx(home) for disc in late.discs() if disc.is_filled)
    late.press("ArrowRight")  # as in every group of radio buttons
    assert (mode(late), ghosts(late), late.tick) == ("Floor", {}, 8)
    late.press("f")
    assert mode(late) == "Both"
    assert len(ghosts(late)) == 2


def test_what_is_shown_is_in_the_address(show: Opener) -> None:
    viewer = show(counter(), "#tick=8&show=floor", actual=counter_late())
    assert mode(viewer) == "Floor"
    viewer.press("f")
    viewer.page.wait_for_url("**#tick=8&show=both")


def test_the_clock_runs_over_the_longer_of_both(show: Opener) -> None:
    # the plan ends at 41; alone and late, robots take longer
    assert show(counter(), actual=counter_late()).end == 41
    plan = crowd(4)
    actual = delayed(plan)
    last = max(int(tick) for tick in actual.completion if tick is not None)
    assert show(plan, actual=actual).end == last > max(track.enter[-1] for track in plan.tracks)


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
    late.seek(30)
    assert late.page.locator("#robot-list .state").all_inner_texts()[:2] == ["stuck", "broken down"]
    states = late.page.get_by_role("list", name="Present states of the robots").get_by_role(
        "listitem"
    )
    assert re.sub(r"\s", "", states.filter(has_text="broken down").inner_text()) == "brokendown1"
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
    viewer.seek(5)
    assert first.inner_text() == "2 late"  # by plan it leaves N1 at 3
    viewer.seek(6)
    assert first.inner_text() == "another way"
    assert viewer.complaints == []


def test_waiting_for_a_late_robot_is_told_and_marked(late: Player) -> None:
    """R2 waits from 0 to 9 instead of 5: the last 4 ticks are not in the plan."""
    late.page.click("#robot-list .row:has-text('R2')")
    sentence = "waits 9 time units in N2 for R1 to leave N1, 4 time units more than planned"
    assert sentence in late.text("#card")
    late.press("Escape")
    orange = [*bytes.fromhex(LIGHT.wait[1:]), 255]
    below = late.diagram_y("N2") + 2
    for tick, is_marked in ((4, False), (6, True), (8.5, True), (9.5, False)):
        found = pixel(late, "diagram", late.diagram_x(tick), below)
        assert (found == orange) is is_marked, tick


def test_the_plan_is_drawn_thin_beside_what_happened(late: Player) -> None:
    """By plan R1 is at home from 6 on; the line of that is gone without the plan."""
    x, y = late.diagram_x(8), late.diagram_y("N0")

    def darkness() -> float:
        seen = [pixel(late, "diagram", x, y + off) for off in (-1, 0, 1)]
        return max((765 - sum(colour)) * opacity / 255 for *colour, opacity in seen)

    with_plan = darkness()
    late.page.get_by_text("Floor", exact=True).click()
    late.painted()
    assert with_plan > darkness() + 100


def test_laps_that_were_delayed_cannot_be_looped_but_their_plan_can(show: Opener) -> None:
    viewer = show(counter(), "#tick=8", actual=counter_late(), steady=[counter_steady()])
    viewer.press("l")
    viewer.page.get_by_role("button", name="Pause").click()
    assert (mode(viewer), viewer.is_pressed("Loop a period")) == ("Plan", True)
    viewer.seek(15)
    viewer.press("ArrowRight")
    assert viewer.tick == 6  # from the end of the first period at 16 back to its beginning
    viewer.press("f")
    assert (mode(viewer), viewer.is_pressed("Loop a period")) == ("Floor", False)


def test_a_thousand_late_robots_are_drawn_once_each(show: Opener) -> None:
    plan = crowd(1000)
    viewer = show(plan, "#tick=50", actual=delayed(plan))
    before = viewer.calls("map")
    viewer.seek(60)
    drawn = viewer.calls("map") - before
    assert 500 * drawn["clearRect"] < drawn["arc"] <= 3 * 1000 * drawn["clearRect"]
    assert viewer.complaints == []


def test_every_control_has_a_name(show: Opener) -> None:
    viewer = show(counter(), actual=counter_late(), steady=[counter_steady()])
    assert nameless_on(viewer) == []
    assert viewer.complaints == []
