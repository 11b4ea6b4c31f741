"""The battery of a simulated robot: it falls with drives, work and time, and rises in charges."""

from __future__ import annotations

from rightofway.model import Battery, Scenario

__all__ = ["SimulatedBattery", "make_simulated_battery"]


class SimulatedBattery:
    """A battery whose state of charge is measured as robots measure it.

    Parameters
    ----------
    battery
        Its shares, by time and length units of the scenario.
    soc
        The state of charge at the begin, from 0 to 1.

    Attributes
    ----------
    soc
        The state of charge, from 0 to 1.
    """

    def __init__(self, battery: Battery, soc: float) -> None:
        self._battery, self.soc = battery, soc

    def pass_time(self, time: float, *, is_charging: bool, works: bool = False) -> None:
        """Let time pass [time unit].

        Parameters
        ----------
        time
            How much.
        is_charging, works
            Whether the robot charges, and whether it works.
        """
        own = self._battery
        share = own.charge if is_charging else -own.on - (own.work if works else 0)
        self.soc = min(max(self.soc + float(share) * time, 0.0), 1.0)

    def drive(self, length: float) -> None:
        """Take the share of a drive [length unit], without its time."""
        self.soc = max(self.soc - float(self._battery.drive) * length, 0.0)


def make_simulated_battery(scenario: Scenario, robot: int) -> SimulatedBattery | None:
    """Return the battery of a robot of a scenario at the begin; None if it has none."""
    own = scenario.robots[robot]
    if own.battery is None:
        return None
    soc = 1.0 if own.start is None else float(own.start.soc)
    return SimulatedBattery(dict(scenario.batteries)[own.battery], soc)
