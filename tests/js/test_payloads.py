"""What the tests of the pages' modules read is what the package gives to the page."""

from __future__ import annotations

import pytest

from tests.builders.payloads import FOLDER, MADE, written


@pytest.mark.parametrize("name", MADE)
def test_a_file_for_tests_of_modules_is_what_the_package_gives(name: str) -> None:
    """Where this fails for a reason, ``python -m tests.builders.payloads`` writes the files."""
    assert (FOLDER / f"{name}.json").read_text(encoding="utf-8") == written(name)


def test_no_other_file_lies_there() -> None:
    assert {path.name for path in FOLDER.iterdir()} == {f"{name}.json" for name in MADE}
