"""The modules of a page share one scope in its single file, so their names must differ."""

from __future__ import annotations

import re
from collections import defaultdict

import pytest

from rightofway.viz.page.scripts import make_classic_script, order_scripts, read_asset

NAME = re.compile(r"^(?:export )?(?:async )?(?:class|function\*?|const|let) (\w+)", re.MULTILINE)


@pytest.mark.parametrize("entry", ["main", "inspect_main", "watch_main"])
def test_no_two_modules_of_a_page_declare_the_same_name(entry: str) -> None:
    modules = defaultdict[str, list[str]](list)
    for module in order_scripts(entry):
        for name in NAME.findall(read_asset(f"{module}.js")):
            modules[name].append(module)
    assert len(modules) > 50  # the pattern finds them
    assert {name: found for name, found in modules.items() if len(found) > 1} == {}


@pytest.mark.parametrize("entry", ["main", "inspect_main", "watch_main"])
def test_no_page_carries_types_of_its_modules(entry: str) -> None:
    """They are comments that fill lines, which are left out as others are."""
    for module in order_scripts(entry):
        script = make_classic_script(module)
        assert not re.search(r"@(param|returns|typedef|import|template)\b", script), module
