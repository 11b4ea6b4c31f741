"""One word, one meaning: exported names, names of classes and variables, sentences for readers."""

from __future__ import annotations

import ast
import re
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest

from tests.builders.sources import SOURCES, parse_modules

ROOT = Path(__file__).parents[1]
ROOMS = sorted(
    path.stem
    for path in SOURCES.iterdir()
    if (path.suffix == ".py" or (path / "__init__.py").exists()) and not path.stem.startswith("_")
)


def room_of(path: Path) -> str:
    return path.relative_to(SOURCES).parts[0].removesuffix(".py")


def test_no_two_rooms_export_one_name_for_different_things() -> None:
    meanings = defaultdict[str, dict[int, str]](dict)
    for room in ROOMS:
        module = import_module(f"rightofway.{room}")
        for name in getattr(module, "__all__", ()):
            meanings[name].setdefault(id(getattr(module, name)), room)
    assert {name: rooms for name, rooms in meanings.items() if len(rooms) > 1} == {}


def test_no_two_classes_have_one_name() -> None:
    places = defaultdict[str, list[str]](list)
    for path, module in parse_modules().items():
        for node in module.body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                places[node.name].append(path.relative_to(SOURCES).as_posix())
    twice = {name: files for name, files in places.items() if len(files) > 1}
    assert twice == {}


def exported_names(module: ast.Module) -> set[str]:
    """Return the names in ``__all__``, none where it is computed."""
    for node in module.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            constants = (name.value for name in ast.walk(node) if isinstance(name, ast.Constant))
            return {str(constant) for constant in constants}
    return set()


def described_functions(module: ast.Module) -> Iterator[str]:
    """Yield what has a section on its parameters: functions, and ``Class.method``."""
    bodies = {"": module.body}
    bodies |= {node.name: node.body for node in module.body if isinstance(node, ast.ClassDef)}
    for owner, body in bodies.items():
        for part in body:
            if not isinstance(part, ast.FunctionDef | ast.AsyncFunctionDef):
                continue
            if "\nParameters\n---" in (ast.get_docstring(part) or ""):
                yield f"{owner}.{part.name}".lstrip(".")


def test_sections_on_parameters_stand_at_what_is_exported() -> None:
    exported = set().union(*(exported_names(module) for module in parse_modules().values()))
    inside = [
        f"{path.relative_to(SOURCES)}: {function}"
        for path, module in parse_modules().items()
        for function in described_functions(module)
        if function.partition(".")[0] not in exported or function.rpartition(".")[2][:1] == "_"
    ]
    assert not inside, "a sentence is enough there"


STOPPED = {
    *("each", "found", "here", "it", "kept", "made", "one", "such"),
    *("that", "there", "thing", "this", "way", "what", "who"),
}
"""Names of variables that do not say what they hold."""


def bound_names(module: ast.Module) -> Iterator[str]:
    """Yield the names that a module binds: variables and parameters."""
    for node in ast.walk(module):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif isinstance(node, ast.arg):
            yield node.arg


@pytest.mark.parametrize("room", ROOMS)
def test_variables_say_what_they_hold(room: str) -> None:
    bound = [
        f"{path.relative_to(SOURCES)}: {name}"
        for path, module in parse_modules().items()
        if room_of(path) == room
        for name in bound_names(module)
        if name in STOPPED
    ]
    assert not bound


IDIOM = {
    r"\bso many\b": "name the number",
    r"\b[Ww]hoever\b": "name the person or the program",
    r"\banew\b": "again",
    r"\b(what|that|who) (is|are) no\b": "is not a …, or: without a …",
    r"\bthe (more|longer)\b[^.]{0,60}, the (more|longer)\b": "grows with",
    r"\bin parts of its\b": "relative to its",
    r"\b(had|have) back\b": "restore",
    r"\bis one robot's\b": "a robot holds",
    r"\bone (press|choice) away\b": "say what the press does",
}
"""Turns of phrase that have to be read three times, and what to write instead."""


BLOCK = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)


@cache
def texts_for_readers() -> list[tuple[str, str]]:
    """Return the pages of the documentation and the docstrings of public names, by place."""
    return list(_texts_for_readers())


def _texts_for_readers() -> Iterator[tuple[str, str]]:
    for page in [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md"))]:
        text = page.read_text(encoding="utf-8")
        yield (
            page.relative_to(ROOT).as_posix(),
            re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL),
        )
    for path, module in parse_modules().items():
        for node in ast.walk(module):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
                name = getattr(node, "name", "")
                if not name.startswith("_"):
                    place = f"{path.relative_to(SOURCES).as_posix()}: {name}"
                    yield place, ast.get_docstring(node) or ""


@pytest.mark.parametrize("idiom", IDIOM)
def test_sentences_name_what_they_are_about(idiom: str) -> None:
    pattern = re.compile(idiom)
    assert [
        f"{place}: {' '.join(text[max(0, match.start() - 30) : match.end() + 20].split())}"
        for place, text in texts_for_readers()
        for match in pattern.finditer(text)
    ] == []
