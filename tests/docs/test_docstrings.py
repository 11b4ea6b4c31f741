"""Examples in docstrings are run; exported functions name their parameters."""

from __future__ import annotations

import doctest
import inspect
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages

import pytest

import rightofway

IS_PACKAGE = {
    module.name: module.ispkg
    for module in walk_packages(rightofway.__path__, "rightofway.")
    if module.name.rpartition(".")[2] not in {"__main__", "_core"}
}
MODULES = sorted(IS_PACKAGE)


ROOT = Path(rightofway.__file__).parents[1]


def has_examples(name: str) -> bool:
    path = ROOT / name.replace(".", "/")
    file = path / "__init__.py" if IS_PACKAGE.get(name, True) else path.with_suffix(".py")
    return ">>>" in file.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", [name for name in ("rightofway", *MODULES) if has_examples(name)])
def test_the_examples_in_docstrings_do_what_they_say(name: str) -> None:
    results = doctest.testmod(import_module(name))
    assert results.failed == 0
    assert results.attempted > 0


ROOMS = ["rightofway", *filter(IS_PACKAGE.__getitem__, MODULES)]
"""Packages that say in ``__all__`` what they export."""


@pytest.mark.parametrize("room", ROOMS)
def test_every_function_that_a_room_exports_names_its_parameters(room: str) -> None:
    module = import_module(room)
    exported = (getattr(module, name) for name in getattr(module, "__all__", ()))
    assert [
        function.__name__
        for function in exported
        if inspect.isfunction(function)
        and inspect.signature(function).parameters
        and "Parameters\n-----" not in (inspect.getdoc(function) or "")
    ] == []
