"""A plan on a floor where robots are late: by the clock it collides, by right of way never."""

from rightofway.floor.delays import CAUSES, DEFAULT, Cause, Delay, hazards_of, read_delays
from rightofway.floor.outcome import (
    Collisions,
    Lateness,
    Outcome,
    RobotLateness,
    Source,
    Spread,
    Won,
)
from rightofway.floor.simulation import simulate

__all__ = [
    "CAUSES",
    "DEFAULT",
    "Cause",
    "Collisions",
    "Delay",
    "Lateness",
    "Outcome",
    "RobotLateness",
    "Source",
    "Spread",
    "Won",
    "hazards_of",
    "read_delays",
    "simulate",
]
