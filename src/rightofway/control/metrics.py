"""Counts and gauges of a control, for Prometheus."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence

from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, start_http_server

from rightofway.control.endpoints import Letter
from rightofway.control.fleet_control import FleetControl
from rightofway.errors import InputError

__all__ = ["FleetMetrics"]

BUCKETS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0)
"""Borders of the histogram of answers [s]."""


class FleetMetrics:
    """Messages, answers and robots, served as text.

    Parameters
    ----------
    names
        Of the robots.
    """

    def __init__(self, names: Sequence[str]) -> None:
        self.registry = CollectorRegistry()
        self._received = Counter(
            "rightofway_messages_received",
            "Messages of robots, by topic",
            ["topic"],
            registry=self.registry,
        )
        self._sent = Counter(
            "rightofway_messages_sent", "Messages to robots, by topic", ["topic"],
            registry=self.registry,
        )  # fmt: skip
        self._answers = Histogram(
            "rightofway_answer_seconds",
            "From a message of a robot to the end of the turn that has sent what follows from it",
            buckets=BUCKETS,
            registry=self.registry,
        )
        self._jobs = Gauge("rightofway_jobs_done", "Jobs done since the journal began",
                           registry=self.registry)  # fmt: skip
        self._waiting = Gauge("rightofway_robots_waiting",
                              "Robots that stand at the end of their base and wait for others",
                              registry=self.registry)  # fmt: skip
        self._unfit = Gauge("rightofway_robots_unfit",
                            "Robots that are lost, faulty, paused, in error or in manual mode",
                            registry=self.registry)  # fmt: skip
        self._charge = Gauge("rightofway_charge", "Measured state of charge, from 0 to 1",
                             ["robot"], registry=self.registry)  # fmt: skip
        self._known = Gauge("rightofway_jobs_known", "Jobs that are known and not finished",
                            registry=self.registry)  # fmt: skip
        self._waits = Counter(
            "rightofway_waits", "How often a robot began to wait for others", ["robot"],
            registry=self.registry,
        )  # fmt: skip
        self._names, self._waits_seen = names, [0] * len(names)

    def serve(self, port: int) -> None:
        """Serve the metrics at a port of this machine.

        Parameters
        ----------
        port
            The port.

        Raises
        ------
        InputError
            If it is in use.
        """
        try:
            start_http_server(port, "127.0.0.1", registry=self.registry)
        except OSError as error:
            message = f"{port} cannot be listened on: {error.strerror} (give another port)"
            raise InputError.at("metrics", message) from error

    def turn(
        self,
        received: Iterable[tuple[float, Letter]],
        sent: Iterable[Letter],
        waits: Sequence[int],
    ) -> None:
        """Take in a turn of the loop that has ended.

        Parameters
        ----------
        received
            Messages that were taken in, each with the time at which it came [s of the counter of
            `time.perf_counter`].
        sent
            Messages that were sent.
        waits
            How often each robot has waited.
        """
        now = time.perf_counter()
        for came, letter in received:
            self._received.labels(letter.name).inc()
            self._answers.observe(now - came)
        for letter in sent:
            self._sent.labels(letter.name).inc()
        for robot, (count, seen) in enumerate(zip(waits, self._waits_seen, strict=True)):
            if count > seen:
                self._waits.labels(self._names[robot]).inc(count - seen)
        self._waits_seen = list(waits)

    def survey(self, control: FleetControl) -> None:
        """Count how robots are; called once a second, not in each turn.

        Parameters
        ----------
        control
            The control.
        """
        robots = control.ledger.robots
        self._jobs.set(sum(control.ledger.count_jobs()))
        self._known.set(len(control.ledger.pool.jobs))
        for robot, charge in control.charges.items():
            self._charge.labels(self._names[robot]).set(charge)
        self._unfit.set(
            sum(not control.is_fit(robot) or own.fault is not None
                for robot, own in enumerate(robots))
        )  # fmt: skip
        self._waiting.set(
            sum(own.arrived == own.released and not own.is_done for own in robots)
        )  # fmt: skip
