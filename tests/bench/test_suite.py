"""Suites are read with every fault named; each bad file says in its comments what is wrong."""

from __future__ import annotations

import re
import tomllib
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from rightofway.bench import read_suite
from rightofway.errors import InputError
from rightofway.io import load, make_schema
from rightofway.io.toml_text import parse_toml
from rightofway.planners import find, find_all

ROOT = Path(__file__).parents[2]
DATA = ROOT / "tests" / "data"
BAD = DATA / "bad_suites"
SUITE = ROOT / "examples" / "suite.toml"


@pytest.mark.parametrize("path", sorted(BAD.glob("*.toml")), ids=lambda path: path.stem)
def test_every_fault_is_told_with_place_value_and_remedy(path: Path) -> None:
    """A file says ``# expect: …`` for a fault, and ``# expect 3: …`` for one in a line."""
    places = {"{here}": str(BAD), "{bad}": str(BAD / ".." / "bad")}
    comments = re.findall(r"^# expect(?: (\d+))?: (.*)", path.read_text("utf-8"), re.MULTILINE)
    expected = [f"{path}{':' if line else ''}{line}: {fault}" for line, fault in comments]
    for short, long in places.items():
        expected = [line.replace(short, long) for line in expected]
    with pytest.raises(InputError) as caught:
        read_suite(path)
    told = str(caught.value).splitlines()
    assert len(told) == len(expected)
    for line, pattern in zip(sorted(told), sorted(expected), strict=True):
        anything = re.escape(pattern).replace("…", ".*")
        assert re.fullmatch(anything, line), line


def test_the_example_can_be_read_and_fits_the_make_schema() -> None:
    assert len(read_suite(SUITE)) >= 20
    assert fits(tomllib.loads(SUITE.read_text(encoding="utf-8")))


def fits(document: Any) -> bool:
    validator = jsonschema.Draft202012Validator(make_schema("suite"))
    return bool(validator.is_valid(document))


@pytest.mark.parametrize("name", ["missing-keys", "no-format", "unknown-keys", "version", "maps"])
def test_what_is_bad_by_its_shape_does_not_fit_the_make_schema(name: str) -> None:
    assert not fits(tomllib.loads((BAD / f"{name}.toml").read_text(encoding="utf-8")))


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("counts", [0]),
        ("counts", []),
        ("counts", [5, 5]),
        ("seeds", [-1]),
        ("limits", [0]),
        ("maps", []),
        ("maps", [{"random": {"size": [8]}}]),
        ("maps", [{"random": {"size": [8, 8], "walls": 1}}]),
        ("maps", [{"file": "hall.map"}]),
        ("fleets", [{"name": "odd", "work": [1]}]),
        ("fleets", [{"name": "odd", "deal": "random"}]),
    ],
)
def test_a_wrong_value_does_not_fit_the_make_schema(key: str, value: Any) -> None:
    good = {
        "format": "rightofway-suite/1",
        "counts": [5],
        "maps": [{"random": {"size": [8, 8]}}],
        "planners": [{"name": "two-level"}],
    }
    assert fits(good)
    assert not fits({**good, key: value})


def test_what_is_left_out_has_a_default(tmp_path: Path) -> None:
    (tmp_path / "small.toml").write_text(
        'format = "rightofway-suite/1"\ncounts = [2]\n'
        'maps = [{random = {size = [8, 9]}}]\nplanners = [{name = "auto"}]\n',
        encoding="utf-8",
    )
    [case] = read_suite(tmp_path / "small.toml")
    assert (case.map, case.fleet, case.robots) == ("random-8-9-0", "default", 2)
    assert (case.seed, case.limit) == (0, Fraction(10))
    assert case.fleet_data == {"speeds": [1], "by_seed": False, "work": (0, 0), "rules": {}}
    spec = find("auto")
    assert (case.planner, case.options) == (spec.name, spec.settle({}))


def test_every_planner_can_be_a_part_of_a_suite(tmp_path: Path) -> None:
    """Options of some are fractions, which JSON does not have."""
    planners = "".join(f'[[planners]]\nname = "{name}"\n' for name in find_all())
    path = tmp_path / "suite.toml"
    head = 'format = "rightofway-suite/1"\ncounts = [2]\n[[maps]]\nrandom = {size = [8, 8]}\n'
    path.write_text(head + planners, encoding="utf-8")
    cases = read_suite(path)
    assert [case.planner for case in cases] == list(find_all())
    assert len({case.key for case in cases}) == len(cases)


def test_numbers_are_exact() -> None:
    assert parse_toml("a = 0.1\nb = 1e400") == {"a": Decimal("0.1"), "b": "1e400"}


def test_toml_is_refused_without_end() -> None:
    with pytest.raises(InputError, match="it is nested too deeply"):
        parse_toml("a = " + "[" * 100_000)


def test_a_suite_is_no_scenario() -> None:
    with pytest.raises(InputError, match="TOML is for the suites of benchmarks"):
        load(SUITE)
