"""What a plan costs, what it must cost at least, what robots lose, where and to which robots."""

from rightofway.metrics.alone import alone_completions
from rightofway.metrics.collisions import Collision, collisions, free_running
from rightofway.metrics.lost_time import joined_waits, lost_time
from rightofway.metrics.measure import Metrics, measure
from rightofway.metrics.waits import waits

__all__ = [
    "Collision",
    "Metrics",
    "alone_completions",
    "collisions",
    "free_running",
    "joined_waits",
    "lost_time",
    "measure",
    "waits",
]
