"""Plans for fleets of mobile robots that go out, work and come home.

::

    import rightofway

    scenario = rightofway.load("examples/door.yaml")
    plan = rightofway.solve(scenario)
    print(rightofway.check(plan))

Functions named ``load…`` read a file, functions named ``write_…`` write one. Every room is imported
when one of its names is first used, so that ``import rightofway`` takes no time.
"""

from __future__ import annotations

import sys as _sys
from importlib import import_module as _import_module
from types import ModuleType as _ModuleType
from typing import TYPE_CHECKING as _TYPE_CHECKING

from rightofway.errors import GaveUp, InputError, InvalidPlan, NoPlanExists, RightOfWayError
from rightofway.facts import Fact
from rightofway.figures import PackageFigures as _PackageFigures
from rightofway.figures import PackageTeller as _PackageTeller
from rightofway.provision import provided as _provided

if _TYPE_CHECKING:
    from rightofway.check import (
        Fault,
        Report,
        check,
    )
    from rightofway.cyclic import (
        CyclicResult,
        find_best_timetable,
        plan_of_laps,
        run_laps,
    )
    from rightofway.execution import (
        SimulationResult,
        simulate,
    )
    from rightofway.fleet_builder import (
        FleetBuilder,
        plan_of_paths,
    )
    from rightofway.io import (
        load,
        load_plan,
        make_layout_of_graph,
        write_plan,
        write_scenario,
    )
    from rightofway.metrics import (
        Metrics,
        compute_lost_time,
        measure,
        waits,
    )
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
    from rightofway.planners import (
        PlannerOptions,
    )
    from rightofway.report.quantities import (
        Quantities,
    )
    from rightofway.site import (
        Roadmap,
    )
    from rightofway.site.layout import (
        Layout,
    )
    from rightofway.solve import (
        improve,
        solve,
    )
    from rightofway.viz import (
        Background,
        Film,
        write_gif,
        write_page,
        write_png,
    )
    from rightofway.viz.palette import (
        Theme,
    )

__version__ = "0.9.0"

_provided["figures"] = _PackageFigures()
_provided["teller"] = _PackageTeller()

_ROOMS = {
    "check": (
        "Fault",
        "Report",
        "check",
    ),
    "cyclic": (
        "CyclicResult",
        "find_best_timetable",
        "plan_of_laps",
        "run_laps",
    ),
    "execution": (
        "SimulationResult",
        "simulate",
    ),
    "fleet_builder": (
        "FleetBuilder",
        "plan_of_paths",
    ),
    "io": (
        "make_layout_of_graph",
        "load",
        "load_plan",
        "write_plan",
        "write_scenario",
    ),
    "metrics": (
        "Metrics",
        "compute_lost_time",
        "measure",
        "waits",
    ),
    "model": (
        "Decision",
        "ExecutionTrace",
        "Loss",
        "LostTime",
        "Objective",
        "Outcome",
        "OutcomeKind",
        "Plan",
        "PlannerRun",
        "Reroute",
        "Robot",
        "RobotPlan",
        "Rules",
        "Scenario",
        "SteadyState",
        "Stop",
        "Track",
        "Wait",
    ),
    "planners": ("PlannerOptions",),
    "report.quantities": ("Quantities",),
    "site": ("Roadmap",),
    "site.layout": ("Layout",),
    "solve": (
        "improve",
        "solve",
    ),
    "viz": (
        "Background",
        "Film",
        "write_gif",
        "write_page",
        "write_png",
    ),
    "viz.palette": ("Theme",),
}
_LATER = {name: room for room, names in _ROOMS.items() for name in names}

__all__ = [
    "Background",
    "CyclicResult",
    "Decision",
    "ExecutionTrace",
    "Fact",
    "Fault",
    "Film",
    "FleetBuilder",
    "GaveUp",
    "InputError",
    "InvalidPlan",
    "Layout",
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
    "Quantities",
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
    "Wait",
    "check",
    "compute_lost_time",
    "find_best_timetable",
    "improve",
    "load",
    "load_plan",
    "make_layout_of_graph",
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


class _Package(_ModuleType):
    """The package; its functions ``check`` and ``solve`` win over the modules of their names."""

    def __setattr__(self, name: str, value: object) -> None:
        # Python sets a module as an attribute of its package when it is imported.
        if not (name in _LATER and isinstance(value, _ModuleType)):
            super().__setattr__(name, value)


_sys.modules[__name__].__class__ = _Package


if not _TYPE_CHECKING:  # a checker would take any misspelt name for an object

    def __getattr__(name: str) -> object:
        if name in _LATER:
            value: object = getattr(_import_module(f"{__name__}.{_LATER[name]}"), name)
            globals()[name] = value
            return value
        if name in _ROOMS:
            return _import_module(f"{__name__}.{name}")
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    dunders = (name for name in globals() if name.startswith("__") and name.endswith("__"))
    return sorted({*dunders, *__all__})
