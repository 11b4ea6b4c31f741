"""The names and versions of our document formats."""

__all__ = ["PLAN_FORMAT", "SCENARIO_FORMAT", "SUITE_FORMAT"]

SCENARIO_FORMAT = "rightofway-scenario/1"
PLAN_FORMAT = "rightofway-plan/1"
SUITE_FORMAT = "rightofway-suite/1"
