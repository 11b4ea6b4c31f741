"""Fleet control: releases the routes of a plan to robots by right of way, and keeps a journal.

States of robots come in, orders and instant actions go out; both may be lost, doubled or late.
Facts that a state proves are committed to the journal, then the release that follows is committed,
then it is sent. No clock is read: a timer only calls `remind`, which sends unanswered messages
again.

Started again on its journal, a control continues: it sends again, word for word, each message that
was not acknowledged. A robot that has it discards it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from fractions import Fraction
from typing import Literal

from rightofway.control.journal import Entry, Journal, JournalFailed
from rightofway.control.ledger import Ledger, make_plan_entry
from rightofway.control.messages import LOOK_AHEAD, Condition, InstantAction, Message, StateReport
from rightofway.control.orders import MayBegin, make_order, make_update
from rightofway.control.proofs import (
    find_proven_visit,
    has_stopped,
    is_acknowledged_by,
    is_taken_back,
    list_facts,
    make_stray,
    take_fault,
)
from rightofway.control.releases import find_last_part, is_in_base
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import RouteToDrive
from rightofway.control.splices import refuse_changes, refuse_rotation, refuse_ways
from rightofway.control.stop_actions import USUAL, ListActions
from rightofway.errors import describe_defect
from rightofway.facts import Fact
from rightofway.precedence import Arrival, ReleaseGraph
from rightofway.site import Roadmap


class LedgerFailed(Exception):
    """An entry on the disk could not be applied: the parts that robots hold are unknown."""


UNSOUND = (JournalFailed, LedgerFailed)
"""Exceptions after which nothing may be sent; the guards of what comes in let them pass."""

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
        The largest number of parts that are released beyond the vertex last arrived at.
    snapshot_every
        Entries after which the journal gets a snapshot, with the next splice.
    long_order
        Jobs after which a robot gets a new order where it stands at the end of its base.
    report
        Receives a robot and a fact: its fault, or a job that failed.
    roadmap
        The map of the jobs; None where the plan has none.

    Attributes
    ----------
    ledger
        The state that the journal describes.
    conditions
        How robots are, by their last states since the start. Conditions are not kept: they hold
        releases back, and never let one go.
    places
        The last place of each robot, by its last state since the start.
    points
        The position that each robot has reported last [m].
    lost
        Robots that no message reaches.
    refused
        Robots that the plan does not fit.
    dispatch
        Called after each message, returns the messages to send because there is more to
        do; a dispatcher sets it.
    may_drive
        Tells of each robot whether it may drive from a vertex to another one, by their names; a
        dispatcher with the map sets it.
    may_enter
        Tells of a robot whether a part of its route may be released, if all before it is; a
        dispatcher with the closures of the scenario sets it.
    may_stop
        Tells whether robots may stop at a vertex, by its name; a dispatcher sets it.
    may_begin
        Tells of a robot whether an item of its work may begin, see `rightofway.control.work_items`:
        robots drive to the places of work that may not begin, and wait there. A dispatcher sets it.
    list_actions
        Returns the actions of a robot for an item of its work. A dispatcher sets it.
    kept_parts
        The last part of each robot that is released while a round is under way; None: no round is.
    stranded
        Robots whose batteries are too low for the way to a charging place.
    charges
        The state of charge of each robot, by its last state since the start, from 0 to 1.
    headings
        The heading that each robot has reported last, as `RobotState.heading` [degrees].
    """

    def __init__(
        self,
        journal: Journal,
        *,
        look_ahead: int = LOOK_AHEAD,
        snapshot_every: int = SNAPSHOT_EVERY,
        long_order: int = LONG_ORDER,
        report: Callable[[int, Fact], None] = lambda *_: None,
        roadmap: Roadmap | None = None,
    ) -> None:
        self._journal, self._look_ahead, self._report = journal, look_ahead, report
        self._snapshot_every, self._long_order = snapshot_every, long_order
        self.ledger = Ledger(roadmap)
        self.conditions: dict[int, Condition] = {}
        self.places: dict[int, str] = {}
        self.points: dict[int, tuple[float, float]] = {}
        self.lost, self.refused, self.stranded = set[int](), set[int](), set[int]()
        self.can_pause = set[int]()
        self._reminded = set[int]()  # robots that were sent again what they have not answered
        self._just_sent = set[int]()  # robots that the next reminder leaves out
        self.dispatch: Callable[[], list[Message]] = list
        self.may_drive: Callable[[int, str, str], bool] = lambda *_: True
        self.may_enter: Callable[[int, int], bool] = lambda *_: True
        self.may_stop: Callable[[str], bool] = lambda _: True
        self.may_begin: MayBegin = lambda *_: True
        self.list_actions: ListActions = lambda *_: (USUAL,)
        self.charges: dict[int, float] = {}
        self.headings: dict[int, Fraction] = {}
        self.kept_parts: tuple[int, ...] | None = None
        self._since_snapshot = 0
        for number, entry in enumerate(journal.read_entries(), 1):
            self.ledger.read(number, entry)
            self._since_snapshot += 1

    # --- what starts and changes the work --------------------------------------------------------

    def begin(
        self,
        run: str,
        routes: Sequence[RouteToDrive],
        graph: ReleaseGraph,
        names: Sequence[str] = (),
        notes: Sequence[Entry] = (),
        *,
        began: float | None = None,
    ) -> None:
        """Give an empty journal its plan.

        Parameters
        ----------
        run
            A name that no other journal has; the ids of orders and actions begin with it.
        routes, graph
            The routes of all robots, and the arrivals that their parts wait for.
        names
            Of the robots; left out, reports give their numbers.
        notes
            Entries that are committed together with the plan.
        began
            When the run began, if not now [s since 1970].

        Raises
        ------
        InputError
            If robots of the plan move round a circle at one instant, or drive where they may not.
        """
        names = tuple(names) or tuple(f"robot {number}" for number in range(len(routes)))
        committed = [0] * len(routes)
        # Rule 1: the robots of a rotation would all wait for each other, so no release could begin.
        refuse_rotation(graph, names)
        refuse_ways(routes, committed, names, self.may_drive)
        entry = make_plan_entry("plan", run, routes, graph, committed=committed, names=names)
        since = {} if began is None else {"began": began}
        self.commit({**entry, **since}, *notes)

    def start(self) -> list[Message]:
        """Return the messages to send after a start: all unanswered ones, requests for states."""
        # Rule 12: messages without an answer go out again word for word, then robots are asked.
        self.commit({"kind": "started"})
        number, run = self.ledger.starts, self.ledger.run
        asks = [
            InstantAction(robot=k, action_id=f"{run}-{k}-start{number}", kind="stateRequest")
            for k in range(len(self.ledger.robots))
        ]
        return [*self._release(), *self.remind(), *asks]

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
            The arrivals that their parts wait for; parts that are released are no longer looked at.
        withdrawn
            Robot and name of withdrawn jobs.
        notes
            Entries that are committed together with the splice.
        placed
            Robots off the floor that were put at the begin of their routes; the first visit has a
            number that no order of before has.

        Raises
        ------
        InputError
            If a route changes a released part, a job is lost, robots move round a circle, or one
            drives where it may not.
        """
        robots, names = self.ledger.robots, self.ledger.names
        # Rule 10: the released parts, sent or not, acknowledged or not, stay as they are.
        committed = self.list_committed()
        refuse_rotation(graph, names)
        refuse_changes(robots, routes, committed, withdrawn, placed)
        for robot in placed:
            committed[robot] = max(robots[robot].route.first, routes[robot].first)
        refuse_ways(routes, committed, names, self.may_drive)
        entry = make_plan_entry("splice", self.ledger.run, routes, graph, committed=committed)
        begins = [{"kind": "placed", "robot": k, "visit": routes[k].first} for k in placed]
        self.kept_parts = None  # a round that is under way is of the old plan
        # One commit swaps the routes and the graph, so that a kill leaves the old or the new plan.
        self.commit(*begins, {**entry, "withdrawn": [list(job) for job in withdrawn]}, *notes)
        if self._since_snapshot >= self._snapshot_every:
            self._journal.begin_again(self.ledger.make_snapshot())
            self._since_snapshot = 0
        return self._release()

    def note(self, *entries: Entry) -> list[Message]:
        """Commit commands of people, or facts that a dispatcher has to remember, and continue.

        Parameters
        ----------
        entries
            For the ledger.
        """
        self.commit(*entries)
        return self._release()

    @property
    def is_done(self) -> bool:
        """Whether each robot on the floor is at the end of its route."""
        return all(own.is_off or own.is_done for own in self.ledger.robots)

    def is_fit(self, robot: int) -> bool:
        """Return whether nothing that is known of a robot's condition holds a release back.

        Parameters
        ----------
        robot
            A robot of the plan.
        """
        if robot in self.lost | self.refused | self.stranded:
            return False
        condition = self.conditions.get(robot)
        return condition is None or condition.is_fit

    def list_stuck(self) -> list[int]:
        """Return the robots on the floor that do not drive on for now."""
        return [
            robot
            for robot, own in enumerate(self.ledger.robots)
            if not own.is_off
            and (own.is_on_hold or own.fault is not None or own.failed or not self.is_fit(robot))
        ]

    # --- what comes in ---------------------------------------------------------------------------

    def receive(self, robot: int, state: StateReport) -> list[Message]:
        """Take in a state; return the messages to send because of it.

        Parameters
        ----------
        robot
            The robot that sent it.
        state
            Its state.
        """
        self.conditions[robot], self.places[robot] = state.condition, state.last_place
        if state.position is not None:
            self.points[robot] = state.position[:2]
        if state.charge is not None:
            self.charges[robot] = state.charge
        self.lost.discard(robot)
        own, graph = self.ledger.robots[robot], self.ledger.graph
        before = own.arrived
        visit = self._find_proven(own, state)
        # Facts are committed before anything is released because of them (rule 5).
        facts = list(list_facts(self.ledger, robot, state, visit, self._report))
        self.commit(*facts)
        answers = [*self._follow_state(robot, state), *self._follow_pause(robot, state)]
        self.commit(*answers)
        # At once: by the timer alone, a robot that says often that it has no order, because the
        # next one is not sent yet, could be asked without end.
        sends = list[Message]()
        if any(entry["kind"] in {"doubt", "order"} for entry in answers):
            self._reminded.discard(robot)
            self._just_sent.add(robot)
            sends += self._list_unanswered(robot)
        # Nobody else can go on because of a state than those that wait for what it proves.
        let_go = (Arrival(robot, visit) for visit in range(before + 1, own.arrived + 1))
        others = {part.robot for arrival in let_go for part in graph.list_waiting_for(arrival)}
        if any(fact["kind"] == "finished" for fact in facts):
            others.update(self._list_holding())  # jobs wait for others to end
        return [*sends, *self._release(sorted({robot, *others})), *self.dispatch()]

    def connect(self, robot: int, *, is_connected: bool) -> list[Message]:
        """Note whether messages reach a robot. A robot that is lost keeps the parts that it holds.

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
        return self._release()

    def refuse(self, robot: int) -> None:
        """Release nothing more to a robot that the plan does not fit, as long as we run.

        Parameters
        ----------
        robot
            A robot of the plan.
        """
        self.refused.add(robot)

    def remind(self) -> list[Message]:
        """Return unanswered messages again; call it every few seconds."""
        robots = [k for k in range(len(self.ledger.robots)) if k not in self._just_sent]
        messages = [message for robot in robots for message in self._list_unanswered(robot)]
        self._reminded |= {message.robot for message in messages}
        self._just_sent.clear()
        return [*messages, *self.dispatch()]

    def _list_unanswered(self, robot: int) -> Iterator[Message]:
        own = self.ledger.robots[robot]
        if own.is_off:
            return
        # One message at a time: a doubt goes first, then an update, then a withdrawal.
        if own.token is not None:
            yield InstantAction(robot=robot, action_id=own.token, kind="stateRequest")
        elif own.message is not None and not own.is_acknowledged:
            yield own.message
        elif own.cancel is not None and own.cancel.action_id is not None:
            yield InstantAction(robot=robot, action_id=own.cancel.action_id, kind="cancelOrder")
        # No release depends on a pause: it goes beside the others.
        yield from self.list_pauses(robot)

    def list_pauses(self, robot: int) -> Iterator[InstantAction]:
        """Yield the message that begins or ends a pause, until a state shows it."""
        own, condition = self.ledger.robots[robot], self.conditions.get(robot)
        if own.pause is None or robot not in self.can_pause:
            return
        is_paused = condition is not None and condition.is_paused
        if not own.pause.is_on or not is_paused:
            kind: Literal["startPause", "stopPause"]
            kind = "startPause" if own.pause.is_on else "stopPause"
            yield InstantAction(robot=robot, action_id=own.pause.action_id, kind=kind)

    def _follow_pause(self, robot: int, state: StateReport) -> Iterator[Entry]:
        """Yield the end of a pause, once the robot has answered and is not paused."""
        own = self.ledger.robots[robot]
        if own.pause is None or own.pause.is_on or state.condition.is_paused:
            return
        has_answered = state.actions.get(own.pause.action_id) in {"FINISHED", "FAILED"}
        if has_answered or robot not in self.can_pause:
            yield {"kind": "pause over", "robot": robot}

    # Some methods below are a call and no more: chaos has a wrong wording of the rule for each.

    def _find_proven(self, own: RobotLedger, state: StateReport) -> int | None:
        """Return the visit at whose vertex a state proves that the robot has arrived."""
        return find_proven_visit(own, state)

    # --- what follows for its orders (rules 6, 8, 9) ---------------------------------------------

    def _follow_state(self, robot: int, state: StateReport) -> Iterator[Entry]:
        """Yield acknowledgements, doubts and their ends, and steps of a withdrawal."""
        own = self.ledger.robots[robot]
        if own.message is None or own.is_off:
            return
        # A withdrawal of long ago has reached a newer order: nobody knows how far the robot will
        # drive.
        if state.order_id == own.order_id and is_taken_back(self.ledger, robot, state):
            yield from self._settle_doubt(robot, state)
        elif state.order_id == own.order_id:
            if own.token in state.actions:
                yield {"kind": "certain", "robot": robot}
            stands_at = own.find_held(state.last_place)
            if not own.is_acknowledged and is_acknowledged_by(own, state):
                yield {"kind": "acknowledged", "robot": robot}
            # Rule 9: it stands at a vertex that it holds. The parts after it become free only when
            # a state shows the new order of this one node.
            elif has_stopped(own, state) and stands_at is not None:
                order = self._make_order(robot, stands_at, stands_at)
                yield {**order, "stands_at": stands_at}
        # Rule 8: no order, or one that is no longer current.
        elif not state.order_id or self.ledger.owns(robot, state.order_id):
            yield from self._settle_doubt(robot, state)

    def _settle_doubt(self, robot: int, state: StateReport) -> Iterator[Entry]:
        """Yield a new doubt, or a new order where the robot answers that it has lost its own."""
        own = self.ledger.robots[robot]
        assert own.message is not None
        if own.token is None:
            is_on_its_way = own.message.update_id == 0 and not own.is_acknowledged
            if is_on_its_way and robot not in self._reminded:
                return  # the state may be from before
            # A fresh token tells answers to this question from states that are late.
            token = f"{self.ledger.run}-{robot}-doubt{own.tokens}"
            yield {"kind": "doubt", "robot": robot, "token": token}
        elif own.token in state.actions and state.is_idle:
            stands_at = own.find_held(state.last_place)
            if stands_at is not None:
                # Idle at a vertex that it holds: a new order from there with all its released
                # parts. This proves no arrival: only states under the new order do.
                yield self._make_order(robot, stands_at, own.released)
            elif own.fault is None:
                yield take_fault(robot, make_stray(state), state, self._report)

    def _make_order(self, robot: int, begin: int, end: int) -> Entry:
        """Return the entry of a new order over some parts."""
        return make_order(
            self.ledger, robot, begin, end, self._may_begin, list_actions=self.list_actions
        )

    def _make_update(self, robot: int, end: int) -> Entry:
        """Return the entry of an update to a last part."""
        return make_update(self.ledger, robot, end, self._may_begin, list_actions=self.list_actions)

    def _may_begin(self, robot: int, item: str) -> bool:
        """Return whether work may begin; none begins that a round may give to another robot."""
        own = self.ledger.robots[robot]
        if self.kept_parts is not None and item in own.route.get_jobs(self.kept_parts[robot]):
            return own.is_sent(item)
        return self.may_begin(robot, item)

    # --- what may be released (rules 4 and 5) ----------------------------------------------------

    def _release(self, robots: Iterable[int] | None = None) -> list[Message]:
        """Release all parts that may be released, by default to all robots; return the messages."""
        sends: list[Message] = []
        for robot in range(len(self.ledger.robots)) if robots is None else robots:
            entry = self._find_step(robot, self.ledger.robots[robot])
            if entry is not None:
                self.commit(entry)
                sends += self._list_unanswered(robot)
        return sends

    def _find_step(self, robot: int, own: RobotLedger) -> Entry | None:
        """Return the next step of a robot: its first order, a withdrawal, or an update."""
        if own.is_off or own.token is not None:
            return None
        # Rule 3: the first order is the first vertex alone.
        if own.message is None:
            return self._make_order(robot, own.arrived, own.arrived)
        # Rule 6: at most one update without an answer, else one lost message would refuse all later
        # ones.
        if not own.is_acknowledged:
            return None
        if own.cancel is None:
            return self._find_held_work(robot, own) or self._find_release(robot, own)
        if own.cancel.action_id is None:
            action_id = f"{self.ledger.run}-{robot}-cancel{own.cancels}"
            return {"kind": "cancel asked", "robot": robot, "action": action_id}
        return None

    def _list_holding(self) -> list[int]:
        """Return the robots that stand where work had to wait."""
        return [
            robot
            for robot, own in enumerate(self.ledger.robots)
            if (item := own.find_next_item()) is not None and not own.is_asked_for(item)
        ]

    def _find_held_work(self, robot: int, own: RobotLedger) -> Entry | None:
        """Return an order of the node where a robot stands, for work that had to wait there."""
        item = own.find_next_item()
        if item is None or own.is_on_hold or own.fault is not None or not self.is_fit(robot):
            return None
        if own.is_asked_for(item) or not self._may_begin(robot, item):
            return None
        return self._make_order(robot, own.released, own.released)

    def _find_release(self, robot: int, own: RobotLedger) -> Entry | None:
        """Return an update with all that may be released now, if there is any."""
        if not self.is_fit(robot):
            return None
        ahead = self._count_ahead(robot)
        end = find_last_part(
            self.ledger,
            robot,
            ahead,
            self._is_in_base,
            may_enter=self._may_enter,
            may_stop=self.may_stop,
        )
        if end == own.released:
            return None
        # All that was released to it is driven and acknowledged, so it stands without an order.
        if own.order_jobs >= self._long_order and own.arrived == own.released:
            return self._make_order(robot, own.released, end)
        return self._make_update(robot, end)

    def _may_enter(self, robot: int, part: int) -> bool:
        """Return whether nothing but other robots keeps a robot from a part."""
        is_kept = self.kept_parts is None or part <= self.kept_parts[robot]
        return is_kept and self.may_enter(robot, part)

    _is_in_base = staticmethod(is_in_base)

    def _count_ahead(self, robot: int) -> int:
        """Return how far ahead a robot may be released: twice as far if it asks for more."""
        condition = self.conditions.get(robot)
        return self._look_ahead * (2 if condition and condition.wants_more else 1)

    def list_committed(self) -> list[int]:
        """Return the last part of each robot that a splice has to keep."""
        return [self._find_committed(own) for own in self.ledger.robots]

    def _find_committed(self, own: RobotLedger) -> int:
        """Return the last part that a splice has to keep, where the robot may stop.

        A robot whose order was withdrawn may stand at a passed vertex. Its chain was
        released as a whole, so no other robot goes first there.
        """
        rest = range(own.released, own.route.end)
        places = map(own.route.get_place, rest)
        ends = (visit for visit, place in zip(rest, places, strict=True) if self.may_stop(place))
        return next(ends, own.released)

    def commit(self, *entries: Entry) -> None:
        """Write entries to the disk, then take them in; release nothing.

        Parameters
        ----------
        entries
            For the ledger.

        Raises
        ------
        JournalFailed
            If they could not be written: nothing has changed.
        LedgerFailed
            If they were written and could not be taken in: the control has to end.
        """
        if entries:
            self._journal.commit(entries)
            self._since_snapshot += len(entries)
            try:
                for entry in entries:
                    self.ledger.apply(entry)
            except Exception as error:
                # The entry is on the disk but not in memory: only a start on the journal can tell
                # what holds.
                raise LedgerFailed(describe_defect(error)) from error
