"""Files of this version, for later ones to read: ``python -m tests.builders.older_files 1.1.0``.

A release writes them once, into a folder of `tests/data/older`, from the scenarios of the folder
0.9.0; `tests/io/test_older_files.py` reads them from then on.
"""

from __future__ import annotations

import shutil
import sys
from itertools import count
from pathlib import Path

import rightofway
from rightofway.cli.main import run
from rightofway.control import FleetControl, SqliteJournal
from rightofway.control.dispatcher import Dispatcher
from tests.builders.floors import Floor
from tests.builders.pages import ROOT

__all__ = ["OLDER", "write_files"]

OLDER = ROOT / "tests" / "data" / "older"
GIVEN = ("door.yaml", "crossroad.yaml", "site.yaml", "suite.toml", "control/robots.yaml")
"""Files that people write."""

COMMANDS = (
    "plan {folder}/door.yaml -q -o {folder}/door.json",
    "plan {folder}/crossroad.yaml --planner paper -q -o {folder}/crossroad.json",
    "plan {folder}/site.yaml -q -o {folder}/site.json",
    "laps examples/bay.yaml -q -o {folder}/laps.json",
    "convert {folder}/door.yaml -q -o {folder}/door.xlsx",
)


def write_files(folder: Path) -> None:
    """Write scenarios, their plans, a workbook, laps, and what a control keeps."""
    (folder / "control").mkdir(parents=True)
    for name in GIVEN:
        shutil.copy(OLDER / "0.9.0" / name, folder / name)
    for command in COMMANDS:
        if run(command.format(folder=folder).split()):
            raise RuntimeError(command)
    write_journal(folder / "door.json", folder / "control" / "door.journal")


def write_journal(plan: Path, path: Path) -> None:
    """Write the journal of a control that ended on the way, after a job was added."""
    seconds = count(1.0)
    journal = SqliteJournal(path, lambda: next(seconds))
    dispatcher = Dispatcher(FleetControl(journal), rightofway.load_plan(plan))
    dispatcher.begin("run")
    floor = Floor(dispatcher)
    floor.drive(2)
    floor.send(floor.operator.add_job("N7", 2)[1])
    floor.drive(1)
    journal.close()


if __name__ == "__main__":
    write_files(OLDER / sys.argv[1])
