"""Files of others are what their record says, and what npm has."""

from __future__ import annotations

import json

import pytest

from tests.builders.vendored import PACKAGES, ROOT, VENDOR, digest, published, record

NAMES = sorted(record())


def test_each_script_of_others_is_recorded() -> None:
    assert [path.name for path in sorted(VENDOR.glob("*.js"))] == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_a_file_of_others_has_the_recorded_hash(name: str) -> None:
    assert digest((VENDOR / name).read_bytes()) == record()[name]["sha256"]


@pytest.mark.parametrize("name", NAMES)
def test_npm_fetches_the_recorded_version(name: str) -> None:
    entry = record()[name]
    pinned = json.loads((ROOT / "package.json").read_text("utf-8"))["devDependencies"]
    assert pinned[entry["package"]] == entry["version"]


@pytest.mark.parametrize("name", NAMES)
def test_the_recipe_gives_the_same_bytes(name: str) -> None:
    if not (PACKAGES / record()[name]["package"]).exists():
        pytest.skip("the packages of npm are not here (just node-modules)")
    assert published(record()[name]) == (VENDOR / name).read_bytes()


def test_the_licences_stand_beside_them() -> None:
    text = (VENDOR / "LICENSES.txt").read_text("utf-8")
    for name, entry in record().items():
        assert f"{name} is {entry['package']} {entry['version']}" in text
