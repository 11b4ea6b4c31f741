"""Dispatch: work that arrives while robots drive, planned in rounds for as long as a shift lasts.

It contains no network, no journal and no clock. The simulated floor and the control of robots use
the same rounds.
"""

from __future__ import annotations

from rightofway.dispatch.horizon import STOPS_AHEAD
from rightofway.dispatch.pool import Pool, PooledJob, PoolEvent
from rightofway.dispatch.record import ShiftRecord
from rightofway.dispatch.reveal import Reveal
from rightofway.dispatch.round import RoundPlanner
from rightofway.dispatch.settings import ShiftSettings
from rightofway.dispatch.shift import ShiftRules, run_shift
from rightofway.dispatch.view import (
    FleetView,
    PlannedStep,
    RobotView,
    Round,
    StopsLater,
    make_whole_tracks,
)

__all__ = [
    "STOPS_AHEAD",
    "FleetView",
    "PlannedStep",
    "Pool",
    "PoolEvent",
    "PooledJob",
    "Reveal",
    "RobotView",
    "Round",
    "RoundPlanner",
    "ShiftRecord",
    "ShiftRules",
    "ShiftSettings",
    "StopsLater",
    "make_whole_tracks",
    "run_shift",
]
