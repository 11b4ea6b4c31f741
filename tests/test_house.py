"""What holds for the tests themselves."""

from __future__ import annotations

import re

from tests.conftest import SLOW, TESTS


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


def test_every_name_in_the_slow_lane_is_a_file_or_folder() -> None:
    """A test file that is renamed would otherwise move to the quick lane unnoticed."""
    assert [name for name in SLOW if not (TESTS / name).exists()] == []
