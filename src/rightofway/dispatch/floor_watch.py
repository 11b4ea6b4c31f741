"""The forecast of a simulated floor, renewed only when a robot is later than last expected."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from statistics import median_low

from rightofway.dispatch.floor import FloorRobot, SimulatedFloor
from rightofway.dispatch.pool import PooledJob
from rightofway.dispatch.triggers import Outlook
from rightofway.execution.monitor import LOOKS
from rightofway.model import NEVER

__all__ = ["FloorWatch", "make_outlook"]


class FloorWatch:
    """The look-out for triggers of rounds that lie in the forecast of a floor.

    As in `rightofway.execution.monitor`, the forecast is renewed when a robot is later than last
    expected by more than a drive takes, and by more than a small part of the plan.

    Parameters
    ----------
    floor
        The floor.

    Attributes
    ----------
    outlook
        The forecast, as it was last made.
    """

    def __init__(self, floor: SimulatedFloor) -> None:
        self._floor, self.outlook = floor, Outlook()
        self._takeover, self._patience = 0, 1
        self._noted = [0] * len(floor.robots)  # how late each robot was at the last forecast
        itineraries = floor.scenario.problem.itineraries
        drives = [ticks for own in itineraries for ticks in set(own.edge_ticks) if ticks > 0]
        self._drive = median_low(drives) if drives else 1

    def take_over(self, now: int, jobs: Mapping[str, PooledJob]) -> None:
        """Begin to look at a plan that has just taken over.

        Parameters
        ----------
        now
            The tick.
        jobs
            The jobs of the pool.
        """
        before, self._takeover = self.outlook, now
        spans = [own.visits[-1].planned - now for own in self._floor.robots if own.lost is None]
        self._patience = max(self._drive, max(spans, default=0) // LOOKS, 1)
        self._noted = [0] * len(self._noted)
        planned = sum(max(0, span) for span in spans)
        self.outlook = Outlook(planned=planned, expected=planned)
        if before.too_late or before.short or before.shut_out:  # the plan may not have mended it
            self._look_ahead(now, jobs)

    def look(self, now: int, jobs: Mapping[str, PooledJob]) -> None:
        """Renew the forecast if a robot is later than last expected.

        Parameters
        ----------
        now
            The tick.
        jobs
            The jobs of the pool.
        """
        late = [_measure_lateness(own, now) for own in self._floor.robots]
        self._noted = list(map(min, self._noted, late))
        if any(own > noted + self._patience for own, noted in zip(late, self._noted, strict=True)):
            self._look_ahead(now, jobs)

    def _look_ahead(self, now: int, jobs: Mapping[str, PooledJob]) -> None:
        """Renew the forecast."""
        self._noted = [_measure_lateness(own, now) for own in self._floor.robots]
        self.outlook = make_outlook(
            self._floor, now, self._takeover, jobs, planned=self.outlook.planned
        )


def make_outlook(
    floor: SimulatedFloor,
    now: int,
    takeover: int,
    jobs: Mapping[str, PooledJob],
    *,
    planned: int | None,
) -> Outlook:
    """Return the forecast of a floor.

    Parameters
    ----------
    floor
        The floor.
    now
        The tick.
    takeover
        When the plan has taken over [ticks].
    jobs
        The jobs of the pool.
    planned
        As in `Outlook`; None where it is not known: then as it is expected now.
    """
    ahead = floor.fork(now)
    ahead.advance(NEVER - 1)
    driving = [k for k, own in enumerate(floor.robots) if own.lost is None]
    ends = {
        k: own.recent[-1][1]
        for k, own in enumerate(ahead.robots)
        if own.lost is None and len(own.visits) == 1
    }
    expected = sum(max(0, ends[k] - takeover) for k in driving if k in ends)
    return Outlook(
        planned=expected if planned is None else planned,
        expected=expected,
        too_late=frozenset(_list_late(ahead, jobs)),
        short=frozenset(k for k in driving if _is_short(ahead, k)),
        shut_out=frozenset(k for k in driving if len(ahead.robots[k].visits) > 1),
    )


def _measure_lateness(own: FloorRobot, now: int) -> int:
    """Return how much later than planned a robot is, as far as that is known now [ticks]."""
    if own.lost is not None:
        return 0
    arrival = own.recent[-1][1]
    late = (own.estimate(now) if arrival > now else arrival) - own.visits[0].planned
    return late if len(own.visits) == 1 else max(late, now - own.visits[1].planned)


def _list_late(ahead: SimulatedFloor, jobs: Mapping[str, PooledJob]) -> Iterator[str]:
    """Yield the jobs that miss `latest` of a stop in a forecast."""
    time_of = ahead.scenario.problem.clock.convert_to_time
    for event in ahead.events:
        if event.is_end and event.job in jobs:
            latest = jobs[event.job].job.stops[event.stop].latest
            if latest is not None and time_of(event.tick) > latest:
                yield event.job


def _is_short(ahead: SimulatedFloor, robot: int) -> bool:
    """Return whether a robot falls below its reserve in a forecast: before charges, or last."""
    battery = ahead.states[robot].battery
    if battery is None:
        return False
    levels = [soc for _, soc in ahead.records[robot].soc]
    last = Fraction(ahead.robots[robot].soc, battery.full)
    return min([*levels, last]) * battery.full < battery.reserve
