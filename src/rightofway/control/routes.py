"""The routes of a plan as orders have them: names of vertices, and the work at stops as jobs."""

from __future__ import annotations

from rightofway.control.ledger import RouteToDrive
from rightofway.model import Plan, route_of

__all__ = ["make_routes_to_drive"]


def make_routes_to_drive(plan: Plan) -> list[RouteToDrive]:
    """Return the route of each robot, with a job for each stop of each lap.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    """
    scenario = plan.scenario
    routes = []
    for robot, itinerary, track in zip(
        scenario.robots, scenario.problem.itineraries, plan.tracks, strict=True
    ):
        route = route_of(scenario.roadmap, itinerary, track)
        jobs: list[list[str]] = [[] for _ in route.vertices]
        work: list[list[int]] = [[] for _ in route.vertices]
        stages_of_lap = len(itinerary.stages) // (robot.laps or scenario.rules.laps)
        for stage, visit in enumerate(route.serves):
            if stage % stages_of_lap < len(robot.stops):  # the rest of a lap is the way home
                jobs[visit].append(f"job{stage}")
                work[visit].append(itinerary.stages[stage].work + itinerary.stages[stage].turn)
        routes.append(
            RouteToDrive(
                places=tuple(map(scenario.roadmap.name, route.vertices)),
                jobs=tuple(map(tuple, jobs)),
                work=tuple(map(tuple, work)),
                enter=tuple(track.enter.tolist()),
                lap_ends=tuple(route.serves[stages_of_lap - 1 :: stages_of_lap]),
            )
        )
    return routes
