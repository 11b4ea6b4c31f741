"""Faults of a document with the line of its text that they stand in, and the names of list items.

Marks are taken only when there is a fault: the text is then read once more, by the YAML library,
which knows the line of each value. JSON is read in the same way, because it is YAML as well.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.errors import InputError, InputFault, is_printable
from rightofway.io.faults import blaming
from rightofway.io.text import MAX_DEPTH, parse_document, read_text

if TYPE_CHECKING:
    import yaml

MAX_CHARACTERS = 500_000
"""Faults in a longer text are reported without lines: to find them would take seconds."""

LONGEST_NAME = 40
"""A longer name is not shown beside a place."""

_STEP = re.compile(r"\.?(?P<key>[^\W\d]\w*)|\[(?P<index>\d+)\]|\[(?P<text>'[^']*'|\"[^\"]*\")\]")
_JSON_ONLY = re.compile(r"\\u[dD][89a-fA-F][0-9a-fA-F]{2}|\\/|\t")


@contextmanager
def document_of(path: Path, text: str | None = None) -> Iterator[Any]:
    """Yield the data of a YAML or JSON file; faults raised inside name the file and the line.

    Parameters
    ----------
    path
        The file.
    text
        Its content, where that is known already.
    """
    with blaming(str(path)):
        text = read_text(path) if text is None else text
        data = parse_document(text, path)
        try:
            yield data
        except InputError as error:
            if error.source:
                raise
            raise InputError(marked(error.faults, text)) from None


def marked(faults: Iterable[InputFault], text: str) -> Iterator[InputFault]:
    """Yield faults of a document with lines and names, as far as its text shows them.

    Parameters
    ----------
    faults
        The faults, with places in the document.
    text
        The text that the document was read from.
    """
    faults = list(faults)
    has_places = any(fault.place and fault.line is None for fault in faults)
    root = _root(text) if has_places else None
    for fault in faults:
        yield _marked(fault, root) if root and fault.place and fault.line is None else fault


def _root(text: str) -> yaml.Node | None:
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
    """Tell whether values are nested too deeply to be read by recursion, as the library does."""
    import yaml

    depth = 0
    for event in events:
        depth += isinstance(event, yaml.CollectionStartEvent)
        depth -= isinstance(event, yaml.CollectionEndEvent)
        if depth > MAX_DEPTH:
            return True
    return False


def _marked(fault: InputFault, root: yaml.Node) -> InputFault:
    """Follow a fault's place from the root of the document, as far as there are values."""
    node, line, named, reached = root, root.start_mark.line, "", 0
    robot = whole = ""  # the name of the robot that it is about; what is named up to there
    for step in _STEP.finditer(fault.place):
        found = _child(node, step) if step.start() == reached else None
        if found is None:
            break
        node, line = found
        reached = step.end()
        named += step[0].removeprefix(".") if named.endswith(": ") else step[0]
        name = _name(node) if step["index"] else ""
        named += f" ({name}): " if name else ""
        if name and not robot and fault.path[0] == "robots":
            robot, whole = name, named
    rest = fault.place[reached:]
    named += rest.removeprefix(".") if named.endswith(": ") else rest
    about = f"{robot}: {named[len(whole) :]}" if robot else named
    named, about = named.removesuffix(": "), about.removesuffix(": ")
    return replace(fault, line=line + 1, named=named, about=about)


def _child(node: yaml.Node, step: re.Match[str]) -> tuple[yaml.Node, int] | None:
    """Return the value that a step of a place leads to, and its line, from 0; None without one."""
    import yaml

    if step["index"]:
        index = int(step["index"])
        if isinstance(node, yaml.SequenceNode) and index < len(node.value):
            item: yaml.Node = node.value[index]
            return item, item.start_mark.line
        if isinstance(node, yaml.ScalarNode) and node.style == "|":  # rows of a grid
            return node, node.start_mark.line + 1 + index
        return None
    key = step["key"] or ast.literal_eval(step["text"])
    if isinstance(node, yaml.MappingNode):
        for name, value in node.value:
            if isinstance(name, yaml.ScalarNode) and name.value == key:
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
