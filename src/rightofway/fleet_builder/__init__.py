"""A fleet built in Python: the map, the robots and the rules, without a file; and its paths."""

from rightofway.fleet_builder.builder import FleetBuilder
from rightofway.fleet_builder.paths import plan_of_paths

__all__ = ["FleetBuilder", "plan_of_paths"]
