"""The ledger: what a journal says of each robot; a fold over its entries, and nothing else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from rightofway.control.journal import Entry
from rightofway.control.messages import Order
from rightofway.precedence import Arrival, Part, ReleaseGraph


@dataclass(frozen=True, slots=True, kw_only=True)
class RouteToDrive:
    """The route of a robot as orders have it.

    Attributes
    ----------
    places
        The name of the vertex of each visit.
    jobs
        For each visit the names of what is to be done there; each name is in one visit.
    """

    places: tuple[str, ...]
    jobs: tuple[tuple[str, ...], ...]

    @classmethod
    def of_document(cls, document: Mapping[str, Any]) -> RouteToDrive:
        """Return a route of a journal.

        Parameters
        ----------
        document
            The places and jobs.
        """
        return cls(places=tuple(document["places"]), jobs=tuple(map(tuple, document["jobs"])))


@dataclass(slots=True)
class SentOrder:
    """An order of ours: the part of its sequence id 0, and where the base of each update ends."""

    offset: int
    ends: list[int]


@dataclass(slots=True)
class Cancel:
    """A cancel under way: wanted, asked with an action id, or followed by an order of one node."""

    action_id: str | None = None
    stands_at: int | None = None  # the part of the order of one node


@dataclass(slots=True)
class RobotLedger:
    """One robot. It holds the vertex last arrived at and every released part after it."""

    route: RouteToDrive
    arrived: int = 0
    released: int = 0
    orders: dict[str, SentOrder] = field(default_factory=dict)
    message: Order | None = None  # the last order or update
    is_acknowledged: bool = False
    token: str | None = None  # of a doubt
    tokens: int = 0
    cancel: Cancel | None = None
    cancels: int = 0
    is_on_hold: bool = False
    fault: str | None = None
    strays_at: str | None = None  # the place that a faulty robot names
    is_off: bool = False  # taken off the floor
    jobs_of: dict[str, str] = field(default_factory=dict)  # action id: job
    attempts: dict[str, int] = field(default_factory=dict)  # job: number of its last action
    finished: set[str] = field(default_factory=set)
    failed: set[str] = field(default_factory=set)

    @property
    def order_id(self) -> str:
        """The current order; empty before the first one."""
        return self.message.order_id if self.message else ""

    def held_at(self, place: str) -> int | None:
        """Return the held part whose vertex is a place, None if there is none."""
        for part in range(self.arrived, self.released + 1):
            if self.route.places[part] == place:
                return part
        return None


class Ledger:
    """All robots, and the release graph of their routes."""

    def __init__(self) -> None:
        self.run = ""
        self.starts = 0
        self.robots: list[RobotLedger] = []
        self.graph = ReleaseGraph((), {})

    @property
    def arrived(self) -> list[int]:
        """The visit at whose vertex each robot has arrived; past the last one once it is off."""
        return [len(own.route.places) if own.is_off else own.arrived for own in self.robots]

    def apply(self, entry: Entry) -> None:
        """Take in an entry.

        Parameters
        ----------
        entry
            The next entry of the journal.
        """
        kind = entry["kind"]
        if kind == "started":
            self.starts += 1
        elif kind in {"plan", "splice"}:
            self._apply_plan(entry)
        else:
            _APPLY[kind](self.robots[entry["robot"]], entry)

    def _apply_plan(self, entry: Entry) -> None:
        routes = [RouteToDrive.of_document(route) for route in entry["routes"]]
        self.graph = ReleaseGraph(
            [len(route.places) for route in routes],
            {
                Part(*part): [Arrival(*arrival) for arrival in arrivals]
                for part, arrivals in entry["waits"]
            },
        )
        if entry["kind"] == "plan":
            self.run = entry["run"]
            self.robots = [RobotLedger(route) for route in routes]
            return
        for own, route in zip(self.robots, routes, strict=True):
            own.route = route


def plan_entry(
    kind: str, run: str, routes: Sequence[RouteToDrive], graph: ReleaseGraph, committed: list[int]
) -> Entry:
    """Return the entry of routes and their release graph.

    Parameters
    ----------
    kind
        ``plan`` for the first one, ``splice`` for a later one.
    run
        A name that no other journal has; orders begin with it.
    routes, graph
        The routes of all robots, and who waits for whom.
    committed
        The last released part of each robot; parts up to it wait for nothing any more.
    """
    waits = [
        [[robot, number], [list(arrival) for arrival in arrivals]]
        for robot, route in enumerate(routes)
        for number in range(committed[robot] + 1, len(route.places))
        if (arrivals := graph.waits(Part(robot, number)))
    ]
    documents = [{"places": route.places, "jobs": route.jobs} for route in routes]
    return {"kind": kind, "run": run, "routes": documents, "waits": waits}


def _arrive(own: RobotLedger, entry: Entry) -> None:
    own.arrived = max(own.arrived, entry["visit"])


def _order(own: RobotLedger, entry: Entry) -> None:
    order = Order.of_document(entry["order"])
    if order.update_id == 0:
        own.orders[order.order_id] = SentOrder(entry["offset"], [])
        own.token = None
        stands_at = entry.get("stands_at")
        if own.cancel is not None:  # a new order drops a cancel under way: it is asked anew
            own.cancel = Cancel(stands_at=stands_at)
    sent = own.orders[order.order_id]
    sent.ends.append(sent.offset + order.nodes[-1].sequence_id // 2)
    own.message, own.is_acknowledged = order, False
    own.released = max(own.released, sent.ends[-1])
    for action_id, job, attempt in entry["actions"]:
        own.jobs_of[action_id] = job
        own.attempts[job] = attempt
        own.failed.discard(job)


def _acknowledge(own: RobotLedger, _: Entry) -> None:
    own.is_acknowledged = True
    if own.cancel is not None and own.cancel.stands_at is not None:
        own.released, own.cancel = own.cancel.stands_at, None


def _doubt(own: RobotLedger, entry: Entry) -> None:
    own.token, own.tokens = entry["token"], own.tokens + 1


def _end_doubt(own: RobotLedger, _: Entry) -> None:
    own.token = None


def _want_cancel(own: RobotLedger, _: Entry) -> None:
    own.cancel = own.cancel or Cancel()


def _ask_cancel(own: RobotLedger, entry: Entry) -> None:
    own.cancel, own.cancels = Cancel(action_id=entry["action"]), own.cancels + 1


def _finish(own: RobotLedger, entry: Entry) -> None:
    own.finished.add(entry["job"])
    own.failed.discard(entry["job"])


def _fail(own: RobotLedger, entry: Entry) -> None:
    own.failed.add(entry["job"])


def _find_fault(own: RobotLedger, entry: Entry) -> None:
    own.fault, own.strays_at = entry["fault"], entry["place"]


def _clear(own: RobotLedger, _: Entry) -> None:
    own.fault = own.strays_at = None


def _hold(own: RobotLedger, entry: Entry) -> None:
    own.is_on_hold = entry["on"]


def _take_off(own: RobotLedger, _: Entry) -> None:
    own.is_off = True


_APPLY = {
    "arrived": _arrive,
    "order": _order,
    "acknowledged": _acknowledge,
    "doubt": _doubt,
    "certain": _end_doubt,
    "cancel wanted": _want_cancel,
    "cancel asked": _ask_cancel,
    "finished": _finish,
    "failed": _fail,
    "fault": _find_fault,
    "cleared": _clear,
    "hold": _hold,
    "taken off": _take_off,
}
