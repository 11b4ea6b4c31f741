"""What pages speak of is there: other pages, files, commands, options, planners, rooms."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import get_args

import click
import pytest

from rightofway import viz
from rightofway.check import FaultKind
from rightofway.cli.main import commands
from rightofway.errors import InputError
from rightofway.io import make_schema, parse_scenario
from rightofway.io.yaml_text import parse_yaml
from rightofway.planners.registry import PLANNERS
from tests.builders.pages import DOCS, PAGES, ROOT, SDIST, Block, blocks, title_of

LINK = re.compile(r"!?\[[^\]]*\]\((?!https?:|#)(?P<file>[^)#\s]+)(?:#(?P<anchor>[^)\s]+))?\)")
WHOLE = re.MULTILINE | re.DOTALL
CODE = re.compile(r"`([^`\n]+)`")


def prose(page: Path) -> str:
    """Return a page without its fenced blocks."""
    return re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=WHOLE)


def anchors(page: Path) -> set[str]:
    """Return what its headings can be linked by."""
    heads = re.findall(r"^#+ (.*)$", prose(page), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


@pytest.mark.parametrize("page", PAGES, ids=title_of)
def test_every_link_leads_somewhere(page: Path) -> None:
    for link in LINK.finditer(prose(page)):
        target = page.parent / link["file"]
        if SDIST and (DOCS / "images").resolve() in target.resolve().parents:
            continue
        assert target.exists(), f"{title_of(page)} links to {link['file']}"
        if link["anchor"]:
            assert link["anchor"] in anchors(target), f"{title_of(page)} links to {link[0]}"


@pytest.mark.slow
def test_generated_parts_are_those_of_the_program() -> None:
    """The output of the script names the stale pages and the recipe that refreshes them."""
    script = ROOT / "docs" / "refresh.py"
    done = subprocess.run(
        [sys.executable, script, "--check"], capture_output=True, text=True, check=False
    )
    assert done.stdout + done.stderr == ""


@pytest.mark.parametrize("page", PAGES, ids=title_of)
def test_a_page_can_be_read_without_a_build(page: Path) -> None:
    """Directives and roles of Sphinx stand in comments, equations in blocks."""
    shown = re.sub(r"^<!-- sphinx$.*?^-->$", "", page.read_text(encoding="utf-8"), flags=WHOLE)
    assert re.findall(r"^ *(?:```|:::)\{.*|\{[a-z:]+\}`.*|^: .*|\$\$.*", shown, re.MULTILINE) == []


def command_lines(page: Path) -> Iterator[list[str]]:
    """Yield the words behind every ``rightofway`` in code."""
    for block in blocks(page):
        if block.language in {"sh", "console"}:
            yield from (
                text.split()[1:] for text in re.findall(r"\brightofway [a-z].*", block.text)
            )
    for code in CODE.findall(prose(page)):
        if code.startswith("rightofway "):
            yield code.split()[1:]


@pytest.mark.parametrize("page", PAGES, ids=title_of)
def test_every_command_and_option_in_code_exists(page: Path) -> None:
    for words in command_lines(page):
        is_option = words[0].startswith("-")
        command = commands if is_option else commands.commands.get(words[0])
        assert command is not None, f"{title_of(page)}: rightofway {words[0]}"
        for word in words:
            if word.startswith("--"):
                assert word.partition("=")[0] in options_of(command), f"{title_of(page)}: {words}"


@pytest.mark.parametrize("page", PAGES, ids=title_of)
def test_every_option_in_a_sentence_exists(page: Path) -> None:
    earlier = {"--show"}  # works and warns
    known = {"--help", *earlier, *(name for each in _commands() for name in options_of(each))}
    for code in CODE.findall(prose(page)):
        if code.startswith("--"):
            assert code.split()[0].partition("=")[0] in known, f"{title_of(page)}: {code}"


def _commands() -> list[click.Command]:
    return [commands, *commands.commands.values()]


def options_of(command: click.Command) -> set[str]:
    return {"--help", *(name for parameter in command.params for name in parameter.opts)}


def test_the_page_on_the_command_line_has_every_command() -> None:
    page = (DOCS / "command-line.md").read_text(encoding="utf-8")
    shown = re.findall(r"^<!-- generated: command-help (\w+) -->$", page, re.MULTILINE)
    assert sorted(shown) == sorted(commands.commands)


def test_every_planner_of_ours_has_a_page_with_its_options_and_a_line_in_the_changelog() -> None:
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    pages = "".join(page.read_text(encoding="utf-8") for page in (DOCS / "planners").iterdir())
    for spec in PLANNERS:
        assert f"<!-- generated: planner-options {spec.name} -->\n" in pages
        assert f"`{spec.name}`" in changelog


@pytest.mark.parametrize("kind", ["scenario", "plan", "shift"])
def test_the_page_on_formats_has_every_part_of_the_make_schema(kind: str) -> None:
    page = (DOCS / "formats.md").read_text(encoding="utf-8")
    shown = set(re.findall(r"^<!-- generated: document-keys \w+ (\w+) -->$", page, re.MULTILINE))
    assert f"<!-- generated: document-keys {kind} -->\n" in page
    assert set(make_schema(kind)["$defs"]) - {"ScenarioDocument"} <= shown  # type: ignore[arg-type]


def scenarios() -> dict[str, Block]:
    """Return the scenarios in pages; those with a file name are used by commands, broken or not."""
    return {
        f"{title_of(page)}:{block.line}": block
        for page in PAGES
        for block in blocks(page)
        if block.text.startswith("format: rightofway-scenario") and block.file_name is None
    }


@pytest.mark.parametrize("block", scenarios().values(), ids=scenarios().keys())
def test_every_scenario_in_a_page_can_be_read(block: Block) -> None:
    try:
        parse_scenario(parse_yaml(block.text))
    except InputError as error:
        pytest.fail(str(error))


def rooms() -> set[str]:
    """Return the packages of the package."""
    package = ROOT / "src" / "rightofway"
    return {path.name for path in package.iterdir() if (path / "__init__.py").exists()}


def test_the_page_on_architecture_names_every_room_and_kind_of_test() -> None:
    page = (DOCS / "architecture.md").read_text(encoding="utf-8")
    tests = {path.name for path in (ROOT / "tests").iterdir() if path.is_dir()} - {"__pycache__"}
    assert {name for name in rooms() | tests if f"`{name}`" not in page} == set()


def test_every_room_with_public_names_has_a_page_on_its_python() -> None:
    """Commands and studio are used otherwise."""
    pages = {path.stem for path in (DOCS / "api").iterdir()} - {"index"}
    public = {room for room in rooms() if hasattr(import_module(f"rightofway.{room}"), "__all__")}
    assert pages == {*public, "errors", "facts", "solve", "units"} - {"cli", "studio"}


def test_the_page_on_pictures_has_every_name_of_its_room() -> None:
    """Its names are imported when they are first used, so Sphinx does not find them by itself."""
    page = (DOCS / "api" / "viz.md").read_text(encoding="utf-8")
    assert [name for name in viz.__all__ if f"rightofway.viz.{name}\n" not in page] == []


def test_the_page_on_the_model_has_every_kind_of_fault() -> None:
    page = (DOCS / "model.md").read_text(encoding="utf-8")
    _, _, judge = page.partition("## Faults of plans")
    assert re.findall(r"^\| `([a-z ]+)` \|", judge, re.MULTILINE) == list(get_args(FaultKind))


PAGE = 60
"""Lines that a decision may have."""


@pytest.mark.parametrize("page", sorted((DOCS / "decisions").glob("0*.md")), ids=title_of)
def test_a_decision_is_a_page_with_context_decision_and_consequences(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    parts = re.findall(r"^(?:\*\*|## )(Context|Decision|Consequences)\b", text, re.MULTILINE)
    assert list(dict.fromkeys(parts)) == ["Context", "Decision", "Consequences"]
    assert len(text.splitlines()) <= PAGE


@pytest.mark.parametrize(
    ("page", "name", "lines"), [("README.md", "quick-start", 2), ("CONTRIBUTING.md", "set-up", 3)]
)
def test_commands_that_ci_runs_are_one_block(page: str, name: str, lines: int) -> None:
    """`.ci/run` takes them from the page, line by line."""
    starts = [block for block in blocks(ROOT / page) if block.info == ("sh", name)]
    assert [len(start.text.splitlines()) for start in starts] == [lines]


MOST_WORDS = 60_000
"""Words that the shelves *Use* and *Understand* may have, without code."""


def test_the_shelves_of_readers_have_a_limited_number_of_words() -> None:
    research = list_research()
    assert {"results", "decisions"} <= {page.parent.name for page in research}
    pages = [page for page in PAGES if DOCS in page.parents and page not in research]
    assert sum(len(re.findall(r"[A-Za-z']+", prose(page))) for page in pages) <= MOST_WORDS


def list_research() -> set[Path]:
    """Return the pages of the shelf *Research*, as the front page lists them."""
    text = (DOCS / "index.md").read_text(encoding="utf-8")
    [shelf] = re.findall(r"^:caption: Research\n:hidden:\n\n(.*?)^```$", text, WHOLE)
    tops = [DOCS / f"{name}.md" for name in shelf.split()]
    return {
        page for top in tops for page in ([top] if top.stem != "index" else top.parent.iterdir())
    }


def test_pictures_of_the_documentation_are_small() -> None:
    for picture in (DOCS / "images").rglob("*.*"):
        assert picture.stat().st_size < 200_000, picture.name
