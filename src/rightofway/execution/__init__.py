"""A plan on a floor where robots are late: by the clock it collides, by right of way never."""

from rightofway.execution.delays import CAUSES, DEFAULT, Cause, Delay, delay_model_of, read_delays
from rightofway.execution.outcome import (
    Collisions,
    Lateness,
    Outcome,
    PolicyGain,
    Quantiles,
    RobotLateness,
    Source,
)
from rightofway.execution.simulation import simulate

__all__ = [
    "CAUSES",
    "DEFAULT",
    "Cause",
    "Collisions",
    "Delay",
    "Lateness",
    "Outcome",
    "PolicyGain",
    "Quantiles",
    "RobotLateness",
    "Source",
    "delay_model_of",
    "read_delays",
    "simulate",
]
