"""The lines of a document's faults, and the names of the list items in which they stand.

Lines are looked up only when there is a fault: the text is then read once more, by the library for
YAML, which knows the line of each value. JSON is read in the same way, because it is YAML as well.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.errors import InputError, InputFault, Location, is_printable, name_file
from rightofway.io.content import read_text
from rightofway.io.documents import parse_document
from rightofway.io.plain_data import MAX_DEPTH

if TYPE_CHECKING:
    import yaml

MAX_CHARACTERS = 500_000
"""Faults in a longer text are reported without lines: to find them would take seconds."""

LONGEST_NAME = 40
"""A longer name is not shown beside a place."""

_JSON_ONLY = re.compile(r"\\u[dD][89a-fA-F][0-9a-fA-F]{2}|\\/|\t")


@contextmanager
def open_document(path: Path, text: str | None = None) -> Iterator[Any]:
    """Yield the data of a YAML or JSON file; faults raised inside name the file and the line."""
    with name_file(str(path)):
        text = read_text(path) if text is None else text
        data = parse_document(text, path)
        with add_lines(text):
            yield data


@contextmanager
def add_lines(text: str) -> Iterator[None]:
    """Add lines and names to the faults that are raised inside."""
    try:
        yield
    except InputError as error:
        raise InputError(locate(error.faults, text)) from None


def locate(faults: Iterable[InputFault], text: str) -> Iterator[InputFault]:
    """Yield faults of a document with lines and names, as far as its text shows them."""
    faults = list(faults)
    has_no_lines = [bool(fault.path) and fault.line is None and not fault.file for fault in faults]
    root = _read_root(text) if any(has_no_lines) else None
    for fault, has_no_line in zip(faults, has_no_lines, strict=True):
        if root is None or not has_no_line:
            yield fault
        else:
            yield fault.place_at(_locate(fault.location, root))


def locate_inner(faults: Iterable[InputFault], text: str) -> Iterator[InputFault]:
    """Yield faults with lines and names where they are in another file, which has this text."""
    for fault in faults:
        inner = fault.location.inner
        if inner is None:
            yield fault
            continue
        (located,) = locate([fault.place_at(replace(inner, file=""))], text)
        place = replace(located.location, file=inner.file)
        yield fault.place_at(replace(fault.location, inner=place))


def _read_root(text: str) -> yaml.Node | None:
    import yaml

    if len(text) > MAX_CHARACTERS:
        return None
    if text.lstrip().startswith(("{", "[")):
        text = _JSON_ONLY.sub(" ", text)  # what YAML reads otherwise; lines stay as they are
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        if _is_deep(yaml.parse(text, Loader=loader)):
            return None
        root: yaml.Node | None = yaml.compose(text, Loader=loader)
    except (yaml.YAMLError, ValueError):
        return None
    return root


def _is_deep(events: Iterable[yaml.Event]) -> bool:
    """Return whether values are nested too deeply to be read by recursion, as the library does."""
    import yaml

    depth = 0
    for event in events:
        depth += isinstance(event, yaml.CollectionStartEvent)
        depth -= isinstance(event, yaml.CollectionEndEvent)
        if depth > MAX_DEPTH:
            return True
    return False


def _locate(location: Location, root: yaml.Node) -> Location:
    """Return a location with line and names, its path followed as far as there are values."""
    node, line, names = root, root.start_mark.line, list[str]()
    for step in location.path:
        child = _find_child(node, step)
        if child is None:
            break
        node, line = child
        names.append(_name(node) if isinstance(step, int) else "")
    return replace(location, line=line + 1, names=tuple(names))


def _find_child(node: yaml.Node, step: str | int) -> tuple[yaml.Node, int] | None:
    """Return the value that a step of a path leads to, and its line, from 0; None without one."""
    import yaml

    if isinstance(step, int):
        if isinstance(node, yaml.SequenceNode) and step < len(node.value):
            item: yaml.Node = node.value[step]
            return item, item.start_mark.line
        if isinstance(node, yaml.ScalarNode) and node.style == "|":  # rows of a grid
            return node, node.start_mark.line + 1 + step
    elif isinstance(node, yaml.MappingNode):
        for name, value in node.value:
            if isinstance(name, yaml.ScalarNode) and name.value == step:
                return value, name.start_mark.line
    return None


def _name(node: yaml.Node) -> str:
    """Return the name of a list's item, where it has one that can be shown."""
    import yaml

    for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
        if key.value == "name" and isinstance(value, yaml.ScalarNode):
            name: str = value.value
            return name if is_printable(name) and len(name) <= LONGEST_NAME else ""
    return ""
