"""The rule of release in chaos: no fault in the rule, and each broken wording of it is found."""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import pairwise

import pytest

import rightofway
from rightofway.control import FleetControl, Message, Order, RouteToDrive, SimulatedRobot
from rightofway.control.routes import make_routes_to_drive
from rightofway.io import parse_scenario
from rightofway.precedence import ReleaseGraph
from tests.builders.broken_wordings import WORDINGS, LastNodeIsEnough, VertexTwiceInBase
from tests.builders.chaos import (
    KINDS,
    Fault,
    MemoryJournal,
    Observer,
    another_plan,
    chaotic_plan,
    run_chaos,
)
from tests.builders.plans import door

SEEDS = 5
"""Of each kind; `just chaos` makes as many runs as are wanted."""


@pytest.mark.parametrize("kind", KINDS)
def test_robots_hold_nothing_together_and_do_each_job_once(kind: str) -> None:
    for seed in range(SEEDS):
        run_chaos(chaotic_plan(seed, kind), seed, KINDS[kind])


def test_chaos_does_what_it_says() -> None:
    """Kills, plans of the rest, lost orders, wrong fields and withdrawals all take place."""
    counts = run_chaos(chaotic_plan(3), 3, KINDS["all"])
    for what in ("kills", "splices", "resets", "wrong fields", "cancels"):
        assert counts[what] > 0, what


def test_another_plan_leads_along_no_lane_from_which_a_robot_is_barred() -> None:
    """A control that was given such a route could not find a better order of it."""
    lanes = [["A", "B"], ["B", "C"], {"from": "A", "to": "C", "barred": ["wide"]}]
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {"vertices": {"A": [0, 0], "B": [1, 1], "C": [2, 0]}, "edges": lanes}},
        "rules": {"rotations": False},
        "robots": [{"name": "R1", "home": "A", "target": "C", "type": "wide"}],
    }
    plan = rightofway.solve(parse_scenario(document), "prioritized")
    control = FleetControl(MemoryJournal())
    control.begin("run", make_routes_to_drive(plan), ReleaseGraph.of(plan.scenario, plan.tracks))
    ways = set[tuple[str, ...]]()
    for seed in range(20):
        routes, _ = another_plan(plan.scenario, control, random.Random(seed)) or ([], None)  # noqa: S311
        ways |= {route.places for route in routes}
    assert len(ways) > 1
    assert {"A", "C"} not in [{*pair} for way in ways for pair in pairwise(way)]


@pytest.mark.parametrize("wording", WORDINGS)
def test_a_broken_wording_is_found(wording: str) -> None:
    """Within forty seeds the observer, the journal or the control itself stops a run."""
    control, kind = WORDINGS[wording]
    for seed in range(40):
        try:
            run_chaos(chaotic_plan(seed, kind), seed, KINDS[kind], control)
        except Exception:  # noqa: BLE001 (some wordings end in a contradiction within control)
            return
    pytest.fail(f"nobody noticed: {control.__doc__}")


class Loop:
    """R1 of the door with a way that comes to N0 twice: N0 N1 N0 N1 N4."""

    def __init__(self, kind: type[FleetControl]) -> None:
        self.robots = [SimulatedRobot("N0"), SimulatedRobot("N2")]
        self.control = kind(MemoryJournal())
        places = [("N0", "N1", "N0", "N1", "N4"), ("N2",)]
        routes = [RouteToDrive(places=own, jobs=((),) * len(own)) for own in places]
        self.control.begin("run", routes, ReleaseGraph([5, 1], {}))
        self.observer = Observer(door().scenario, self.robots)
        self.take(self.control.start())
        self.update = self.control.receive(0, self.robots[0].report_state())

    def take(self, messages: list[Message]) -> None:
        """Bring orders to R1."""
        for message in messages:
            if isinstance(message, Order) and message.robot == 0:
                self.robots[0].take_order(message)


@pytest.mark.parametrize("kind", [FleetControl, VertexTwiceInBase])
def test_a_loop_is_not_driven_twice_by_a_robot_that_forgets_it(kind: type[FleetControl]) -> None:
    """It comes to N0 again, forgets its order, gets it again, and its state from before comes.

    In chaos so much has to happen at once that hundreds of runs do not find it.
    """
    loop = Loop(kind)
    loop.take(loop.update)
    robot = loop.robots[0]
    for _ in range(4):
        robot.step()
    late = robot.report_state()
    assert robot.forget()
    loop.take(loop.control.remind())
    loop.control.receive(0, late)
    if kind is FleetControl:
        loop.observer.look(loop.control)
    else:
        with pytest.raises(Fault, match="robot 0 has base"):
            loop.observer.look(loop.control)


@pytest.mark.parametrize("kind", [FleetControl, VertexTwiceInBase, LastNodeIsEnough])
def test_a_wrong_number_of_a_node_proves_nothing(kind: type[FleetControl]) -> None:
    """Its update is on its way, and R1 says that it is at N0 for the second time."""
    loop = Loop(kind)
    wrong = replace(loop.robots[0].report_state(), last_sequence_id=4)
    loop.control.receive(0, wrong)
    loop.take(loop.update)
    if kind is LastNodeIsEnough:
        with pytest.raises(Fault, match="robot 0 has base"):
            loop.observer.look(loop.control)
    else:
        loop.observer.look(loop.control)
