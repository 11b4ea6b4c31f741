"""Wordings of the rule of release that are wrong, each as a control with one step changed.

Chaos finds each of them: the runs would not be worth much otherwise.
"""

from __future__ import annotations

from collections.abc import Iterator

from rightofway.control import Entry, FleetControl, RobotLedger, StateReport
from rightofway.control.orders import make_order
from rightofway.control.robot_ledger import SentOrder

__all__ = ["WORDINGS", "LastNodeIsEnough", "VertexTwiceInBase"]


class LeftWhenItDrives(FleetControl):
    """A robot that drives has left its vertex."""

    def _find_proven(self, own: RobotLedger, state: StateReport) -> int | None:
        visit = super()._find_proven(own, state)
        if visit is not None and state.is_driving:
            return min(visit + 1, own.released)
        return visit


class EmptyMeansArrived(FleetControl):
    """A robot with no nodes left is at the end of its base."""

    def _find_proven(self, own: RobotLedger, state: StateReport) -> int | None:
        visit = super()._find_proven(own, state)
        return own.released if state.order_id and not state.nodes else visit


class AnyOrderId(FleetControl):
    """Sequence ids count in the current order, whatever order a state names."""

    def _find_proven(self, own: RobotLedger, state: StateReport) -> int | None:
        sent = own.orders.get(own.order_id, SentOrder(0))
        visit = sent.offset + state.last_sequence_id // 2
        return visit if visit <= own.released else None


class SentBeforeCommitted(FleetControl):
    """A release is sent before it is in the journal: a kill between the two forgets it."""

    def commit(self, *entries: Entry) -> None:
        if not any(entry["kind"] == "order" for entry in entries):
            super().commit(*entries)
            return
        for entry in entries:
            self.ledger.apply(entry)
        # A kill comes where the next thing is committed; until then the release is in memory only.
        self._unwritten = [*getattr(self, "_unwritten", []), *entries]
        if len(self._unwritten) > 1:
            self._journal.commit(self._unwritten)
            self._unwritten = []


class SplicedBehindAcknowledged(FleetControl):
    """A new plan keeps what robots have acknowledged, not all that is released."""

    def _find_committed(self, own: RobotLedger) -> int:
        if own.is_acknowledged or own.message is None:
            return own.released
        sent = own.orders[own.order_id]
        return sent.ends[sent.updates - 2] if sent.updates > 1 else own.released


class SplicedBehindArrived(FleetControl):
    """A new plan keeps what robots have reached, not all that is released."""

    def _find_committed(self, own: RobotLedger) -> int:
        return own.arrived


class NextBeforeAcknowledged(FleetControl):
    """The next update is sent before a state shows the last one."""

    def _find_step(self, robot: int, own: RobotLedger) -> Entry | None:
        if own.message is not None and own.cancel is None:
            own.is_acknowledged = True
        return super()._find_step(robot, own)


class FreeWhenCancelled(FleetControl):
    """A withdrawal is asked at any time, and frees the rest as soon as it is finished."""

    def _find_step(self, robot: int, own: RobotLedger) -> Entry | None:
        if own.cancel is not None and own.cancel.action_id is None and own.message is not None:
            action_id = f"{self.ledger.run}-{robot}-cancel{own.cancels}"
            return {"kind": "cancel asked", "robot": robot, "action": action_id}
        return super()._find_step(robot, own)

    def _follow_state(self, robot: int, state: StateReport) -> Iterator[Entry]:
        own = self.ledger.robots[robot]
        asked = own.cancel.action_id if own.cancel else None
        if asked is not None and state.actions.get(asked) in {"FINISHED", "FAILED"}:
            stands_at = own.find_held(state.last_place)
            if stands_at is not None:
                own.released, own.cancel = max(stands_at, own.arrived), None
        yield from super()._follow_state(robot, state)


class FactsInMemory(FleetControl):
    """Arrivals and finished jobs are not in the journal."""

    def commit(self, *entries: Entry) -> None:
        facts = [entry for entry in entries if entry["kind"] in {"arrived", "finished"}]
        super().commit(*(entry for entry in entries if entry not in facts))
        for entry in facts:
            self.ledger.apply(entry)


class VertexTwiceInBase(FleetControl):
    """A base may come to a vertex twice."""

    @staticmethod
    def _is_in_base(own: RobotLedger, part: int) -> bool:  # noqa: ARG004
        return False


class LastNodeIsEnough(VertexTwiceInBase):
    """A vertex with the right name is reached, whatever the base of the update that a state names.

    As long as no base comes to a vertex twice, one wrong field cannot make another vertex look
    right: the two conditions are one behind the other, and only both are a fault together.
    """

    def _find_proven(self, own: RobotLedger, state: StateReport) -> int | None:
        sent = own.orders.get(state.order_id)
        if sent is None:
            return None
        visit = sent.offset + state.last_sequence_id // 2
        is_held = own.route.first <= visit <= own.released
        return visit if is_held and own.route.get_place(visit) == state.last_place else None


class OrderPerLeg(FleetControl):
    """A robot that has come to the end of its base gets a new order, not an update.

    An idle robot takes an old order that starts where it stands, if it comes late enough. Where
    orders keep their order on a connection, as is assumed of the broker, none does.
    """

    def _make_update(self, robot: int, end: int) -> Entry:
        own = self.ledger.robots[robot]
        if own.arrived < own.released:
            return super()._make_update(robot, end)
        return make_order(self.ledger, robot, own.released, end)


class WithdrawalOutlivesOrder(FleetControl):
    """A new order after a doubt does not drop the withdrawal that is under way."""

    def commit(self, *entries: Entry) -> None:
        kept = {
            entry["robot"]: cancel
            for entry in entries
            if entry["kind"] == "order" and "stands_at" not in entry
            if (cancel := self.ledger.robots[entry["robot"]].cancel) is not None
        }
        super().commit(*entries)
        for robot, cancel in kept.items():
            self.ledger.robots[robot].cancel = cancel


class DoubtProvesArrival(FleetControl):
    """A robot without an order has arrived where it says that it stands."""

    def _settle_doubt(self, robot: int, state: StateReport) -> Iterator[Entry]:
        own = self.ledger.robots[robot]
        if own.token in state.actions and state.is_idle:
            stands_at = own.find_held(state.last_place)
            if stands_at is not None:
                yield {"kind": "arrived", "robot": robot, "visit": stands_at}
        yield from super()._settle_doubt(robot, state)


WORDINGS = {
    "left = drives away": (LeftWhenItDrives, "plain"),
    "no nodes = arrived": (EmptyMeansArrived, "plain"),
    "the order of a state is not looked at": (AnyOrderId, "cancels and resets"),
    "send, then commit": (SentBeforeCommitted, "killed often"),
    "splice behind what is acknowledged": (SplicedBehindAcknowledged, "killed often"),
    "splice behind where robots are": (SplicedBehindArrived, "killed often"),
    "next update before the acknowledgement": (NextBeforeAcknowledged, "plain"),
    "a withdrawal frees at once": (FreeWhenCancelled, "cancels"),
    "an order for each leg": (OrderPerLeg, "orders out of order"),
    "a withdrawal outlives the next order": (WithdrawalOutlivesOrder, "cancels and resets"),
    "a doubt proves an arrival": (DoubtProvesArrival, "wrong fields and many resets"),
    "facts in memory": (FactsInMemory, "all"),
}
"""Each wording with the chaos that finds it."""
