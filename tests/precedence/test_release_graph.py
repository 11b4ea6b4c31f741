"""The release graph of plans written by hand: the paper's door, and robots in a circle."""

from __future__ import annotations

from rightofway import FleetBuilder
from rightofway.model import Robot, Rules, Scenario, Stop, Tick, Track
from rightofway.precedence import Arrival, Part, ReleaseGraph
from rightofway.site import VertexId, make_grid_roadmap
from tests.builders.plans import door


def test_the_second_robot_waits_until_the_first_has_arrived_beyond_the_door() -> None:
    """R1 enters N1, its vertex 1, after R2 has left its own vertex 1: it is at its vertex 2."""
    plan = door()
    graph = ReleaseGraph.of(plan.scenario, plan.tracks)
    assert graph.waits(Part(0, 1)) == (Arrival(1, 2),)
    assert graph.list_waiting_for(Arrival(1, 2)) == (Part(0, 1),)
    assert not graph.may_go(Part(0, 1), [0, 1])
    assert graph.list_missing(Part(0, 1), [0, 1]) == (Arrival(1, 2),)
    assert graph.may_go(Part(0, 1), [0, 2])
    assert graph.waits(Part(1, 1)) == ()
    assert graph.find_rotation() == ()


def test_robots_that_move_round_a_square_at_one_instant_are_a_cycle() -> None:
    """Four robots on 2 x 2 cells, each to the next cell clockwise: 0, 1, 3, 2."""
    roadmap, circle = make_grid_roadmap(("..", "..")), (0, 1, 3, 2)
    ways = list(zip(circle, (*circle[1:], 0), strict=True))
    robots = tuple(
        Robot(name=f"R{k}", home=VertexId(home), stops=(Stop(at=VertexId(to)),))
        for k, (home, to) in enumerate(ways)
    )
    scenario = Scenario(roadmap=roadmap, robots=robots, rules=Rules(ends="none"))
    tracks = [Track.of(way, [0, Tick(1)]) for way in ways]
    cycle = ReleaseGraph.of(scenario, tracks).find_rotation()
    assert cycle == (Part(0, 1), Part(1, 1), Part(2, 1), Part(3, 1))


def test_robots_wait_in_the_order_of_their_arrivals_however_long_a_drive_takes() -> None:
    """R1 drives along a lane, then slow R2 along one that crosses it; times only number arrivals.

    R2 drives for 10 ticks, R1 for 1: by the begins of drives of these lengths, R2 would go first.
    """
    fleet = FleetBuilder(ends="none", turn=0, spacing="whole")
    for name, x, y in (("A", 0, 5), ("B", 10, 5), ("C", 5, 0), ("D", 5, 10)):
        fleet = fleet.add_vertex(name, x, y)
    fleet = fleet.add_edge("A", "B").add_edge("C", "D")
    fleet = fleet.add_robot("R1", home="A", target="B", speed=10, radius=1)
    fleet = fleet.add_robot("R2", home="C", target="D", speed=1, radius=1)
    tracks = [Track.of((0, 1), (0, 2)), Track.of((2, 3), (0, 4))]
    graph = ReleaseGraph.of(fleet.build_scenario(), tracks)
    assert (graph.waits(Part(0, 1)), graph.waits(Part(1, 1))) == ((), (Arrival(0, 1),))
