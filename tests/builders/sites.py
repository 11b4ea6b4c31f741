"""The door with both ends of its wires: letters of its robots, and sentences on them."""

from __future__ import annotations

import json
from typing import Any

from rightofway.control import FleetControl, SimulatedRobot
from rightofway.control.endpoints import ControlEnd, Letter, RobotEnd
from rightofway.control.identities import Identity
from rightofway.control.notices import Notices
from rightofway.control.order_map import make_order_maps
from rightofway.control.routes import make_routes_to_drive
from rightofway.model import Plan
from rightofway.precedence import ReleaseGraph
from tests.builders.chaos import MemoryJournal
from tests.builders.plans import door

__all__ = ["NOW", "Site"]

NOW = "2026-01-31T12:00:00.000Z"


class Site:
    """The door with both ends of its wires, and what is said of its robots."""

    def __init__(self, plan: Plan | None = None, version: str = "2.1.0") -> None:
        plan = plan or door()
        self.said: list[str] = []
        self.time = 0.0
        names = [robot.name for robot in plan.scenario.robots]
        notices = Notices(names, lambda fact: self.said.append(str(fact)), lambda: self.time)
        self.control = FleetControl(MemoryJournal(), report=notices.report_on)
        routes = make_routes_to_drive(plan)
        self.control.begin("run", routes, ReleaseGraph.of(plan.scenario, plan.tracks))
        self.identities = [
            Identity(manufacturer="maker", serial_number=name, version=version) for name in names
        ]
        maps = make_order_maps(plan.scenario, self.identities)
        self.end = ControlEnd(self.control, maps, lambda: NOW, notices)
        self.robots = [
            RobotEnd(SimulatedRobot(route.places[0]), k, self.identities[k], lambda: NOW)
            for k, route in enumerate(routes)
        ]
        self.deliver(self.end.make_letters(self.control.start()))

    def deliver(self, letters: list[Letter]) -> None:
        """Bring letters to robots, and nothing back."""
        for letter in letters:
            for robot in self.robots:
                if letter.topic in robot.topics:
                    robot.receive(letter)

    def say(self, robot: int, **changes: Any) -> None:
        """Let a robot send its state with changes, and deliver what is answered."""
        letter = self.robots[robot].report_state()
        document = {**json.loads(letter.payload), **changes}
        self.deliver(self.end.receive(Letter(letter.topic, json.dumps(document).encode())))

    def send(self, robot: int, name: str, document: Any) -> None:
        """Let a robot send a message."""
        topic = self.identities[robot].get_topic(name)
        self.end.receive(Letter(topic, json.dumps(document).encode()))

    @property
    def released(self) -> list[int]:
        """The last released part of each robot."""
        return [own.released for own in self.control.ledger.robots]
