"""What a plan costs, what it must cost at least, who waits for whom, and what waiting avoids."""

from rightofway.metrics.alone import alone_completions
from rightofway.metrics.collisions import Collision, collisions, free_running
from rightofway.metrics.measure import Metrics, measure
from rightofway.metrics.waits import waits

__all__ = [
    "Collision",
    "Metrics",
    "alone_completions",
    "collisions",
    "free_running",
    "measure",
    "waits",
]
