"""Conformance of the messages of a robot to VDA 5050: official schemas, headers and contents.

No network is here. Every departure is a fact that is counted once, however many messages have it.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from datetime import datetime
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.control import vda5050
from rightofway.control.identities import VERSIONS
from rightofway.errors import InputError, quote
from rightofway.execution.probe_result import ProbeFinding, Verdict
from rightofway.facts import Fact

if TYPE_CHECKING:
    from jsonschema import Draft202012Validator, ValidationError

__all__ = [
    "MessageAudit",
    "choose_version",
    "find_schema",
    "get_list",
    "get_mapping",
    "read_position",
]

SCHEMAS = Path(__file__).with_name("schemas")
"""The official schemas, see the README there."""

READ: Mapping[str, type[vda5050.Body]] = {
    "state": vda5050.StateMessage,
    "connection": vda5050.ConnectionMessage,
    "factsheet": vda5050.Factsheet,
}
"""The models with which the control reads the topics of a robot."""

TIMESTAMP = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z")
"""A time of a header: ISO 8601, UTC."""

MOST_SECONDS = 30.0
"""The largest difference of the clock of a robot from that of this machine [s]."""

STEP = 60
"""The difference of clocks is rounded to this, so that it is one finding [s]."""

MOST_FAULTS = 20
"""Departures from a schema that one message may show."""


@cache
def find_schema(version: str, topic: str) -> Draft202012Validator | None:
    """Return the official schema of a topic, None where the version has none."""
    from jsonschema import Draft202012Validator

    path = SCHEMAS / version / f"{topic}.schema"
    if not path.exists():
        return None
    return Draft202012Validator(json.loads(path.read_text(encoding="utf-8-sig")))


def choose_version(given: object, major: str) -> str:
    """Return the known version that is nearest to the one of a header.

    Parameters
    ----------
    given
        The value of ``version``.
    major
        The version of the topic, such as ``v2``.
    """
    text = str(given)
    if text in VERSIONS:
        return text
    alike = [version for version in VERSIONS if version.rpartition(".")[0] == text]
    return alike[0] if alike else "3.0.0" if major == "v3" else "2.1.0"


class MessageAudit:
    """The departures of a robot's messages from the norm.

    Parameters
    ----------
    manufacturer, serial_number
        The robot, as topics have it.
    version
        The version of VDA 5050 whose schemas count.

    Attributes
    ----------
    counts
        How many messages of each topic were audited.
    """

    def __init__(self, manufacturer: str, serial_number: str, version: str) -> None:
        self._expected = {"manufacturer": manufacturer, "serialNumber": serial_number}
        self._version = version
        self._findings: dict[ProbeFinding, None] = {}
        self._header_ids: dict[str, int] = {}
        self.counts = Counter[str]()

    @property
    def findings(self) -> tuple[ProbeFinding, ...]:
        """The departures so far, each once."""
        return tuple(self._findings)

    def take(
        self, topic: str, payload: bytes, *, now: datetime, is_retained: bool = False
    ) -> dict[str, Any] | None:
        """Audit a message; return its content, None where it is no JSON object.

        Parameters
        ----------
        topic
            The last part of its topic.
        payload
            The message.
        now
            When it came, in UTC.
        is_retained
            Whether the broker had kept it from before.
        """
        self.counts[topic] += 1
        try:
            document = json.loads(payload)
        except (ValueError, RecursionError):
            document = None
        if not isinstance(document, dict):
            excerpt = quote(payload[:60].decode(errors="replace"))
            self._note(topic, "blocks", Fact("no JSON object", message=excerpt))
            return None
        self._compare_schema(topic, document)
        self._check_header(topic, document, now, is_retained=is_retained)
        self._try_reader(topic, document)
        if is_retained and topic == "state":
            self._note(topic, "departs", Fact("state is retained"))
        return document

    def _note(self, topic: str, verdict: Verdict, fact: Fact) -> None:
        self._findings[ProbeFinding(topic, verdict, fact)] = None

    def _compare_schema(self, topic: str, document: dict[str, Any]) -> None:
        """Note departures from the official schema."""
        schema = find_schema(self._version, topic)
        if schema is None:
            self._note(topic, "note", Fact("no official schema", version=self._version))
            return
        for number, error in enumerate(schema.iter_errors(document)):
            if number == MOST_FAULTS:
                break
            for fact in _describe_error(error):
                self._note(topic, "departs", fact)

    def _check_header(
        self, topic: str, document: dict[str, Any], now: datetime, *, is_retained: bool
    ) -> None:
        """Note departures of the header: names, version, count of messages, time."""
        for key, value in self._expected.items():
            given = document.get(key, value)
            if given != value:
                fact = Fact("header contradicts topic", key=key, given=quote(given), wanted=value)
                self._note(topic, "blocks", fact)
        version = document.get("version", self._version)
        if version not in VERSIONS:
            fact = Fact("unknown version", given=quote(version), taken=self._version)
            self._note(topic, "note", fact)
        self._check_count(topic, document.get("headerId"), is_retained=is_retained)
        if (timestamp := document.get("timestamp")) is not None and not is_retained:
            self._check_time(topic, timestamp, now)

    def _check_count(self, topic: str, number: object, *, is_retained: bool) -> None:
        """Note header ids that do not count the messages of their topic."""
        if not isinstance(number, int) or is_retained:
            return
        before = self._header_ids.get(topic)
        self._header_ids[topic] = number
        if before is not None and number <= before:
            self._note(topic, "departs", Fact("header id does not count"))
        elif before is not None and number > before + 1:
            self._note(topic, "note", Fact("header id has gaps"))

    def _check_time(self, topic: str, timestamp: object, now: datetime) -> None:
        """Note a time that is not ISO 8601 in UTC, and a clock that differs from ours."""
        if not isinstance(timestamp, str) or not TIMESTAMP.fullmatch(timestamp):
            # One finding for each way to write a time, not one for each message.
            self._note(topic, "departs", Fact("timestamp of other form", form=_mask(timestamp)))
            return
        try:
            apart = abs((datetime.fromisoformat(timestamp) - now).total_seconds())
        except ValueError:
            self._note(topic, "departs", Fact("timestamp of other form", form=_mask(timestamp)))
            return
        if apart > MOST_SECONDS:
            self._note(topic, "note", Fact("clock differs", seconds=STEP * round(apart / STEP)))

    def _try_reader(self, topic: str, document: dict[str, Any]) -> None:
        """Note a message that the control cannot use."""
        model = READ.get(topic)
        if model is None:
            return
        try:
            vda5050.read(model, document, topic)
        except InputError as error:
            self._note(topic, "blocks", Fact("unusable message", error=str(error)))


def _mask(timestamp: object) -> str:
    """Return the form of a time: each digit as 0."""
    return quote(re.sub(r"\d", "0", timestamp) if isinstance(timestamp, str) else timestamp)


def _describe_error(error: ValidationError) -> Iterator[Fact]:
    """Return the facts of a departure from a schema; numbers of list items are left out."""
    key = _name_key(error.absolute_path)
    value: Any = error.validator_value
    match error.validator:
        case "required":
            for name in value:
                if name not in dict(error.instance):  # type: ignore[arg-type]  # an object
                    yield Fact("key missing", key=f"{key}.{name}" if key else name)
        case "type" if error.instance is None:
            yield Fact("key null", key=key)
        case "type":
            kinds = (value,) if isinstance(value, str) else tuple(value)
            yield Fact("key of other type", key=key, given=quote(error.instance), wanted=kinds)
        case "enum":
            known = tuple(map(str, value))
            yield Fact("value not in norm", key=key, given=quote(error.instance), known=known)
        case rule:
            yield Fact("schema broken", key=key, given=quote(error.instance), rule=str(rule))


def _name_key(path: Any) -> str:
    """Return the place of a key, such as ``nodeStates[].nodeId``."""
    name = ""
    for part in path:
        name += "[]" if isinstance(part, int) else f".{part}" if name else str(part)
    return name


def read_position(state: Mapping[str, Any]) -> dict[str, Any] | None:
    """Return x, y and map of a state, None where it has no complete position."""
    given = get_mapping(state, "agvPosition", "mobileRobotPosition")
    is_known = given.get("positionInitialized", given.get("localized", True)) is not False
    numbers = [given.get("x"), given.get("y")]
    is_complete = all(
        isinstance(number, int | float) and not isinstance(number, bool) for number in numbers
    ) and isinstance(given.get("mapId"), str)
    if not (is_known and is_complete):
        return None
    return {"x": float(given["x"]), "y": float(given["y"]), "mapId": given["mapId"]}


def get_mapping(document: Mapping[str, Any], *keys: str) -> Mapping[str, Any]:
    """Return the first of some keys that has a mapping, an empty one without."""
    values = map(document.get, keys)
    return next((value for value in values if isinstance(value, Mapping)), {})


def get_list(document: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
    """Return the mappings in the list of a key."""
    given = document.get(key)
    return [item for item in given if isinstance(item, Mapping)] if isinstance(given, list) else []
