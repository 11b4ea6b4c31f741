"""Text files to plain data and back: YAML, JSON and TOML read strictly, JSON laid out for people.

Plain data are mappings, lists, text, whole numbers, decimals, true, false and nothing. Whatever a
file holds instead is an InputError with its place. YAML is built from the parser's events, not by
its constructors: those accept tags that make objects, keys other than text, the later of two equal
keys, decimals as floats, and aliases that expand without end ("billion laughs").
"""

from __future__ import annotations

import gc
import json
import math
import os
import re
import stat
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from decimal import Decimal
from io import StringIO
from itertools import islice
from pathlib import Path
from typing import Any, BinaryIO
from weakref import WeakKeyDictionary

from rightofway.arguments import checks_arguments
from rightofway.deadline import READING, limit_loop
from rightofway.errors import InputError, InputFault, Location, name_file, quote

MAX_BYTES = 2**29
"""Largest file that is read [bytes]."""

LIMIT = "RIGHTOFWAY_MOST_CHARACTERS"
"""The variable of the environment that raises the limit on layouts."""

MAX_CHARACTERS = 60_000_000
"""The longest layout that is read without it: a file takes twenty times its size of memory."""

PIECE = 2**20
"""What is read from a file at once [bytes]."""

MAX_ALIASED = 100_000
"""The most values that may be reached through aliases."""

MAX_DEPTH = 64
"""Mappings and lists inside each other, at most; ours need a dozen."""

LONGEST_TOKEN = 40
"""A number of more characters stays text when a file is read, and is refused as a number."""

LARGEST_EXPONENT = 400
"""A decimal with a larger exponent stays text, too."""

DELAY_FILES = (".yaml", ".yml", ".json")
"""How the names of such files end."""

SPREAD_KEYS = {"scenario", "map", "grid", "roadmap", "vertices", "edges", "robots"}
SPREAD_KEYS |= {"planner", "decisions", "reroutes", "steady"}
"""Values of these keys are spread over lines in JSON; each item in them stays on one line."""

_ENCODER = json.JSONEncoder(ensure_ascii=False, allow_nan=False)
_BEGIN = re.compile(r"(\s*#[^\n]*\n)*\s*format\s*:")
_TOML_PLACE = re.compile(r"(?P<what>.*) \(at line (?P<line>\d+), (?P<column>.*)\)", re.DOTALL)

# What is read as a number here is read as one by YAML 1.1 and 1.2 alike; all else stays text.
_INTEGER = re.compile(r"[+-]?(0|[1-9][0-9]*)")
_DECIMAL = re.compile(r"([+-]?[0-9]+\.[0-9]*|\.[0-9]+)([eE][+-][0-9]+)?")
_WORDS = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}


def parse_document(text: str, path: Path) -> Any:
    """Return the data of a YAML or JSON file, recognized by its name, else by its start.

    A file that is named otherwise, is no YAML and does not begin with a format is plain text, and
    returned as it is: its reader says which document it wants.
    """
    suffix = path.suffix.lower()
    if suffix == ".map":
        message = "a map has no robots (write a scenario with map: {file: ...}, or give a .scen)"
        raise InputError.at("", message)
    if suffix == ".toml":
        message = "TOML is for the suites of benchmarks (write scenarios and plans as YAML or JSON)"
        raise InputError.at("", message)
    if suffix == ".csv":
        remedy = f"write a scenario with robots: {{table: {path.name}}}"
        raise InputError.at("", f"a table of robots has no map ({remedy})")
    looks_like_json = text.lstrip().startswith(("{", "["))
    is_json = suffix == ".json" or (suffix not in {".yaml", ".yml"} and looks_like_json)
    if is_json:
        return parse_json(text)
    try:
        return parse_yaml(text)
    except InputError:
        if suffix in {".yaml", ".yml", ""} or _BEGIN.match(text):
            raise
        return text


@checks_arguments
def load_delays(path: Path | str) -> tuple[str, ...]:
    """Return the lines of a YAML or JSON file with a list of delays, or one under ``delays``.

    Parameters
    ----------
    path
        A name that ends in .yaml, .yml or .json.

    Raises
    ------
    InputError
        If there is no such file, or no list of texts in it.
    """
    with name_file(str(path)):
        causes = parse_document(read_text(Path(path)), Path(path))
        if isinstance(causes, dict) and list(causes) == ["delays"]:
            causes = causes["delays"]
        if not (isinstance(causes, list) and all(isinstance(cause, str) for cause in causes)):
            message = "is no list of delays (write lines like - exponential:0.2)"
            raise InputError.at("", message)
        return tuple(causes)


