"""A fleet built in Python: the map, the robots and the rules, without a file."""

from rightofway.fleet_builder.builder import FleetBuilder

__all__ = ["FleetBuilder"]
