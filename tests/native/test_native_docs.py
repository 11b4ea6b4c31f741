"""The docstrings of the native core agree with its signatures, which the stub holds."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import rightofway

STUB = ast.parse(Path(rightofway.__file__).with_name("_core.pyi").read_text("utf-8"))

Function = tuple[str, ast.FunctionDef, str]
"""Name, signature, and the docstring that describes it."""


def functions() -> Iterator[Function]:
    """Yield all functions and methods; the docstring of a class describes its constructor."""
    for node in STUB.body:
        if isinstance(node, ast.FunctionDef):
            yield node.name, node, ast.get_docstring(node) or ""
        elif isinstance(node, ast.ClassDef):
            for own in node.body:
                if isinstance(own, ast.FunctionDef):
                    describing = node if own.name == "__init__" else own
                    name = f"{node.name}.{own.name}"
                    yield name, own, ast.get_docstring(describing) or ""


def section(docstring: str, title: str) -> list[str]:
    """Return the lines of a section."""
    pattern = rf"^{title}\n-+\n(.*?)(?=\n\n\S+\n---|\Z)"
    match = re.search(pattern, docstring, re.DOTALL | re.MULTILINE)
    return match[1].splitlines() if match else []


def names_in(lines: list[str]) -> list[str]:
    """Return what a section describes: the names before the colons."""
    entries = [line.partition(" : ")[0] for line in lines if line and not line.startswith(" ")]
    return [name for entry in entries for name in entry.split(", ")]


def items_of(entry: str) -> int:
    """Return how many items ``tuple of (int, int32[N, 2])`` has."""
    inside = re.sub(r"\[.*?\]", "", entry.partition("(")[2].partition(")")[0])
    return len(inside.split(","))


FUNCTIONS = list(functions())
NAMES = [name for name, _, _ in FUNCTIONS]


@pytest.mark.parametrize(("name", "function", "docstring"), FUNCTIONS, ids=NAMES)
def test_every_argument_is_described(name: str, function: ast.FunctionDef, docstring: str) -> None:
    arguments = [*function.args.args, *function.args.kwonlyargs]
    expected = [argument.arg for argument in arguments if argument.arg != "self"]
    assert names_in(section(docstring, "Parameters")) == expected, name


def tuple_in(annotation: ast.expr | None) -> list[ast.expr] | None:
    """Return the types of a tuple, also of one that may be None."""
    if isinstance(annotation, ast.BinOp):
        return tuple_in(annotation.left)
    if isinstance(annotation, ast.Subscript) and ast.unparse(annotation.value) == "tuple":
        assert isinstance(annotation.slice, ast.Tuple)
        return annotation.slice.elts
    return None


TUPLES = [(name, types, doc) for name, one, doc in FUNCTIONS if (types := tuple_in(one.returns))]


def test_tuples_are_returned() -> None:
    assert {"ActionDependencyGraph.runs", "critical_circuit"} < {name for name, _, _ in TUPLES}


@pytest.mark.parametrize(("name", "types", "docstring"), TUPLES, ids=[t[0] for t in TUPLES])
def test_every_item_of_a_returned_tuple_is_described(
    name: str, types: list[ast.expr], docstring: str
) -> None:
    returns = section(docstring, "Returns")
    head = returns[0] if returns else ""
    described = items_of(head) if head.startswith("tuple of (") else len(names_in(returns))
    assert described == len(types), name
