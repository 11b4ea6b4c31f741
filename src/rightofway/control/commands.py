"""Commands to a control that runs: a table of their own in a file beside its journal.

The journal is locked by the process that may send. Any other program writes a row into
this file, and the control answers in it. A command is in the journal with its changes, in
one transaction, so that it is carried out once, also by a control that was killed.
"""

from __future__ import annotations

import json
import re
import sqlite3
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, quote

__all__ = [
    "NAMED",
    "Answer",
    "Commands",
    "CommandsFailed",
    "read_command",
    "read_duration",
    "refuse_nameless",
]

Answer = Mapping[str, Any]
"""The result of a command: ``done``, and a ``fact`` or None; more for programs."""

NAMED: Mapping[str, str] = {
    "change": "job",
    "withdraw": "job",
    "again": "job",
    "skip": "job",
    "close": "place",
    "open": "place",
    "cancel": "robot",
    "clear": "robot",
    "join": "robot",
    "remove": "robot",
    "place": "robot",
    "seen": "person",
}
"""The kinds of commands that need a ``name``, each with the thing that it names."""

SECONDS = {"s": 1, "min": 60, "h": 3600}
"""Units of durations that people write [s]."""

LONGEST = 40
"""Characters of a duration; Python reads no number of more than 4300 digits."""

DURATION = re.compile(r"([0-9]+(?:\.[0-9]+|/[1-9][0-9]*)?) ?(s|min|h)?", re.ASCII)

KEPT = 1_000
"""Commands that are kept with their answers."""

PAUSE = 0.05
"""Seconds between two looks for an answer."""


class CommandsFailed(InputError):
    """The file of commands cannot be read or written."""


class Commands:
    """The commands to the control of a journal. Each method raises `CommandsFailed`.

    Parameters
    ----------
    journal
        The file of the journal; commands are in the file beside it, which is made if need be.

    Raises
    ------
    CommandsFailed
        If the file cannot be read and written.
    """

    def __init__(self, journal: Path) -> None:
        self._path = journal.with_name(f"{journal.name}-commands")
        with self._guard():
            self._database = sqlite3.connect(self._path, timeout=5, isolation_level=None)
            self._database.execute("PRAGMA journal_mode = WAL")
            self._database.execute(
                "CREATE TABLE IF NOT EXISTS commands"
                " (number INTEGER PRIMARY KEY AUTOINCREMENT, command TEXT, answer TEXT)"
            )

    @contextmanager
    def _guard(self) -> Iterator[None]:
        """Name the file in errors of the database."""
        try:
            yield
        except sqlite3.Error as error:
            message = f"cannot be used for commands: {error} (name the journal of rightofway drive)"
            raise CommandsFailed.at(str(self._path), message) from error

    def ask(self, command: Mapping[str, Any]) -> int:
        """Write a command; return its number.

        Parameters
        ----------
        command
            Its ``kind``, and the values of this kind.
        """
        query = "INSERT INTO commands (command) VALUES (?)"
        with self._guard():
            return int(self._database.execute(query, (json.dumps(command),)).lastrowid or 0)

    def list_unanswered(self) -> list[tuple[int, Any]]:
        """Return number and text of each command that has no answer, in their order.

        Any program may have written the text: see `read_command`.
        """
        query = "SELECT number, command FROM commands WHERE answer IS NULL ORDER BY number"
        with self._guard():
            return list(self._database.execute(query))

    def answer(self, number: int, answer: Answer) -> None:
        """Answer a command.

        Parameters
        ----------
        number
            Of the command.
        answer
            Its result.
        """
        query = "UPDATE commands SET answer = ? WHERE number = ?"
        with self._guard():
            self._database.execute(query, (json.dumps(answer), number))
            self._database.execute("DELETE FROM commands WHERE number <= ?", (number - KEPT,))

    def wait_for(self, number: int, seconds: float) -> Answer | None:
        """Return the answer to a command, None if there is none after some time [s].

        Parameters
        ----------
        number
            Of the command.
        seconds
            How long to wait.
        """
        until = time.monotonic() + seconds
        query = "SELECT answer FROM commands WHERE number = ?"
        while True:
            with self._guard():
                row = self._database.execute(query, (number,)).fetchone()
            if row and row[0] is not None:
                answer: Answer = json.loads(row[0])
                return answer
            if time.monotonic() > until:
                return None
            time.sleep(PAUSE)

    def close(self) -> None:
        """Close the file."""
        self._database.close()


def read_command(text: Any) -> Mapping[str, Any]:
    """Return a command that a program has written.

    Parameters
    ----------
    text
        As it is in the file.

    Raises
    ------
    InputError
        If it is no JSON object with the ``kind`` of a command.
    """
    try:
        command = json.loads(text)
    except (TypeError, ValueError, RecursionError):
        command = text
    if not isinstance(command, dict) or not isinstance(command.get("kind"), str):
        message = f"{quote(command)} is no command (give a JSON object with its kind)"
        raise InputError.at("command", message)
    return command


def refuse_nameless(command: Mapping[str, Any]) -> None:
    """Refuse a command without the name that its kind needs.

    Parameters
    ----------
    command
        A command with its ``kind``.

    Raises
    ------
    InputError
        If it has no name, or an empty one.
    """
    kind = command["kind"]
    if kind in NAMED and not command.get("name"):
        named = NAMED[kind]
        raise InputError.at(named, f"{kind} needs the name of a {named} (give one)")


def read_duration(given: object, seconds: Fraction | None) -> Fraction:
    """Return a duration that a person has written [time unit].

    Parameters
    ----------
    given
        A number or a fraction, not negative, perhaps with a unit: ``90``, ``1/2``, ``15min``.
    seconds
        How long a time unit is [s]; None where it has no unit.

    Raises
    ------
    InputError
        If it is no duration, or has a unit though times have none.
    """
    text = str(given) if isinstance(given, str | int | float | Fraction) else ""
    match = DURATION.fullmatch(text.strip()) if len(text) <= LONGEST else None
    if match is None:
        remedy = "for example 5, 1/2, 90s, 15min or 2h"
        raise InputError.at("time", f"{quote(given)} is no duration ({remedy})")
    value, unit = Fraction(match[1]), match[2]
    if unit is None:
        return value
    if seconds is None:
        message = f"{quote(given)} has a unit, and the times of the plan have none"
        raise InputError.at("time", f"{message} (leave it out)")
    return value * SECONDS[unit] / seconds
