"""Rounds in a process of their own, so that the control answers robots meanwhile."""

from __future__ import annotations

import contextlib
import multiprocessing
import time
from collections.abc import Mapping
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Protocol

from rightofway.dispatch import FleetView, PooledJob, Round, RoundPlanner
from rightofway.facts import Fact
from rightofway.model import Scenario

__all__ = ["ProcessRounds", "RoundRequest", "Rounds", "RoundsAtOnce"]

GRACE = 20.0
"""Seconds beyond its time limit after which a round is given up, with its process.

Twice as long after each round that was given up: on a slow machine a later one ends in time.
"""

STARTING = 600.0
"""Seconds after which a process that has not started is given up: a busy machine needs minutes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RoundRequest:
    """The input of a round.

    Attributes
    ----------
    scenario
        The robots that are on the floor, their roads and rules.
    view
        These robots at the takeover.
    jobs
        The jobs of the pool, by name.
    over
        How jobs have left the pool, by name.
    seed
        For all that is drawn.
    """

    scenario: Scenario
    view: FleetView
    jobs: Mapping[str, PooledJob]
    over: Mapping[str, str]
    seed: int


class Rounds(Protocol):
    """A process that plans rounds, one at a time."""

    time_limit: float | None
    """The time limit of a round [s]; None for no limit but that of steps."""

    def prepare(self) -> bool:
        """Return whether a round may begin; until then what plans is starting."""

    def begin(self, request: RoundRequest) -> None:
        """Begin to plan a round; call it after `prepare`."""

    def poll(self) -> Round | None:
        """Return the plan of the round that was begun, once; None as long as there is none."""

    def close(self) -> None:
        """End what plans."""


class _Planners:
    """Planners of rounds, kept from round to round as long as the fleet is the same."""

    def __init__(self, time_limit: float | None, planner: str) -> None:
        self._time_limit, self._planner = time_limit, planner
        self._known: tuple[Scenario, RoundPlanner] | None = None

    def plan(self, request: RoundRequest) -> Round:
        scenario = request.scenario
        if self._known is None or self._known[0] != scenario:
            self._known = scenario, RoundPlanner(scenario, self._planner)
        return self._known[1].plan(
            request.view,
            request.jobs,
            over=request.over,
            time_limit=self._time_limit,
            seed=request.seed,
        )


class RoundsAtOnce:
    """Rounds that are planned where they are begun, for robots whose time is simulated.

    Parameters
    ----------
    time_limit
        How long a round may take [s]; None for no limit but that of steps.
    planner
        The name of the planner where planning around old tracks fails.
    """

    def __init__(self, time_limit: float | None = 2.0, planner: str = "auto") -> None:
        self.time_limit = time_limit
        self._planners, self._planned = _Planners(time_limit, planner), list[Round]()

    def prepare(self) -> bool:
        """Return True: all is in this process."""
        return True

    def begin(self, request: RoundRequest) -> None:
        """Plan a round."""
        self._planned = [self._planners.plan(request)]

    def poll(self) -> Round | None:
        """Return the plan of the round that was begun, once."""
        return self._planned.pop() if self._planned else None

    def close(self) -> None:
        """Do nothing: all is in this process."""


class ProcessRounds:
    """Rounds in a process that is started when it is needed.

    Parameters
    ----------
    time_limit
        How long a round may take [s].
    planner
        The name of the planner where planning around old tracks fails.
    """

    def __init__(self, time_limit: float = 2.0, planner: str = "auto") -> None:
        self.time_limit: float | None = time_limit
        self._limit, self._planner = time_limit, planner
        self._process: multiprocessing.process.BaseProcess | None = None
        self._pipe: Connection | None = None
        self._has_started = False
        self._until, self._grace = 0.0, GRACE

    def prepare(self) -> bool:
        """Return whether the process has started, or a round has to report that it does not.

        No robot has to keep its parts while a process starts, which takes a busy machine minutes.
        """
        if self._process is None or (self._has_started and not self._process.is_alive()):
            self._start()
        assert self._process is not None
        assert self._pipe is not None
        try:
            if not self._has_started and self._pipe.poll():
                self._pipe.recv()
                self._has_started = True
        except (EOFError, OSError):
            return True
        has_failed = not self._process.is_alive() or time.monotonic() > self._until
        return self._has_started or has_failed

    def begin(self, request: RoundRequest) -> None:
        """Give a round to the process."""
        self._until = 0.0
        if self._has_started and self._pipe is not None:
            self._until = time.monotonic() + self._limit + self._grace
            with contextlib.suppress(OSError):  # `poll` reports a process that has ended
                self._pipe.send(request)

    def poll(self) -> Round | None:
        """Return the plan of the round that was begun, once; None as long as there is none.

        A process that has ended, or takes too long, has found no plan.
        """
        if self._pipe is None or self._process is None:
            return self._give_up()
        try:
            if self._has_started and self._pipe.poll():
                planned: Round = self._pipe.recv()
                self._grace = GRACE
                return planned
        except (EOFError, OSError):
            return self._give_up()
        if not self._process.is_alive():
            return self._give_up()
        if time.monotonic() > self._until:
            self._grace *= 2
            return self._give_up()
        return None

    def close(self) -> None:
        """End the process."""
        if self._process is not None:
            self._process.kill()
            self._process.join()
        if self._pipe is not None:
            self._pipe.close()
        self._process = self._pipe = None
        self._has_started = False

    def _start(self) -> None:
        self.close()
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(
            target=_serve_rounds, args=(theirs, self._limit, self._planner), daemon=True
        )
        self._process.start()
        self._until = time.monotonic() + STARTING
        theirs.close()

    def _give_up(self) -> Round:
        self.close()
        fact = Fact("old plan stands", reason=Fact("round ended"))
        return Round(tracks=(), steps=(), stands=True, facts=(fact,))


def _serve_rounds(pipe: Connection, time_limit: float, planner: str) -> None:
    """Say that it has started; plan the rounds that come, until the pipe is closed."""
    planners = _Planners(time_limit, planner)
    pipe.send(None)
    while True:
        try:
            pipe.send(planners.plan(pipe.recv()))
        except (EOFError, OSError, KeyboardInterrupt):
            return
