"""XML files as a tree of elements with lines; files that declare entities are refused.

Only expat is used, and no entity is ever expanded: that rules out "billion laughs" and files that
are read over the network. Names are without namespaces.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from xml.parsers import expat

from rightofway.errors import InputError, InputFault, is_printable, shown
from rightofway.io.layouts.parts import LONGEST_NAME, number_in

MAX_DEPTH = 64
"""Elements inside each other, at most."""

MAX_ELEMENTS = 1_000_000
"""The most elements of a file."""


@dataclass(slots=True)
class Element:
    """An element of an XML file."""

    name: str
    attributes: dict[str, str]
    line: int
    children: list[Element] = field(default_factory=list)
    text: str = ""

    @property
    def place(self) -> str:
        """Where it stands in the file."""
        return f"line {self.line}"

    def all(self, name: str) -> Iterator[Element]:
        """Yield the children of a name."""
        return (child for child in self.children if child.name == name)

    def descendants(self, name: str) -> Iterator[Element]:
        """Yield all elements of a name inside."""
        for child in self.children:
            if child.name == name:
                yield child
            yield from child.descendants(name)

    def get(self, *names: str) -> str | None:
        """Return the first of several attributes that is there, or None."""
        return next((self.attributes[name] for name in names if name in self.attributes), None)

    def need(self, *names: str) -> str:
        """Return an attribute of the first name that is there."""
        found = self.get(*names)
        if found is None:
            raise InputError.at(self.place, f"<{self.name}> has no {names[0]} (add it)")
        return found

    def label(self, *names: str) -> str:
        """Return an attribute that is a name."""
        found = self.need(*names)
        if not is_printable(found) or len(found) > LONGEST_NAME:
            raise InputError.at(self.place, f"{shown(found)} is no name (give printable text)")
        return found

    def number(self, *names: str) -> Fraction:
        """Return an attribute that is a number."""
        return number_in(self.need(*names), self.place)


def parse_xml(text: str) -> Element:
    """Return the root of an XML text.

    Raises
    ------
    InputError
        If it is no XML, declares entities, or is too large or too deep.
    """
    parser = expat.ParserCreate("utf-8", " ")  # whatever encoding the text declares
    parser.buffer_text = True
    parser.SetParamEntityParsing(expat.XML_PARAM_ENTITY_PARSING_NEVER)
    document = Element("", {}, 1)
    opened, count = [document], 0

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal count
        line, count = parser.CurrentLineNumber, count + 1
        if len(opened) > MAX_DEPTH or count > MAX_ELEMENTS:
            what = f"more than {MAX_DEPTH} deep" if count <= MAX_ELEMENTS else "too many"
            message = f"its elements are {what} (is it the right file?)"
            raise InputError([InputFault("", message, line)])
        plain = {key.rpartition(" ")[2]: value for key, value in attributes.items()}
        element = Element(name.rpartition(" ")[2], plain, line)
        opened[-1].children.append(element)
        opened.append(element)

    def end(_name: str) -> None:
        opened.pop()

    def characters(data: str) -> None:
        opened[-1].text += data

    def entity(name: str, *_: object) -> None:
        message = f"the entity {shown(name)} is not allowed (write out what is meant)"
        raise InputError([InputFault("", message, parser.CurrentLineNumber)])

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.CharacterDataHandler, parser.EntityDeclHandler = characters, entity
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        reason = expat.ErrorString(error.code)
        raise InputError(
            [InputFault("", f"this is no XML: {reason} (check it there)", error.lineno)]
        ) from None
    return document.children[0]
