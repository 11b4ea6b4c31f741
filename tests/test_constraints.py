"""The versions that CI installs."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
PINNED = {
    line.partition("==")[0]
    for line in (ROOT / "constraints.txt").read_text("utf-8").splitlines()
    if not line.startswith("#")
}


def test_every_requirement_is_pinned_for_ci() -> None:
    """A new dependency has to be added by `just constraints`."""
    lists = [
        PROJECT["project"]["dependencies"],
        *PROJECT["project"]["optional-dependencies"].values(),
        *PROJECT["dependency-groups"].values(),
    ]
    names = {re.split(r"[<>=\[;]", line)[0].strip() for some in lists for line in some}
    assert {name.lower().replace("_", "-") for name in names} - PINNED == {"rightofway"}
