"""The state of one robot by a journal: its place, the parts it holds, its orders and jobs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from rightofway.control.journal import Entry
from rightofway.control.messages import Order
from rightofway.control.routes import RouteToDrive
from rightofway.control.stop_actions import split_action
from rightofway.control.work_items import find_next_number

__all__ = ["APPLY_TO_ROBOT", "RobotLedger", "SentOrder"]


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


@dataclass(frozen=True, slots=True)
class Pause:
    """A pause that a person has asked for.

    Attributes
    ----------
    is_on
        Whether the robot is to pause; else it is to end its pause.
    action_id
        The id of the instant action.
    """

    is_on: bool
    action_id: str


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
    pause: Pause | None = None  # that a person wants to begin or end
    pauses: int = 0
    fault: Entry | None = None  # as a fact has it
    strays_at: str | None = None  # the place that a faulty robot names
    is_off: bool = False  # taken off the floor
    jobs_of: dict[str, str] = field(default_factory=dict)  # action id: job
    attempts: dict[str, int] = field(default_factory=dict)  # job: number of its last action
    finished: set[str] = field(default_factory=set)  # jobs of the route, skipped ones too
    failed: set[str] = field(default_factory=set)
    tasks: dict[str, Any] = field(default_factory=dict)  # what unusual actions are to do, by id
    steps_done: dict[str, list[int]] = field(default_factory=dict)  # of jobs of several actions
    next_job: int = 0  # the number of the next new job: no name comes twice
    jobs_done: int = 0  # items of work of all
    whole_jobs: int = 0  # of the pool that it has ended
    laps_done: int = 0
    waits: int = 0  # for others at the end of its released parts, as `Story` counts them

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

    def find_next_item(self) -> str | None:
        """Return the next work of a robot at the end of its released parts."""
        if self.arrived < self.released:
            return None
        items = self.route.get_jobs(self.arrived)
        return next((item for item in items if item not in self.finished), None)

    def is_sent(self, item: str) -> bool:
        """Return whether an order had the work of an item; that of a withdrawn job has none."""
        return self.attempts.get(item, 0) > 0

    def count_steps(self, item: str) -> int:
        """Return the number of actions of an item that an order had."""
        return len({split_action(action)[1] for action, job in self.jobs_of.items() if job == item})

    def is_asked_for(self, item: str) -> bool:
        """Return whether the last node of the last order has the work of an item, or it failed."""
        actions = self.message.nodes[-1].actions if self.message else ()
        return item in self.failed or any(self.jobs_of.get(action) == item for action in actions)

    def count_laps(self) -> int:
        """Return the number of its laps until now, or until the end of its route."""
        return self.laps_done + sum(end > self.arrived for end in self.route.lap_ends)

    def find_held(self, place: str) -> int | None:
        """Return the held part whose vertex is a place, None if there is none."""
        held = self.held
        return self.arrived + held.index(place) if place in held else None

    def take_route(self, route: RouteToDrive) -> None:
        """Continue along another route; drop the jobs and orders before it.

        A lap of which nothing is left to drive is over.

        Parameters
        ----------
        route
            The released parts and those after them.
        """
        self.laps_done += route.lap_ends.count(self.arrived) - self.route.lap_ends.count(
            self.arrived
        )
        self.route, jobs = route, route.all_jobs
        self.next_job = max(self.next_job, find_next_number(jobs))
        # Jobs and orders that no visit names any more are dropped, so that laps without end need no
        # more memory.
        self.finished &= jobs
        self.failed &= jobs
        self.attempts = {job: number for job, number in self.attempts.items() if job in jobs}
        self.jobs_of = {action: job for action, job in self.jobs_of.items() if job in jobs}
        self.tasks = {action: task for action, task in self.tasks.items() if action in self.jobs_of}
        self.steps_done = {job: done for job, done in self.steps_done.items() if job in jobs}
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
        """Return the entry of a journal.

        Parameters
        ----------
        document
            The result of `to_document`.
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
                "pause": Pause(**document["pause"]) if document["pause"] else None,
                "finished": set(document["finished"]),
                "failed": set(document["failed"]),
            }
        )


def _record_arrival(own: RobotLedger, entry: Entry) -> None:
    before, own.arrived = own.arrived, max(own.arrived, entry["visit"])
    own.laps_done += sum(before < visit <= own.arrived for visit in own.route.lap_ends)


