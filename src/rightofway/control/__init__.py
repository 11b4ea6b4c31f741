"""Fleet control: a plan released to real robots by right of way, with a journal.

Modules are imported when a name of them is first used, so that the help of commands starts quickly.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rightofway.provision import import_later

if TYPE_CHECKING:
    from rightofway.control.fleet_control import FleetControl
    from rightofway.control.journal import (
        Entry,
        Journal,
        JournalFailed,
        JournalReader,
        JournalRow,
        SqliteJournal,
    )
    from rightofway.control.ledger import Ledger
    from rightofway.control.messages import (
        Condition,
        InstantAction,
        Message,
        Order,
        OrderNode,
        RobotError,
        StateReport,
    )
    from rightofway.control.robot_ledger import RobotLedger
    from rightofway.control.routes import RouteToDrive
    from rightofway.control.simulated_robot import SimulatedRobot

_MODULES = {
    "fleet_control": ("FleetControl",),
    "journal": (
        "Entry",
        "Journal",
        "JournalFailed",
        "JournalReader",
        "JournalRow",
        "SqliteJournal",
    ),
    "ledger": ("Ledger",),
    "messages": (
        "Condition",
        "InstantAction",
        "Message",
        "Order",
        "OrderNode",
        "RobotError",
        "StateReport",
    ),
    "robot_ledger": ("RobotLedger",),
    "routes": ("RouteToDrive",),
    "simulated_robot": ("SimulatedRobot",),
}

__all__ = [
    "Condition",
    "Entry",
    "FleetControl",
    "InstantAction",
    "Journal",
    "JournalFailed",
    "JournalReader",
    "JournalRow",
    "Ledger",
    "Message",
    "Order",
    "OrderNode",
    "RobotError",
    "RobotLedger",
    "RouteToDrive",
    "SimulatedRobot",
    "SqliteJournal",
    "StateReport",
]

if not TYPE_CHECKING:  # a checker would take any misspelt name for an object
    __getattr__ = import_later(__name__, _MODULES)
