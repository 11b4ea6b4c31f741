"""Loads and states of charge of robots on their tours, over time."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import ceil

from rightofway.model import Plan, PlannedItem, Tick, Track
from rightofway.model.work import BoundBattery, BoundRobot, Work

Charge = tuple[Tick, Fraction]
"""A tick and the state of charge then; 1 is full."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TourCourse:
    """The load and the battery of a robot over time.

    Attributes
    ----------
    loads
        What is on board after each item of the tour.
    charges
        The state of charge from when the robot is ready until it rests, at all ticks at which it
        begins to rise or fall differently; between them it changes evenly. Empty without a battery.
    reserve
        The least state of charge; None without a battery.
    """

    loads: tuple[int, ...]
    charges: tuple[Charge, ...]
    reserve: Fraction | None


def trace_tours(
    plan: Plan, *, measured: Sequence[Sequence[Charge]] | None = None
) -> tuple[TourCourse, ...]:
    """Return the load and the battery of each robot over time.

    Parameters
    ----------
    plan
        A plan; empty without jobs.
    measured
        The measured state of charge of each robot, instead of the one by the plan.

    Notes
    -----
    The energy of a drive is spread evenly over the drive here, and counts at its end for the judge.
    """
    work = plan.scenario.problem.work
    if work is None:
        return ()
    return tuple(
        TourCourse(
            loads=tuple(_list_loads(work, robot, tour)),
            charges=()
            if state.battery is None
            else tuple(
                _drop_straight(
                    list(_trace_charge(plan, robot, state, state.battery))
                    if measured is None
                    else measured[robot]
                )
            ),
            reserve=None
            if state.battery is None
            else Fraction(state.battery.reserve, state.battery.full),
        )
        for robot, (state, tour) in enumerate(zip(work.robots, plan.tours or (), strict=False))
    )


def _list_loads(work: Work, robot: int, tour: Sequence[PlannedItem]) -> Iterator[int]:
    load = work.robots[robot].load
    for item in tour:
        if item.job is not None and item.stop is not None:
            job = work.jobs[item.job]
            load += job.stops[item.stop - job.first].load
        yield load


def _trace_charge(
    plan: Plan, robot: int, state: BoundRobot, battery: BoundBattery
) -> Iterator[Charge]:
    """Yield the state of charge at each tick at which something begins or ends."""
    track, tour = plan.tracks[robot], (plan.tours or ())[robot]
    last = max([state.ready, int(track.enter[-1]), *(item.end for item in tour)])
    slopes: dict[int, Fraction] = defaultdict(Fraction)  # by how much the rate changes at a tick
    for begin, end, rate in (
        (state.ready, last, Fraction(-battery.on)),
        *_list_drives(plan, robot, track, battery),
        *_list_work(tour, battery),
    ):
        slopes[begin] += rate
        slopes[end] -= rate
    soc, rate, full = Fraction(battery.soc), Fraction(0), battery.full
    yield state.ready, soc / full
    for begin, end in pairwise(sorted(slopes)):
        rate += slopes[begin]
        later = soc + rate * (end - begin)
        if soc < full < later:
            yield Tick(begin + ceil((full - soc) / rate)), Fraction(1)
        soc = min(later, Fraction(full))
        yield Tick(end), soc / full


def _list_work(
    tour: Sequence[PlannedItem], battery: BoundBattery
) -> Iterator[tuple[int, int, Fraction]]:
    """Yield when each item begins and ends, and how it changes the rate of the battery."""
    for item in tour:
        change = battery.charge + battery.on if item.job is None else -battery.work
        yield item.begin, item.end, Fraction(change)


def _list_drives(
    plan: Plan, robot: int, track: Track, battery: BoundBattery
) -> Iterator[tuple[int, int, Fraction]]:
    """Yield when each drive begins and ends, and what it takes in each tick."""
    roadmap, ticks = plan.scenario.roadmap, plan.scenario.problem.itineraries[robot].edge_ticks
    edges = roadmap.find_edges(track.vertices[:-1], track.vertices[1:]).tolist()
    for edge, end in zip(edges, track.enter[1:].tolist(), strict=True):
        kind = int(roadmap.class_of_edge[edge])
        if edge >= 0 and ticks[kind] > 0:
            yield end - ticks[kind], end, Fraction(-battery.drive[kind], ticks[kind])


def _drop_straight(charges: Sequence[Charge]) -> Iterator[Charge]:
    """Yield charges without those between two others on a straight line."""
    corners = list(charges[:1])
    for charge, after in pairwise(charges[1:]):
        before = corners[-1]
        rise = (charge[1] - before[1]) * (after[0] - charge[0])
        if rise != (after[1] - charge[1]) * (charge[0] - before[0]):
            corners.append(charge)
    yield from (*corners, *charges[1:][-1:])
