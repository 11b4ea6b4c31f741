"""The ledger: what a journal says of each robot; a fold over its entries, and nothing else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from rightofway.control.journal import UNFOLDED, Entry
from rightofway.control.messages import Order
from rightofway.precedence import Arrival, Part, ReleaseGraph

Names = tuple[str, ...]
"""What a person closes: a vertex, or the two ends of a lane."""

Edge = tuple[str, str]
"""The names of the vertices that an edge leaves and enters."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RouteToDrive:
    """The route of a robot as orders have it; visits keep their numbers when the first ones go.

    Attributes
    ----------
    places
        The name of the vertex of each visit.
    jobs
        For each visit the names of what is to be done there; each name is in one visit.
    first
        The number of the first visit that is kept.
    work
        For each job of each visit how long it lasts with its turn [ticks]; empty where nobody
        plans.
    enter
        When each visit is planned to begin [ticks]: only the order of these times counts. Empty
        where nobody plans.
    lap_ends
        Numbers of the visits at which a lap ends.
    in_step
        Whether the end is that of a lap of the plan, so that its next lap may follow.
    """

    places: tuple[str, ...]
    jobs: tuple[tuple[str, ...], ...]
    first: int = 0
    work: tuple[tuple[int, ...], ...] = ()
    enter: tuple[int, ...] = ()
    lap_ends: tuple[int, ...] = ()
    in_step: bool = True

    @property
    def end(self) -> int:
        """The number after that of the last visit."""
        return self.first + len(self.places)

    def get_place(self, visit: int) -> str:
        """Return the name of the vertex of a visit.

        Parameters
        ----------
        visit
            The number of a visit that is kept.
        """
        return self.places[self._index(visit)]

    def get_jobs(self, visit: int) -> tuple[str, ...]:
        """Return what is to be done in a visit.

        Parameters
        ----------
        visit
            The number of a visit that is kept.
        """
        return self.jobs[self._index(visit)]

    def get_work(self, visit: int) -> tuple[int, ...]:
        """Return how long each job of a visit lasts [ticks].

        Parameters
        ----------
        visit
            The number of a visit that is kept.
        """
        return self.work[self._index(visit)]

    def stretch(self, begin: int, end: int) -> tuple[str, ...]:
        """Return the places of visits, those before ``end``.

        Parameters
        ----------
        begin, end
            Numbers of visits; what is not kept is left out.
        """
        return self.places[max(begin - self.first, 0) : max(end - self.first, 0)]

    def cut_before(self, visit: int) -> RouteToDrive:
        """Return the route without the visits before one.

        Parameters
        ----------
        visit
            The number of a visit that is kept.
        """
        index = self._index(visit)
        return replace(
            self,
            first=visit,
            places=self.places[index:],
            jobs=self.jobs[index:],
            work=self.work[index:],
            enter=self.enter[index:],
            lap_ends=tuple(end for end in self.lap_ends if end >= visit),
        )

    @property
    def all_jobs(self) -> set[str]:
        """Return the names of all that is to be done."""
        return {job for jobs in self.jobs for job in jobs}

    def _index(self, visit: int) -> int:
        index = visit - self.first
        if index < 0:
            raise IndexError(f"visit {visit} is not kept, the first is {self.first}")
        return index

    @classmethod
    def of_document(cls, document: Mapping[str, Any]) -> RouteToDrive:
        """Return a route of a journal.

        Parameters
        ----------
        document
            The route as `asdict` has it.
        """
        return cls(
            **{
                **document,
                "places": tuple(document["places"]),
                "jobs": tuple(map(tuple, document["jobs"])),
                "work": tuple(map(tuple, document["work"])),
                "enter": tuple(document["enter"]),
                "lap_ends": tuple(document["lap_ends"]),
            }
        )


