"""Robot, scenario, problem, plan: frozen, in integer ticks, without files."""

from rightofway.model.actions import ActionUse, Blocking, PlaceActions, StopAction
from rightofway.model.booking_rules import BookingRules
from rightofway.model.closures import Closure, Closures
from rightofway.model.itinerary import Arc, Itinerary, Stage, compute_least_dwell
from rightofway.model.kept_facts import RerouteReason, Status
from rightofway.model.lap import Lap, make_lap, make_visits_of_laps
from rightofway.model.lost_time import Loss, LostTime, Wait
from rightofway.model.outcome import ForcedLoss, Objective, Outcome, OutcomeKind, Proof
from rightofway.model.plan import (
    Decision,
    Improvement,
    Plan,
    PlannerRun,
    Reroute,
    RobotPlan,
    StartPlan,
)
from rightofway.model.planned_tour import PlannedItem, PlannedTour
from rightofway.model.problem import Problem
from rightofway.model.resources import Resources
from rightofway.model.robot import Occupancy, Robot, Rules, Stop, TripEnd, Turn, Walls
from rightofway.model.route import (
    Route,
    Track,
    compute_drives_along,
    compute_turns_along,
    find_serving_visits,
    join_route,
    join_track,
    make_route,
    make_route_through,
)
from rightofway.model.scenario import Scenario, assign_tours
from rightofway.model.stays import (
    Stays,
    compute_completions,
    compute_cost,
    compute_flowtime,
    find_stays,
)
from rightofway.model.steady_state import SteadyState
from rightofway.model.trace import ExecutionTrace
from rightofway.model.units import NEVER, Clock, Tick, choose_clock, require_time_limit
from rightofway.model.work import (
    Assignment,
    Battery,
    BoundBattery,
    BoundJob,
    BoundRobot,
    BoundStop,
    Job,
    JobStop,
    RobotState,
    Tour,
    TourItem,
    UnservedReason,
    Work,
    WorkObjective,
)

__all__ = [
    "NEVER",
    "ActionUse",
    "Arc",
    "Assignment",
    "Battery",
    "Blocking",
    "BookingRules",
    "BoundBattery",
    "BoundJob",
    "BoundRobot",
    "BoundStop",
    "Clock",
    "Closure",
    "Closures",
    "Decision",
    "ExecutionTrace",
    "ForcedLoss",
    "Improvement",
    "Itinerary",
    "Job",
    "JobStop",
    "Lap",
    "Loss",
    "LostTime",
    "Objective",
    "Occupancy",
    "Outcome",
    "OutcomeKind",
    "PlaceActions",
    "Plan",
    "PlannedItem",
    "PlannedTour",
    "PlannerRun",
    "Problem",
    "Proof",
    "Reroute",
    "RerouteReason",
    "Resources",
    "Robot",
    "RobotPlan",
    "RobotState",
    "Route",
    "Rules",
    "Scenario",
    "Stage",
    "StartPlan",
    "Status",
    "Stays",
    "SteadyState",
    "Stop",
    "StopAction",
    "Tick",
    "Tour",
    "TourItem",
    "Track",
    "TripEnd",
    "Turn",
    "UnservedReason",
    "Wait",
    "Walls",
    "Work",
    "WorkObjective",
    "assign_tours",
    "choose_clock",
    "compute_completions",
    "compute_cost",
    "compute_drives_along",
    "compute_flowtime",
    "compute_least_dwell",
    "compute_turns_along",
    "find_serving_visits",
    "find_stays",
    "join_route",
    "join_track",
    "make_lap",
    "make_route",
    "make_route_through",
    "make_visits_of_laps",
    "require_time_limit",
]
