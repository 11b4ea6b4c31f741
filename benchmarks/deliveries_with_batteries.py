"""Deliveries of robots with batteries, compared with the best assignment of Open-RMF's planner.

``python -m benchmarks.deliveries_with_batteries [--seconds S]`` plans a case from the tests of
https://github.com/open-rmf/rmf_task: two robots on a grid of 4 x 4 vertices, 1 000 m apart, with 11
deliveries that come in three waves. Both programs minimize the sum of finish - earliest start.

That planner gives tasks to robots one after another, with full charges at a robot's own charger
between them, and leaves paths to others. Its least cost is found here by dynamic programming over
sets of deliveries; paths that get in each other's way would only make it larger. Here, robots may
charge for as long as they need, and the paths of the plan have no conflict.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import NamedTuple

from benchmarks.common import table
from rightofway import Plan, solve
from rightofway.check import check
from rightofway.dispatch.settings import ShiftSettings
from rightofway.metrics import list_job_times
from rightofway.model import Battery, Job, JobStop, Robot, Rules, Scenario
from rightofway.site import VertexId, make_grid_roadmap

SIDE, LENGTH = 4, 1000
"""Vertices in a row, and metres between them: as many seconds."""

CHARGERS = (13, 2)
"""The homes of the robots, where they charge."""

WAVES = {
    0: ((0, 3), (15, 2), (7, 9)),
    50_000: ((8, 11), (10, 0)),
    60_000: ((4, 8), (8, 14), (5, 11), (9, 0), (1, 3), (0, 12)),
}
"""From when on deliveries may begin [s], and their places."""

DRIVE, ON, CHARGE = Fraction(437, 10**7), Fraction(58, 10**7), Fraction(611, 10**7)
"""Shares of the battery: per metre, per second, and per second of a charge."""

RESERVE = Fraction(1, 5)


class Delivery(NamedTuple):
    """A load to be brought from one vertex to another."""

    pickup: int
    dropoff: int
    earliest: int


class State(NamedTuple):
    """A robot after some deliveries: their cost, when and where it is, and its charge."""

    cost: int
    time: int
    soc: Fraction
    place: int


DELIVERIES = [Delivery(*places, start) for start, wave in WAVES.items() for places in wave]


def measure(one: int, other: int) -> int:
    """Return the metres of a shortest way, which are as many seconds."""
    return LENGTH * (abs(one // SIDE - other // SIDE) + abs(one % SIDE - other % SIDE))


def find_least_cost() -> int:
    """Return the least cost of deliveries in sequence with full charges [s]."""
    every = (1 << len(DELIVERIES)) - 1
    one, other = (_find_costs(charger) for charger in CHARGERS)
    return min(one[some] + other[every - some] for some in one if every - some in other)


def _find_costs(charger: int) -> dict[int, int]:
    """Return the least cost of each set of deliveries that a robot can make, by its bits."""
    states = {0: [State(0, 0, Fraction(1), charger)]}
    for some in range(1, 1 << len(DELIVERIES)):
        found = [
            after
            for number, delivery in enumerate(DELIVERIES)
            if some >> number & 1
            for before in states.get(some - (1 << number), ())
            for after in _deliver(before, delivery, charger)
        ]
        states[some] = _keep_best(found)
    return {some: min(state.cost for state in own) for some, own in states.items() if own}


def _deliver(state: State, delivery: Delivery, charger: int) -> Iterator[State]:
    """Yield the state after a delivery, at once and after a full charge, where charge is left."""
    way = measure(state.place, charger)
    arrived = state.soc - way * (DRIVE + ON)
    if state.place == charger:  # it stands at its charger, and may fill up
        arrived = state.soc
    filled = state.time + way + -((arrived - 1) // CHARGE)
    for begin in (state, State(state.cost, int(filled), Fraction(1), charger)):
        reached = begin.time + measure(begin.place, delivery.pickup)
        waits = max(0, delivery.earliest - reached)
        driven = measure(begin.place, delivery.pickup) + measure(*delivery[:2])
        soc = begin.soc - driven * (DRIVE + ON) - (0 if begin.place == charger else waits * ON)
        if soc - measure(delivery.dropoff, charger) * (DRIVE + ON) < RESERVE:
            continue
        end = reached + waits + measure(*delivery[:2])
        yield State(state.cost + end - delivery.earliest, end, soc, delivery.dropoff)


def _keep_best(states: Sequence[State]) -> list[State]:
    """Return the states that no other one at the same place is better than in all."""
    best: list[State] = []
    for state in sorted(states, key=lambda own: (own.cost, own.time, -own.soc)):
        if not any(
            own.place == state.place and own.time <= state.time and own.soc >= state.soc
            for own in best
        ):
            best.append(state)
    return best


def make_scenario() -> Scenario:
    """Return the case as a scenario with jobs."""
    battery = Battery(drive=DRIVE, on=ON, charge=CHARGE, reserve=RESERVE)
    robots = tuple(
        Robot(
            name=f"R{number}",
            home=VertexId(home),
            battery="rmf",
            charging=(VertexId(home),),
        )
        for number, home in enumerate(CHARGERS)
    )
    jobs = tuple(
        Job(
            name=f"D{number}",
            stops=(
                JobStop(at=VertexId(delivery.pickup), load=1, earliest=Fraction(delivery.earliest)),
                JobStop(at=VertexId(delivery.dropoff), load=-1),
            ),
        )
        for number, delivery in enumerate(DELIVERIES)
    )
    return Scenario(
        roadmap=make_grid_roadmap(["." * SIDE] * SIDE, cell_size=Fraction(LENGTH)),
        robots=robots,
        rules=Rules(turn=Fraction(0)),
        jobs=jobs,
        batteries=(("rmf", battery),),
    )


def measure_cost(plan: Plan) -> Fraction:
    """Return the sum of finish - earliest start of a plan that serves all deliveries [s]."""
    assert check(plan).ok, "the plan keeps all rules, reserves too"
    assert not plan.unserved, "all deliveries are made"
    tick = plan.scenario.problem.clock.tick
    return tick * sum(done.service_time for done in list_job_times(plan))


def measure_shift() -> Fraction:
    """Return the same sum of a shift; a delivery is known from its earliest start on [s]."""
    scenario = make_scenario()
    record = ShiftSettings(lead=Fraction(0)).simulate(scenario)
    assert check(record.make_plan()).ok, "the shift keeps all rules, reserves too"
    jobs = record.jobs.values()
    assert all(own.ended is not None for own in jobs), "all deliveries are made"
    ends = sum((own.ended or 0 for own in jobs), 0) * scenario.problem.clock.tick
    return ends - sum((own.job.earliest for own in jobs), Fraction(0))


def main() -> None:
    """Print both costs."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10)
    given = parser.parse_args()
    here = measure_cost(solve(make_scenario(), time_limit=given.seconds))
    rows = [
        ("assigned in sequence, without paths", f"{find_least_cost():,} s"),
        ("here, with paths", f"{float(here):,.0f} s"),
        ("here, each known from its earliest start on", f"{float(measure_shift()):,.0f} s"),
    ]
    sys.stdout.write(table(["deliveries", "sum of finish - earliest start"], rows))


if __name__ == "__main__":
    main()
