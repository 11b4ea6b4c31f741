"""Robots at their true size, what they book, and how near they come to each other."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from rightofway.io import scenario_of
from rightofway.model import Plan, PlannerRun, Track
from rightofway.solve import solve
from tests.builders.plans import crowd, door
from tests.builders.players import Player
from tests.viewer.conftest import Opener

CROSS = {
    "vertices": {"A": [0, 0], "B": [8, 0], "C": [4, -4], "D": [4, 4]},
    "edges": [["A", "B"], ["C", "D"]],
}


def cross(**more: Any) -> Plan:
    """Return two robots on lanes that cross: R1 is by before R2 starts.

    R1 drives from A to B from 0 to 8; R2 waits at C until 8 and drives to D until 16.
    """
    robots = [
        {"name": "R1", "home": "A", "target": "B", "radius": 1, "return": "none"},
        {"name": "R2", "home": "C", "target": "D", "radius": "1/2", "return": "none"},
    ]
    document: dict[str, Any] = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {**CROSS, **more}, "y": "up"},
        "units": {"length": "m", "time": "s"},
        "robots": robots,
        "rules": {"clearance": "1/10"},
    }
    scenario = scenario_of(document)
    tick, times = scenario.problem.clock.tick, ([0, 8], [0, 16])
    return Plan(
        scenario=scenario,
        tracks=tuple(
            Track.of([tail, head], [int(at / tick) for at in enter])
            for tail, head, enter in zip((0, 2), (1, 3), times, strict=True)
        ),
        run=PlannerRun(name="by hand", status="valid"),
    )


def held(viewer: Player, robot: int, time: float) -> dict[str, Any]:
    """Return the names of vertices and lanes that a robot books at a time."""
    viewer.ask(f"clock.seek({time} * clock.ticksPerUnit); frames.paint(0)")
    found: dict[str, Any] = viewer.page.evaluate(
        """(robot) => {
          const { vertices, edges } = mapView.space.heldBy(plan.robots[robot]);
          const name = (vertex) => plan.roadmap.name(vertex);
          const lanes = edges.map((edge) => edge.map(name).join(""));
          return { vertices: vertices.map(name), edges: lanes };
        }""",
        robot,
    )
    return found


def test_robots_have_their_true_size(show: Opener) -> None:
    viewer = show(cross())
    for zoom in (1, 2, 0.5):
        viewer.ask(f"mapView.viewport.zoom({zoom})")
        pixels_of_a_metre = viewer.ask("mapView.viewport.scale / plan.roadmap.unit")
        sizes = viewer.ask("plan.robots.map((robot) => mapView.sizes.of(robot))")
        assert sizes == pytest.approx([pixels_of_a_metre, pixels_of_a_metre / 2])
    assert viewer.complaints == []


def test_a_robot_books_what_it_drives_on_from_and_to(show: Opener) -> None:
    viewer = show(cross())
    assert held(viewer, 0, 3) == {"vertices": ["A", "B"], "edges": ["AB"]}
    assert held(viewer, 1, 3) == {"vertices": ["C"], "edges": []}
    assert held(viewer, 1, 9) == {"vertices": ["C", "D"], "edges": ["CD"]}
    assert held(viewer, 0, 9) == {"vertices": ["B"], "edges": []}


def test_bookings_are_shown_on_request(show: Opener) -> None:
    viewer = show(cross())
    assert viewer.page.get_attribute("#space", "aria-pressed") == "false"
    viewer.page.keyboard.press("s")
    assert viewer.page.get_attribute("#space", "aria-pressed") == "true"
    viewer.page.click("#space")
    assert not viewer.ask("choice.space")


def test_fleets_of_points_have_no_such_button(show: Opener) -> None:
    for plan in (door(), crowd(20)):
        viewer = show(plan)
        assert viewer.ask("document.getElementById('space').hidden")
        viewer.page.keyboard.press("s")
        assert not viewer.ask("choice.space")


def test_the_closest_approach_is_exact_and_one_goes_to_it(show: Opener) -> None:
    """R1 is nearest to C, where R2 waits, at (4, 0): 4 m; they need 1 + 1/2 + 1/10."""
    viewer = show(cross(), "#robot=R1")
    (found,) = viewer.ask("mapView.space.encounters(plan.robots[0])")
    assert (found["distance"], found["room"]) == pytest.approx((4, 1.6))
    assert "4 m apart, 1.6 m needed" in viewer.text("#card")
    viewer.page.click("#card .go:has-text('4 m apart')")
    assert viewer.ask("clock.tick / clock.ticksPerUnit") == pytest.approx(4)
    assert viewer.ask("[choice.space, choice.pair]") == [True, 1]


def test_the_closest_approach_of_the_fleet_is_said_and_one_goes_to_it(show: Opener) -> None:
    viewer = show(cross())
    viewer.page.click("#space")
    legend = "R1 and R2, 4 m apart, 1.6 m needed, at 4 s"
    assert legend in viewer.text("#space-legend")
    viewer.page.click("#space-legend button")
    assert viewer.ask("[choice.robotIndex, choice.pair, clock.tick / clock.ticksPerUnit]") == [
        0, 1, pytest.approx(4),
    ]  # fmt: skip
    assert not viewer.page.is_visible("#space-legend")


def test_closest_approaches_are_never_below_what_robots_need(show: Opener) -> None:
    """The planner keeps to it; the page measures the same plan by itself."""
    robots = [
        {"name": f"R{k}", "home": [0, 2 * k], "target": [6, 6 - 2 * k], "radius": "45/100"}
        for k in range(4)
    ]
    document = {"format": "rightofway-scenario/1", "map": {"grid": ["." * 7] * 7}, "robots": robots}
    viewer = show(solve(scenario_of(document), time_limit=None, planner="prioritized"))
    spare = viewer.ask(
        "plan.robots.flatMap((robot) => mapView.space.encounters(robot))"
        ".map(({ distance, room }) => distance - room)"
    )
    assert len(spare) == 12
    assert min(spare) > -1e-9


def test_a_zone_has_the_colour_of_the_robot_that_holds_it(show: Opener) -> None:
    zones = [{"name": "aisle", "vertices": ["C"], "edges": [["C", "D"], ["D", "C"]]}]
    viewer = show(cross(zones=zones))
    assert viewer.ask("[...mapView.space.zoneHolders].map(([zone, { name }]) => [zone, name])") == [
        [0, "R2"]
    ]
    held(viewer, 1, 16)  # it has left the lane and C
    assert viewer.ask("mapView.space.zoneHolders.size") == 0


def test_lanes_that_cross_are_marked_where_they_cross(show: Opener) -> None:
    viewer = show(cross())
    at = viewer.ask(
        "plan.roadmap.close.crossings.map((lanes) => crossingOf(plan.roadmap, lanes))"
        ".map((at) => plan.roadmap.toSite(...at))"
    )
    assert at == [pytest.approx([4, 0])]


def test_names_of_stations_zones_and_limits_do_not_cover_each_other(show: Opener) -> None:
    more = {
        "stations": {"Press": "B", "Oven": "D"}, "parking": ["A"], "charging": ["C"],
        "zones": [{"name": "aisle", "vertices": ["C"], "edges": [["C", "D"]]}],
        "edges": [
            {"from": "A", "to": "B", "max_speed": "1/2"}, {"from": "C", "to": "D", "max_speed": 1},
        ],
    }  # fmt: skip
    plan = cross(**{key: value for key, value in more.items() if key != "edges"})
    limited = scenario_of({
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {**CROSS, **more}, "y": "up"},
        "robots": [{"name": "R1", "home": "A", "target": "B", "radius": 1}],
    })  # fmt: skip
    for shown in (plan, solve(limited)):
        viewer = show(shown)
        boxes = viewer.ask("mapView.names.written.map(({ name, box }) => [name, ...box])")
        names = {box[0] for box in boxes}
        assert {"B · Press", "D · Oven", "aisle"} <= names
        for one, (_, left, top, right, bottom) in enumerate(boxes):
            for _, x, y, to_x, to_y in boxes[one + 1 :]:
                assert right <= x or to_x <= left or bottom <= y or to_y <= top
    assert {"0.5", "1"} <= names


def test_a_closure_is_drawn_and_named(show: Opener) -> None:
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": CROSS},
        "robots": [{"name": "R1", "home": "A", "target": "B"}],
        "closures": [{"edge": ["C", "D"], "from": 8, "until": 24, "radius": 1}],
    }
    plan = solve(scenario_of(document))
    viewer = show(plan)
    (closure,) = viewer.ask("plan.closures")
    assert Fraction(closure["from"]) * plan.scenario.problem.clock.tick == 8
    assert (
        viewer.ask("words.closure(plan.closures[0])") == "C to D closed from time 8 until time 24"
    )
    assert viewer.complaints == []