def read_text(path: Path) -> str:
    """Return the text of a file, UTF-8 with any kind of line end; ``-`` is standard input."""
    source = str(path)
    with name_file(source):
        data = read_content(path)
    if not data or data.isspace():
        raise InputError.at("", "the file is empty (give it some content)", source)
    return _decode(data, source).replace("\r\n", "\n").replace("\r", "\n")


def read_content(path: Path, most: int | None = None) -> bytes | bytearray:
    """Return the bytes of a file, a pipe, or of standard input as ``-``.

    Raises
    ------
    InputError
        If it cannot be read, is a device or a directory, or is longer.

    Notes
    -----
    A pipe can be read only once: what was read of one is kept.
    """
    most = MAX_BYTES if most is None else most
    try:
        if str(path) == "-":
            data = _STREAMS.get(sys.stdin.buffer)
            if data is None:
                data = _STREAMS[sys.stdin.buffer] = _content(sys.stdin.buffer, most)
        else:
            data = _content_of_file(path, most)
    except InputError:
        raise
    except (OSError, ValueError) as error:
        raise InputError.at("", _why_unreadable(error, path)) from None
    if len(data) > most:
        raise _too_long(most)
    return data


_STREAMS: WeakKeyDictionary[BinaryIO, bytearray] = WeakKeyDictionary()
"""What was read of each standard input."""

_PIPES: dict[tuple[int, int], bytearray] = {}
"""What was read of each pipe, by device and number."""


def _content_of_file(path: Path, most: int) -> bytearray:
    status = path.stat()
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError
    is_pipe = stat.S_ISFIFO(status.st_mode) or stat.S_ISSOCK(status.st_mode)
    if not (is_pipe or stat.S_ISREG(status.st_mode)):
        raise InputError.at("", "this is a device (give a file)")
    if status.st_size > most:
        raise _too_long(most)
    key = status.st_dev, status.st_ino
    if is_pipe and key in _PIPES:
        return _PIPES[key]
    with path.open("rb") as file:
        data = _content(file, most)
    if is_pipe:
        _PIPES[key] = data
    return data


def _content(file: BinaryIO, most: int) -> bytearray:
    """Return the bytes of a file up to the limit, in pieces: one read reserves all that it asks."""
    content = bytearray()
    while len(content) <= most and (piece := file.read(PIECE)):
        content += piece
    return content


def _too_long(most: int) -> InputError:
    return InputError.at("", f"the file is longer than {most} bytes (is it the right one?)")


SHORT_LINE = 80
"""Characters of a line in which a fault is found by eye."""

EXCERPT = 25
"""Characters before and after a fault that a message shows of a longer line."""


def choose_limit() -> int:
    """Return how long a layout may be: a limit on the memory that reading it takes."""
    given = os.environ.get(LIMIT)
    if given is None:
        return MAX_CHARACTERS
    if not given.isascii() or not given.isdecimal() or len(given) > LONGEST_TOKEN:
        raise InputError.at("", f"{LIMIT} is {quote(given)} (give a number of characters)")
    return int(given)


def refuse_long(text: str) -> None:
    """Refuse a layout whose reading would take gigabytes.

    Raises
    ------
    InputError
        If it is longer than `choose_limit`.
    """
    if len(text) > choose_limit():
        message = f"the file has {len(text)} characters, more than {choose_limit()}, and takes"
        message += f" about {20 * len(text) // 10**6} MB to read"
        raise InputError.at("", f"{message} (set {LIMIT}={len(text)} if you have them)")


def is_regular(path: Path) -> bool:
    """Return whether a file is there, and is no directory, device or pipe."""
    return os.path.isfile(path)  # noqa: PTH113 - Path.is_file raises for a name that is too long


def refuse_special(path: Path) -> None:
    """Refuse a device or a pipe where a document names a file.

    Raises
    ------
    InputError
        If it is there, and is not a file like others.
    """
    if str(path) == "-":  # readers take it for standard input
        raise InputError.at("", "'-' names no file here (name a file)")
    is_there = os.path.exists(path)  # noqa: PTH110 - Path.exists raises for a long name
    if is_there and not (is_regular(path) or path.is_dir()):
        message = f"{quote(str(path))} is a device or a pipe, not a file (name a file)"
        raise InputError.at("", message)


def find_remedy_for_missing(path: Path) -> str:
    """Return what to do about a file that is not there."""
    if path.parts[:1] == ("examples",):
        return "rightofway examples --copy . writes the examples"
    return "check the path"


