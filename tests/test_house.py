"""What holds for the tests themselves."""

from __future__ import annotations

import re

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
