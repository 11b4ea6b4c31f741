"""What holds for the tests themselves."""

from __future__ import annotations

import re
from pathlib import Path

TESTS = Path(__file__).parent


def test_no_test_imports_another_test() -> None:
    """Shared makers live in ``tests/builders``, so that a test file can be rewritten alone."""
    imports = re.compile(r"^from tests\.[\w.]*test_\w+ import|^import tests\.[\w.]*test_", re.M)
    assert [
        str(path.relative_to(TESTS))
        for path in sorted(TESTS.rglob("*.py"))
        if imports.search(path.read_text(encoding="utf-8"))
    ] == []
