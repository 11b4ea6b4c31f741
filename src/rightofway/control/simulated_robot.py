"""A simulated robot: takes orders as the norm has it, drives node by node, and does its actions.

It has no clock: each `step` is the next thing that it does. Its owner decides when.

A withdrawal or a job is carried out once for its id, however often it comes: a robot that forgets
its order still knows which actions it has finished. Of a robot that forgets even these before a
state of them has arrived, nobody could know that the work is done.
"""

from __future__ import annotations

from typing import Literal

from rightofway.control.messages import (
    Condition,
    InstantAction,
    Load,
    Order,
    OrderNode,
    StateReport,
)

Step = Literal["begin to drive", "arrive", "begin work", "end work"]
"""The next step of a robot."""

AS_USUAL = Condition()
"""The condition of a robot that is fit."""


class SimulatedRobot:
    """A simulated robot at a place.

    Parameters
    ----------
    place
        The name of its first vertex.

    Attributes
    ----------
    place
        The node that it has reached last.
    is_driving
        Whether it drives to the first node of `ahead`.
    ahead
        The remaining nodes of its base.
    done
        The number of times that each action was finished, by its id.
    refusal
        The kind of error of the last order, if it was rejected; None after an accepted one.
    instant_actions
        The ids of all instant actions that it was asked for.
    charging
        Actions that begin a charge (True) or end one, by their ids; its owner knows.
    is_charging
        Whether its battery is charged; driving on ends it, too.
    handling
        Actions that pick a load (True) or drop one, by their ids; its owner knows.
    loads
        What it carries.
    is_paused
        Whether it stands until its pause ends.
    """

    def __init__(self, place: str) -> None:
        self.place, self.is_driving, self.is_paused = place, False, False
        self.ahead: list[OrderNode] = []
        self.done: dict[str, int] = {}
        self.refusal: str | None = None
        self.instant_actions = set[str]()
        self.charging: dict[str, bool] = {}
        self.is_charging = False
        self.handling: dict[str, tuple[bool, Load]] = {}
        self.loads: list[Load] = []
        self._order_id, self._update_id, self._sequence_id = "", 0, 0
        self._actions: dict[str, str] = {}
        self._waiting: list[str] = []  # at this node
        self._is_cancelled = False
        self._cancelling: str | None = None
        self._withdrawals: dict[str, str] = {}  # what becomes of each

    @property
    def is_active(self) -> bool:
        """Whether an order is under way."""
        return bool(self.ahead or self._waiting or self.is_driving)

    @property
    def next_step(self) -> Step | None:
        """The action of the next `step`; None for none."""
        if self.is_paused:
            return None
        if self.is_driving:
            return "arrive"
        if self._waiting:
            is_new = self._actions[self._waiting[0]] == "WAITING"
            return "begin work" if is_new else "end work"
        return "begin to drive" if self.ahead else None

    @property
    def next_action(self) -> str | None:
        """The action that it does here next; None for none."""
        return self._waiting[0] if self._waiting and not self.is_driving else None

    def report_state(
        self, condition: Condition = AS_USUAL, charge: float | None = None
    ) -> StateReport:
        """Return the robot's message about itself.

        Parameters
        ----------
        condition
            Whether it is fit to drive on; its owner knows.
        charge
            The state of charge of its battery, from 0 to 1; None where it has none.
        """
        numbers = tuple(node.sequence_id for node in self.ahead)
        return StateReport(
            order_id=self._order_id,
            update_id=self._update_id,
            last_place=self.place,
            last_sequence_id=self._sequence_id,
            nodes=numbers,
            edges=tuple(number - 1 for number in numbers),
            actions=dict(self._actions),
            is_driving=self.is_driving,
            condition=condition,
            charge=charge,
            loads=tuple(self.loads),
        )

    def take_order(self, order: Order) -> bool:
        """Take an order or update, or refuse it; return whether anything has changed.

        Parameters
        ----------
        order
            A new order, or an update of the one that it has.
        """
        first = order.nodes[0]
        if order.order_id == self._order_id:
            if order.update_id == self._update_id:
                return False  # it has this one
            last = self.ahead[-1].sequence_id if self.ahead else self._sequence_id
            is_next = order.update_id > self._update_id and first.sequence_id == last
            if self._is_cancelled or not is_next:
                self.refusal = "orderUpdateError"
                return False
            self.ahead += order.nodes[1:]
        else:
            if self.is_active or first.place != self.place:
                self.refusal = "orderError"
                return False
            self._order_id, self._is_cancelled = order.order_id, False
            self._sequence_id, self.ahead = first.sequence_id, list(order.nodes[1:])
            self._actions = {}
            self.instant_actions.clear()
            self._waiting = [action for action in first.actions if action not in self.done]
        self._update_id, self.refusal = order.update_id, None
        for node in order.nodes:
            for action in node.actions:
                status = "FINISHED" if action in self.done else "WAITING"
                self._actions.setdefault(action, status)
        return True

    def take_action(self, action: InstantAction) -> bool:
        """Carry out an instant action; return whether a state is due.

        Parameters
        ----------
        action
            A request for a state or a factsheet, the begin or the end of a pause, or the withdrawal
            of the order.
        """
        self.instant_actions.add(action.action_id)
        if action.kind in {"startPause", "stopPause"}:
            self.is_paused = action.kind == "startPause"
        if action.kind != "cancelOrder":
            self._actions[action.action_id] = "FINISHED"
            return True
        known = self._withdrawals.get(action.action_id)
        if known is not None:
            self._actions.setdefault(action.action_id, known)
            return True
        if not self.is_active:
            self._withdrawals[action.action_id] = "FAILED"  # there is no order to cancel
            self._actions[action.action_id] = "FAILED"
        else:
            self._withdrawals[action.action_id] = "FINISHED"
            self._actions[action.action_id] = "RUNNING"
            self._cancelling, self._is_cancelled = action.action_id, True
            dropped = self.ahead[1:] if self.is_driving else self.ahead
            self.ahead = self.ahead[:1] if self.is_driving else []
            for node in dropped:
                self._fail(node.actions)
            self._finish_cancel()
        return True

    def step(self) -> bool:
        """Do the next thing, see `next_step`; return whether there was one."""
        match self.next_step:
            case "arrive":
                node = self.ahead.pop(0)
                self.place, self._sequence_id, self.is_driving = node.place, node.sequence_id, False
                if self._is_cancelled:
                    self._fail(node.actions)
                else:
                    self._waiting = [action for action in node.actions if action not in self.done]
                self._finish_cancel()
            case "begin work":
                self._actions[self._waiting[0]] = "RUNNING"
            case "end work":
                action = self._waiting.pop(0)
                self._actions[action] = "FINISHED"
                self.done[action] = self.done.get(action, 0) + 1
                self.is_charging = self.charging.get(action, self.is_charging)
                if action in self.handling:
                    self._handle_load(*self.handling[action])
                self._finish_cancel()
            case "begin to drive":
                self.is_driving, self.is_charging = True, False
            case None:
                return False
        return True

    def _handle_load(self, is_picked: bool, load: Load) -> None:
        """Pick a load or drop it; an unknown load that is dropped is the last one picked."""
        if is_picked:
            self.loads.append(load)
        elif load in self.loads:
            self.loads.remove(load)
        elif self.loads:
            self.loads.pop()

    def forget(self) -> bool:
        """Forget the order, as after a reset; not between two nodes, nor while it works."""
        if self.is_driving or any(self._actions[action] == "RUNNING" for action in self._waiting):
            return False
        self._order_id, self._update_id, self._sequence_id = "", 0, 0
        self.ahead, self._waiting, self._cancelling = [], [], None
        self._is_cancelled = False
        self._actions = {key: value for key, value in self._actions.items() if value == "FINISHED"}
        return True

    def fail_work(self) -> bool:
        """Fail in the work that it is at; return whether there was any."""
        if self.next_step not in {"begin work", "end work"}:
            return False
        self._actions[self._waiting.pop(0)] = "FAILED"
        self._finish_cancel()
        return True

    def _fail(self, actions: tuple[str, ...] | list[str]) -> None:
        for action in actions:
            if self._actions[action] == "WAITING":
                self._actions[action] = "FAILED"

    def _finish_cancel(self) -> None:
        """End a withdrawal once the robot stands and has ended its action."""
        if self._cancelling is None or self.is_driving:
            return
        running = [action for action in self._waiting if self._actions[action] == "RUNNING"]
        self._fail([action for action in self._waiting if action not in running])
        self._waiting = running
        if not running:
            self._actions[self._cancelling] = "FINISHED"
            self._cancelling = None
