"""The version stands in the package; pages that people cite repeat it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rightofway import __version__

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(
    ("page", "line"),
    [("CITATION.cff", f"version: {__version__}"), ("README.md", f"  version = {{{__version__}}}")],
)
def test_a_page_that_is_cited_names_the_version(page: str, line: str) -> None:
    assert line in (ROOT / page).read_text("utf-8").splitlines()
