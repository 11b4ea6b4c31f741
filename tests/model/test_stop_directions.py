"""Where robots may not turn, each stops in the directions of a shortest trip of it alone."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from math import prod
from types import SimpleNamespace
from typing import Any, cast

import pytest

from rightofway import GaveUp, check, solve
from rightofway.assign.travel import measure_travel
from rightofway.io import parse_scenario
from rightofway.model import OutcomeKind, Scenario, Stage
from rightofway.model.stop_directions import list_directions
from rightofway.search import Distances
from rightofway.site import VertexId
from tests.builders.any_fleet import any_fleet
from tests.builders.laws import law, leave
from tests.oracles.alone import alone_completions

CORRIDOR: dict[str, Any] = {
    "A": [0, 0],
    "V": {"at": [4, 0], "turning": False},
    "W": {"at": [8, 0], "turning": False},
    "B": [12, 0],
}
EDGES = [["A", "V"], ["V", "W"], ["W", "B"]]


def make_corridor(*robots: dict[str, Any], back: str = "none", **vertices: Any) -> Scenario:
    """Make a corridor A V W B, in whose middle robots may not turn."""
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"roadmap": {"vertices": CORRIDOR | vertices, "edges": EDGES}},
            "robots": [{"name": f"R{index}", **robot} for index, robot in enumerate(robots, 1)],
            "rules": {"return": back},
        }
    )


MOST_CHOICES = 64
"""Directions of all stops of a robot that are tried."""


def put_stage_at(stage: Stage, vertex: VertexId) -> Stage:
    """Return a stage in another direction."""
    return replace(stage, vertex=vertex)


def list_names(scenario: Scenario) -> list[str]:
    """Return the path of the first robot, without the names of directions."""
    roadmap, plan = scenario.roadmap, solve(scenario)
    assert check(plan).ok
    places = [
        roadmap.originals.get(at, at) for at in map(VertexId, plan.tracks[0].vertices.tolist())
    ]
    return [roadmap.name(place) for place in places]


@pytest.mark.parametrize(("home", "target"), [*product("AB", "VW")])
def test_a_robot_stops_at_a_passage_from_both_sides(home: str, target: str) -> None:
    way = "AVWB" if home == "A" else "BWVA"
    path = list_names(make_corridor({"home": home, "target": target}))
    assert "".join(path) == way[: way.index(target) + 1]


def test_the_stops_of_one_trip_may_have_different_directions() -> None:
    stops = [{"at": at} for at in ("W", "B", "V", "A", "W")]
    assert "".join(list_names(make_corridor({"home": "A", "stops": stops}))) == "AVWBWVAVW"


def test_the_direction_of_a_stop_depends_on_the_stops_after_it() -> None:
    turn_at_b = [{"at": "V"}, {"at": "B"}]
    assert "".join(list_names(make_corridor({"home": "B", "stops": turn_at_b}))) == "BWVAVWB"


@law(any_fleet(always={"forbidden turns"}, robots=(1, 2)))
def test_no_other_directions_make_a_shorter_trip(scenario: Scenario) -> None:
    problem, roadmap = scenario.problem, scenario.roadmap
    for robot, itinerary in enumerate(problem.itineraries):
        home = scenario.robots[robot].home
        choices = [
            (stage.vertex,) if stage.vertex == home else list_directions(roadmap, stage.vertex)
            for stage in itinerary.stages
        ]
        if prod(map(len, choices)) > MOST_CHOICES:
            leave("many choices")
        trips = [
            replace(itinerary, stages=tuple(map(put_stage_at, itinerary.stages, chosen)))
            for chosen in product(*choices)
        ]
        floor = SimpleNamespace(roadmap=roadmap, problem=replace(problem, itineraries=tuple(trips)))
        alone = [ticks for ticks in alone_completions(cast("Scenario", floor)) if ticks >= 0]
        own = alone_completions(scenario)[robot]
        assert own == min(alone, default=-1)


def test_a_heading_fixes_the_direction() -> None:
    vertices: dict[str, Any] = {"V": {"at": [4, 0], "turning": False, "heading": 0}}
    assert "".join(list_names(make_corridor({"home": "B", "target": "V"}, **vertices))) == "BWVAV"


def test_nothing_is_proven_of_other_directions() -> None:
    """Each robot blocks the other: a shortest trip of each ends at the place of the other."""
    apart = make_corridor({"home": "A", "target": "W"}, {"home": "B", "target": "V"})
    with pytest.raises(GaveUp, match="other directions were not tried"):
        solve(apart)


def test_a_plan_of_least_times_is_optimal_in_all_directions() -> None:
    plan = solve(make_corridor({"home": "A", "target": "V"}, {"home": "B", "target": "W"}))
    assert plan.run is not None
    assert plan.run.outcome is not None
    assert plan.run.outcome.kind is OutcomeKind.OPTIMAL
    assert plan.flowtime == 2


def test_jobs_have_stops_and_charges_in_any_direction() -> None:
    """Both ends of the corridor are far apart; the charging place is on the way to the jobs."""
    stops = [{"at": "W", "work": 2}, {"at": "V", "work": 1}]
    robot = {"name": "R1", "home": "B", "start": {"at": "B", "soc": 0.9}, "charging": ["W"]}
    battery = {"drive": 0.01, "on": 0.001, "charge": 0.01, "reserve": 0.2}
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"roadmap": {"vertices": CORRIDOR, "edges": EDGES}},
            "robots": [robot | {"battery": "small"}],
            "batteries": {"small": battery},
            "jobs": [{"name": "J1", "stops": stops}],
            "rules": {"return": "none"},
        }
    )
    plan = solve(scenario)
    assert check(plan).ok
    assert [scenario.roadmap.name(at) for at in plan.tracks[0].vertices] == [
        "B",
        "B-W/end",
        "W-V/end",
    ]
    measured = measure_travel(scenario.problem, Distances(scenario.roadmap))
    start, place_of = measured.get_start(0), measured.place_of
    to_work = [measured.ticks[0, start, place_of[scenario.roadmap.get_vertex(at)]] for at in "WV"]
    assert to_work == [plan.tracks[0].enter[1], 2 * plan.tracks[0].enter[1]]
