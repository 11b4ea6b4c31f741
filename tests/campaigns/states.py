"""Fuzz of states: broken, old, doubled and contradictory messages of a robot, by the thousand.

None stops the control, none makes it release what another robot holds, and each kind of trouble is
reported once.
"""

from __future__ import annotations

import argparse
import copy
import json
import random
import sys
import time
from collections import Counter
from random import SystemRandom
from typing import Any

from rightofway.control import FleetControl, SimulatedRobot
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.endpoints import ControlEnd, Letter, RobotEnd
from rightofway.control.identities import VERSIONS, make_simulated_identities
from rightofway.control.notices import MAX_KINDS, Notices
from rightofway.control.order_map import make_order_maps
from tests.builders.chaos import MemoryJournal
from tests.builders.warehouses import warehouse

__all__ = ["fuzz_states"]

NOW = "2026-01-31T12:00:00.000Z"

VALUES: tuple[Any, ...] = (
    *(None, True, False, 0, 1, -1, 2, 3, 2**32, 2**70, 0.5, 1e308, float("inf"), float("nan")),
    *("", "N0", "x" * 10_000, "\ud800", "FATAL", "FINISHED", "MANUAL", "CONNECTIONBROKEN"),
    *([], {}, [None], [{}], {"a": {"b": []}}, ["N0"] * 50),
)
"""What a field may be instead."""


def _places(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Return the paths of all values inside a document."""
    items = value.items() if isinstance(value, dict) else enumerate(value)
    return [
        place
        for key, item in items
        for place in (
            (*path, key),
            *(_places(item, (*path, key)) if isinstance(item, dict | list) else ()),
        )
    ]


def _broken(document: dict[str, Any], draw: random.Random) -> bytes:
    """Return a payload with one to three fields changed, or cut short."""
    document = copy.deepcopy(document)
    for _ in range(draw.randint(1, 3)):
        *way, last = draw.choice(_places(document))
        owner: Any = document
        for key in way:
            owner = owner[key]
        if isinstance(owner, dict) and draw.random() < 0.2:
            del owner[last]
        else:
            owner[last] = copy.deepcopy(draw.choice(VALUES))
        if not document:
            break
    payload = json.dumps(document).encode()
    if draw.random() < 0.02:
        payload = payload[: draw.randrange(len(payload))]
    return payload


def fuzz_states(count: int, seed: int) -> Counter[str]:
    """Send broken states to a control whose other robots drive; return what was reported.

    Raises
    ------
    AssertionError
        If robots hold a place together, or something is reported too often.
    """
    draw, said = random.Random(seed), Counter[str]()  # noqa: S311
    plan = warehouse(4, seed=seed % 5)
    names = [robot.name for robot in plan.scenario.robots]
    notices = Notices(names, lambda sentence: said.update([sentence]), lambda: 0.0)
    control = FleetControl(MemoryJournal(), report=notices.report_on)
    Dispatcher(control, plan).begin("run")
    identities = make_simulated_identities(names, draw.choice(VERSIONS))
    maps = make_order_maps(plan.scenario, identities)
    end = ControlEnd(control, maps, lambda: NOW, notices)
    homes = [plan.scenario.roadmap.name(robot.home) for robot in plan.scenario.robots]
    robots = [
        RobotEnd(SimulatedRobot(home), number, identities[number], lambda: NOW)
        for number, home in enumerate(homes)
    ]
    listens = {topic: robot for robot in robots for topic in robot.topics}
    letters = end.make_letters(control.start())
    for _ in range(count):
        for letter in letters:
            listens[letter.topic].receive(letter)
        robot = draw.choice(robots)
        robot.robot.step()
        letter = robot.report_state()
        if draw.random() < 0.7:
            name = draw.choice(("state",) * 8 + ("connection", "factsheet"))
            topic = letter.topic.rpartition("/")[0] + f"/{name}"
            letter = Letter(topic, _broken(json.loads(letter.payload), draw))
        letters = end.receive(letter)
        if draw.random() < 0.05:
            letters += end.make_letters(control.remind())
        _look(control)
    worst = max(said.values(), default=0)
    assert worst <= 2, said.most_common(1)
    assert len(said) <= (MAX_KINDS + 10) * len(names), len(said)
    return said


def _look(control: FleetControl) -> None:
    """Fail if two robots hold a place."""
    held = Counter(place for own in control.ledger.robots for place in set(own.held))
    assert max(held.values()) == 1, held.most_common(1)


def main() -> int:
    """Fuzz, in rounds; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.campaigns.states", description=__doc__)
    parser.add_argument("count", type=int, help="states to send")
    parser.add_argument("--seed", type=int, default=SystemRandom().randrange(10**9))
    given = parser.parse_args()
    began, sent, kinds = time.perf_counter(), 0, Counter[str]()
    sys.stdout.write(f"fuzz-states {given.count} --seed {given.seed}\n")
    while sent < given.count:
        kinds += fuzz_states(500, given.seed + sent // 500)
        sent += 500
    seconds = time.perf_counter() - began
    sys.stdout.write(f"fuzz-states: {sent} states, {len(kinds)} sentences, {seconds:.0f} s\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
