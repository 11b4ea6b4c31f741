"""Fleet control: releases the routes of a plan to robots by right of way, and keeps a journal.

States of robots come in, orders and instant actions go out; both may be lost, doubled or late. What
a state proves is committed to the journal, then what is released because of it is committed, then
it is sent. No clock is read: a timer only calls `remind`, which sends again what was not answered.

Started again on its journal, a control goes on where it was: it sends again, word for word, what
was not acknowledged. A robot that has it discards it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence

from rightofway.control.journal import Entry, Journal
from rightofway.control.ledger import Ledger, RobotLedger, RouteToDrive, plan_entry
from rightofway.control.messages import (
    Condition,
    InstantAction,
    Message,
    Order,
    OrderNode,
    RobotState,
)
from rightofway.errors import InputError, escape_text
from rightofway.phrases import Phrase
from rightofway.precedence import Arrival, Part, ReleaseGraph

LOOK_AHEAD = 4
"""Released parts that a robot has not reached yet, at most: re-planning keeps the rest free."""

LONG_ORDER = 50
"""Jobs after which a robot gets a new order: its states list all that it has done in this one."""

SNAPSHOT_EVERY = 5_000
"""Entries after which the journal gets a snapshot, so that a start need not read those before."""


class FleetControl:
    """The control of a fleet, without a network.

    Parameters
    ----------
    journal
        Empty, or of an earlier start; `begin` gives an empty one its plan.
    look_ahead
        How many parts are released beyond the vertex last arrived at, at most.
    snapshot_every
        Entries after which the journal gets a snapshot, with the next splice.
    long_order
        Jobs after which a robot gets a new order where it stands at the end of its base.
    report
        Receives a robot and a sentence on its fault, or on a job that failed.

    Attributes
    ----------
    ledger
        What the journal says.
    conditions
        How robots are, by their last states since the start. Conditions are not kept: they hold
        releases back, and never let one go.
    places
        The last place of each robot, by its last state since the start.
    lost
        Robots that no message reaches.
    refused
        Robots that the plan does not fit.
    dispatch
        Is called after whatever comes in, and returns what is to be sent because there is more to
        do; a dispatcher sets it.
    """

    def __init__(
        self,
        journal: Journal,
        *,
        look_ahead: int = LOOK_AHEAD,
        snapshot_every: int = SNAPSHOT_EVERY,
        long_order: int = LONG_ORDER,
        report: Callable[[int, str], None] = lambda *_: None,
    ) -> None:
        self._journal, self._look_ahead, self._report = journal, look_ahead, report
        self._snapshot_every, self._long_order = snapshot_every, long_order
        self.ledger = Ledger()
        self.conditions: dict[int, Condition] = {}
        self.places: dict[int, str] = {}
        self.lost, self.refused = set[int](), set[int]()
        self._reminded = set[int]()  # robots that were sent again what they have not answered
        self._just_sent = set[int]()  # robots that the next reminder leaves out
        self.dispatch: Callable[[], list[Message]] = list
        self._since_snapshot = 0
        for entry in journal.read_entries():
            self.ledger.apply(entry)
            self._since_snapshot += 1

    # --- what starts and changes the work --------------------------------------------------------

    def begin(
        self,
        run: str,
        routes: Sequence[RouteToDrive],
        graph: ReleaseGraph,
        names: Sequence[str] = (),
    ) -> None:
        """Give an empty journal its plan.

        Parameters
        ----------
        run
            A name that no other journal has; the ids of orders and actions begin with it.
        routes, graph
            The routes of all robots, and who waits for whom.
        names
            Of the robots; left out, reports give their numbers.

        Raises
        ------
        InputError
            If robots of the plan move round a circle at one instant.
        """
        names = tuple(names) or tuple(f"robot {number}" for number in range(len(routes)))
        _refuse_rotation(graph, names)
        entry = plan_entry("plan", run, routes, graph, committed=[0] * len(routes), names=names)
        self._commit(entry)

    def start(self) -> list[Message]:
        """Return what is to be sent after a start: all that is unanswered, requests for states."""
        self._commit({"kind": "started"})
        number, run = self.ledger.starts, self.ledger.run
        asks = [
            InstantAction(robot=k, action_id=f"{run}-{k}-start{number}", kind="stateRequest")
            for k in range(len(self.ledger.robots))
        ]
        return [*self._go_on(), *self.remind(), *asks]

    def splice(
        self,
        routes: Sequence[RouteToDrive],
        graph: ReleaseGraph,
        *,
        withdrawn: Collection[tuple[int, str]] = (),
        notes: Sequence[Entry] = (),
        placed: Collection[int] = (),
    ) -> list[Message]:
        """Replace all that is not released by other routes and rights of way.

        Parameters
        ----------
        routes
            Routes that begin with all that is released, sent or not, acknowledged or not. Visits
            before the one that a robot has last arrived at may be left out.
        graph
            Who waits for whom on them; parts that are released are no longer looked at.
        withdrawn
            Robot and name of jobs that nobody wants any more.
        notes
            Entries that are committed together with the splice.
        placed
            Robots off the floor that were put at the begin of their routes; the first visit has a
            number that no order of before has.

        Raises
        ------
        InputError
            If a route changes what is released, a job is lost, or robots move round a circle.
        """
        robots, names = self.ledger.robots, self.ledger.names
        committed = self.list_committed()
        _refuse_rotation(graph, names)
        for robot, (own, new, end) in enumerate(zip(robots, routes, committed, strict=True)):
            old, begin = own.route, max(own.route.first, new.first)
            if robot in placed:
                committed[robot] = begin
                keeps_released = own.is_off and begin == old.end
            else:
                keeps_released = begin <= own.arrived and all(
                    (old.get_place(visit), old.get_jobs(visit))
                    == (new.get_place(visit), new.get_jobs(visit))
                    for visit in range(begin, end + 1)
                )
            if not keeps_released:
                message = "the route changes what is released (begin it with the released parts)"
                raise InputError.at(("routes", robot), message)
            unwanted = {job for other, job in withdrawn if other == robot}
            if lost := sorted(old.all_jobs - own.finished - new.all_jobs - unwanted):
                raise InputError.at(("routes", robot), f"{lost[0]} is in no visit (keep each job)")
        entry = plan_entry("splice", self.ledger.run, routes, graph, committed=committed)
        begins = [{"kind": "placed", "robot": k, "visit": routes[k].first} for k in placed]
        self._commit(*begins, {**entry, "withdrawn": [list(job) for job in withdrawn]}, *notes)
        if self._since_snapshot >= self._snapshot_every:
            self._journal.begin_again(self.ledger.make_snapshot())
            self._since_snapshot = 0
        return self._go_on()

    def cancel(self, robot: int) -> list[Message]:
        """Take back what is released to a robot, as far as it can stop before.

        Parameters
        ----------
        robot
            A robot of the plan.
        """
        self._commit({"kind": "cancel wanted", "robot": robot})
        return self._go_on()

    def note(self, *entries: Entry) -> list[Message]:
        """Commit what a dispatcher has to remember.

        Parameters
        ----------
        entries
            For the ledger.
        """
        self._commit(*entries)
        return self._go_on()

    def hold(self, robot: int, *, on: bool) -> list[Message]:
        """Release nothing more to a robot until it is let go.

        Parameters
        ----------
        robot
            A robot of the plan.
        on
            Whether it is on hold from now on.
        """
        self._commit({"kind": "hold", "robot": robot, "on": on})
        return self._go_on()

    def clear(self, robot: int) -> list[Message]:
        """Have a person confirm that a faulty robot is where the journal has it.

        Parameters
        ----------
        robot
            A robot of the plan.
        """
        self._commit({"kind": "cleared", "robot": robot})
        return self._go_on()

    def take_off(self, robot: int) -> list[Message]:
        """Have a person confirm that a robot is off the floor: it holds nothing any more.

        Parameters
        ----------
        robot
            A robot of the plan.
        """
        self._commit({"kind": "taken off", "robot": robot})
        return self._go_on()

    @property
    def is_done(self) -> bool:
        """Whether each robot that is on the floor has come to the end of its route."""
        return all(own.is_off or own.is_done for own in self.ledger.robots)

    def is_fit(self, robot: int) -> bool:
        """Return whether nothing that is known of a robot's condition holds a release back.

        Parameters
        ----------
        robot
            A robot of the plan.
        """
        if robot in self.lost or robot in self.refused:
            return False
        condition = self.conditions.get(robot)
        return condition is None or condition.is_fit

    def list_stuck(self) -> list[int]:
        """Return the robots on the floor that do not go on for now."""
        return [
            robot
            for robot, own in enumerate(self.ledger.robots)
            if not own.is_off
            and (own.is_on_hold or own.fault is not None or own.failed or not self.is_fit(robot))
        ]

    # --- what comes in ---------------------------------------------------------------------------

    def receive(self, robot: int, state: RobotState) -> list[Message]:
        """Take in a state; return what is to be sent because of it.

        Parameters
        ----------
        robot
            The robot that sent it.
        state
            Its state.
        """
        self.conditions[robot], self.places[robot] = state.condition, state.last_place
        self.lost.discard(robot)
        own, graph = self.ledger.robots[robot], self.ledger.graph
        before = own.arrived
        self._commit(*self._facts(robot, state))
        answers = list(self._answers(robot, state))
        self._commit(*answers)
        # At once: by the timer alone, a robot that says often that it has no order, because the
        # next one is not sent yet, could be asked without end.
        sends = list[Message]()
        if any(entry["kind"] in {"doubt", "order"} for entry in answers):
            self._reminded.discard(robot)
            self._just_sent.add(robot)
            sends += self._open(robot)
        # Nobody else can go on because of a state than those that wait for what it proves.
        let_go = (Arrival(robot, visit) for visit in range(before + 1, own.arrived + 1))
        others = {part.robot for arrival in let_go for part in graph.list_waiting_for(arrival)}
        return [*sends, *self._go_on(sorted({robot, *others})), *self.dispatch()]

    def connect(self, robot: int, *, is_connected: bool) -> list[Message]:
        """Note whether messages reach a robot. A robot that is lost keeps what it holds.

        Parameters
        ----------
        robot
            A robot of the plan.
        is_connected
            Whether they do; each of its states says so, too.
        """
        if is_connected:
            self.lost.discard(robot)
        else:
            self.lost.add(robot)
        return self._go_on()

    def refuse(self, robot: int) -> None:
        """Release nothing more to a robot that the plan does not fit, as long as we run.

        Parameters
        ----------
        robot
            A robot of the plan.
        """
        self.refused.add(robot)

    def remind(self) -> list[Message]:
        """Return again what robots have not answered; call it every few seconds."""
        robots = [k for k in range(len(self.ledger.robots)) if k not in self._just_sent]
        messages = [message for robot in robots for message in self._open(robot)]
        self._reminded |= {message.robot for message in messages}
        self._just_sent.clear()
        return [*messages, *self.dispatch()]

    def _open(self, robot: int) -> Iterator[Message]:
        own = self.ledger.robots[robot]
        if own.is_off:
            return
        if own.token is not None:
            yield InstantAction(robot=robot, action_id=own.token, kind="stateRequest")
        elif own.message is not None and not own.is_acknowledged:
            yield own.message
        elif own.cancel is not None and own.cancel.action_id is not None:
            yield InstantAction(robot=robot, action_id=own.cancel.action_id, kind="cancelOrder")

    # --- what a state proves (rule 7) ------------------------------------------------------------

    def _facts(self, robot: int, state: RobotState) -> Iterator[Entry]:
        """Yield what a state proves: finished jobs, an arrival, faults."""
        own = self.ledger.robots[robot]
        for action_id, status in state.actions.items():
            job = own.jobs_of.get(action_id)
            if job is None or job in own.finished:
                continue
            if status == "FINISHED":
                yield {"kind": "finished", "robot": robot, "job": job}
            elif (
                status == "FAILED"
                and state.order_id == own.order_id
                and self._is_failure(own, action_id, job)
            ):
                self._report(robot, Phrase("has failed in {job}: it goes no further", job=job))
                yield {"kind": "failed", "robot": robot, "job": job}
        visit = self._proven(own, state)
        if visit is not None and visit > own.arrived:
            yield {"kind": "arrived", "robot": robot, "visit": visit}
        fault = None if own.fault else self._fault(robot, state)
        if fault is not None:
            yield self._fault_entry(robot, fault, state)

    def _fault_entry(self, robot: int, fault: str, state: RobotState) -> Entry:
        """Report a fault; return its entry."""
        sentence = Phrase("is faulty: {fault}; a person has to look after it", fault=fault)
        self._report(robot, sentence)
        place = state.last_place or None
        return {"kind": "fault", "robot": robot, "fault": fault, "place": place}

    @staticmethod
    def _is_failure(own: RobotLedger, action_id: str, job: str) -> bool:
        """Return whether the last action for a job failed by itself, not by our withdrawal."""
        is_last = action_id.endswith(f"-{own.attempts[job]}")
        return is_last and job not in own.failed and own.cancel is None

    def _proven(self, own: RobotLedger, state: RobotState) -> int | None:
        """Return the visit at whose vertex a state proves that the robot has arrived."""
        sent = own.orders.get(state.order_id)
        if sent is None or state.last_sequence_id % 2:
            return None
        end = sent.ends.get(state.update_id)
        if end is None:  # never sent, or so old that it proves nothing new
            return None
        begin = max(sent.offset, own.route.first)
        visit = sent.offset + state.last_sequence_id // 2
        if not begin <= visit <= min(end, own.released):
            return None
        if own.route.get_place(visit) != state.last_place:
            return None
        if not state.nodes:
            # A state from before the update, after a withdrawal or a reset has no nodes either.
            return visit if visit == end else None
        ahead = [sent.offset + (number + 1) // 2 for number in (*state.nodes, *state.edges)]
        visit = min(visit, min(ahead) - 1)
        return visit if visit >= begin else None

    def _fault(self, robot: int, state: RobotState) -> str | None:
        """Return how a state contradicts all that was sent (rule 11)."""
        own = self.ledger.robots[robot]
        sent = own.orders.get(state.order_id)
        if sent is None:
            return self._fault_of_order(robot, own, state)
        if state.update_id >= sent.updates:
            return Phrase(
                "it has update {update} of an order with {updates}",
                update=str(state.update_id),
                updates=str(sent.updates),
            )
        visit = sent.offset + state.last_sequence_id // 2
        if state.update_id not in sent.ends or visit < own.route.first:
            return None  # of long ago: where it was is not kept
        end = max(sent.ends.values())
        base = range(sent.offset, end + 1)
        beyond = [number for number in state.nodes if sent.offset + number // 2 not in base]
        if beyond:
            return Phrase("it drives to node {node}, which was not released", node=str(beyond[0]))
        places = own.route.stretch(sent.offset, end + 1)
        if state.order_id == own.order_id and state.last_place not in {*places, ""}:
            return Phrase("it is at {place}, off its way", place=escape_text(state.last_place[:80]))
        return None

    def _fault_of_order(self, robot: int, own: RobotLedger, state: RobotState) -> str | None:
        """Return what is wrong with an order that is not kept."""
        if not state.order_id:
            return None
        if not self.ledger.owns(robot, state.order_id):
            order = escape_text(state.order_id[:80])
            return Phrase("it has order {order}, which is not ours", order=order)
        number = int(state.order_id.rpartition("-")[2])
        if number < own.first_order and state.nodes:
            return Phrase("it still has an order from before it was placed")
        return None

    # --- what follows for its orders (rules 6, 8, 9) ---------------------------------------------

    def _answers(self, robot: int, state: RobotState) -> Iterator[Entry]:
        """Yield acknowledgements, doubts and their ends, and steps of a withdrawal."""
        own = self.ledger.robots[robot]
        if own.message is None or own.is_off:
            return
        if state.order_id == own.order_id and self._is_taken_back(robot, state):
            yield from self._settle_doubt(robot, state)
        elif state.order_id == own.order_id:
            if own.token in state.actions:
                yield {"kind": "certain", "robot": robot}
            stands_at = own.find_held(state.last_place)
            if not own.is_acknowledged and self._acknowledges(own, state):
                yield {"kind": "acknowledged", "robot": robot}
            elif self._has_stopped(own, state) and stands_at is not None:
                order = self._new_order(robot, stands_at, stands_at)
                yield {**order, "stands_at": stands_at}
        elif not state.order_id or self.ledger.owns(robot, state.order_id):
            yield from self._settle_doubt(robot, state)

    def _settle_doubt(self, robot: int, state: RobotState) -> Iterator[Entry]:
        """Yield a new doubt, or a new order where the robot answers that it has lost its own."""
        own = self.ledger.robots[robot]
        assert own.message is not None
        if own.token is None:
            is_on_its_way = own.message.update_id == 0 and not own.is_acknowledged
            if is_on_its_way and robot not in self._reminded:
                return  # the state may be from before
            token = f"{self.ledger.run}-{robot}-doubt{own.tokens}"
            yield {"kind": "doubt", "robot": robot, "token": token}
        elif own.token in state.actions and state.is_idle:
            stands_at = own.find_held(state.last_place)
            if stands_at is not None:
                yield self._new_order(robot, stands_at, own.released)
            elif own.fault is None:
                place = escape_text(state.last_place[:80])
                fault = Phrase("it stands at {place}, which it does not hold", place=place)
                yield self._fault_entry(robot, fault, state)

    def _is_taken_back(self, robot: int, state: RobotState) -> bool:
        """Return whether an old withdrawal, which has come late, took the current order back.

        The robot takes no update of it any more. Its answer to a token says where it stands.
        """
        own, start = self.ledger.robots[robot], f"{self.ledger.run}-{robot}-cancel"
        current = own.cancel.action_id if own.cancel else None
        return any(
            status == "FINISHED" and action.startswith(start) and action != current
            for action, status in state.actions.items()
        )

    @staticmethod
    def _acknowledges(own: RobotLedger, state: RobotState) -> bool:
        """Return whether a state shows the last order or update, to its last node."""
        assert own.message is not None
        last = own.message.nodes[-1].sequence_id
        is_known = last in state.nodes or last == state.last_sequence_id
        return state.update_id == own.message.update_id and is_known

    @staticmethod
    def _has_stopped(own: RobotLedger, state: RobotState) -> bool:
        """Return whether a robot has carried out our withdrawal, or had nothing to withdraw."""
        if own.cancel is None or own.cancel.action_id is None or own.token is not None:
            return False
        status = state.actions.get(own.cancel.action_id)
        return status in {"FINISHED", "FAILED"} and state.is_idle and own.is_acknowledged

    def _new_order(self, robot: int, begin: int, end: int) -> Entry:
        """Return the entry of a new order over some parts."""
        own = self.ledger.robots[robot]
        order_id = f"{self.ledger.run}-{robot}-{own.order_count}"
        parts = range(begin, end + 1)
        nodes, actions = self._nodes(robot, parts, begin)
        order = Order(robot=robot, order_id=order_id, update_id=0, nodes=tuple(nodes))
        return _order_entry(order, begin, actions)

    def _update(self, robot: int, end: int) -> Entry:
        """Return the entry of an update to a last part; it begins with the last node of the base.

        That node is sent again word for word; its actions are done once.
        """
        own = self.ledger.robots[robot]
        assert own.message is not None
        sent = own.orders[own.order_id]
        parts = range(own.released + 1, end + 1)
        nodes, actions = self._nodes(robot, parts, sent.offset)
        order = Order(
            robot=robot,
            order_id=own.order_id,
            update_id=sent.updates,
            nodes=(own.message.nodes[-1], *nodes),
        )
        return _order_entry(order, sent.offset, actions)

    def _nodes(
        self, robot: int, parts: range, offset: int
    ) -> tuple[list[OrderNode], list[tuple[str, str, int]]]:
        """Return the nodes of parts, and the id, job and number of their actions.

        The action of a job keeps its id in all orders, so that it is not done twice: a state that
        says that it is finished may have been lost.
        """
        own, actions, nodes = self.ledger.robots[robot], [], []
        for part in parts:
            ids = list[str]()
            for job in own.route.get_jobs(part):
                if job in own.finished or job in own.failed:  # a person decides on failed ones
                    continue
                last = own.attempts.get(job, 0)
                attempt = max(last, 1)
                ids.append(f"{self.ledger.run}-{robot}-{job}-{attempt}")
                actions.append((ids[-1], job, attempt))
            place, number = own.route.get_place(part), 2 * (part - offset)
            nodes.append(OrderNode(place=place, sequence_id=number, actions=tuple(ids)))
        return nodes, actions

    # --- what may be released (rules 4 and 5) ----------------------------------------------------

    def _go_on(self, robots: Iterable[int] | None = None) -> list[Message]:
        """Release what may be released to robots, by default to all; return what is to be sent."""
        sends: list[Message] = []
        for robot in range(len(self.ledger.robots)) if robots is None else robots:
            entry = self._next(robot, self.ledger.robots[robot])
            if entry is not None:
                self._commit(entry)
                sends += self._open(robot)
        return sends

    def _next(self, robot: int, own: RobotLedger) -> Entry | None:
        """Return the next step of a robot: its first order, a withdrawal, or an update."""
        if own.is_off or own.token is not None:
            return None
        if own.message is None:
            return self._new_order(robot, own.arrived, own.arrived)
        if not own.is_acknowledged:
            return None
        if own.cancel is None:
            return self._next_release(robot, own)
        if own.cancel.action_id is None:
            action_id = f"{self.ledger.run}-{robot}-cancel{own.cancels}"
            return {"kind": "cancel asked", "robot": robot, "action": action_id}
        return None

    def _next_release(self, robot: int, own: RobotLedger) -> Entry | None:
        """Return an update with all that may be released now, if there is any."""
        end = own.released
        while self._may_release(robot, own, end + 1):
            end += 1
        if end == own.released:
            return None
        # All that was released to it is driven and acknowledged, so it stands without an order.
        if own.order_jobs >= self._long_order and own.arrived == own.released:
            return self._new_order(robot, own.released, end)
        return self._update(robot, end)

    def _may_release(self, robot: int, own: RobotLedger, part: int) -> bool:
        """Return whether a part may be released after those before it (rule 4)."""
        route = own.route
        return (
            part < route.end
            and not own.is_on_hold
            and own.fault is None
            and self.is_fit(robot)
            and part - own.arrived <= self._ahead(robot)
            and own.finished.issuperset(route.get_jobs(part - 1))
            and not self._is_in_base(own, part)
            and not self._is_closed(route.get_place(part - 1), route.get_place(part))
            and not self._is_strayed_to(route.get_place(part))
            and self.ledger.graph.may_go(Part(robot, part), self.ledger.arrived)
        )

    @staticmethod
    def _is_in_base(own: RobotLedger, part: int) -> bool:
        """Return whether a robot holds the vertex of a part already, by an earlier part.

        A robot that forgot its order would take an update again whose way ends where it began, and
        drive it twice.
        """
        return own.route.get_place(part) in own.route.stretch(own.arrived, part)

    def _is_closed(self, tail: str, head: str) -> bool:
        """Return whether nobody may enter an edge."""
        return any((tail, head) in edges for edges in self.ledger.closed.values())

    def _is_strayed_to(self, place: str) -> bool:
        """Return whether a faulty robot says that it is at a place."""
        return any(other.strays_at == place for other in self.ledger.robots)

    def _ahead(self, robot: int) -> int:
        """Return how far ahead a robot may be released: twice as far if it asks for more."""
        condition = self.conditions.get(robot)
        return self._look_ahead * (2 if condition and condition.wants_more else 1)

    def list_committed(self) -> list[int]:
        """Return the last part of each robot that a splice has to keep."""
        return [self._committed(own) for own in self.ledger.robots]

    def _committed(self, own: RobotLedger) -> int:
        """Return the last part that a splice has to keep."""
        return own.released

    def _commit(self, *entries: Entry) -> None:
        """Write entries to the disk, then take them in."""
        if entries:
            self._journal.commit(entries)
            self._since_snapshot += len(entries)
            for entry in entries:
                self.ledger.apply(entry)


def _order_entry(order: Order, offset: int, actions: list[tuple[str, str, int]]) -> Entry:
    """Return the entry of an order whose sequence id 0 is a part of the route."""
    document = order.to_document()
    return {
        "kind": "order",
        "robot": order.robot,
        "order": document,
        "offset": offset,
        "actions": actions,
    }


def _refuse_rotation(graph: ReleaseGraph, names: Sequence[str]) -> None:
    if cycle := graph.find_rotation():
        robots = ", ".join(names[robot] for robot in sorted({part.robot for part in cycle}))
        message = f"{robots} move round a circle at one instant, which orders cannot make safe"
        raise InputError.at("plan", f"{message} (plan with rotations: false)")
