"""A timetable from a plan of one lap per robot, repeated for ever.

The period of the plan is its makespan, but the cycle time of its orders is shorter: robots begin
their next lap before others finish. Every plan gives a timetable, also on new routes if the usual
routes end in a deadlock.
"""

from __future__ import annotations

from dataclasses import replace

from rightofway.cyclic.problem import Candidate, CyclicProblem, RobotCycle
from rightofway.cyclic.route import make_lap_rows
from rightofway.errors import GaveUp
from rightofway.model import Itinerary, Scenario, Tick, Track, make_lap, make_route
from rightofway.planners import PlanRequest
from rightofway.planners.lacam import lacam
from rightofway.planners.prioritized import prioritized


def repeat_plan(problem: CyclicProblem) -> Candidate | None:
    """Return the timetable of a plan of one lap each; None if no plan was found in time.

    Raises
    ------
    NoPlanExists
        If it is proven that the robots of the group cannot make one lap each.

    Notes
    -----
    Without a plan or a proof, the search ends at the deadline of the problem only.
    """
    scenario, context = problem.context.scenario, problem.context
    robots = tuple(replace(scenario.robots[robot], laps=1) for robot in context.robots)
    part = replace(scenario, robots=robots)
    if context.is_apart:
        headway = scenario.problem.clock.convert_to_time(context.booking_rules.end(Tick(0)))
        part = replace(part, rules=replace(part.rules, headway=headway))
    request = PlanRequest(
        scenario=part,
        options={"paths": "spread"},
        seed=problem.draw.randrange(2**31),
        deadline=problem.deadline,
    )
    try:
        if scenario.problem.resources.are_points:
            tracks = lacam(request).tracks
        else:
            tracks = prioritized(replace(request, options={"order": "shortest"})).tracks
    except GaveUp:
        return None
    factor = part.problem.clock.tick / scenario.problem.clock.tick
    if factor.denominator != 1:
        return None
    laps, cycles = [], []
    for robot, track in zip(context.robots, tracks, strict=True):
        once, enter = take_one_lap(scenario, robot), track.enter * factor.numerator
        route = make_route(scenario.roadmap, once, Track(vertices=track.vertices, enter=enter))
        laps.append((make_lap(scenario.roadmap, once, route), enter))
        if not problem.forbidden.isdisjoint(make_lap_rows(scenario, robot, laps[-1][0]).booked):
            return None
    apart = context.booking_rules.end(0) + max(max(lap.drive) + lap.dwell[0] for lap, _ in laps)
    period = max(int(enter[-1]) for _, enter in laps) + apart
    for lap, enter in laps:
        visits = enter[:-1].copy()
        visits[0] = enter[-1] - period
        cycles.append(RobotCycle(lap, 1, visits + (period if visits[0] < 0 else 0)))
    timetable = problem.join_cycles(cycles, period)
    return (
        problem.make_candidate(timetable)
        if problem.build_graph(timetable).compute_slack().min() >= 0
        else None
    )


def take_one_lap(scenario: Scenario, robot: int) -> Itinerary:
    """Return the stages of a robot's first lap."""
    itinerary = scenario.problem.itineraries[robot]
    return replace(itinerary, stages=itinerary.stages[: len(scenario.robots[robot].stops) + 1])
