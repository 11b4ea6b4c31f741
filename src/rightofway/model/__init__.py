"""Roadmap, robot, scenario, plan: frozen, in integer ticks, without files."""

from rightofway.model.closures import Closure, Closures
from rightofway.model.clustering import Floor, Obstacle, cluster, node_length, steps_per_unit
from rightofway.model.edges import Edge, roadmap_of_edges
from rightofway.model.geometry import Frame, Point, rounding_step, squared_distance, straight_length
from rightofway.model.grid import roadmap_of_grid
from rightofway.model.lap import Lap, lap_of, stages_at_home, visits_of_laps
from rightofway.model.lost_time import Loss, LostTime
from rightofway.model.plan import (
    Decision,
    Improvement,
    Plan,
    PlannerRun,
    Reroute,
    RobotPlan,
    StartPlan,
    Wait,
)
from rightofway.model.problem import Itinerary, Problem, Stage, least_dwell
from rightofway.model.quantities import Quantities, Units, decimal
from rightofway.model.resources import Resources
from rightofway.model.roadmap import Grid, Roadmap
from rightofway.model.robot import Occupancy, Robot, Rules, Stop, TripEnd, Turn, Walls
from rightofway.model.route import (
    Route,
    Track,
    drives_along,
    route_along,
    route_of,
    route_through,
    serving_visits,
    turns_along,
)
from rightofway.model.scenario import Scenario
from rightofway.model.stays import Stays, completions_of, cost_of, flowtime_of, stays_of
from rightofway.model.steady_state import SteadyState
from rightofway.model.trace import ExecutionTrace
from rightofway.model.units import NEVER, Clock, Tick, VertexId, checked_time_limit, choose_clock

__all__ = [
    "NEVER",
    "Clock",
    "Closure",
    "Closures",
    "Decision",
    "Edge",
    "ExecutionTrace",
    "Floor",
    "Frame",
    "Grid",
    "Improvement",
    "Itinerary",
    "Lap",
    "Loss",
    "LostTime",
    "Obstacle",
    "Occupancy",
    "Plan",
    "PlannerRun",
    "Point",
    "Problem",
    "Quantities",
    "Reroute",
    "Resources",
    "Roadmap",
    "Robot",
    "RobotPlan",
    "Route",
    "Rules",
    "Scenario",
    "Stage",
    "StartPlan",
    "Stays",
    "SteadyState",
    "Stop",
    "Tick",
    "Track",
    "TripEnd",
    "Turn",
    "Units",
    "VertexId",
    "Wait",
    "Walls",
    "checked_time_limit",
    "choose_clock",
    "cluster",
    "completions_of",
    "cost_of",
    "decimal",
    "drives_along",
    "flowtime_of",
    "lap_of",
    "least_dwell",
    "node_length",
    "roadmap_of_edges",
    "roadmap_of_grid",
    "rounding_step",
    "route_along",
    "route_of",
    "route_through",
    "serving_visits",
    "squared_distance",
    "stages_at_home",
    "stays_of",
    "steps_per_unit",
    "straight_length",
    "turns_along",
    "visits_of_laps",
]
