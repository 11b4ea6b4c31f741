"""The slow simulation of repeated laps under a rule of the native simulator."""

from __future__ import annotations

from rightofway.cyclic.rolling_horizon import RollingHorizon
from rightofway.cyclic.route import GroupContext
from rightofway.cyclic.run import by_windows

__all__ = ["rolling"]


def rolling(context: GroupContext, rule: str) -> RollingHorizon:
    """Return the slow simulation of a native rule, with the pacemaker of the native simulator."""
    return by_windows(context, rule)
