"""Simulated robots at one control, without any fault."""

from __future__ import annotations

from collections.abc import Sequence

from rightofway.control import Message, Order, SimulatedRobot
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.joins import Joins
from rightofway.control.operator import Operator

__all__ = ["Floor"]


class Floor:
    """Robots that drive one after another, without any fault.

    They begin at their homes, or at the places given, and know of no order; or they are the
    ``robots`` of a floor whose control has begun again.
    """

    def __init__(
        self,
        dispatcher: Dispatcher,
        places: Sequence[str] = (),
        *,
        robots: Sequence[SimulatedRobot] = (),
        joins: Joins | None = None,
    ) -> None:
        self.dispatcher, self.operator = dispatcher, Operator(dispatcher, joins)
        homes = [own.route.places[0] for own in dispatcher.ledger.robots]
        self.robots = [*robots] or [SimulatedRobot(place) for place in places or homes]
        self.send(dispatcher.control.start())

    def send(self, messages: list[Message]) -> None:
        """Deliver messages, and all that is answered."""
        while messages:
            message = messages.pop(0)
            robot = self.robots[message.robot]
            if isinstance(message, Order):
                robot.take_order(message)
            else:
                robot.take_action(message)
            messages += self.dispatcher.control.receive(message.robot, robot.report_state())

    def drive(self, steps: int) -> None:
        """Have each robot do the next things."""
        for _ in range(steps):
            for number, robot in enumerate(self.robots):
                robot.step()
                self.send(self.dispatcher.control.receive(number, robot.report_state()))
