"""What holds for the tests themselves."""

from __future__ import annotations

import ast
import re
from pathlib import Path

from tests.builders.sources import parse_modules
from tests.conftest import NIGHTLY, SLOW, TESTS

CPP = TESTS.parent / "cpp"
ROOMS = [
    "core",
    "problem",
    "distances",
    "search",
    "precedence",
    "lacam",
    "lns",
    "tours",
    "cbs",
    "bounds",
    "cyclic",
    "execution",
    "bind",
]
"""The folders of the native core; an include may name a folder further left, never one behind."""


def test_no_test_imports_another_test() -> None:
    """Shared makers live in ``tests/builders``, so that a test file can be rewritten alone."""
    imports = re.compile(
        r"^from tests\.[\w.]*test_\w+ import|^import tests\.[\w.]*test_", re.MULTILINE
    )
    assert [
        str(path.relative_to(TESTS))
        for path in sorted(TESTS.rglob("*.py"))
        if imports.search(path.read_text(encoding="utf-8"))
    ] == []


def test_every_name_in_the_lanes_is_a_file_or_folder() -> None:
    """A test file that is renamed would otherwise move to the quick lane unnoticed."""
    assert [name for name in (*SLOW, *NIGHTLY) if not (TESTS / name).exists()] == []


def test_includes_of_the_native_core_never_point_back() -> None:
    found = [
        (file.parent.name, room, f"{file.name} includes {room}")
        for file in sorted(CPP.glob("*/*.?pp"))
        if file.parent.name in ROOMS
        for room in re.findall(r'^#include "(\w+)/', file.read_text(encoding="utf-8"), re.MULTILINE)
    ]
    assert len(found) > len(ROOMS)
    assert [what for own, room, what in found if ROOMS.index(room) > ROOMS.index(own)] == []


SLEEPS = {
    "builders/brokers.py": "wait_for, which has a deadline",
    "builders/browsers.py": "Viewer.poll, which has a deadline",
    "builders/suites.py": "soon, which has a deadline",
    "builders/odd_planners.py": "planners that are slow on purpose",
    "campaigns/kills.py": "a process that is killed some time after a start",
    "cli/test_process.py": "an interrupt some time after a start: each time has to end well",
    "cyclic/test_run.py": "a robot that takes all of its time on purpose",
}
"""Files in which something sleeps, each once a reason; all others wait for what they await."""


def test_no_test_sleeps_for_a_fixed_time() -> None:
    """A sleep is too short on a busy machine, and too long on any other one."""
    sleeps = re.compile(r"\bsleep\(|wait_for_timeout\(")
    found = {
        path.relative_to(TESTS).as_posix()
        for path in TESTS.rglob("*.py")
        if path != Path(__file__) and sleeps.search(path.read_text(encoding="utf-8"))
    }
    assert found == set(SLEEPS)


def test_tests_of_pages_ask_nothing_of_the_names_inside_scripts() -> None:
    """Roles, labels and texts are what a person has; names inside scripts may change."""
    asks = re.compile(r"""\.ask\(|\.wait_for\(\s*f?["']""")
    found = [
        path.name
        for folder in ("builders", "studio", "viewer")
        for path in (TESTS / folder).rglob("*.py")
        if asks.search(path.read_text(encoding="utf-8"))
    ]
    assert found == []


ASSETS = [TESTS.parent / "src/rightofway" / room for room in ("viz/page/assets", "studio/assets")]
TAKES_APART = {
    "a place as text": re.compile(  # of a fault
        r"(?<!typeof )\bplace(\.(startsWith|endsWith|match|split|includes|indexOf)\(| === \")"
    ),
    "a sentence split": re.compile(r"\.(split|indexOf|lastIndexOf)\(\"[^\"]* [^\"]*\"\)"),
    "words in a pattern": re.compile(
        r"/[^/\n]*( [a-z]{3,}|[a-z]{3,} )[^/\n]*/\w*\.(exec|test)\("
        r"|\.(match|replace|split)\(/[^/\n]*( [a-z]{3,}|[a-z]{3,} )[^/\n]*/"
    ),
}
TAKEN_APART = {"document.js: words in a pattern": "names of drafts, which this file makes itself"}
"""Texts that scripts take apart, each with its reason; all others have fields (decision 17)."""


def test_no_script_takes_english_apart() -> None:
    found = {
        f"{path.name}: {what}"
        for folder in ASSETS
        for path in folder.rglob("*.js")
        if "vendor" not in path.parts
        for what, pattern in TAKES_APART.items()
        if pattern.search(path.read_text("utf-8"))
    }
    assert found == set(TAKEN_APART)


def test_what_takes_english_apart_is_found() -> None:
    samples = {
        "a place as text": "fault.place.startsWith(`${place}.`)",
        "a sentence split": 'heading.split(" (")[0]',
        "words in a pattern": r"/^(\d+) robots$/.exec(what)",
    }
    assert {what for what, text in samples.items() if TAKES_APART[what].search(text)} == set(
        TAKES_APART
    )


LOCATED = {"at", "note", "attempt", "under", "InputFault"}
"""Calls of which the first argument is a place."""


def places_as_text(module: ast.Module) -> list[str]:
    """Return the places of faults that are built as text, or hold a path as text."""
    found = []
    for node in ast.walk(module):
        if not (isinstance(node, ast.Call) and node.args):
            continue
        name = node.func.attr if isinstance(node.func, ast.Attribute) else ""
        name = node.func.id if isinstance(node.func, ast.Name) else name
        if name not in LOCATED:
            continue
        place = node.args[0]
        is_path = isinstance(place, ast.Constant) and re.search(r"[].[]| \d", str(place.value))
        if isinstance(place, ast.JoinedStr | ast.BinOp) or is_path:
            found.append(ast.unparse(place))
    return found


def test_faults_have_locations_instead_of_text() -> None:
    """A key, a tuple of keys and indices, or a `Location`; text is made of it in one place."""
    found = {path.name: places_as_text(module) for path, module in parse_modules().items()}
    assert {name: places for name, places in found.items() if places} == {}


def test_places_as_text_are_found() -> None:
    source = """
raise InputError.at(f"robots[{index}]", message)
faults.note("line " + str(line), message)
under("robots[3].speed")
InputFault(("robots", 3, "speed"), message)
InputError.at("speed", message)
"""
    assert len(places_as_text(ast.parse(source))) == 3


def test_every_action_of_a_workflow_is_pinned_to_a_commit() -> None:
    """A tag can be moved to other code after it was read; the 40 digits of a commit cannot."""
    uses = [
        line.split("uses:", 1)[1].strip()
        for file in sorted((TESTS.parent / ".github/workflows").glob("*.yml"))
        for line in file.read_text().splitlines()
        if "uses:" in line
    ]
    assert len(uses) > 10
    pinned = re.compile(r"[\w./-]+@[0-9a-f]{40} # v[\d.]+\b.*")
    assert [line for line in uses if not pinned.fullmatch(line)] == []
