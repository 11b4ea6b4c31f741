"""What the wheel and the sdist carry of others, and the licences that they name."""

from __future__ import annotations

import re
import tomllib
from importlib.metadata import distribution
from pathlib import Path
from typing import Any

import pytest

from tests.builders.vendored import VENDOR, record

ROOT = Path(__file__).parents[1]
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
CARRIED: list[dict[str, Any]] = tomllib.loads(
    (ROOT / "licences" / "carried.toml").read_text("utf-8")
)["carried"]

OURS = ["README.md"]
"""Files in folders of others that are ours."""


def files_of_others() -> set[Path]:
    return {path for entry in CARRIED for pattern in entry["files"] for path in ROOT.glob(pattern)}


def test_the_expression_names_the_licences_of_what_the_wheel_holds_and_no_other() -> None:
    carried = {spdx for entry in CARRIED if entry["wheel"] for spdx in entry["spdx"]}
    assert set(PROJECT["license"].split(" AND ")) == {"MIT", *carried}


@pytest.mark.parametrize("entry", CARRIED, ids=lambda entry: str(entry["name"]))
def test_the_text_of_a_licence_is_in_the_metadata_if_the_wheel_holds_the_files(
    entry: dict[str, Any],
) -> None:
    """`license-files` are copied into every wheel; an sdist has all texts."""
    kept = {path for pattern in PROJECT["license-files"] for path in ROOT.glob(pattern)}
    in_the_wheel = {other["text"] for other in CARRIED if other["wheel"]}
    assert (ROOT / entry["text"] in kept) == (entry["text"] in in_the_wheel)
    assert (ROOT / entry["text"]).is_file()
    assert all(list(ROOT.glob(pattern)) for pattern in entry["files"])


FOLDERS = [
    "examples/maps",
    "tests/data/samples",
    "src/rightofway/control/schemas",
    str(VENDOR.relative_to(ROOT)),
]
"""Folders with files of others."""


@pytest.mark.parametrize("folder", FOLDERS)
def test_no_file_of_others_is_forgotten(folder: str) -> None:
    """Maps, samples and vendored scripts are all in the table; a new one has to be listed."""
    known = files_of_others() | {ROOT / entry["text"] for entry in CARRIED}
    about = {VENDOR / "vendor.json", *(VENDOR / f"{Path(name).stem}.d.ts" for name in record())}
    unknown = {path for path in (ROOT / folder).rglob("*") if path.is_file()} - known - about
    assert {path for path in unknown if path.name not in OURS} == set()


def test_a_text_of_a_licence_stands_only_where_files_of_others_are_listed() -> None:
    """A folder that brings its own licence is in the table."""
    texts = {
        path.relative_to(ROOT).as_posix()
        for folder in ("benchmarks", "cpp", "docs", "examples", "licences", "src", "tests")
        for path in (ROOT / folder).rglob("*")
        if re.search(r"licen[cs]e", path.name, re.IGNORECASE) and path.suffix not in {".py", ".pyc"}
    }
    texts = {text for text in texts if (ROOT / text).is_file() and "_build" not in text}
    assert texts <= {entry["text"] for entry in CARRIED}


def test_the_texts_are_those_of_the_compiled_code() -> None:
    """A new version of nanobind may bring another licence: then this fails."""
    nanobind = pytest.importorskip("nanobind", reason="what builds the core is not here")
    texts = {str(file) for file in distribution("nanobind").files or [] if "licenses" in str(file)}
    [text] = texts
    licence = distribution("nanobind").locate_file(text)
    assert Path(str(licence)).read_text("utf-8") == (ROOT / "licences/nanobind.txt").read_text()
    header = Path(nanobind.__file__).parent / "ext/robin_map/include/tsl/robin_map.h"
    comment = [line.removeprefix(" *").strip() for line in header.read_text("utf-8").splitlines()]
    ours = (ROOT / "licences/robin-map.txt").read_text("utf-8").splitlines()
    assert comment[1 : 1 + len(ours)] == [line.strip() for line in ours]