@dataclass(slots=True)
class SentOrder:
    """An order of ours.

    Attributes
    ----------
    offset
        The part of its sequence id 0.
    ends
        The last part of the base of each update, by its id; of old ones, which can prove nothing
        new, there are none.
    updates
        The number of all updates.
    """

    offset: int
    ends: dict[int, int] = field(default_factory=dict)
    updates: int = 0


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
    orders: dict[str, SentOrder] = field(default_factory=dict)  # without old ones
    order_count: int = 0  # of all
    order_jobs: int = 0  # jobs of the current order
    first_order: int = 0  # since a person placed the robot
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
    finished: set[str] = field(default_factory=set)  # jobs of the route, skipped ones too
    failed: set[str] = field(default_factory=set)
    next_job: int = 0  # the number of the next new job: no name comes twice
    jobs_done: int = 0  # of all
    laps_done: int = 0

    @property
    def order_id(self) -> str:
        """The current order; empty before the first one."""
        return self.message.order_id if self.message else ""

    @property
    def held(self) -> tuple[str, ...]:
        """The vertices that it holds: the one last arrived at, and all that are released."""
        return self.route.stretch(self.arrived, self.released + 1)

    @property
    def is_done(self) -> bool:
        """Whether it is at the end of its route, with all its jobs done."""
        return self.arrived == self.route.end - 1 and self.finished >= self.route.all_jobs

    def find_held(self, place: str) -> int | None:
        """Return the held part whose vertex is a place, None if there is none."""
        held = self.held
        return self.arrived + held.index(place) if place in held else None

    def take_route(self, route: RouteToDrive) -> None:
        """Go on along another route; drop what is known of jobs and orders before it.

        Parameters
        ----------
        route
            What is released, and what follows.
        """
        self.route, jobs = route, route.all_jobs
        numbers = (int(job.removeprefix("job")) for job in jobs)
        self.next_job = max(self.next_job, max(numbers, default=-1) + 1)
        self.finished &= jobs
        self.failed &= jobs
        self.attempts = {job: number for job, number in self.attempts.items() if job in jobs}
        self.jobs_of = {action: job for action, job in self.jobs_of.items() if job in jobs}
        for sent in self.orders.values():
            ends = sent.ends.items()
            sent.ends = {update: end for update, end in ends if end >= self.route.first}
        self.orders = {
            name: sent for name, sent in self.orders.items() if sent.ends or name == self.order_id
        }

    def to_document(self) -> dict[str, Any]:
        """Return all of it for a journal."""
        return {**asdict(self), "finished": sorted(self.finished), "failed": sorted(self.failed)}

    @classmethod
    def of_document(cls, document: Mapping[str, Any]) -> RobotLedger:
        """Return what a journal has.

        Parameters
        ----------
        document
            What `to_document` has returned.
        """
        message, cancel = document["message"], document["cancel"]
        orders = {
            name: SentOrder(
                sent["offset"],
                {int(update): end for update, end in sent["ends"].items()},
                sent["updates"],
            )
            for name, sent in document["orders"].items()
        }
        return cls(
            **{
                **document,
                "route": RouteToDrive.of_document(document["route"]),
                "orders": orders,
                "message": Order.of_document(message) if message else None,
                "cancel": Cancel(**cancel) if cancel else None,
                "finished": set(document["finished"]),
                "failed": set(document["failed"]),
            }
        )


class Ledger:
    """All robots, and the release graph of their routes."""

    def __init__(self) -> None:
        self.run = ""
        self.starts = 0
        self.names: tuple[str, ...] = ()
        self.robots: list[RobotLedger] = []
        self.graph = ReleaseGraph((), {})
        self.closed: dict[Names, tuple[Edge, ...]] = {}  # what nobody may enter
        self.commands = 0  # the number of the last command that was carried out
        self.answer = ""  # to it

    @property
    def arrived(self) -> list[int]:
        """The visit at whose vertex each robot has arrived.

        A robot that is off the floor goes on in thought, wherever it would have right of way:
        a part that waits for it does not list who goes before both of them. In the end it is past
        its last visit.
        """
        arrived = [own.arrived for own in self.robots]
        absent = [robot for robot, own in enumerate(self.robots) if own.is_off]
        for robot in absent:
            arrived[robot] = self.robots[robot].released
        goes_on = bool(absent)
        while goes_on:
            goes_on = False
            for robot in absent:
                end = self.robots[robot].route.end
                while arrived[robot] < end and (
                    arrived[robot] + 1 == end
                    or self.graph.may_go(Part(robot, arrived[robot] + 1), arrived)
                ):
                    arrived[robot], goes_on = arrived[robot] + 1, True
        return arrived

    @property
    def closed_edges(self) -> set[Edge]:
        """The edges that nobody may enter, by the names of their vertices."""
        return {edge for edges in self.closed.values() for edge in edges}

    def owns(self, robot: int, order_id: str) -> bool:
        """Return whether an order is one of ours for a robot, however old.

        Parameters
        ----------
        robot
            Its number.
        order_id
            As a state names it.
        """
        known = self.robots[robot]
        if order_id in known.orders:
            return True
        start, _, number = order_id.rpartition("-")
        is_number = number.isdecimal() and number == str(int(number))
        return start == f"{self.run}-{robot}" and is_number and int(number) < known.order_count

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
        elif kind == "snapshot":
            self._apply_snapshot(entry)
        elif kind == "closed":
            self.closed[tuple(entry["names"])] = tuple(map(tuple, entry["edges"]))
        elif kind == "opened":
            self.closed.pop(tuple(entry["names"]), None)
        elif kind == "command":
            self.commands, self.answer = entry["number"], entry["answer"]
        elif kind in UNFOLDED:
            pass
        else:
            _APPLY[kind](self.robots[entry["robot"]], entry)

    def make_snapshot(self) -> Entry:
        """Return an entry that says all that the entries before it say together."""
        robots = [own.to_document() for own in self.robots]
        waits = _written_waits(self.graph, [own.released for own in self.robots])
        return {
            "kind": "snapshot",
            "run": self.run,
            "starts": self.starts,
            "names": self.names,
            "closed": list(self.closed.items()),
            "commands": self.commands,
            "answer": self.answer,
            "robots": robots,
            "waits": waits,
        }

    def _apply_plan(self, entry: Entry) -> None:
        routes = [RouteToDrive.of_document(route) for route in entry["routes"]]
        self.graph = _graph_of(routes, entry["waits"])
        if entry["kind"] == "plan":
            self.run, self.names = entry["run"], tuple(entry["names"])
            self.robots = [RobotLedger(route) for route in routes]
        for own, route in zip(self.robots, routes, strict=True):
            own.take_route(route)

    def _apply_snapshot(self, entry: Entry) -> None:
        self.run, self.starts = entry["run"], entry["starts"]
        self.names, self.closed = (
            tuple(entry["names"]),
            {tuple(names): tuple(map(tuple, edges)) for names, edges in entry["closed"]},
        )
        self.commands, self.answer = entry["commands"], entry["answer"]
        self.robots = [RobotLedger.of_document(robot) for robot in entry["robots"]]
        self.graph = _graph_of([own.route for own in self.robots], entry["waits"])


