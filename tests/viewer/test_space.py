"""Robots at their true size, what they book, and how near they come to each other."""

from __future__ import annotations

from itertools import combinations

import pytest

from rightofway.io import parse_scenario
from rightofway.solve import solve
from tests.builders.payloads import CROSS, cross
from tests.builders.plans import crowd, door
from tests.builders.players import overlap
from tests.viewer.conftest import Opener


def test_robots_have_their_true_size(show: Opener) -> None:
    viewer = show(cross())
    for key in ("0", "+", "-"):
        viewer.press(key)
        metre = viewer.view[0]
        for place, radius in (((0, 0), metre), ((4, -4), metre / 2)):  # R1 in A, R2 in C
            at = pytest.approx(viewer.on_map(place))
            radii = [disc.radius for disc in viewer.discs() if (disc.x, disc.y) == at]
            assert any(each == pytest.approx(radius) for each in radii), (key, place, radii)
    assert viewer.complaints == []


def test_bookings_are_shown_on_request(show: Opener) -> None:
    viewer = show(cross())
    assert viewer.page.get_attribute("#space", "aria-pressed") == "false"
    viewer.page.keyboard.press("s")
    assert viewer.page.get_attribute("#space", "aria-pressed") == "true"
    viewer.page.click("#space")
    assert viewer.page.get_attribute("#space", "aria-pressed") == "false"


def test_fleets_of_points_have_no_such_button(show: Opener) -> None:
    for plan in (door(), crowd(20)):
        viewer = show(plan)
        assert not viewer.page.locator("#space").is_visible()
        viewer.page.keyboard.press("s")
        assert viewer.page.get_attribute("#space", "aria-pressed") == "false"


def test_the_closest_approach_is_exact_and_one_goes_to_it(show: Opener) -> None:
    """R1 is nearest to C, where R2 waits, at (4, 0): 4 m; they need 1 + 1/2 + 1/10."""
    viewer = show(cross(), "#robot=R1")
    assert "4 m apart, 1.6 m needed" in viewer.text("#card")
    viewer.page.click("#card .go:has-text('4 m apart')")
    assert viewer.text("#readout") == "4 s of 16 s"
    assert viewer.page.get_attribute("#space", "aria-pressed") == "true"


def test_the_closest_approach_of_the_fleet_is_said_and_one_goes_to_it(show: Opener) -> None:
    viewer = show(cross())
    viewer.page.click("#space")
    legend = "R1 and R2, 4 m apart, 1.6 m needed, at 4 s"
    assert legend in viewer.text("#space-legend")
    viewer.page.click("#space-legend button")
    assert (viewer.chosen, viewer.text("#readout")) == ("R1", "4 s of 16 s")
    assert not viewer.page.is_visible("#space-legend")


def test_names_of_stations_zones_and_limits_do_not_cover_each_other(show: Opener) -> None:
    more = {
        "stations": {"Press": "B", "Oven": "D"}, "parking": ["A"], "charging": ["C"],
        "zones": [{"name": "aisle", "vertices": ["C"], "edges": [["C", "D"]]}],
        "edges": [
            {"from": "A", "to": "B", "max_speed": "1/2"}, {"from": "C", "to": "D", "max_speed": 1},
        ],
    }  # fmt: skip
    plan = cross(**{key: value for key, value in more.items() if key != "edges"})
    limited = parse_scenario({
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {**CROSS, **more}, "y": "up"},
        "robots": [{"name": "R1", "home": "A", "target": "B", "radius": 1}],
    })  # fmt: skip
    for shown in (plan, solve(limited)):
        viewer = show(shown)
        written = viewer.names()
        names = {each.text for each in written}
        assert {"B · Press", "D · Oven", "aisle"} <= names
        for one, other in combinations(written, 2):
            assert not overlap(one.box, other.box), (one, other)
    assert {"0.5", "1"} <= names


def test_a_closure_is_drawn_and_named(show: Opener) -> None:
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": CROSS},
        "robots": [{"name": "R1", "home": "A", "target": "B"}],
        "closures": [{"edge": ["C", "D"], "from": 8, "until": 24, "radius": 1}],
    }
    plan = solve(parse_scenario(document))
    viewer = show(plan)
    viewer.page.mouse.move(*viewer.at((4, 2)))  # in the lane from C to D, beside the crossing
    assert "C to D closed from time 8 until time 24" in viewer.text("#hover")
    assert viewer.complaints == []
