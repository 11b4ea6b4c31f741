"""Phrases, and the texts of each language: the same kinds, values and labels in all."""

from __future__ import annotations

import ast
import copy
import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from rightofway.errors import join_names
from rightofway.languages import LANGUAGES, VALUE, list_names, read_texts
from rightofway.model import Objective
from rightofway.report.phrases import Phrase, join_items, to_parts
from tests.builders.languages import say, translate
from tests.builders.sources import SOURCES, parse_modules

DATA = Path(__file__).parent / "data"


@pytest.mark.parametrize("case", json.loads((DATA / "templates.json").read_text("utf-8")))
def test_a_phrase_has_the_text_that_pages_make_of_it(case: dict[str, Any]) -> None:
    phrase = say(case["phrase"])
    assert (phrase, to_parts(phrase), translate(phrase)) == (
        case["en"],
        case["phrase"],
        case["de"],
    )


def list_templates(node: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Yield each template of a tree of texts, with the keys that lead to it."""
    is_table = isinstance(node, dict) and all(isinstance(node[key], str) for key in node)
    if isinstance(node, str) or (is_table and "other" in node):
        yield path, node
    elif isinstance(node, dict | list):
        pairs = node.items() if isinstance(node, dict) else enumerate(node)
        for key, each in pairs:
            yield from list_templates(each, f"{path}.{key}")


@pytest.mark.parametrize("section", ["facts", "page", "studio"])
@pytest.mark.parametrize("language", LANGUAGES[1:])
def test_each_text_has_a_translation_with_the_same_values(language: str, section: str) -> None:
    english = {key: list_names(text) for key, text in list_templates(read_texts()[section])}
    texts = dict(list_templates(read_texts(language)[section]))
    forms = {form for text in texts.values() for _, form in VALUE.findall(str(text))}
    others = {f".{form}" for form in forms} - english.keys()  # cases of nouns, for example
    names = {key: list_names(text) for key, text in texts.items() if key not in others}
    assert {key: set(each) - {"number"} for key, each in names.items()} == {
        key: set(each) - {"number"} for key, each in english.items()
    }


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_key_is_twice_in_a_file_of_texts(language: str) -> None:
    def refuse_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        assert len(dict(pairs)) == len(pairs), [key for key, _ in pairs]
        return dict(pairs)

    text = (SOURCES / "texts" / f"{language}.json").read_text("utf-8")
    json.loads(text, object_pairs_hook=refuse_repeats)


@cache
def list_constants() -> frozenset[str]:
    """Return the texts in the code of the package."""
    return frozenset(
        node.value
        for module in parse_modules().values()
        for node in ast.walk(module)
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    )


@cache
def list_patterns() -> frozenset[str]:
    """Return patterns of the texts that code makes of parts."""
    return frozenset(
        "".join(
            re.escape(str(part.value)) if isinstance(part, ast.Constant) else ".+"
            for part in node.values
        )
        for module in parse_modules().values()
        for node in ast.walk(module)
        if isinstance(node, ast.JoinedStr) and len(node.values) > 1
    )


def test_each_kind_of_fact_is_one_that_code_names_and_code_names_no_other() -> None:
    kinds = read_texts()["facts"]
    texts = [text for _, text in list_templates(kinds)]
    forms = {
        form
        for tree in (texts, read_texts()["page"], read_texts()["studio"])
        for _, text in list_templates(tree)
        for _, form in VALUE.findall(str(text))
    }
    faults = {kind for kind in kinds if kind.rpartition(": ")[2] in {"name", "reason", "remedy"}}
    known = list_constants() | forms | {*Objective}
    made = {
        kind
        for kind in kinds.keys() - faults - known
        if any(re.fullmatch(pattern, kind) for pattern in list_patterns())
    }
    assert kinds.keys() - faults - known - made == set()
    assert {kind.rpartition(": ")[0] for kind in faults} <= known
    named = {
        node.args[0].value
        for module in parse_modules().values()
        for node in ast.walk(module)
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") in {"Phrase", *FACTS}
        if node.args and isinstance(node.args[0], ast.Constant)
    }
    assert named - kinds.keys() == set()


COMPUTED = re.compile(r"^\.examples\.")
"""Labels whose keys are names of files."""


@cache
def read_scripts() -> str:
    """Return the scripts and the markup of the page and of the studio."""
    folders = SOURCES / "viz/page/assets", SOURCES / "studio/assets"
    paths = [path for folder in folders for path in sorted(folder.rglob("*.js"))]
    return "\n".join(path.read_text("utf-8") for path in paths if "vendor" not in path.parts)


def test_only_messages_on_faults_of_files_are_marked_as_english() -> None:
    lines = [line for line in read_scripts().splitlines() if re.search(r"lang(=|: ).*\"en\"", line)]
    assert lines
    assert [line for line in lines if not re.search(r"message|trouble", line)] == []


@pytest.mark.parametrize("section", ["page", "studio"])
def test_each_label_is_one_that_a_script_names(section: str) -> None:
    words = {*re.findall(r"\w+", read_scripts()), *list_constants()}
    unused = [
        path
        for path, _ in list_templates(read_texts()[section])
        if not COMPUTED.search(path)
        and not {key for key in path.split(".") if key.isidentifier()} <= words
    ]
    assert unused == []


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


def test_the_german_texts_have_one_word_for_one_thing() -> None:
    text = (SOURCES / "texts/de.json").read_text("utf-8")
    found = {
        match[0]: word for other, word in OTHER_WORDS.items() for match in re.finditer(other, text)
    }
    assert not found


def test_a_phrase_is_its_text_and_keeps_template_and_values() -> None:
    phrase = Phrase("reason and remedy", reason=Phrase("n_laps", number="2"), remedy="{N1}")
    assert phrase == "2 laps ({N1})"
    assert json.loads(json.dumps(phrase)) == "2 laps ({N1})"
    assert to_parts(phrase) == [
        "reason and remedy",
        {"reason": ["n_laps", {"number": "2"}], "remedy": "{N1}"},
    ]


def test_a_copy_of_a_phrase_keeps_its_values() -> None:
    phrase = Phrase("named station", name="Dock")
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

TERMINAL = {
    *("report/driving.py", "report/execution.py", "report/inspection.py"),
    *("report/jobs.py", "report/laps.py", "report/plan.py", "report/probe.py", "report/shift.py"),
}
"""Reports of the command line, which speaks English."""

MOST_LITERALS = {"planners": 10, "repair": 0, "report": 0, "resume": 0}
"""How many parts of errors a room makes in other ways; the numbers may only fall."""


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
def test_each_sentence_of_a_room_that_pages_show_is_a_phrase(room: str) -> None:
    literals = [
        f"{path.relative_to(SOURCES)}: {text}"
        for path, module in parse_modules(SOURCES / room).items()
        if path.relative_to(SOURCES).as_posix() not in TERMINAL
        for function in ast.walk(module)
        if isinstance(function, ast.FunctionDef)
        for text in literals_for_people(function)
    ]
    assert len(set(literals)) <= MOST_LITERALS[room], "\n".join(literals)
