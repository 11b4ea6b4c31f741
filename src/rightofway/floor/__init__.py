"""A plan on a floor where robots are late: by the clock it collides, by right of way never."""

from rightofway.floor.delays import DEFAULT, Delay, hazards_of, read_delays
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
    "DEFAULT",
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
