"""Files: scenarios and plans, read with every fault reported and written whole; MovingAI files.

``load_…`` reads a file and ``write_…`` writes one; ``parse_…`` reads plain data, as JSON has them,
``dump_…`` makes them, and ``format_…`` makes a file's text. Pydantic and PyYAML are imported when
the first file is read, and nowhere else in the package; readers and writers of other formats when
the first such file is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rightofway.provision import import_later

if TYPE_CHECKING:
    from rightofway.io.documents import DELAY_FILES, load_delays
    from rightofway.io.foreign import FOREIGN_FORMATS, format_foreign, is_foreign
    from rightofway.io.formats import make_schema
    from rightofway.io.layouts import (
        LAYOUT_WRITERS,
        LayoutFormat,
        format_layout,
        is_layout,
        make_layout_of_graph,
        read_layout,
    )
    from rightofway.io.movingai import load_map, load_scen, write_map, write_scen
    from rightofway.io.plan.reader import parse_plan
    from rightofway.io.plan.writer import dump_plan, format_plan, write_plan
    from rightofway.io.readers import load, load_either, load_plan, load_with_notes
    from rightofway.io.scenario.example import make_example
    from rightofway.io.scenario.reader import Loaded, parse_scenario
    from rightofway.io.scenario.writer import dump_scenario, format_scenario, write_scenario
    from rightofway.io.site_plans import SITE_PLAN_FORMATS, format_site_plan

_MODULES = {
    "foreign": ("FOREIGN_FORMATS", "format_foreign", "is_foreign"),
    "formats": ("make_schema",),
    "layouts": (
        "LAYOUT_WRITERS",
        "LayoutFormat",
        "is_layout",
        "make_layout_of_graph",
        "format_layout",
        "read_layout",
    ),
    "movingai": ("load_map", "load_scen", "write_map", "write_scen"),
    "plan.reader": ("parse_plan",),
    "plan.writer": ("dump_plan", "format_plan", "write_plan"),
    "readers": ("load", "load_either", "load_plan", "load_with_notes"),
    "scenario.example": ("make_example",),
    "scenario.reader": ("Loaded", "parse_scenario"),
    "scenario.writer": ("dump_scenario", "format_scenario", "write_scenario"),
    "site_plans": ("SITE_PLAN_FORMATS", "format_site_plan"),
    "documents": ("DELAY_FILES", "load_delays"),
}

__all__ = [
    "DELAY_FILES",
    "FOREIGN_FORMATS",
    "LAYOUT_WRITERS",
    "SITE_PLAN_FORMATS",
    "LayoutFormat",
    "Loaded",
    "dump_plan",
    "dump_scenario",
    "format_foreign",
    "format_layout",
    "format_plan",
    "format_scenario",
    "format_site_plan",
    "is_foreign",
    "is_layout",
    "load",
    "load_delays",
    "load_either",
    "load_map",
    "load_plan",
    "load_scen",
    "load_with_notes",
    "make_example",
    "make_layout_of_graph",
    "make_schema",
    "parse_plan",
    "parse_scenario",
    "read_layout",
    "write_map",
    "write_plan",
    "write_scen",
    "write_scenario",
]

if not TYPE_CHECKING:  # a checker would take any misspelt name for an object
    __getattr__ = import_later(__name__, _MODULES)
