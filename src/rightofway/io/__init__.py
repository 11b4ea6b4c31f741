"""Files: scenarios and plans, read with every fault named and written whole; MovingAI files.

Pydantic and PyYAML serve in here, at the border; both are imported when the first file is read.
"""

from rightofway.io.delays import DELAY_FILES, load_delays
from rightofway.io.movingai import read_map, read_scen, write_map, write_scen
from rightofway.io.plan.reader import load_plan, plan_of, read_either
from rightofway.io.plan.writer import dump_plan, plan_text, write_plan
from rightofway.io.scenario.reader import Loaded, load, read, scenario_of
from rightofway.io.scenario.writer import dump_scenario, write_scenario
from rightofway.io.schema import schema

__all__ = [
    "DELAY_FILES",
    "Loaded",
    "dump_plan",
    "dump_scenario",
    "load",
    "load_delays",
    "load_plan",
    "plan_of",
    "plan_text",
    "read",
    "read_either",
    "read_map",
    "read_scen",
    "scenario_of",
    "schema",
    "write_map",
    "write_plan",
    "write_scen",
    "write_scenario",
]
