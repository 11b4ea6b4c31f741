"""Plans for fleets of mobile robots that go out, work and come home.

::

    import rightofway

    scenario = rightofway.load("examples/door.yaml")
    plan = rightofway.solve(scenario)
    print(rightofway.check(plan))

Readers, writers and pages are imported when they are first used. ``check`` and ``solve`` are
imported here, because the functions must win over the modules of the same names.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from rightofway.check import Fault, Report, check
from rightofway.errors import GaveUp, InputError, InvalidPlan, NoPlanExists, RightOfWayError
from rightofway.model import Plan, Roadmap, Robot, Rules, Scenario, Stop
from rightofway.solve import improve, solve

if TYPE_CHECKING:
    from rightofway.cyclic import CyclicResult, plan_of, run_laps
    from rightofway.execution import Outcome, simulate
    from rightofway.io import load, load_plan, save_plan
    from rightofway.metrics import Metrics, measure, waits
    from rightofway.viz import write_gif, write_page, write_png

__version__ = "0.1.0"

_LATER = {
    "CyclicResult": "cyclic",
    "Metrics": "metrics",
    "Outcome": "execution",
    "load": "io",
    "load_plan": "io",
    "measure": "metrics",
    "plan_of": "cyclic",
    "run_laps": "cyclic",
    "save_plan": "io",
    "simulate": "execution",
    "waits": "metrics",
    "write_gif": "viz",
    "write_page": "viz",
    "write_png": "viz",
}

__all__ = [
    "CyclicResult",
    "Fault",
    "GaveUp",
    "InputError",
    "InvalidPlan",
    "Metrics",
    "NoPlanExists",
    "Outcome",
    "Plan",
    "Report",
    "RightOfWayError",
    "Roadmap",
    "Robot",
    "Rules",
    "Scenario",
    "Stop",
    "check",
    "improve",
    "load",
    "load_plan",
    "measure",
    "plan_of",
    "run_laps",
    "save_plan",
    "simulate",
    "solve",
    "waits",
    "write_gif",
    "write_page",
    "write_png",
]


def _page_in_a_notebook(plan: Plan) -> str:
    from rightofway.viz import frame_of

    return frame_of(plan)


# Notebooks look for this on the plan, but the model knows nothing of pages.
Plan._repr_html_ = _page_in_a_notebook  # type: ignore[attr-defined]


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_LATER[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