def _order(own: RobotLedger, entry: Entry) -> None:
    order = Order.of_document(entry["order"])
    if order.update_id == 0:
        own.orders[order.order_id] = SentOrder(entry["offset"])
        own.order_count, own.order_jobs = own.order_count + 1, 0
        own.token = None
        stands_at = entry.get("stands_at")
        if own.cancel is not None:  # a new order drops a cancel under way: it is asked for again
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
    own.tasks |= entry.get("tasks", {})


def _record_acknowledgement(own: RobotLedger, _: Entry) -> None:
    own.is_acknowledged = True
    # Rule 9: only now does the robot give up the parts after the node where it stopped.
    if own.cancel is not None and own.cancel.stands_at is not None:
        own.released, own.cancel = own.cancel.stands_at, None


def _record_doubt(own: RobotLedger, entry: Entry) -> None:
    own.token, own.tokens = entry["token"], own.tokens + 1


def _end_doubt(own: RobotLedger, _: Entry) -> None:
    own.token = None


def _record_cancel(own: RobotLedger, _: Entry) -> None:
    own.cancel = own.cancel or Cancel()


def _ask_cancel(own: RobotLedger, entry: Entry) -> None:
    own.cancel, own.cancels = Cancel(action_id=entry["action"]), own.cancels + 1


def _finish(own: RobotLedger, entry: Entry) -> None:
    own.jobs_done += entry["job"] not in own.finished
    own.finished.add(entry["job"])
    own.failed.discard(entry["job"])


def _finish_action(own: RobotLedger, entry: Entry) -> None:
    done = own.steps_done.setdefault(entry["job"], [])
    if entry["step"] not in done:
        done.append(entry["step"])


def _fail(own: RobotLedger, entry: Entry) -> None:
    own.failed.add(entry["job"])


def _find_fault(own: RobotLedger, entry: Entry) -> None:
    own.fault, own.strays_at = entry["fault"], entry["place"]


def _clear(own: RobotLedger, _: Entry) -> None:
    own.fault = own.strays_at = None


def _hold(own: RobotLedger, entry: Entry) -> None:
    own.is_on_hold = entry["on"]


def _want_pause(own: RobotLedger, entry: Entry) -> None:
    own.pause, own.pauses = Pause(entry["on"], entry["action"]), own.pauses + 1


def _end_pause(own: RobotLedger, _: Entry) -> None:
    own.pause = None


def _take_off(own: RobotLedger, _: Entry) -> None:
    own.is_off = True


def _place(own: RobotLedger, entry: Entry) -> None:
    """Have a robot begin at a visit that no order has; orders of before prove nothing."""
    # A person has placed it: states under earlier orders prove nothing any more.
    own.arrived = own.released = entry["visit"]
    own.message, own.is_acknowledged, own.first_order = None, False, own.order_count
    own.token = own.cancel = own.fault = own.strays_at = None
    own.is_off = False
    for job in own.failed:
        # A new id for each attempt, so that a late FAILED of the one before is not taken for it.
        own.attempts[job] += 1
    own.failed.clear()


def _record_retry(own: RobotLedger, entry: Entry) -> None:
    own.attempts[entry["job"]] += 1
    own.failed.discard(entry["job"])
    if own.cancel is not None and own.cancel.stands_at is not None:
        own.cancel = Cancel()  # the order that is on its way was made without the job


def _skip(own: RobotLedger, entry: Entry) -> None:
    own.finished.add(entry["job"])
    own.failed.discard(entry["job"])


APPLY_TO_ROBOT: Mapping[str, Callable[[RobotLedger, Entry], None]] = {
    "arrived": _record_arrival,
    "order": _order,
    "acknowledged": _record_acknowledgement,
    "doubt": _record_doubt,
    "certain": _end_doubt,
    "cancel wanted": _record_cancel,
    "cancel asked": _ask_cancel,
    "finished": _finish,
    "action finished": _finish_action,
    "failed": _fail,
    "fault": _find_fault,
    "cleared": _clear,
    "hold": _hold,
    "pause wanted": _want_pause,
    "pause over": _end_pause,
    "taken off": _take_off,
    "placed": _place,
    "again": _record_retry,
    "skipped": _skip,
}
"""How a robot changes by each kind of entry on it."""