def _why_unreadable(error: Exception, path: Path) -> str:
    if isinstance(error, FileNotFoundError):
        return f"there is no such file ({find_remedy_for_missing(path)})"
    if isinstance(error, IsADirectoryError):
        return "this is a directory (give a file in it)"
    reason = error.strerror if isinstance(error, OSError) else str(error)
    return f"the file cannot be read: {reason} (check the path and its permissions)"


def _decode(data: bytes | bytearray, source: str) -> str:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise InputError.at("", "the file is UTF-16 text (save it as UTF-8)", source)
    if b"\0" in data:
        at = data.index(b"\0")
        raise InputError.at("", f"the file is not text: byte {at} is 0 (give a text file)", source)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        message = f"byte {data[error.start]:#x} is not UTF-8 (save the file as UTF-8)"
        raise InputError.at(Location(line=line), message, source) from None


def read_whole(token: str) -> int | str:
    """Return a whole number of a file, or its text where it is too long."""
    return int(token) if len(token) <= LONGEST_TOKEN else token


def read_decimal(token: str) -> Decimal | str:
    """Return a decimal of a file exactly, or its text where no float comes near it."""
    _, _, exponent = token.lower().partition("e")
    if len(token) > LONGEST_TOKEN or abs(int(exponent or "0")) > LARGEST_EXPONENT:
        return token
    return Decimal(token) if math.isfinite(float(token)) else token


