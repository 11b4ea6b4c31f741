"""Execution of a plan with delays: collisions by the clock, none by right of way."""

from rightofway.execution.delays import (
    CAUSES,
    DEFAULT_DELAYS,
    Cause,
    Delay,
    delay_model_of,
    read_delays,
)
from rightofway.execution.simulation import replay, simulate
from rightofway.execution.statistics import (
    Collisions,
    Lateness,
    LatenessSource,
    PolicyGain,
    Quantiles,
    RobotLateness,
    SimulationResult,
)

__all__ = [
    "CAUSES",
    "DEFAULT_DELAYS",
    "Cause",
    "Collisions",
    "Delay",
    "Lateness",
    "LatenessSource",
    "PolicyGain",
    "Quantiles",
    "RobotLateness",
    "SimulationResult",
    "delay_model_of",
    "read_delays",
    "replay",
    "simulate",
]
