"""Fleet control: a plan released to real robots by right of way, with a journal."""

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
    RobotState,
)
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import RouteToDrive
from rightofway.control.simulated_robot import SimulatedRobot

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
    "RobotState",
    "RouteToDrive",
    "SimulatedRobot",
    "SqliteJournal",
]
