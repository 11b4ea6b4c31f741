"""Plans for fleets of mobile robots that go out, work and come home.

::

    import rightofway

    scenario = rightofway.load("examples/door.yaml")
    plan = rightofway.solve(scenario)
    print(rightofway.check(plan))

Functions named ``load…`` read a file, functions named ``write_…`` write one. Readers, writers and
pages are imported when they are first used. ``check`` and ``solve`` are imported here, because the
functions must win over the modules of the same names.
"""

from __future__ import annotations

from importlib import import_module as _import_module
from typing import TYPE_CHECKING as _TYPE_CHECKING

from rightofway.check import Fault, Report, check
from rightofway.errors import GaveUp, InputError, InvalidPlan, NoPlanExists, RightOfWayError
from rightofway.figures import PackageFigures as _PackageFigures
from rightofway.fleet_builder import FleetBuilder, plan_of_paths
from rightofway.model import (
    Decision,
    ExecutionTrace,
    Loss,
    LostTime,
    Objective,
    Outcome,
    OutcomeKind,
    Plan,
    PlannerRun,
    Reroute,
    Robot,
    RobotPlan,
    Rules,
    Scenario,
    SteadyState,
    Stop,
    Track,
    Wait,
)
from rightofway.model.figures import provide as _provide
from rightofway.planners import (
    AutoOptions,
    LacamOptions,
    LnsOptions,
    LocalSearchOptions,
    PlannerOptions,
    PrioritizedOptions,
    PriorityOptions,
    PrioritySearchOptions,
    RandomPriorityOptions,
    TwoLevelOptions,
)
from rightofway.quantities import Quantities
from rightofway.site import Roadmap
from rightofway.site.layout import Layout
from rightofway.solve import improve, solve

if _TYPE_CHECKING:
    from rightofway.cyclic import CyclicResult, best_timetable, plan_of_laps, run_laps
    from rightofway.execution import SimulationResult, simulate
    from rightofway.io import (
        layout_of_graph,
        load,
        load_plan,
        write_plan,
        write_scenario,
    )
    from rightofway.metrics import Metrics, lost_time, measure, waits
    from rightofway.viz import Background, Film, write_gif, write_page, write_png
    from rightofway.viz.palette import Theme

__version__ = "0.1.0"

_provide(_PackageFigures())

_ROOMS = {
    "cyclic": ("CyclicResult", "best_timetable", "plan_of_laps", "run_laps"),
    "execution": ("SimulationResult", "simulate"),
    "io": (
        "layout_of_graph",
        "load",
        "load_plan",
        "write_plan",
        "write_scenario",
    ),
    "metrics": ("Metrics", "lost_time", "measure", "waits"),
    "viz": ("Background", "Film", "write_gif", "write_page", "write_png"),
    "viz.palette": ("Theme",),
}
_LATER = {name: room for room, names in _ROOMS.items() for name in names}

__all__ = [
    "AutoOptions",
    "Background",
    "CyclicResult",
    "Decision",
    "ExecutionTrace",
    "Fault",
    "Film",
    "FleetBuilder",
    "GaveUp",
    "InputError",
    "InvalidPlan",
    "LacamOptions",
    "Layout",
    "LnsOptions",
    "LocalSearchOptions",
    "Loss",
    "LostTime",
    "Metrics",
    "NoPlanExists",
    "Objective",
    "Outcome",
    "OutcomeKind",
    "Plan",
    "PlannerOptions",
    "PlannerRun",
    "PrioritizedOptions",
    "PriorityOptions",
    "PrioritySearchOptions",
    "Quantities",
    "RandomPriorityOptions",
    "Report",
    "Reroute",
    "RightOfWayError",
    "Roadmap",
    "Robot",
    "RobotPlan",
    "Rules",
    "Scenario",
    "SimulationResult",
    "SteadyState",
    "Stop",
    "Theme",
    "Track",
    "TwoLevelOptions",
    "Wait",
    "best_timetable",
    "check",
    "improve",
    "layout_of_graph",
    "load",
    "load_plan",
    "lost_time",
    "measure",
    "plan_of_laps",
    "plan_of_paths",
    "run_laps",
    "simulate",
    "solve",
    "waits",
    "write_gif",
    "write_page",
    "write_plan",
    "write_png",
    "write_scenario",
]


def __getattr__(name: str) -> object:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value: object = getattr(_import_module(f"{__name__}.{_LATER[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    dunders = (name for name in globals() if name.startswith("__") and name.endswith("__"))
    return sorted({*dunders, *__all__})
