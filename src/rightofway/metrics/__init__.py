"""What a plan costs, what it must cost at least, who waits for whom, and what waiting avoids."""

from rightofway.metrics.alone import alone_completions
from rightofway.metrics.collisions import Collision, collisions, free_running
from rightofway.metrics.measure import Metrics, completions_of, flowtime_of, measure
from rightofway.metrics.waits import Wait, waits

__all__ = [
    "Collision",
    "Metrics",
    "Wait",
    "alone_completions",
    "collisions",
    "completions_of",
    "flowtime_of",
    "free_running",
    "measure",
    "waits",
]
