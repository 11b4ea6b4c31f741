"""A robot that may drive and does not move has an alarm, as long as it stands."""

from __future__ import annotations

from typing import Any

import pytest

from rightofway.control import Condition, Entry, FleetControl, Order, SimulatedRobot, StateReport
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.notices import Notices
from rightofway.control.standstill import Standstill
from tests.builders.chaos import MemoryJournal
from tests.builders.plans import door


class Watch:
    """The door's robots, and a clock: an edge takes 1 tick, so a robot stands after 2 + 11."""

    def __init__(self) -> None:
        self.now, self.said, self.kept = 0, list[str](), list[Entry]()
        plan = door()
        names = [robot.name for robot in plan.scenario.robots]
        notices = Notices(
            names, lambda fact: self.said.append(str(fact)), lambda: 0.0, keep=self.kept.append
        )
        self.control = FleetControl(MemoryJournal(), look_ahead=2)
        dispatcher = Dispatcher(self.control, plan)
        dispatcher.begin("run")
        self.standstill = Standstill(dispatcher, notices, lambda: self.now)
        self.robot = SimulatedRobot("N2")
        self.messages = self.control.start()
        self.exchange()

    def exchange(self, **changes: Any) -> None:
        """Deliver what is sent to R2, and its states."""
        while own := [message for message in self.messages if message.robot == 1]:
            self.messages = []
            for message in own:
                if isinstance(message, Order):
                    self.robot.take_order(message)
                else:
                    self.robot.take_action(message)
            self.messages = self.control.receive(1, self.state(**changes))

    def state(self, **changes: Any) -> StateReport:
        """Return the state of R2, with a condition or a position."""
        state = self.robot.report_state(changes.get("condition", Condition()))
        fields = {field: getattr(state, field) for field in StateReport.__dataclass_fields__}
        return StateReport(**{**fields, **changes})

    def wait(self, ticks: int, **changes: Any) -> None:
        """Let time go by; R2 sends its state each tick."""
        for _ in range(ticks):
            self.now += 1
            self.messages = self.control.receive(1, self.state(**changes))
            self.exchange(**changes)
            self.standstill.look()


BEGIN = "R2 does not move: it was at N2 last, and its way to N4 is released"
END = "R2 moves again, or has no way released"


def test_a_robot_that_stands_on_a_free_way_has_an_alarm_until_it_moves() -> None:
    watch = Watch()
    watch.wait(13)
    assert watch.said == []
    watch.wait(50)
    assert watch.said == [BEGIN]
    while watch.robot.place == "N2":
        watch.robot.step()
    watch.wait(1)
    assert watch.said == [BEGIN, END]
    assert [(entry["about"], entry["over"]) for entry in watch.kept] == [
        ("still", False),
        ("still", True),
    ]


def test_a_robot_whose_position_changes_moves() -> None:
    """A robot on a long lane, or a slow one; noise of some centimetres is no move."""
    watch = Watch()
    for step in range(100):
        watch.wait(1, position=(2.0 - step / 5, 0.0, "map"))
    assert watch.said == []
    for step in range(30):
        watch.wait(1, position=(-18.0 + step % 2 / 50, 0.0, "map"))
    assert watch.said == [BEGIN]


@pytest.mark.parametrize("trouble", [Condition(is_paused=True), Condition(mode="MANUAL")])
def test_a_robot_that_is_not_fit_has_its_own_alarm_only(trouble: Condition) -> None:
    watch = Watch()
    watch.wait(100, condition=trouble)
    assert watch.said == []
    watch.wait(1)
    assert watch.said == [BEGIN]


def test_a_robot_that_waits_for_others_stands_without_an_alarm() -> None:
    """R2 works at N8, and may not leave it before R1 is at N6."""
    watch = Watch()
    for _ in range(100):
        watch.robot.step()
        watch.wait(1)
    assert watch.robot.place == "N8"
    assert watch.said == []
