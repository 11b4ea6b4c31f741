"""Robot, scenario, problem, plan: frozen, in integer ticks, without files."""

from rightofway.model.booking_rules import BookingRules
from rightofway.model.closures import Closure, Closures
from rightofway.model.lap import Lap, lap_of, visits_of_laps
from rightofway.model.lost_time import Loss, LostTime
from rightofway.model.outcome import ForcedLoss, Objective, Outcome, OutcomeKind, Proof
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
from rightofway.model.resources import Resources
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
from rightofway.model.units import NEVER, Clock, Tick, checked_time_limit, choose_clock

__all__ = [
    "NEVER",
    "BookingRules",
    "Clock",
    "Closure",
    "Closures",
    "Decision",
    "ExecutionTrace",
    "ForcedLoss",
    "Improvement",
    "Itinerary",
    "Lap",
    "Loss",
    "LostTime",
    "Objective",
    "Occupancy",
    "Outcome",
    "OutcomeKind",
    "Plan",
    "PlannerRun",
    "Problem",
    "Proof",
    "Reroute",
    "Resources",
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
    "Wait",
    "Walls",
    "checked_time_limit",
    "choose_clock",
    "completions_of",
    "cost_of",
    "drives_along",
    "flowtime_of",
    "lap_of",
    "least_dwell",
    "route_along",
    "route_of",
    "route_through",
    "serving_visits",
    "stays_of",
    "turns_along",
    "visits_of_laps",
]
