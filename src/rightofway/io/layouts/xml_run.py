"""Runs of XML elements that are written alike, read as columns without an element for each.

A layout has up to a million lanes, one below the other, in which only values differ. The text of
the first one becomes a regular expression with a group for each value. The elements that follow and
match it are cut out of the text; expat reads the first one with all else, and thereby checks the
names that they have in common.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from rightofway.deadline import READING, STEPS_BETWEEN_LOOKS, check_work

# Values of characters that XML allows as they are, without references.
_ILLEGAL = "<&>\\x00-\\x1f\ud800-\udfff\ufffe\uffff"
_VALUE, _CONTENT = f'"([^"{_ILLEGAL}]*)"', f">([^{_ILLEGAL}]*)<"
_ATTRIBUTES = rf'(?:[ ]+[\w.-]+="[^"{_ILLEGAL}]*")*'
_SPACE = r"[ \t\r\n]*"
_CHILD = rf"{_SPACE}<(\w+){_ATTRIBUTES}>[^{_ILLEGAL}]*</\w+>"


@dataclass(frozen=True, slots=True)
class ElementRun:
    """Elements that follow one of the same form.

    Attributes
    ----------
    columns
        For each value of the form, in the order of the text, those of all elements.
    text
        The text of the elements, with the text between them.
    line
        The line at which it begins.
    """

    columns: tuple[tuple[str, ...], ...]
    text: str
    line: int


def cut_run(text: str, name: str, most: int) -> tuple[str, ElementRun | None]:
    """Return an XML text without the elements of a name that are written as the first one.

    They are ``most`` at most, counted with those inside them.

    Notes
    -----
    The lines of all else stay as they are. There is no run in a text with comments, declarations
    or prefixes in front of the first element: only expat recognizes elements there.
    """
    begin = text.find(f"<{name} ")
    if not name or begin < 0 or "<!" in text or "<?" in text[2:] or f":{name}" in text[:begin]:
        return text, None
    form = rf"<{name}{_ATTRIBUTES}(?:/>|>(?:{_CHILD})*{_SPACE}</{name}>)"
    first = re.compile(form).match(text, begin)
    if first is None or "xmlns" in first[0]:
        return text, None
    rows, end = _read_rows(_SPACE + _generalize(first[0]), text, first.end())
    if not rows or len(rows) * len(re.findall("<[^/]", first[0])) > most:
        return text, None
    run = ElementRun(
        columns=tuple(zip(*rows, strict=True)),
        text=text[first.end() : end],
        line=text.count("\n", 0, first.end()) + 1,
    )
    return text[: first.end()] + "\n" * run.text.count("\n") + text[end:], run


def _generalize(element: str) -> str:
    """Return the expression of elements of a form, with a group for each value."""
    return "".join(map(_generalize_part, re.split('("[^"]*"|>[^<]*<)', element)))


def _generalize_part(part: str) -> str:
    if part.startswith('"'):
        return _VALUE
    if not part.startswith(">"):
        return re.escape(part)
    return _CONTENT if part[1:-1].strip() else f">{_SPACE}<"


def _read_rows(form: str, text: str, begin: int) -> tuple[list[tuple[str, ...]], int]:
    """Return the values of the elements that follow each other, and the end of the last one."""
    match, rows, end = re.compile(form).match, list[tuple[str, ...]](), begin
    while element := match(text, end):
        if len(rows) % STEPS_BETWEEN_LOOKS == 0:
            check_work(READING)
        rows.append(element.groups())
        end = element.end()
    return rows, end
