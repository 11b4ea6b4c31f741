"""Examples in docstrings are run too."""

from __future__ import annotations

import doctest
from importlib import import_module
from pkgutil import walk_packages

import pytest

import rightofway

MODULES = sorted(
    module.name for module in walk_packages(rightofway.__path__, "rightofway.")
    if module.name.rpartition(".")[2] not in {"__main__", "_core"}
)  # fmt: skip


@pytest.mark.parametrize("name", ["rightofway", *MODULES])
def test_the_examples_in_docstrings_do_what_they_say(name: str) -> None:
    results = doctest.testmod(import_module(name))
    assert results.failed == 0


def test_there_are_examples_in_docstrings() -> None:
    attempted = [doctest.testmod(import_module(name)).attempted for name in MODULES]
    assert sum(attempted) > 0
