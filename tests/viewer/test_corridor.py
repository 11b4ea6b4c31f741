"""The distance axis of the space-time diagram: along a route, or a corridor that is chosen."""

from __future__ import annotations

from itertools import combinations

import pytest

from tests.builders.plans import crowd, door, yard
from tests.builders.players import Player
from tests.viewer.conftest import Opener


def places_in(viewer: Player) -> set[str]:
    """Return the places that the diagram names."""
    return {each.text for each in viewer.texts("diagram") if each.text.startswith("N")}


@pytest.mark.parametrize("fragment", ["", "#robot=Robot 3"])
@pytest.mark.parametrize("robots", [3, 40])
def test_names_of_rows_never_collide(show: Opener, fragment: str, robots: int) -> None:
    viewer = show(crowd(robots), fragment)
    heights = [each.at[1] for each in viewer.texts("diagram") if each.text.startswith("N")]
    assert all(abs(one - other) >= 14 for one, other in combinations(heights, 2))
    assert bool(heights) is bool(fragment)


def test_a_corridor_is_the_shortest_way_between_two_places(show: Opener) -> None:
    viewer = show(door())
    viewer.page.click("#corridor")
    viewer.painted()
    assert "press its first place on the map" in viewer.text("#diagram-title")
    viewer.page.mouse.click(*viewer.at((0.5, 0.5)))  # N0
    viewer.page.mouse.click(*viewer.at((2.5, 2.5)))  # N8
    viewer.painted()
    assert viewer.text("#diagram-title").startswith("N0 to N8, 4 length units: slopes are speeds")
    assert places_in(viewer) == {"N0", "N1", "N4", "N7", "N8"}
    viewer.page.wait_for_url("**&from=N0&to=N8")
    assert viewer.page.get_attribute("#corridor", "aria-pressed") == "true"
    viewer.page.keyboard.press("c")
    assert viewer.page.get_attribute("#corridor", "aria-pressed") == "false"


def test_a_decision_shows_both_robots_in_full(show: Opener) -> None:
    """All seven places of the door, also those where only the robot comes that goes first."""
    viewer = show(door(), "#decision=1")
    viewer.painted()
    assert places_in(viewer) == {"N0", "N1", "N2", "N4", "N6", "N7", "N8"}
    assert viewer.text("#diagram-title").startswith("Place over time")


def test_a_link_shows_a_corridor(show: Opener) -> None:
    viewer = show(yard(), "#tick=2&from=gate&to=paint")
    assert viewer.text("#diagram-title").startswith("gate to paint, 7 m")  # 3 m and 4 m
    viewer = show(yard(), "#from=gate&to=nowhere")
    assert viewer.page.get_attribute("#corridor", "aria-pressed") == "false"


def test_escape_ends_the_choice_of_a_corridor(show: Opener) -> None:
    viewer = show(door())
    viewer.page.keyboard.press("c")
    assert viewer.page.get_attribute("#corridor", "aria-pressed") == "true"
    viewer.page.keyboard.press("Escape")
    assert viewer.page.get_attribute("#corridor", "aria-pressed") == "false"


def test_one_robot_among_a_thousand_has_its_diagram(show: Opener) -> None:
    viewer = show(crowd(1000), "#robot=Robot 7")
    viewer.painted()
    assert viewer.text("#diagram-title").startswith("Route of Robot 7")
    assert viewer.complaints == []
