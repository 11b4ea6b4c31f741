"""A plan with jobs and batteries for robots on a floor, and the actions that they are asked for."""

from __future__ import annotations

import contextlib
import json
import sqlite3
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import rightofway
from rightofway.control.demo import drive_demo
from rightofway.control.endpoints import Letter
from rightofway.control.journal import JournalReader
from rightofway.control.ledger import Ledger
from rightofway.io import parse_scenario
from rightofway.model import Plan

__all__ = [
    "Action",
    "count_finished",
    "driven_actions",
    "floor_document",
    "floor_plan",
    "read_pool",
]


def floor_document() -> dict[str, Any]:
    """Return two robots, of which R2 has to charge first, and three jobs with times."""
    return {
        "format": "rightofway-scenario/1",
        "map": {"grid": [".....", ".@.@.", "....."]},
        "rules": {"rotations": False, "turn": 0},
        "batteries": {
            "small": {"drive": "1/20", "on": "1/400", "charge": "1/10", "reserve": "1/10"}
        },
        "charging": ["N0", "N4"],
        "robots": [
            {"name": "R1", "home": "N0", "capacity": 2, "battery": "small"},
            {"name": "R2", "home": "N4", "battery": "small", "start": {"at": "N4", "soc": 0.2}},
        ],
        "jobs": [
            {"name": "J1", "pickup": "N10", "dropoff": "N2", "pickup_work": 3, "robot": "R1",
             "earliest": 12},
            {"name": "J2", "at": "N14", "work": 4, "after": ["J1"], "robot": "R2"},
            {"name": "J3", "pickup": "N12", "dropoff": "N3", "robot": "R2"},
        ],
    }  # fmt: skip


@cache
def floor_plan() -> Plan:
    """Return a plan of the document."""
    return rightofway.solve(parse_scenario(floor_document()), "prioritized")


class Action(NamedTuple):
    """An action of an order, with the time at which the order was sent first [s]."""

    second: float
    robot: int
    node: str
    kind: str
    item: str


def driven_actions(plan: Plan, **options: Any) -> tuple[list[Action], list[dict[str, Any]]]:
    """Return the actions of a demo in the order in which they were sent, and all states."""
    actions, states, seen = list[Action](), list[dict[str, Any]](), set[str]()

    def watch(letter: Letter) -> None:
        document = json.loads(letter.payload)
        if letter.name == "state":
            states.append(document)
        if letter.name != "order":
            return
        robot = int(document["serialNumber"].removeprefix("robot"))
        minutes, seconds = document["timestamp"][14:-1].split(":")
        for node in document["nodes"]:
            for action in node["actions"]:
                if action["actionId"] in seen:
                    continue
                seen.add(action["actionId"])
                second = 60 * int(minutes) + float(seconds)
                item = action["actionId"].removeprefix(f"demo-{robot}-").rpartition("-")[0]
                actions.append(Action(second, robot, node["nodeId"], action["actionType"], item))

    drive_demo(plan, watch=watch, **options)
    return actions, states


def read_pool(journal: Path) -> dict[str, str]:
    """Return how jobs have left the pool, by the entries of a journal."""
    reader = JournalReader(journal)
    ledger = Ledger(floor_plan().scenario.roadmap)
    for row in reader.read_rows():
        ledger.read(row.number, row.entry)
    reader.close()
    return dict(ledger.pool.left)


def count_finished(journal: Path) -> dict[str, int]:
    """Return how often the journal has each stop of a job as finished, in their order."""
    with contextlib.closing(sqlite3.connect(journal)) as database:
        query = "SELECT json_extract(entry, '$.job'), count(*) FROM entries"
        return dict(
            database.execute(
                f"{query} WHERE json_extract(entry, '$.kind') = 'finished'"
                " AND json_extract(entry, '$.job') LIKE '%/%' GROUP BY 1 ORDER BY min(number)"
            )
        )
