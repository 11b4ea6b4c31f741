"""Sentences that keep template and values; every one that pages translate has its German."""

from __future__ import annotations

import ast
import copy
import inspect
import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from rightofway.errors import join_names
from rightofway.languages import read_tables
from rightofway.phrases import Phrase, chain_items, join_items, say_count, to_parts
from rightofway.report.facts import list_template_texts
from tests.builders.sources import SOURCES, parse_modules

VALUE = re.compile(r"\{(\w+)\}")


TERMINAL = {
    *("report/driving.py", "report/execution.py", "report/inspection.py"),
    *("report/laps.py", "report/plan.py"),
}
"""Reports of the command line, which speaks English, as ``cli`` and commands of rooms do."""


def is_shown_by_pages(path: Path) -> bool:
    """Return whether sentences of a module can be on a page, in the studio or in the live view."""
    name = path.relative_to(SOURCES).as_posix()
    return name not in TERMINAL and not name.startswith("cli/") and "/command_line" not in name


@cache
def templates() -> frozenset[str]:
    """Return the templates of all phrases that pages show."""
    return frozenset(_templates())


def _templates() -> Iterator[str]:
    yield from list_template_texts()
    yield inspect.signature(chain_items).parameters["template"].default
    for path, module in parse_modules().items():
        if not is_shown_by_pages(path):
            continue
        for node in ast.walk(module):
            if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Name)):
                continue
            texts = [str(each.value) for each in node.args if isinstance(each, ast.Constant)]
            if node.func.id in {"Phrase", "chain_items"}:
                yield from texts
            elif node.func.id == "say_count" and len(texts) > 1:
                yield from (f"{{number}} {text}" for text in texts)


@pytest.mark.parametrize("language", read_tables())
def test_every_phrase_that_pages_show_has_its_translation(language: str) -> None:
    assert templates() - set(read_tables()[language]) == set()


@pytest.mark.parametrize("language", read_tables())
def test_no_translation_is_left_of_a_phrase_that_no_page_shows(language: str) -> None:
    assert set(read_tables()[language]) - templates() == set()


@pytest.mark.parametrize("language", read_tables())
def test_a_translation_has_the_values_of_its_template(language: str) -> None:
    for template, text in read_tables()[language].items():
        assert sorted(VALUE.findall(template)) == sorted(VALUE.findall(text)), template


OTHER_WORDS = {
    r"\bPlaner\b": "Verfahren",
    r"\bRunden?\b": "Umlauf",
    r"\bHeim\b|[Ff]alscher? Starts?\b|\"Start\"": "Startplatz",
    r"\bHalten?\b(?! auf Durchfahrt)|\bArbeitspl": "Ziel",
    r"\bBoden\b": "Grundriss",
    r"\bWenden\b": "Drehen",
    r"\bFolgezeit\b": "Zeitabstand",
    r"(?<!Höchst)\b[Gg]eschwindigkeit: ": "Tempo",
    r"Summe der (Ankünfte|Ankunftszeiten)": "Zeitsumme",
}
"""Second words for things of the glossary, with the words that it has for them."""

GERMAN_TEXTS = (
    "texts/de.json",
    "viz/page/assets/texts/de.js",
    "studio/assets/words/de.js",
)


@pytest.mark.parametrize("name", GERMAN_TEXTS)
def test_the_german_texts_have_one_word_for_one_thing(name: str) -> None:
    text = (SOURCES / name).read_text("utf-8")
    found = {
        match[0]: word for other, word in OTHER_WORDS.items() for match in re.finditer(other, text)
    }
    assert not found


def test_a_phrase_is_its_text_and_keeps_template_and_values() -> None:
    phrase = Phrase("{place} holds {robots}", place="{N1}", robots=say_count(2, "robot", "robots"))
    assert phrase == "{N1} holds 2 robots"
    assert json.loads(json.dumps(phrase)) == "{N1} holds 2 robots"
    assert to_parts(phrase) == [
        "{place} holds {robots}",
        {"place": "{N1}", "robots": ["{number} robots", {"number": "2"}]},
    ]


def test_a_copy_of_a_phrase_keeps_its_values() -> None:
    phrase = Phrase("station {name}", name="Dock")
    assert to_parts(copy.deepcopy(phrase)) == to_parts(phrase)


@pytest.mark.parametrize(
    ("items", "text"),
    [(["A"], "A"), (["A", "B"], "A and B"), (["A", "B", "C"], "A, B and C")],
)
def test_items_are_joined_as_in_a_sentence(items: list[str], text: str) -> None:
    assert join_items(items) == join_names(items) == text


def test_plain_text_has_no_parts() -> None:
    assert to_parts("D1") == "D1"


WORDS = re.compile(r"[A-Za-z]{2,} [A-Za-z]{2,}")
"""Two words: text for people, a sentence or a part of one."""

NOT_SAID = {
    *("fail", "at", "BadParameter", "UsageError", "InputError", "GaveUp", "NoPlanExists"),
    *("PlannerSpec", "check", "option", "section", "write_text"),
}
"""Calls whose texts are errors, or help: both are English, as keys and options are."""

FACTS = {"Fact", "Status", "RerouteReason"}
"""Facts have a kind, which is no text for people."""

REFUSED = {"message", "remedy", "hint", "fault"}
"""Names of variables for the parts of an error."""

MOST_LITERALS = {"planners": 11, "report": 0}
"""How many parts of errors and help a room makes in other ways; the numbers may only fall."""


def literals_for_people(node: ast.AST) -> Iterator[str]:
    """Yield the texts of several words below a node that no phrase holds."""
    if isinstance(node, ast.Constant | ast.JoinedStr):
        parts = [getattr(part, "value", " ") for part in getattr(node, "values", [node])]
        text = "".join(part if isinstance(part, str) else " " for part in parts)
        if WORDS.search(text):
            yield text
    elif not is_exempt(node):
        children = ast.iter_child_nodes(node)
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            children = iter(node.body)  # decorators hold help
        for child in children:
            yield from literals_for_people(child)


def is_exempt(node: ast.AST) -> bool:
    """Return whether texts in a node are phrases, errors, help, documentation, or keys."""
    match node:
        case ast.Expr(value=ast.Constant()) | ast.Raise() | ast.Assert() | ast.Compare():
            return True
        case ast.match_case() | ast.Subscript() | ast.Set():
            return True
        case ast.Assign(targets=[ast.Name(id=name)]):
            return name in REFUSED
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name)):
            return name in NOT_SAID or name in {"Phrase", "say_count", "chain_items", *FACTS}
        case _:
            return False


@pytest.mark.parametrize("room", MOST_LITERALS)
def test_what_a_room_says_to_people_is_a_phrase(room: str) -> None:
    literals = [
        f"{path.relative_to(SOURCES)}: {text}"
        for path, module in parse_modules(SOURCES / room).items()
        for function in ast.walk(module)
        if isinstance(function, ast.FunctionDef)
        for text in literals_for_people(function)
    ]
    assert len(set(literals)) <= MOST_LITERALS[room], "\n".join(literals)
