"""The distance axis of the space-time diagram: along a route, or a corridor that is chosen."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import pytest

from tests.builders.plans import crowd, door, loop, yard
from tests.builders.players import Player
from tests.viewer.conftest import Opener


def entries(viewer: Player, route: list[int]) -> list[list[Any]]:
    """Return the sections of a corridor: vertex and distance of each entry, from below."""
    found: list[list[Any]] = viewer.ask(
        f"new Corridor(plan.roadmap, {route}).sections"
        ".map((section) => section.map(({ vertex, at }) => [vertex, at]))"
    )
    return found


def test_the_way_back_is_the_way_there(show: Opener) -> None:
    # N0, N1, N4, N7, N6 of the door, a cell each
    assert entries(show(door()), [0, 1, 3, 5, 4, 5, 3, 1, 0]) == [
        [[0, 0], [1, 1], [3, 2], [5, 3], [4, 4]]
    ]


def test_a_loop_ends_where_it_began(show: Opener) -> None:
    # dock, gate, press, paint and dock again: 4, 3, 4 and 3 metres
    assert entries(show(yard()), [0, 1, 2, 3, 0, 1, 2]) == [
        [[0, 0], [1, 4], [2, 7], [3, 11], [0, 14]]
    ]


def test_what_lies_the_other_way_from_home_is_below_it(show: Opener) -> None:
    assert entries(show(door()), [1, 0, 1, 2]) == [[[2, 0], [1, 1], [0, 2]]]


def test_a_branch_begins_a_section(show: Opener) -> None:
    # from N1 to N0, N2 and N4: the third way from N1 has no room beside the first two
    assert entries(show(door()), [0, 1, 2, 1, 3]) == [[[0, 0], [1, 1], [2, 2]], [[1, 2], [3, 3]]]


def test_slopes_are_speeds(show: Opener) -> None:
    """The cart drives 1, 1 and 3/2 time units for 2, 2 and 3 length units."""
    viewer = show(loop(), "#robot=Cart")
    viewer.wait_for("!frames.asked")
    slopes = viewer.ask(
        """(({ phases, vertices }) =>
          [...phases.activity].flatMap((activity, i) => {
            if (activity !== DRIVE) return [];
            const visit = phases.visit[i];
            const { from, to } = diagram.spaceTime.axis.way(vertices[visit], vertices[visit + 1]);
            const ticks = phases.end(i) - phases.begin[i];
            return [Math.abs(from.y - to.y) / diagram.spaceTime.axis.perLength / ticks];
          }))(plan.robots[0])"""
    )
    # the way from d to a is 2 long
    assert slopes == pytest.approx([1, 1, 1, 1], rel=1e-6)


@pytest.mark.parametrize("fragment", ["", "#robot=Robot 3"])
@pytest.mark.parametrize("robots", [3, 40])
def test_names_of_rows_never_collide(show: Opener, fragment: str, robots: int) -> None:
    viewer = show(crowd(robots), fragment)
    viewer.wait_for("!frames.asked")
    heights = viewer.ask("(diagram.spaceTime.named ?? []).map(({ y }) => y)")
    assert all(abs(one - other) >= 14 for one, other in combinations(heights, 2))
    assert bool(heights) is bool(fragment)


def test_a_corridor_is_the_shortest_way_between_two_places(show: Opener) -> None:
    viewer = show(door())
    viewer.page.click("#corridor")
    viewer.wait_for("!frames.asked")
    assert "press the place on the map where it begins" in viewer.text("#diagram-title")
    box = viewer.page.locator("#map").bounding_box()
    assert box
    left, top, scale = viewer.ask("(({left, top, scale}) => [left, top, scale])(mapView.viewport)")
    viewer.page.mouse.click(box["x"] + left, box["y"] + top)  # N0
    viewer.page.mouse.click(box["x"] + left + 2 * scale, box["y"] + top + 2 * scale)  # N8
    assert viewer.ask("choice.corridor") == [0, 1, 3, 5, 6]
    viewer.wait_for("!frames.asked")
    assert viewer.text("#diagram-title").startswith("N0 to N8, 4 length units: slopes are speeds")
    assert viewer.ask("diagram.spaceTime.axis.rows.map(({ vertex }) => vertex)") == [0, 1, 3, 5, 6]
    viewer.wait_for("location.hash.endsWith('from=N0&to=N8')")
    viewer.page.keyboard.press("c")
    assert viewer.ask("choice.corridor") is None


def test_a_decision_shows_both_robots_in_full(show: Opener) -> None:
    """All seven places of the door, also those where only the robot comes that goes first."""
    viewer = show(door(), "#decision=1")
    viewer.wait_for("!frames.asked")
    assert viewer.ask("diagram.spaceTime.axis.rows.length") == 7
    assert viewer.text("#diagram-title").startswith("Place over time")


def test_a_link_shows_a_corridor(show: Opener) -> None:
    viewer = show(yard(), "#tick=2&from=gate&to=paint")
    assert viewer.ask("choice.corridor") == [1, 2, 3]
    assert show(yard(), "#from=gate&to=nowhere").ask("choice.corridor") is None


def test_escape_ends_the_choice_of_a_corridor(show: Opener) -> None:
    viewer = show(door())
    viewer.page.keyboard.press("c")
    assert viewer.ask("choice.picked") == []
    viewer.page.keyboard.press("Escape")
    assert viewer.ask("choice.picked") is None


def test_a_corridor_against_one_way_lanes_is_found_the_other_way(show: Opener) -> None:
    viewer = show(yard())
    # from paint only the dock can be driven to, 3 m; from the press, paint: 4 m
    assert viewer.ask("shortestWay(plan.roadmap, 3, 2)") == [3, 0, 1, 2]
    assert viewer.ask("shortestWay(plan.roadmap, 2, 0)") == [2, 3, 0]


def test_one_robot_among_a_thousand_has_its_diagram(show: Opener) -> None:
    viewer = show(crowd(1000), "#robot=Robot 7")
    viewer.wait_for("!frames.asked")
    assert viewer.ask("diagram.view === diagram.spaceTime")
    assert viewer.complaints == []
