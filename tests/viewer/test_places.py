"""What cells of a floor are called: people know metres, files know numbers of cells."""

from __future__ import annotations

from pathlib import Path

from rightofway import load
from rightofway.solve import solve
from tests.builders.fleets import grid_fleet
from tests.builders.payloads import in_metres
from tests.builders.plans import door
from tests.builders.players import overlap
from tests.viewer.conftest import Opener


def test_a_cell_of_a_measured_floor_is_called_by_where_it_is(show: Opener) -> None:
    viewer = show(in_metres(door()), "#decision=1")
    assert "R1 and R2 would both have been in N1 (1.5, 0.5)." in viewer.text("#card")


def test_a_card_says_where_home_and_stops_are(show: Opener) -> None:
    card = show(in_metres(door()), "#robot=R1").text("#card")
    assert "Home\nN0 (0.5,\u00a00.5)" in card
    assert "N6 (0.5,\u00a02.5), turns 1 s" in card


def test_the_tip_of_a_cell_names_it_as_files_do(show: Opener) -> None:
    viewer = show(in_metres(door()))
    viewer.page.mouse.move(*viewer.at((1.5, 1.5)))
    assert viewer.text("#hover").startswith("(1.5,\u00a01.5), N4")


def test_a_link_keeps_names(show: Opener) -> None:
    viewer = show(in_metres(door()), "#from=N0&to=N8")
    title = "the home of R1 (N0) to the stop of R2 (N8), 4 m"
    assert viewer.text("#diagram-title").startswith(title)
    viewer.seek(1)
    viewer.page.wait_for_url("**#tick=1&from=N0&to=N8")


def test_the_length_of_a_route_is_how_far_the_robot_drives(show: Opener) -> None:
    """R1 drives 4 m to its stop, and the same 4 m back."""
    viewer = show(in_metres(door()), "#robot=R1")
    assert viewer.text("#diagram-title").startswith("Route of R1, 8 m: slopes are speeds")


def test_no_name_of_a_place_lies_on_the_route_of_the_robot_chosen(show: Opener) -> None:
    """On a floor of small cells a route leads past most of the spots beside a home and a stop."""
    scenario = grid_fleet(["." * 24] * 16, [("N25", "N165"), ("N45", "N146"), ("N357", "N203")])
    plan = in_metres(solve(scenario))
    viewer = show(plan, viewport={"width": 1280, "height": 720})
    for robot, track in zip(plan.scenario.robots, plan.tracks, strict=True):
        viewer.robot(robot.name).click()
        written = [name for name in viewer.names() if name.text.startswith("(")]
        assert len(written) == 2
        middles = plan.scenario.roadmap.positions[track.vertices] + 0.5
        for x, y in viewer.all_on_map(middles.tolist()):
            for name in written:
                assert not overlap(name.box, (x - 2, y - 2, x + 2, y + 2)), name


def test_a_split_lane_has_one_name_at_its_middle_joint(show: Opener, tmp_path: Path) -> None:
    """Two lanes cross; each is cut at every metre, and names of all pieces would cover the map."""
    (tmp_path / "lanes.yaml").write_text(
        "format: rightofway-scenario/1\n"
        "map:\n"
        "  roadmap:\n"
        "    vertices: {W: [0, 1], E: [6, 1], N: [2, 3], S: [2, -1]}\n"
        "    edges: [[W, E], [N, S]]\n"
        "  spacing: 1\n"
        "robots: [{name: R1, home: W, target: E}]\n",
        encoding="utf-8",
    )
    viewer = show(solve(load(tmp_path / "lanes.yaml")), "#tick=4")
    names = [name.text for name in viewer.names()]
    assert sorted(name for name in names if "-" in name) == ["N-S", "W-E"]