Waits = list[list[list[Any]]]
"""A release graph in a journal: for each part that waits, the part and its arrivals."""


def plan_entry(
    kind: str,
    run: str,
    routes: Sequence[RouteToDrive],
    graph: ReleaseGraph,
    *,
    committed: Sequence[int],
    names: Sequence[str] = (),
) -> Entry:
    """Return the entry of routes and their release graph."""
    documents = [asdict(route) for route in routes]
    waits = _written_waits(graph, committed)
    return {"kind": kind, "run": run, "names": names, "routes": documents, "waits": waits}


def _written_waits(graph: ReleaseGraph, committed: Sequence[int]) -> Waits:
    """Return who waits for whom behind what is released."""
    return [
        [list(part), [list(arrival) for arrival in graph.waits(part)]]
        for part in graph.list_waiting_parts()
        if part.number > committed[part.robot]
    ]


def _graph_of(routes: Sequence[RouteToDrive], waits: Waits) -> ReleaseGraph:
    return ReleaseGraph(
        [route.end for route in routes],
        {Part(*part): [Arrival(*arrival) for arrival in arrivals] for part, arrivals in waits},
        [route.first for route in routes],
    )


def _arrive(own: RobotLedger, entry: Entry) -> None:
    before, own.arrived = own.arrived, max(own.arrived, entry["visit"])
    own.laps_done += sum(before < visit <= own.arrived for visit in own.route.lap_ends)


def _order(own: RobotLedger, entry: Entry) -> None:
    order = Order.of_document(entry["order"])
    if order.update_id == 0:
        own.orders[order.order_id] = SentOrder(entry["offset"])
        own.order_count, own.order_jobs = own.order_count + 1, 0
        own.token = None
        stands_at = entry.get("stands_at")
        if own.cancel is not None:  # a new order drops a cancel under way: it is asked anew
            own.cancel = Cancel(stands_at=stands_at)
    sent = own.orders[order.order_id]
    end = sent.offset + order.nodes[-1].sequence_id // 2
    sent.ends[order.update_id], sent.updates = end, sent.updates + 1
    own.message, own.is_acknowledged = order, False
    own.released = max(own.released, end)
    own.order_jobs += len(entry["actions"])
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
    own.jobs_done += entry["job"] not in own.finished
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


def _place(own: RobotLedger, entry: Entry) -> None:
    """Have a robot begin at a visit that no order has; orders of before prove nothing."""
    own.arrived = own.released = entry["visit"]
    own.message, own.is_acknowledged, own.first_order = None, False, own.order_count
    own.token = own.cancel = own.fault = own.strays_at = None
    own.is_off = False
    for job in own.failed:
        own.attempts[job] += 1
    own.failed.clear()


def _retry(own: RobotLedger, entry: Entry) -> None:
    own.attempts[entry["job"]] += 1
    own.failed.discard(entry["job"])


def _skip(own: RobotLedger, entry: Entry) -> None:
    own.finished.add(entry["job"])
    own.failed.discard(entry["job"])


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
    "placed": _place,
    "again": _retry,
    "skipped": _skip,
}
