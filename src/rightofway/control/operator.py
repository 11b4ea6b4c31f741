"""The operator: what people ask a control for, each command carried out once.

A command is committed to the journal with what it changes, in one transaction. So a control that
was killed knows at its next start which commands it has carried out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import partial
from typing import Any

from rightofway.control.commands import Answer, Commands
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.journal import Entry
from rightofway.control.messages import Message
from rightofway.control.names import find_robot, list_jobs
from rightofway.errors import GaveUp, InputError, quote

__all__ = ["Operator"]

OPERATIONS: Mapping[str, Entry] = {
    "hold": {"kind": "hold", "on": True},
    "go": {"kind": "hold", "on": False},
    "clear": {"kind": "cleared"},
    "cancel": {"kind": "cancel wanted"},
    "remove": {"kind": "taken off"},
}
"""What an operator does to robots: the entry of each command."""


class Operator:
    """Carries out what people have asked for.

    Parameters
    ----------
    dispatcher
        The work of robots.
    """

    def __init__(self, dispatcher: Dispatcher) -> None:
        self._dispatcher = dispatcher

    def obey(self, commands: Commands) -> tuple[list[Message], list[tuple[int, Answer]]]:
        """Carry out what people have asked for, each command once.

        Parameters
        ----------
        commands
            The file beside the journal.

        Returns
        -------
        tuple
            What is to be sent, and the answers: give them to `Commands.answer` once all is on the
            disk.
        """
        dispatcher, ledger = self._dispatcher, self._dispatcher.ledger
        messages: list[Message] = []
        answers: list[tuple[int, Answer]] = []
        for number, command in commands.list_unanswered():
            if number <= ledger.commands:  # it was carried out before a start
                is_last = number == ledger.commands
                text = ledger.answer if is_last else "carried out before a start"
                answers.append((number, {"done": True, "text": text}))
                continue
            dispatcher.command = number
            try:
                more, answer = self._obey(command)
            except (InputError, GaveUp) as error:
                more, answer = [], {"done": False, "text": str(error)}
            dispatcher.command = None
            answers.append((number, answer))
            messages += more
        return messages, answers

    def _obey(self, command: Mapping[str, Any]) -> tuple[list[Message], Answer]:
        """Carry out a command; return what is to be sent, and the answer."""
        dispatcher = self._dispatcher
        kind, name, at = command["kind"], str(command.get("name")), command.get("at")
        robot, lasts = command.get("robot"), command.get("work")
        places = [str(command[key]) for key in ("name", "to") if key in command]
        clock = dispatcher.plan.scenario.problem.clock
        ticks = None if lasts is None else clock.count_ticks(Fraction(lasts))
        if kind == "list":
            return [], {"done": True, "text": "", "jobs": list_jobs(dispatcher.ledger)}
        changes: dict[str, Callable[[], list[Message]]] = {
            "add": lambda: dispatcher.add_job(str(at), int(ticks or 0), robot)[1],
            "change": lambda: dispatcher.change_job(name, at, ticks),
            "withdraw": lambda: dispatcher.withdraw_job(name),
            "again": lambda: dispatcher.retry_job(name),
            "skip": lambda: dispatcher.skip_job(name),
            "close": lambda: dispatcher.close(*places),
            "open": lambda: dispatcher.open(*places),
            "place": lambda: dispatcher.place_robot(name, at),
            "replan": dispatcher.replan,
        }
        change = changes.get(kind) or partial(self._operate, kind, command.get("name"))
        messages = change()
        return messages, {"done": True, "text": dispatcher.ledger.answer}

    def _operate(self, kind: str, name: str | None) -> list[Message]:
        """Hold one robot or all, let them go, or confirm where one is."""
        dispatcher, names = self._dispatcher, self._dispatcher.ledger.names
        robots = range(len(names)) if name is None else [find_robot(dispatcher.ledger, name)]
        entry = OPERATIONS.get(kind)
        if entry is None:
            raise InputError.at("command", f"{quote(kind)} is no command (see rightofway jobs)")
        if name is None and kind not in {"hold", "go"}:
            raise InputError.at("robot", f"{kind} needs the name of a robot (give one)")
        text = f"{name or 'all robots'}: {kind}"
        return dispatcher.note(*({**entry, "robot": robot} for robot in robots), text=text)
