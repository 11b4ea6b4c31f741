"""Delays and oracles of executions."""

from __future__ import annotations

import random
from collections.abc import Iterable
from dataclasses import replace

from rightofway.check import Fault, check
from rightofway.execution import SimulationResult
from rightofway.model import NEVER, ExecutionTrace, Plan, Scenario, Tick
from rightofway.precedence import (
    ActionDependencyGraph,
    DelayModel,
    DelaySample,
    Execution,
    Stoppage,
)
from tests.oracles import execution, judge

__all__ = [
    "ONE_CHAIN",
    "any_delays",
    "judge_trace",
    "late",
    "oracle_of",
    "some_delays",
    "times",
    "wrong_in",
]

ONE_CHAIN = frozenset({"closures", "forbidden turns", "passed", "sizes", "spacing", "zones"})
"""Features unknown to the oracle of robots that look: its order is one chain of visits for each
vertex, and it has no places of several vertices."""

RANDOM = (
    (),
    (("exponential", 0.5, 0.0),),
    (("uniform", -0.5, 1.0), ("chance", 0.1, 7.0)),
    (("normal", 0.2, 0.3), ("breaks", 0.1, 0.0)),
)


def some_delays(draw: random.Random, robots: int, makespan: int) -> DelayModel:
    """Return random delays; 0.1 of the robots break down, others stop, are slow or early."""

    def stoppages() -> tuple[Stoppage, ...]:
        if draw.random() < 0.6:
            return ()
        lasts = draw.choice([1, 5, 30, NEVER])
        more = [(draw.randint(0, makespan), draw.choice([1, 5, 30])) for _ in range(2)]
        every = sorted([(draw.randint(0, makespan), lasts), *more])
        return tuple(Stoppage(Tick(tick), Tick(ticks)) for tick, ticks in every)

    return DelayModel(
        random=draw.choice(RANDOM),
        pace=tuple(draw.choice([1.0, 1.0, 1.7, 0.6]) for _ in range(robots)),
        stoppages=tuple(stoppages() for _ in range(robots)),
    )


def late(plan: Plan, draw: random.Random) -> ActionDependencyGraph:
    """Return a plan as it is executed with some delays."""
    last = max(int(track.enter[-1]) for track in plan.tracks)
    delays = some_delays(draw, len(plan.tracks), last)
    return ActionDependencyGraph(plan.scenario, plan.tracks, delays)


def oracle_of(adg: ActionDependencyGraph, delay_sample: DelaySample) -> execution.Orders:
    """Return what the oracle executes."""
    return execution.Orders(
        first_visit=adg.first_visit.tolist(),
        vertex=adg.vertex.tolist(),
        planned=adg.planned.tolist(),
        nominal_drive=adg.drive.tolist(),
        before=[(*adg.comes_after(visit), -1)[0] for visit in range(len(adg.vertex))],
        since=adg.since.tolist(),
        headway=int(adg.scenario.problem.booking_rules.headway),
        books_ahead=adg.scenario.problem.booking_rules.books_ahead,
        dwell=delay_sample.dwell.tolist(),
        drive=delay_sample.drive.tolist(),
        stoppages=[delay_sample.list_stoppages(robot) for robot in range(len(adg.routes))],
    )


def times(found: execution.Times | Execution) -> tuple[list[int], list[int], list[int]]:
    """Return when visits begin, when they are booked, and when robots complete."""
    return list(found.enter), list(found.start), list(found.completion)


def judge_trace(plan: Plan, trace: ExecutionTrace) -> list[Fault]:
    """Return the faults that the judge finds in what became of a plan.

    The judge assumes that drives take as long as planned. So a robot that drives slowly out of a
    passed vertex seems to stop there: that alone is no fault, if the visit lasts exactly as long as
    the robot was turning, driving and out of order.
    """
    found = check(replace(plan, tracks=trace.tracks), limit=10**6).faults
    return [fault for fault in found if not _is_slow_drive(fault, trace)]


def _is_slow_drive(fault: Fault, trace: ExecutionTrace) -> bool:
    if fault.kind != "stop at pass":
        return False
    (robot,) = fault.robots
    enter = trace.tracks[robot].enter.tolist()
    visit = enter.index(fault.tick)
    begin, end = enter[visit : visit + 2]
    needs = int(trace.dwell[robot][visit] + trace.drive[robot][visit + 1])
    for tick, ticks in trace.stoppages[robot] if trace.stoppages else ():
        needs += max(min(end, tick + (ticks or 0)) - max(begin, tick), 0)
    return bool(end - begin == needs)


def any_delays(draw: random.Random, scenario: Scenario) -> str:
    """Return one or two causes of delay in their notation."""
    name = draw.choice(scenario.robots).name
    causes = (
        "exponential:0.5",
        "uniform:-0.3..1",
        "normal:0.1~0.3",
        "chance:0.2x9",
        "breaks:0.1",
        f"slow:{name}x1.7",
        f"early:{name}x0.6",
        f"stop:{name}@{draw.randint(0, 20)}+{draw.randint(1, 30)}",
        f"stop:{name}@{draw.randint(0, 20)}",
    )
    return ",".join(draw.sample(causes, draw.choice([1, 2])))


def wrong_in(outcome: SimulationResult, traces: Iterable[int]) -> list[str]:
    """Return what must not happen in runs: collisions and deadlocks, and faults of some traces.

    A robot may only be stranded by one that broke down, or by a closure.
    """
    wrong = []
    if outcome.collisions or outcome.deadlocks:
        wrong.append(f"{outcome.collisions} collisions, {outcome.deadlocks} deadlocks")
    if outcome.stranded and not (outcome.broken or outcome.plan.scenario.closures):
        wrong.append(f"{outcome.stranded} robots are stranded, although none broke down")
    for run in traces:
        faults = judge.faults(outcome.plan, outcome.trace(run))
        wrong += [f"run {run}: {kind} of robots {who}" for kind, who in sorted(faults)]
    return wrong
