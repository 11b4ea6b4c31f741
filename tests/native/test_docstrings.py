"""Docstrings of the native core against its signatures, which nanobind makes of the C++ types."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

from rightofway import _core

ARRAY = re.compile(r"\b(u?int\d+|float\d+)\[([^\]]*)\]")
"""An array as docstrings write it: ``int32[R + 1]``, ``int64[K, R]``."""

RETURNED = re.compile(r"ndarray\[dtype=(\w+), shape=\(([^)]*)\)")
"""An array as a signature writes it."""


def documented() -> Iterator[tuple[str, str]]:
    """Yield the name and the docstring of each function and class of the core."""
    for name, member in vars(_core).items():
        if callable(member) and not name.startswith("_"):
            yield name, member.__doc__ or ""
        if isinstance(member, type):
            for own, method in vars(member).items():
                if not own.startswith("_") and callable(method):
                    yield f"{name}.{own}", method.__doc__ or ""


def parts_of(docstring: str) -> dict[str, str]:
    """Return the sections of a docstring by their names; that before the first is ``""``."""
    pieces = re.split(r"^(\w+)\n-+\n", docstring, flags=re.MULTILINE)
    return {"": pieces[0], **dict(zip(pieces[1::2], pieces[2::2], strict=True))}


def arrays(text: str) -> list[tuple[str, int]]:
    """Return the types and dimensions of the arrays in a text; ``a, b : int64[N]`` are two."""
    found = []
    for line in text.splitlines():
        names, separator, _ = line.partition(" : ")
        of_line = [(kind, shape.count(",") + 1) for kind, shape in ARRAY.findall(line)]
        found += of_line * (names.count(",") + 1 if separator and len(of_line) == 1 else 1)
    return found


def names_in(section: str) -> list[str]:
    """Return the names that a section on parameters or returns explains."""
    entries = re.findall(r"^(\w+(?:, \w+)*) : ", section, flags=re.MULTILINE)
    return [name for entry in entries for name in entry.split(", ")]


FUNCTIONS = [(name, doc) for name, doc in documented() if doc.partition("\n")[0].count(" -> ")]


@pytest.mark.parametrize(("name", "doc"), FUNCTIONS, ids=[name for name, _ in FUNCTIONS])
def test_a_docstring_names_the_arrays_that_come_out(name: str, doc: str) -> None:
    """In their order, each with its type and its number of dimensions."""
    signature, _, text = doc.partition("\n")
    result = signature.rpartition(" -> ")[2]
    returned = [(kind, shape.count(",") + 1) for kind, shape in RETURNED.findall(result)]
    parts = parts_of(text)
    assert arrays(parts.get("Returns", parts[""])) == returned, name


@pytest.mark.parametrize(("name", "doc"), FUNCTIONS, ids=[name for name, _ in FUNCTIONS])
def test_a_section_on_parameters_names_them_all(name: str, doc: str) -> None:
    signature, _, text = doc.partition("\n")
    parts = parts_of(text)
    if "Parameters" in parts:
        arguments = signature.partition("(")[2].rpartition(") -> ")[0]
        arguments = re.sub(r"\[[^\[\]]*(\[[^\[\]]*\][^\[\]]*)*\]", "", arguments)
        given = re.findall(r"(\w+): ", arguments)
        assert sorted(names_in(parts["Parameters"])) == sorted(given), name


def test_there_are_such_docstrings() -> None:
    assert sum(bool(RETURNED.search(doc.partition("\n")[0])) for _, doc in FUNCTIONS) > 20
    assert sum("Parameters" in parts_of(doc) for _, doc in FUNCTIONS) > 20
