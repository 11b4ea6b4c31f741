"""The look-out of a control for what begins a round: the same triggers as in simulated shifts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction

from rightofway.control.fleet_control import FleetControl
from rightofway.control.ledger import Edge, Ledger
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.round_floor import FloorReports, mirror_floor
from rightofway.control.work_items import find_charge_step, find_stop
from rightofway.dispatch import STOPS_AHEAD, StopsLater
from rightofway.dispatch.floor import SimulatedFloor
from rightofway.dispatch.floor_watch import make_outlook
from rightofway.dispatch.triggers import RETRY, Outlook, Situation, list_triggers
from rightofway.facts import Fact
from rightofway.model import Scenario

__all__ = ["RoundWatch"]

LOOKS_PER_FORECAST = 10
"""Calls of `look` for a forecast: it takes about 0.2 s for 8 000 parts."""

MOST_DOUBLED = 6
"""The largest number of doublings of a pause between rounds."""

TOLERANCE = Fraction(1, 100)
"""By how much a forecast may be below the reserve: robots report whole percents."""


class RoundWatch:
    """The look-out for what begins a round.

    Parameters
    ----------
    fleet
        The fleet with its closures, without jobs.
    control
        The control, with the pool of jobs in its ledger.
    ready
        When each robot is ready [ticks].

    Attributes
    ----------
    unable
        Robots that do not go on: others are planned round them.
    list_closed
        Returns the edges that are closed now.
    read_ticks
        Returns the time since the run began [ticks].
    reasons
        Why the last round was wanted.
    """

    def __init__(self, fleet: Scenario, control: FleetControl, ready: Sequence[int]) -> None:
        self._fleet, self._control = fleet, control
        self.unable = frozenset[int]()
        self.list_closed: Callable[[], Collection[Edge]] = tuple
        self.read_ticks: Callable[[], int] = lambda: 0
        self.reasons: tuple[Fact, ...] = ()
        self._reports = FloorReports(control.charges, control.headings, ready)
        self._later: tuple[object, Mapping[int, StopsLater]] = None, {}  # a graph, and its own
        self._tried: Situation | None = None  # when the last round began
        self._looks, self._retries, self._catches_up = 0, _Pauses(), _Pauses()
        self._takeover, self._outlook = 0, Outlook()
        self._planned: int | None = None

    @property
    def later(self) -> Mapping[int, StopsLater]:
        """What robots do behind the ends of their routes; nothing is known after other splices."""
        graph, later = self._later
        return later if graph is self._ledger.graph else {}

    @property
    def _ledger(self) -> Ledger:
        return self._control.ledger

    def map_robots(self) -> dict[str, int]:
        """Return the robot that has each job in its tour, by name; without those that are off."""
        planned, later = dict[str, int](), self.later
        for robot, own in enumerate(self._ledger.robots):
            if not own.is_off:
                stops = filter(None, map(find_stop, own.route.all_jobs))
                names = (name for name, _ in (*stops, *later.get(robot, ())))
                planned |= dict.fromkeys(names, robot)
        return planned

    def list_waiting(self) -> list[str]:
        """Return the jobs of the pool that are in no tour and not begun."""
        planned, pool = self.map_robots(), self._ledger.pool
        return [name for name, own in pool.jobs.items() if not own.is_begun and name not in planned]

    def mirror_floor(self, spare: Fraction = Fraction(0)) -> SimulatedFloor:
        """Return the floor as it is expected to be now.

        Parameters
        ----------
        spare
            The share of a battery by which each is fuller than measured.
        """
        now = self.read_ticks()
        return mirror_floor(
            self._fleet, self._ledger, self._reports, now=now, unable=self.unable, spare=spare
        )

    def look(self, *, forecasts: bool) -> bool:
        """Return whether a round should begin; call it every second.

        Parameters
        ----------
        forecasts
            Whether robots follow their plan: they do not where a round is under way.
        """
        self._reports.look(self._ledger, self.read_ticks())
        self._looks += 1
        if self._tried is None or (forecasts and self._looks % LOOKS_PER_FORECAST == 0):
            self._look_ahead()
        situation = self._describe()
        if self._tried is None:  # the plan of a new journal needs no round but for jobs it leaves
            self._tried = replace(situation, free=frozenset())
        self._retries.look(situation.counts["job known"])
        self._catches_up.look(situation.counts["stop done"])
        self.reasons = tuple(self._list_reasons(self._tried, situation))
        return bool(self.reasons)

    def _list_reasons(self, tried: Situation, situation: Situation) -> Iterator[Fact]:
        """Yield the reasons to begin a round; those that only time gives, more and more rarely."""
        for reason in list_triggers(tried, situation):
            if reason.kind != "fallen behind" or self._catches_up.is_due:
                yield reason
        if situation.waiting and self._retries.is_due:
            yield Fact("jobs still wait")

    def begin_round(self) -> None:
        """Note that a round begins: it looks at all that there is."""
        self._tried = self._describe()
        self._retries.begin()
        if any(reason.kind == "fallen behind" for reason in self.reasons):
            self._catches_up.begin()

    def take_over(self, later: Mapping[int, StopsLater], takeover: int, planned: int) -> None:
        """Begin to look at a plan that has taken over.

        Parameters
        ----------
        later
            What robots do behind the ends of their routes.
        takeover
            When it has taken over [ticks].
        planned
            As `Outlook.planned`.
        """
        self._later = self._ledger.graph, later
        self._takeover, self._planned = takeover, planned
        self.keep_old()

    def keep_old(self) -> None:
        """Look at the old plan as it is expected now: no better one was found."""
        self._look_ahead()
        if self._tried is not None:
            self._tried = replace(self._tried, outlook=self._outlook)

    def _look_ahead(self) -> None:
        """Renew the forecast."""
        self._outlook = make_outlook(
            self.mirror_floor(TOLERANCE),
            self.read_ticks(),
            self._takeover,
            self._ledger.pool.jobs,
            planned=self._planned,
        )
        self._planned = self._outlook.planned

    def _describe(self) -> Situation:
        """Return what may begin a round."""
        ledger = self._ledger
        off = {robot for robot, own in enumerate(ledger.robots) if own.is_off}
        driving = {k: own for k, own in enumerate(ledger.robots) if k not in off | self.unable}
        cut = {robot for robot, stops in self.later.items() if stops}
        return Situation(
            counts=Counter(ledger.pool.counts),
            waiting=frozenset(self.list_waiting()),
            free=frozenset(k for k, own in driving.items() if own.is_done) - cut,
            ending=frozenset(k for k in cut & driving.keys() if _is_near_end(driving[k])),
            unable=self.unable | off,
            closed=frozenset(self.list_closed()),
            outlook=self._outlook,
        )


class _Pauses:
    """Pauses between rounds for which nothing but time is a reason.

    Each is twice as long as the one before, until there is news. If rounds followed each other as
    fast as they can, a slow fleet could give a job from robot to robot and never do it.
    """

    def __init__(self) -> None:
        self.left, self._n_doubled, self._news = 0, 0, 0

    @property
    def is_due(self) -> bool:
        """Whether the pause is over."""
        return self.left <= 0

    def look(self, news: int) -> None:
        """Count a look; ``news`` are all that there were."""
        self.left -= 1
        if news != self._news:
            self._n_doubled, self._news = 0, news

    def begin(self) -> None:
        """Begin a pause."""
        self.left = RETRY << min(self._n_doubled, MOST_DOUBLED)
        self._n_doubled += 1


def _is_near_end(own: RobotLedger) -> bool:
    """Return whether a robot has little left to do on its route."""
    left = (item for item in own.route.all_jobs - own.finished if not own.is_sent(item))
    return sum(find_charge_step(item) != "end" for item in left) < STOPS_AHEAD
