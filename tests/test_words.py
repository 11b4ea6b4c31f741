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


FIRST_WORDS = """
    accepts add advance allow answer apply are as ask attempt avoid begin bind book bring build
    bundle cancel carry chain change check checkpoint checks choose circumscribe classify clear
    close cluster coerce comes commit compare complain complete compute confine connect convert
    count create cut deal decide declare defer delay delete derive descend describe do download draw
    drive dump empty end enter enters escape evict exclude execute explain export extend extract
    fade fail fill find finish finishes flip flush follow forget format free get give glance go goes
    group handle hang happens has have hold holds import improve inline insert inspect is join judge
    keep keeps kill lay limit link list listen load locate make map may measure mix name need nest
    note number obey open operate order owns pack parse pass pause perturb place plan prepare
    prioritize prove put quote rank reach reaches read receive recognizes refuse release relocate
    remind remove rename reorder repair repeat replan replay report require reroute reset resolve
    restore resume retime retry reverse rollback round run save say scale search select send serve
    set sets settle share shorten show simulate skip solve sort speak splice split spread start stay
    step stop stream stretch submit summarize survey switch tabulate take tell to trace translate
    turn unroll upload validate wait waits warn widen withdraw work write zip
"""
VERBS = frozenset(FIRST_WORDS.split())
"""First words of functions: verbs, claims (``is_empty``), ``as_``, ``to_``; add what is missing."""

ESTABLISHED = {
    *("auto", "cbs", "fixed_priority", "lacam", "lns", "local_search", "paper", "prioritized"),
    *("priority_search", "random_priority", "two_level"),
    *("connection_lost", "connection_made", "data_received", "shutdown", "startup"),
    *("main",),
}
"""Published names of methods, names that asyncio and uvicorn call, and a program's entry point."""


def called_names(module: ast.Module) -> Iterator[str]:
    """Yield the public functions and methods that are called: no properties, no constructors."""
    bodies = [module.body, *(node.body for node in module.body if isinstance(node, ast.ClassDef))]
    for node in (node for body in bodies for node in body):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name[0] != "_":
            calls = (getattr(each, "func", each) for each in node.decorator_list)
            decorators = {ast.unparse(each).rpartition(".")[2] for each in calls}
            if not decorators & NOT_CALLED:
                yield node.name


NOT_CALLED = {
    *("property", "cached_property", "setter", "classmethod", "staticmethod"),
    *("command", "group"),
}
"""Decorators of attributes, of constructors, and of commands, whose names users type."""


@pytest.mark.parametrize("room", ROOMS)
def test_functions_begin_with_a_verb(room: str) -> None:
    nouns = [
        f"{path.relative_to(SOURCES)}: {name}"
        for path, module in parse_modules().items()
        if room_of(path) == room
        for name in called_names(module)
        if name.partition("_")[0] not in VERBS and name not in ESTABLISHED
    ]
    assert not nouns


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
