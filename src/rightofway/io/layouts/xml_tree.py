"""XML files as a tree of elements with lines; files that declare entities are refused.

Only expat is used, and no entity is ever expanded: that rules out "billion laughs" and files that
are read over the network. Names are without namespaces.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.parsers import expat

from rightofway.deadline import READING, STEPS_BETWEEN_LOOKS, check_work
from rightofway.errors import InputError, Location, quote
from rightofway.io.content import LIMIT, choose_limit
from rightofway.io.layouts.xml_run import ElementRun, cut_run
from rightofway.io.plain_data import describe_column
from rightofway.io.source import Source

MAX_DEPTH = 64
"""Elements inside each other, at most."""

CHARACTERS_PER_ELEMENT = 40
"""One element is allowed for this part of the characters that a layout may have."""


@dataclass(slots=True)
class Element(Source):
    """An element of an XML file: its value is the mapping of its attributes."""

    name: str = ""
    children: list[Element] = field(default_factory=list)
    content: str = ""
    run: ElementRun | None = None  # the elements that follow it in the same form

    def list_children(self, name: str) -> Iterator[Element]:
        """Yield the children; of a run only where a name occurs in it, after the first one.

        A reader that sets the run of the first one to None gets no other elements of it.
        """
        for child in self.children:
            yield child
            if child.run is not None and name in {
                child.name,
                *(own.name for own in child.children),
            }:
                yield from _expand_run(child.run)

    def list_all(self, name: str) -> Iterator[Element]:
        """Yield the children of a name."""
        return (child for child in self.list_children(name) if child.name == name)

    def list_descendants(self, name: str) -> Iterator[Element]:
        """Yield all elements of a name inside, each before those inside it."""
        opened = [self.list_children(name)]
        while opened:
            for child in opened[-1]:
                if child.name == name:
                    yield child
                if child.children:
                    opened.append(child.list_children(name))
                    break
            else:
                opened.pop()


def _strip_namespaces(attributes: dict[str, str]) -> dict[str, str]:
    for key in attributes:
        if " " in key:
            return {key.rpartition(" ")[2]: value for key, value in attributes.items()}
    return attributes


class _LocalNames(dict[str, str]):
    """Names without their namespaces; a million elements have a handful."""

    def __missing__(self, name: str) -> str:
        self[name] = name.rpartition(" ")[2]
        return self[name]


def _make_size_fault(line: int, most: int | None) -> InputError:
    """Return the fault of a file with more than so many elements; None for one that is too deep."""
    if most is None:
        message = f"its elements are more than {MAX_DEPTH} deep (is it the right file?)"
    else:
        remedy = f"set {LIMIT}={2 * CHARACTERS_PER_ELEMENT * most} for twice as many"
        message = f"the file has more than {most} elements ({remedy})"
    return InputError.at(Location(line=line), message)


def _expand_run(run: ElementRun) -> list[Element]:
    """Return the elements of a run."""
    elements = parse_xml(f"<run>{run.text}</run>").children
    for element in elements:
        for part in (element, *element.children):
            part.line = (part.line or 1) + run.line - 1
    return elements


def parse_xml(text: str, run_of: str = "") -> Element:
    """Return the root of an XML text.

    Elements of the name ``run_of`` may be many and alike: those that follow the first one in the
    same form are its `ElementRun`.

    Raises
    ------
    InputError
        If it is no XML, declares entities, or is too large or too deep.
    """
    most = choose_limit() // CHARACTERS_PER_ELEMENT
    shorter, run = cut_run(text, run_of, most)
    if run is None:
        return _parse_whole(text, most).children[0]
    try:
        document = _parse_whole(shorter, most)
    except InputError:  # whose place may be in a line with elements of the run
        return parse_xml(text)
    next(document.list_descendants(run_of)).run = run
    return document.children[0]


def _parse_whole(text: str, most: int) -> Element:
    """Return the parent of the root of an XML text."""
    parser = expat.ParserCreate("utf-8", " ")  # whatever encoding the text declares
    parser.buffer_text = True
    parser.SetParamEntityParsing(expat.XML_PARAM_ENTITY_PARSING_NEVER)
    document = Element({})
    opened, count = [document], 0
    texts = defaultdict[int, list[str]](list)  # by depth; most elements of a million have none
    local_names = _LocalNames()

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal count
        line, count = parser.CurrentLineNumber, count + 1
        if count % STEPS_BETWEEN_LOOKS == 0:
            check_work(READING)
        if len(opened) > MAX_DEPTH or count > most:
            raise _make_size_fault(line, most if count > most else None)
        element = Element(_strip_namespaces(attributes), (), line, local_names[name], [])
        opened[-1].children.append(element)
        opened.append(element)

    def end(_name: str) -> None:
        depth, element = len(opened), opened.pop()
        if depth in texts:
            element.content = "".join(texts.pop(depth))

    def characters(data: str) -> None:
        if not data.isspace():  # between a million elements there are as many line ends
            texts[len(opened)].append(data)

    def entity(name: str, *_: object) -> None:
        message = f"the entity {quote(name)} is not allowed (write out what is meant)"
        raise InputError.at(Location(line=parser.CurrentLineNumber), message)

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.CharacterDataHandler, parser.EntityDeclHandler = characters, entity
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        reason = expat.ErrorString(error.code)
        column = describe_column(text, error.lineno, error.offset + 1)
        message = f"this is no XML: {reason}{column} (check it there)"
        raise InputError.at(Location(line=error.lineno), message) from None
    return document
