"""Plans of every planner for any fleet, plans that are broken, and what two judges say of them."""

from __future__ import annotations

import random
from dataclasses import replace

import rightofway
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Plan, Scenario, Track, find_stays
from rightofway.planners import Feature, find_all
from tests.builders.changes import CHANGES
from tests.builders.laws import leave
from tests.oracles import judge

__all__ = ["ALL", "QUICK", "STRICT", "broken", "by_both_judges", "knows", "planned"]

SPECS = find_all()
ALL = sorted(SPECS)
STRICT = [name for name in ALL if Feature.LEAVES_SWAPS not in SPECS[name].features]
"""Planners whose plans keep all rules; the paper's method leaves swaps."""

STEPS = {"iterations": 10, "nodes": 30, "rounds": 3, "restarts": 2}
"""A few steps, by the names of the options that bound a planner by steps."""

QUICK = {
    name: {option.name: STEPS[option.name] for option in spec.options if option.name in STEPS}
    for name, spec in SPECS.items()
}
"""Options that bound a planner by steps."""

BETWEEN_ROBOTS = {
    "vertex conflict": "booking",
    "headway": "booking",
    "space conflict": "booking",
    "zone conflict": "booking",
    "swap conflict": "swap",
    "rotation": "rotation",
    "too close": "meeting",
    "closed": "closure",
}
"""What the second judge says instead; every other fault is one of a trip."""

Faults = set[tuple[str, tuple[int, ...]]]
"""Kinds, each with the robots concerned."""


def knows(planner: str, scenario: Scenario) -> bool:
    """Tell whether a fleet is within the contract of a planner; it refuses all others."""
    features, problem = SPECS[planner].features, scenario.problem
    return all(
        (
            Feature.SIZES in features or problem.resources.are_points,
            Feature.TURN_RATES in features
            or all(one.turning is None for one in problem.itineraries),
            Feature.CLOSURES in features or not scenario.closures,
            Feature.BARRED_EDGES in features or not problem.is_barred,
        )
    )


def planned(scenario: Scenario, planner: str, seed: int = 0, *, start: Plan | None = None) -> Plan:
    """Return a plan; leave the case where the planner refuses the fleet, or finds none."""
    if not knows(planner, scenario):
        leave("the planner does not know such fleets")
    try:
        return rightofway.solve(
            scenario, planner, time_limit=None, seed=seed, start=start, options=QUICK.get(planner)
        )
    except NoPlanExists:
        leave("no plan exists")
    except GaveUp:
        leave("the planner gave up")


def broken(plan: Plan, draw: random.Random) -> Plan:
    """Return a plan with a change of one robot's track, or of the scenario; few are without fault.

    A robot goes on earlier or later, or without a wait, or is at a visit earlier or later, or goes
    elsewhere; or one thing of the scenario changes.
    """
    what = draw.random()
    if what < 0.1:
        return _of_another_scenario(plan, draw)
    tracks = list(plan.tracks)
    robot = draw.randrange(len(tracks))
    vertices, enter = tracks[robot].vertices.tolist(), tracks[robot].enter.tolist()
    if len(vertices) < 2:
        return _of_another_scenario(plan, draw)
    visit = draw.randrange(1, len(vertices))
    quickest = int(plan.scenario.problem.itineraries[robot].quickest_edge)
    if what < 0.5:
        by = draw.choice([-1, 1, 2, 3, 5]) * draw.choice([1, quickest])
        enter[visit:] = [tick + by for tick in enter[visit:]]
    elif what < 0.7:
        waits = find_stays(plan.scenario, plan.tracks)[robot].waits.tolist()
        visit = max(range(len(waits)), key=lambda k: (waits[k] > 0) * draw.random())
        enter[visit + 1 :] = [tick - waits[visit] for tick in enter[visit + 1 :]]
    elif what < 0.85:
        enter[visit] += draw.choice([-1, 1])
    else:
        vertices[visit - 1 : visit + 1] = vertices[visit - 1 : visit + 1][::-1]
    tracks[robot] = Track.of(vertices, enter)
    return replace(plan, tracks=tuple(tracks))


def _of_another_scenario(plan: Plan, draw: random.Random) -> Plan:
    change = draw.choice(["a speed", "something closed", "a rule"])
    try:
        return replace(plan, scenario=CHANGES[change](plan.scenario, draw))
    except InputError:  # a rule that does not fit to the fleet
        return plan


def by_both_judges(plan: Plan) -> tuple[Faults, Faults]:
    """Return the faults that `check` finds, and those of the second judge, in the same words.

    If a robot cannot make its trip, only faults of trips; swaps of robots whose bookings overlap
    are left out.
    """
    found = {
        (BETWEEN_ROBOTS.get(fault.kind, "trip"), fault.robots)
        for fault in rightofway.check(plan, limit=10**6).faults
    }
    found = {fault for fault in found if fault[0] == "trip"} or found
    return _without_needless_swaps(found), _without_needless_swaps(judge.faults(plan))


def _without_needless_swaps(found: Faults) -> Faults:
    return {(kind, who) for kind, who in found if kind != "swap" or ("booking", who) not in found}
