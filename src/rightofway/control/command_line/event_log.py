"""The log of a control: a line for each event, as a sentence or as JSON."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any, Literal

import click

from rightofway.cli.terminal import say

if TYPE_CHECKING:
    from rightofway.control.endpoints import Letter
    from rightofway.facts import Fact
    from rightofway.model import Scenario
    from rightofway.report.facts import FactWriter

Level = Literal["debug", "info", "warning"]

LEVELS: tuple[Level, ...] = ("debug", "info", "warning")
"""Levels of events: messages, events, and trouble that begins."""


def add_log_options(command: Any) -> Any:
    """Add the options of the log of a control."""
    form = click.option("--log", type=click.Choice(["text", "json"]), default="text",
                        metavar="FORM", show_default=True,
                        help="Lines of the log with --broker: text or json.")  # fmt: skip
    level = click.option("--log-level", type=click.Choice(LEVELS), default="info",
                         metavar="LEVEL",
                         show_default=True,
                         help="Level of the log: debug (each message), info (each event) or warning"
                         " (trouble that begins).")  # fmt: skip
    return form(level(command))


@dataclass(slots=True, kw_only=True)
class EventLog:
    """The log of a control, on standard error.

    Attributes
    ----------
    scenario
        The scenario of the plan.
    level
        The least level that is written.
    as_json
        Whether each line is a JSON object.
    """

    scenario: Scenario
    level: Level
    as_json: bool
    _writer: FactWriter = field(init=False)

    def __post_init__(self) -> None:
        from rightofway.report.facts import FactWriter

        self._writer = FactWriter(self.scenario)

    def inform(self, fact: Fact) -> None:
        """Write an event."""
        self._write("info", fact)

    def warn(self, fact: Fact) -> None:
        """Write trouble that begins."""
        self._write("warning", fact)

    @property
    def has_messages(self) -> bool:
        """Whether messages are written."""
        return self.level == "debug"

    def trace(self, letter: Letter, is_sent: bool) -> None:
        """Write a message that was sent or received."""
        text = letter.payload.decode(errors="replace")
        direction = "sent" if is_sent else "received"
        if self.as_json:
            details = {"direction": direction, "topic": letter.topic, "message": text}
            self._put("debug", "message", details)
        else:
            self._put("debug", f"{direction} {letter.topic} {text}", {})

    def _write(self, level: Level, fact: Fact) -> None:
        if LEVELS.index(level) < LEVELS.index(self.level):
            return
        details: dict[str, Any] = {}
        if self.as_json:
            details = {**self._writer.export(fact)}
        self._put(level, str(self._writer.write(fact)), details)

    def _put(self, level: Level, text: str, details: dict[str, Any]) -> None:
        """Write a line; times of people are local, those of programs in UTC."""
        if not self.as_json:
            say(f"{datetime.now().astimezone():%H:%M:%S}  {text}")
            return
        time = datetime.now(UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")
        line = {"time": time, "level": level, "text": text, **details}
        say(json.dumps(line, ensure_ascii=False))