def parse_json(text: str) -> Any:
    """Return the data of a JSON text; no key may be given twice, nor be nested too deeply."""
    doubled: list[tuple[dict[str, Any], str]] = []  # mappings, each with a key given twice

    def mapping_of(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        mapping = dict(pairs)
        if len(mapping) < len(pairs):
            counts = Counter(key for key, _ in pairs)
            doubled.extend((mapping, key) for key, count in counts.items() if count > 1)
        return mapping

    try:
        data = json.loads(
            text,
            object_pairs_hook=mapping_of,
            parse_float=read_decimal,
            parse_int=read_whole,
            parse_constant=str,  # NaN and Infinity: words, and refused as words
        )
    except json.JSONDecodeError as error:
        column = describe_column(text, error.lineno, error.colno)
        raise _fault(error.lineno, f"{error.msg}{column} (check the JSON there)") from None
    except RecursionError:
        raise _too_deep() from None
    check_depth(data)
    if doubled:
        raise InputError(
            InputFault(
                _path_to(mapping, data),
                f"the key {quote(key)} is given twice (take one out)",
            )
            for mapping, key in doubled
        )
    return data


def describe_column(text: str, line: int, column: int) -> str:
    """Return the column of a fault with the text around it; nothing where the line is short.

    Line and column count from 1.
    """
    written = next(islice(StringIO(text), line - 1, None), "").rstrip("\n")
    if len(written) <= SHORT_LINE:
        return ""
    around = written[max(column - 1 - EXCERPT, 0) : column - 1 + EXCERPT]
    return f" at column {column}, in {quote(around)}"


def _path_to(target: dict[str, Any], data: Any) -> tuple[str | int, ...]:
    waiting: list[tuple[tuple[str | int, ...], Any]] = [((), data)]
    while waiting:
        path, node = waiting.pop()
        if node is target:
            return path
        if isinstance(node, dict | list):
            steps = node.items() if isinstance(node, dict) else enumerate(node)
            waiting += [((*path, step), child) for step, child in steps]
    return ()  # a key given twice has overwritten the mapping


def check_depth(data: Any) -> None:
    """Refuse data in which mappings and lists are inside each other more than `MAX_DEPTH` deep."""
    level = [data] if isinstance(data, dict | list) else []
    for _ in range(MAX_DEPTH):
        level = [
            child
            for node in level
            for child in (node.values() if isinstance(node, dict) else node)
            if isinstance(child, dict | list)
        ]
        if not level:
            return
    raise _too_deep()


def _too_deep(line: int | None = None) -> InputError:
    message = f"values are nested more than {MAX_DEPTH} deep (a document needs no such depth)"
    return InputError.at(Location(line=line), message)


def parse_toml(text: str) -> dict[str, Any]:
    """Return the data of a TOML text."""
    import tomllib  # here: few commands read TOML

    try:
        return tomllib.loads(text, parse_float=read_decimal)
    except RecursionError:
        raise InputError.at("", "it is nested too deeply (make it flatter)") from None
    except ValueError as error:
        match = _TOML_PLACE.fullmatch(str(error))
        fault = match["what"] if match else str(error)
        message = f"this is no TOML: {fault[:1].lower()}{fault[1:]} (mend it)"
        where = Location(line=int(match["line"]), path=(match["column"],)) if match else ""
        raise InputError.at(where, message) from None


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
            raise _fault(line, message) from None
        if "nesting" in (error.problem or ""):  # libyaml from 0.2.6 looks ahead, and counts first
            raise _too_deep(line) from None
        begin = error.context_mark
        problem = str(error.problem)
        if begin and begin.line + 1 < line:
            problem += f" for what begins in line {begin.line + 1}"
        column = describe_column(text, line, mark.column + 1) if mark else ""
        raise _fault(line, f"{problem}{column} (check the YAML there)") from None
    except (yaml.YAMLError, ValueError, OverflowError) as error:
        reason = getattr(error, "reason", None) or "characters that no YAML file may hold"
        raise InputError.at("", f"{reason} (save the file as plain text)") from None
    return builder.data


def _fault(line: int, message: str) -> InputError:
    return InputError.at(Location(line=line), message)


@dataclass(slots=True)
class _Open:
    """A mapping or list that is not closed yet."""

    value: dict[str, Any] | list[Any]
    anchor: str | None
    key: str | None = None  # of a mapping: the key whose value comes next
    size: int = 1  # values in it, aliases counted in full


@dataclass(slots=True)
class _Builder:
    """Takes events one by one; `data` is what they make."""

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
            raise _fault(line, f"the tag {quote(tag)} is not allowed (take it out)")
        match type(event).__name__:
            case "DocumentStartEvent":
                self.documents += 1
                if self.documents > 1:
                    raise _fault(line, "a second document begins (keep one in a file)")
            case "ScalarEvent":
                self._add(_scalar(event), 1, event.anchor, line)
            case "AliasEvent":
                value, size = self._named(event.anchor, line)
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
            raise _too_deep(line)
        if opened.anchor is not None:
            self.anchored.pop(opened.anchor, None)
        self.open.append(opened)

    def _named(self, anchor: str, line: int) -> tuple[Any, int]:
        """Return the value that an alias stands for, and its size."""
        if anchor not in self.anchored:
            inside = any(opened.anchor == anchor for opened in self.open)
            fault = "stands inside what it names" if inside else "names nothing before it"
            raise _fault(line, f"the alias *{anchor} {fault} (write the value out)")
        self.aliased += self.anchored[anchor][1]
        if self.aliased > MAX_ALIASED:
            message = f"aliases stand for more than {MAX_ALIASED} values (write out what is meant)"
            raise _fault(line, message)
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
            raise _fault(line, f"{message} (put it in quotes, or add what is missing)")
        elif value in parent.value:
            remedy = "write lists as [0, 1]" if value.endswith(")") else "take one out"
            raise _fault(line, f"the key {quote(value)} is given twice ({remedy})")
        else:
            parent.key = value


def _scalar(event: Any) -> Any:
    text: str = event.value
    is_plain, _ = event.implicit
    if not is_plain:
        return text
    if text in _WORDS:
        return _WORDS[text]
    if _INTEGER.fullmatch(text):
        return read_whole(text)
    return read_decimal(text) if _DECIMAL.fullmatch(text) else text


def format_json(document: dict[str, Any]) -> str:
    """Return a document as JSON text with one row, robot or edge on a line."""
    return _spread(document, "\n") + "\n"


def _spread(value: dict[str, Any] | list[Any], margin: str) -> str:
    inner = margin + "  "
    if isinstance(value, list):
        return f"[{inner}{f',{inner}'.join(map(format_json_line, value))}{margin}]"
    pairs = (
        f"{format_json_line(key)}: "
        + (_spread(child, inner) if _is_spread(key, child) else format_json_line(child))
        for key, child in value.items()
    )
    return f"{{{inner}{f',{inner}'.join(pairs)}{margin}}}"


def _is_spread(key: str, value: Any) -> bool:
    return key in SPREAD_KEYS and isinstance(value, list | dict) and bool(value)


def format_json_line(value: Any) -> str:
    """Return a value as JSON text on one line."""
    return _ENCODER.encode(value)


@contextmanager
def pause_garbage_collection() -> Iterator[None]:
    """Look for no cycles of objects inside: a file becomes millions of objects, all of which stay.

    Threads may overlap: the first one that paused the collection resumes it. What was made inside
    counts as old then, or the next look would be at all of it: 1.7 s of a file of 52 MB.
    """
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            if not gc.get_freeze_count():  # what a program has frozen stays so
                gc.freeze()
                gc.unfreeze()
            gc.enable()
