"""Roadmap, robot, scenario, plan: frozen, in integer ticks, without files."""

from rightofway.model.actual import Actual
from rightofway.model.clustering import Floor, Obstacle, cluster, node_length, steps_per_unit
from rightofway.model.itinerary import Itinerary, Stage, Timing, least_dwell
from rightofway.model.lap import Lap, lap_of
from rightofway.model.plan import Decision, Plan, PlannerRun, Reroute, Track
from rightofway.model.roadmap import Edge, Grid, Roadmap, roadmap_of_edges, roadmap_of_grid
from rightofway.model.robot import Robot, Stop, TripEnd, Turn
from rightofway.model.route import Route, edge_ticks, route_along, route_of, route_through
from rightofway.model.rules import Occupancy, Rules
from rightofway.model.scenario import Scenario
from rightofway.model.steady import Steady
from rightofway.model.units import Clock, Tick, VertexId, choose_clock

__all__ = [
    "Actual",
    "Clock",
    "Decision",
    "Edge",
    "Floor",
    "Grid",
    "Itinerary",
    "Lap",
    "Obstacle",
    "Occupancy",
    "Plan",
    "PlannerRun",
    "Reroute",
    "Roadmap",
    "Robot",
    "Route",
    "Rules",
    "Scenario",
    "Stage",
    "Steady",
    "Stop",
    "Tick",
    "Timing",
    "Track",
    "TripEnd",
    "Turn",
    "VertexId",
    "choose_clock",
    "cluster",
    "edge_ticks",
    "lap_of",
    "least_dwell",
    "node_length",
    "roadmap_of_edges",
    "roadmap_of_grid",
    "route_along",
    "route_of",
    "route_through",
    "steps_per_unit",
]
