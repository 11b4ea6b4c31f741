"""Fuzz of states: broken, old, doubled and contradictory messages of a robot, by the thousand.

None stops the control, and none makes it release what another robot holds. The begin and the end of
each kind of trouble are reported in turn. Sizes have no limit: texts, numbers, lists and depths.
"""

from __future__ import annotations

import argparse
import copy
import json
import random
import re
import sys
import time
from collections import Counter
from random import SystemRandom
from typing import Any

from rightofway.control import Entry, FleetControl, SimulatedRobot
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.endpoints import ControlEnd, Letter, RobotEnd
from rightofway.control.identities import VERSIONS, make_simulated_identities
from rightofway.control.notices import BURST, Notices
from rightofway.control.order_map import make_order_maps
from tests.builders.chaos import MemoryJournal
from tests.builders.warehouses import warehouse

__all__ = ["draw_large", "fuzz_states", "refuse_endless", "write_large"]

NOW = "2026-01-31T12:00:00.000Z"

VALUES: tuple[Any, ...] = (
    *(None, True, False, 0, 1, -1, 2, 3, 2**32, 2**70, 0.5, 1e308, float("inf"), float("nan")),
    *("", "N0", "\ud800", "FATAL", "FINISHED", "MANUAL", "CONNECTIONBROKEN"),
    *([], {}, [None], [{}], {"a": {"b": []}}),
)
"""What a field may be instead."""

LARGEST = 6
"""The power of ten up to which sizes of values are drawn; all powers are as likely."""


def draw_large(draw: random.Random) -> Any:
    """Return a value of any size."""
    size = int(10 ** draw.uniform(0, LARGEST))
    match draw.randrange(6):
        case 0:
            return "x" * size
        case 1:
            return f"run-{draw.randrange(4)}-" + draw.choice("0159") * size  # as an order of ours
        case 2:
            return [0] * size
        case 3:
            return [{"sequenceId": 2, "actionId": "a", "actionStatus": "FINISHED"}] * (size // 10)
        case 4:
            return f"\ufffe{size}"  # a number of so many digits, see `write_large`
        case _:
            return f"\uffff{size}"  # a list that is so deep


def write_large(document: Any) -> bytes:
    """Return a document as JSON, with numbers and depths that Python's writer refuses."""
    text = json.dumps(document)
    text = re.sub(r'"\\ufffe(\d+)"', lambda found: "7" * int(found[1]), text)
    return re.sub(
        r'"\\uffff(\d+)"', lambda found: "[" * int(found[1]) + "]" * int(found[1]), text
    ).encode()


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
            owner[last] = (
                draw_large(draw) if draw.random() < 0.05 else copy.deepcopy(draw.choice(VALUES))
            )
        if not document:
            break
    payload = write_large(document)
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
    draw, said, kept = random.Random(seed), Counter[str](), list[Entry]()  # noqa: S311
    plan = warehouse(4, seed=seed % 5)
    names = [robot.name for robot in plan.scenario.robots]
    notices = Notices(names, lambda fact: said.update([str(fact)]), lambda: 0.0, keep=kept.append)
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
    refuse_endless(kept, len(names))
    return said


def refuse_endless(kept: list[Entry], robots: int) -> None:
    """Fail if trouble begins twice before it ends, or more is reported than may be at once."""
    last = set[tuple[int, str]]()
    for entry in kept:
        key = (entry["robot"], entry["about"])
        if entry["about"]:
            assert (key in last) == entry["over"], entry
            last ^= {key}
    assert len([entry for entry in kept if entry["about"]]) <= (BURST + 1) * robots


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
