"""Counts and gauges of a control, for Prometheus."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from socketserver import ThreadingMixIn
from threading import Thread
from typing import Any, cast
from wsgiref.simple_server import WSGIRequestHandler, WSGIServer, make_server

from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, make_wsgi_app

from rightofway.control.endpoints import Letter
from rightofway.control.fleet_control import FleetControl
from rightofway.errors import InputError

__all__ = ["FleetMetrics"]

BUCKETS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0)
"""Borders of the histogram of answers [s]."""


HEALTH = {"/healthz": "alive", "/readyz": "ready"}
"""The paths of health, each with the key that decides on its status."""


class _Server(ThreadingMixIn, WSGIServer):
    daemon_threads = True


class _SilentHandler(WSGIRequestHandler):
    def log_message(self, format: str, *args: Any) -> None:  # noqa: A002 (the name of the base)
        """Write nothing: the log has the events of robots."""


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

    def take_names(self, names: Sequence[str]) -> None:
        """Take in that more robots are in the fleet.

        Parameters
        ----------
        names
            Of all robots.
        """
        self._waits_seen += [0] * (len(names) - len(self._names))
        self._names = names

    def serve(self, port: int, host: str, report_health: Callable[[], Mapping[str, Any]]) -> None:
        """Serve metrics and health over HTTP: ``/metrics``, ``/healthz`` and ``/readyz``.

        Parameters
        ----------
        port, host
            Where to listen.
        report_health
            Returns whether the control is ``alive`` and ``ready``, and more.

        Raises
        ------
        InputError
            If it is in use.
        """
        metrics = make_wsgi_app(self.registry)

        def answer(environ: dict[str, Any], start: Callable[..., Any]) -> Iterable[bytes]:
            key = HEALTH.get(environ["PATH_INFO"])
            if key is None:
                return cast("Iterable[bytes]", metrics(environ, start))
            health = report_health()
            status = "200 OK" if health[key] else "503 Service Unavailable"
            start(status, [("Content-Type", "application/json")])
            return [json.dumps(health).encode() + b"\n"]

        try:
            server = make_server(host, port, answer, _Server, handler_class=_SilentHandler)
        except OSError as error:
            message = f"{port} cannot be listened on: {error.strerror} (give another port)"
            raise InputError.at("metrics", message) from error
        Thread(target=server.serve_forever, daemon=True).start()

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
