"""What cells of a floor are called: people know metres, files know numbers of cells."""

from __future__ import annotations

from dataclasses import replace

from rightofway.model import Plan
from rightofway.quantities import Units
from rightofway.solve import solve
from tests.builders.fleets import grid_fleet
from tests.builders.labels import labels, overlap
from tests.builders.plans import door, yard
from tests.viewer.conftest import Opener

ROUTE = """(() => {
  const { left, top, scale } = mapView.viewport;
  const { vertices } = choice.robot;
  return [...vertices].map((vertex) =>
    [left + plan.roadmap.x[vertex] * scale, top + plan.roadmap.y[vertex] * scale]);
})()"""


def measured(plan: Plan) -> Plan:
    """Return a plan whose lengths are metres; its cells are as wide as one."""
    return replace(plan, scenario=replace(plan.scenario, units=Units(length="m", time="s")))


def test_a_cell_of_a_measured_floor_is_called_by_where_it_is(show: Opener) -> None:
    viewer = show(measured(door()), "#decision=1")
    assert "R1 and R2 would both have been in N1 (1.5,\u00a00.5)." in viewer.text("#card")


def test_homes_and_stops_are_called_after_their_robots(show: Opener) -> None:
    viewer = show(measured(door()))
    names = viewer.ask("[...plan.roadmap.x.keys()].map((vertex) => words.vertex(vertex))")
    # N0, N1, N2, N4, N6, N7 and N8
    assert names == [
        "the home of R1 (N0)", "N1 (1.5,\u00a00.5)", "the home of R2 (N2)", "N4 (1.5,\u00a01.5)",
        "the stop of R1 (N6)", "N7 (1.5,\u00a02.5)", "the stop of R2 (N8)",
    ]  # fmt: skip


def test_a_card_says_where_home_and_stops_are(show: Opener) -> None:
    card = show(measured(door()), "#robot=R1").text("#card")
    assert "Home\nN0 (0.5,\u00a00.5)" in card
    assert "N6 (0.5,\u00a02.5), turns 1 s" in card


def test_the_tip_of_a_cell_names_it_as_files_do(show: Opener) -> None:
    viewer = show(measured(door()))
    box = viewer.page.locator("#map").bounding_box()
    assert box is not None
    left, top, scale = viewer.ask(
        "(({ left, top, scale }) => [left, top, scale])(mapView.viewport)"
    )
    viewer.page.mouse.move(box["x"] + left + scale, box["y"] + top + scale)
    assert viewer.text("#hover").startswith("(1.5,\u00a01.5), N4")


def test_a_link_keeps_names(show: Opener) -> None:
    viewer = show(measured(door()), "#from=N0&to=N8")
    title = "the home of R1 (N0) to the stop of R2 (N8), 4 m"
    assert viewer.text("#diagram-title").startswith(title)
    viewer.ask("clock.seek(1)")
    viewer.wait_for("location.hash.endsWith('from=N0&to=N8')")


def test_a_station_and_a_vertex_of_a_roadmap_keep_their_names(show: Opener) -> None:
    viewer = show(measured(yard()))
    assert viewer.ask("words.vertex(0)") == "dock"


def test_the_length_of_a_route_is_how_far_the_robot_drives(show: Opener) -> None:
    """R1 drives 4 m to its stop, and the same 4 m back."""
    viewer = show(measured(door()), "#robot=R1")
    assert viewer.text("#diagram-title").startswith("Route of R1, 8 m: slopes are speeds")


def test_no_name_of_a_place_lies_on_the_route_of_the_robot_chosen(show: Opener) -> None:
    """On a floor of small cells a route leads past most of the spots beside a home and a stop."""
    scenario = grid_fleet(["." * 24] * 16, [("N25", "N165"), ("N45", "N146"), ("N357", "N203")])
    viewer = show(measured(solve(scenario)), viewport={"width": 1280, "height": 720})
    for robot in range(3):
        viewer.ask(f"choice.chooseRobot({robot})")
        written = [label for label in labels(viewer) if label["name"].startswith("(")]
        assert len(written) == 2
        for label in written:
            for x, y in viewer.ask(ROUTE):
                assert not overlap(label["box"], [x - 2, y - 2, x + 2, y + 2]), label
