"""Files: scenarios and plans, read with every fault reported and written whole; MovingAI files.

``load_…`` reads a file and ``write_…`` writes one; ``…_of`` reads plain data, as JSON has them, and
``dump_…`` makes them. Pydantic and PyYAML are imported when the first file is read, and nowhere
else in the package; readers and writers of other formats when the first such file is.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rightofway.io.foreign import FOREIGN_FORMATS, foreign_text, is_foreign
    from rightofway.io.formats import schema
    from rightofway.io.layouts import (
        LAYOUT_WRITERS,
        is_layout,
        layout_of_graph,
        layout_text,
        read_layout,
    )
    from rightofway.io.movingai import load_map, load_scen, write_map, write_scen
    from rightofway.io.plan.reader import plan_of
    from rightofway.io.plan.writer import dump_plan, plan_text, write_plan
    from rightofway.io.readers import load, load_either, load_plan, load_with_notes
    from rightofway.io.scenario.example import example_of_layout
    from rightofway.io.scenario.reader import Loaded, scenario_of
    from rightofway.io.scenario.writer import dump_scenario, scenario_text, write_scenario
    from rightofway.io.site_plans import SITE_PLAN_FORMATS, site_plan_text
    from rightofway.io.text import DELAY_FILES, load_delays

_MODULES = {
    "foreign": ("FOREIGN_FORMATS", "foreign_text", "is_foreign"),
    "formats": ("schema",),
    "layouts": ("LAYOUT_WRITERS", "is_layout", "layout_of_graph", "layout_text", "read_layout"),
    "movingai": ("load_map", "load_scen", "write_map", "write_scen"),
    "plan.reader": ("plan_of",),
    "plan.writer": ("dump_plan", "plan_text", "write_plan"),
    "readers": ("load", "load_either", "load_plan", "load_with_notes"),
    "scenario.example": ("example_of_layout",),
    "scenario.reader": ("Loaded", "scenario_of"),
    "scenario.writer": ("dump_scenario", "scenario_text", "write_scenario"),
    "site_plans": ("SITE_PLAN_FORMATS", "site_plan_text"),
    "text": ("DELAY_FILES", "load_delays"),
}

__all__ = [
    "DELAY_FILES",
    "FOREIGN_FORMATS",
    "LAYOUT_WRITERS",
    "SITE_PLAN_FORMATS",
    "Loaded",
    "dump_plan",
    "dump_scenario",
    "example_of_layout",
    "foreign_text",
    "is_foreign",
    "is_layout",
    "layout_of_graph",
    "layout_text",
    "load",
    "load_delays",
    "load_either",
    "load_map",
    "load_plan",
    "load_scen",
    "load_with_notes",
    "plan_of",
    "plan_text",
    "read_layout",
    "scenario_of",
    "scenario_text",
    "schema",
    "site_plan_text",
    "write_map",
    "write_plan",
    "write_scen",
    "write_scenario",
]


def __getattr__(name: str) -> Any:
    for module, names in _MODULES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{module}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
