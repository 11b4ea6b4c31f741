"""YAML, read strictly to plain data.

Data are built from the parser's events, not by its constructors: those accept tags that make
objects, keys other than text, the later of two equal keys, decimals as floats, and aliases that
expand without end ("billion laughs").
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

from rightofway.deadline import READING, limit_loop
from rightofway.errors import InputError, quote
from rightofway.io.plain_data import (
    MAX_DEPTH,
    describe_column,
    make_depth_fault,
    make_line_fault,
    read_decimal,
    read_whole,
)

MAX_ALIASED = 100_000
"""The most values that may be reached through aliases."""

# What is read as a number here is read as one by YAML 1.1 and 1.2 alike; all else stays text.
_INTEGER = re.compile(r"[+-]?(0|[1-9][0-9]*)")
_DECIMAL = re.compile(r"([+-]?[0-9]+\.[0-9]*|\.[0-9]+)([eE][+-][0-9]+)?")
_WORDS = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}


def parse_yaml(text: str, *, number_keys: bool = False) -> Any:
    """Return the data of a YAML text, decimals exactly as they are written.

    With ``number_keys``, keys may be whole numbers, which become text.
    """
    import yaml

    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    builder = _Builder(number_keys)
    try:
        for event in limit_loop(yaml.parse(text, Loader=loader), READING):
            builder.take(event)
    except InputError:
        raise
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        line = mark.line + 1 if mark else 1
        rest = text.split("\n")[mark.line :] if mark else []
        if mark and rest and rest[0][mark.column : mark.column + 1] == "\t":
            message = "a tab stands where YAML wants spaces (use spaces)"
            raise make_line_fault(line, message) from None
        if "nesting" in (error.problem or ""):  # libyaml from 0.2.6 looks ahead, and counts first
            raise make_depth_fault(line) from None
        begin = error.context_mark
        problem = str(error.problem)
        if begin and begin.line + 1 < line:
            problem += f" for what begins in line {begin.line + 1}"
        column = describe_column(text, line, mark.column + 1) if mark else ""
        raise make_line_fault(line, f"{problem}{column} (check the YAML there)") from None
    except (yaml.YAMLError, ValueError, OverflowError) as error:
        reason = getattr(error, "reason", None) or "characters that no YAML file may hold"
        raise InputError.at("", f"{reason} (save the file as plain text)") from None
    return builder.data


@dataclass(slots=True)
class _Open:
    """A mapping or list that is not closed yet."""

    value: dict[str, Any] | list[Any]
    anchor: str | None
    key: str | None = None  # of a mapping: the key whose value comes next
    size: int = 1  # values in it, aliases counted in full


@dataclass(slots=True)
class _Builder:
    """Takes events one by one; `data` is their result."""

    number_keys: bool
    data: Any = None
    documents: int = 0
    aliased: int = 0
    open: list[_Open] = field(default_factory=list)
    anchored: dict[str, tuple[Any, int]] = field(default_factory=dict)

    def take(self, event: Any) -> None:
        """Take the next event of the parser."""
        line, tag = event.start_mark.line + 1, getattr(event, "tag", None)
        if tag is not None:
            raise make_line_fault(line, f"the tag {quote(tag)} is not allowed (take it out)")
        match type(event).__name__:
            case "DocumentStartEvent":
                self.documents += 1
                if self.documents > 1:
                    raise make_line_fault(line, "a second document begins (keep one in a file)")
            case "ScalarEvent":
                self._add(_read_scalar(event), 1, event.anchor, line)
            case "AliasEvent":
                value, size = self._find_named(event.anchor, line)
                self._add(value, size, None, line)
            case "SequenceStartEvent":
                self._begin(_Open([], event.anchor), line)
            case "MappingStartEvent":
                self._begin(_Open({}, event.anchor), line)
            case "SequenceEndEvent" | "MappingEndEvent":
                closed = self.open.pop()
                self._add(closed.value, closed.size, closed.anchor, line)

    def _begin(self, opened: _Open, line: int) -> None:
        if len(self.open) == MAX_DEPTH:
            raise make_depth_fault(line)
        if opened.anchor is not None:
            self.anchored.pop(opened.anchor, None)
        self.open.append(opened)

    def _find_named(self, anchor: str, line: int) -> tuple[Any, int]:
        """Return the value that an alias stands for, and its size."""
        if anchor not in self.anchored:
            inside = any(opened.anchor == anchor for opened in self.open)
            fault = "stands inside what it names" if inside else "names nothing before it"
            raise make_line_fault(line, f"the alias *{anchor} {fault} (write the value out)")
        self.aliased += self.anchored[anchor][1]
        if self.aliased > MAX_ALIASED:
            message = f"aliases stand for more than {MAX_ALIASED} values (write out what is meant)"
            raise make_line_fault(line, message)
        return self.anchored[anchor]

    def _add(self, value: Any, size: int, anchor: str | None, line: int) -> None:
        if anchor is not None:
            self.anchored[anchor] = (value, size)
        if not self.open:
            self.data = value
            return
        parent = self.open[-1]
        parent.size += size
        if isinstance(parent.value, list):
            parent.value.append(value)
        elif parent.key is not None:
            parent.value[parent.key] = value
            parent.key = None
        elif self.number_keys and type(value) is int and str(value) not in parent.value:
            parent.key = str(value)
        elif not isinstance(value, str):
            message = f"the key {quote(value)} is not text"
            raise make_line_fault(line, f"{message} (put it in quotes, or add what is missing)")
        elif value in parent.value:
            remedy = "write lists as [0, 1]" if value.endswith(")") else "take one out"
            raise make_line_fault(line, f"the key {quote(value)} is given twice ({remedy})")
        else:
            parent.key = value


def _read_scalar(event: Any) -> Any:
    text: str = event.value
    is_plain, _ = event.implicit
    if not is_plain:
        return text
    if text in _WORDS:
        return _WORDS[text]
    if _INTEGER.fullmatch(text):
        return read_whole(text)
    return read_decimal(text) if _DECIMAL.fullmatch(text) else text
