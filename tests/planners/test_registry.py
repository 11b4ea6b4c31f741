"""What planners can be told."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import FrozenInstanceError, dataclass
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any, Literal

import pytest

from rightofway import FleetBuilder, solve
from rightofway.errors import InputError
from rightofway.kinds.table import COUNT, make_number
from rightofway.planners import (
    Feature,
    PlannerOptions,
    PlannerSpec,
    find,
    find_all,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class OwnOptions(PlannerOptions):
    """Options of a planner of another package."""

    order: Annotated[Literal["file", "random"], "In which order."] = "file"
    rounds: Annotated[int, COUNT, "How often."] = 5


SPEC = PlannerSpec("own", "own:own", "A planner of another package.", OwnOptions)
WORD, NUMBER = OwnOptions.described()


def test_options_are_described_by_their_fields() -> None:
    assert (WORD.name, WORD.default, WORD.summary) == ("order", "file", "In which order.")
    assert (NUMBER.name, NUMBER.default, NUMBER.kind) == ("rounds", 5, COUNT)
    assert (WORD.choices, NUMBER.choices) == (("file", "random"), ())
    assert SPEC.options == (WORD, NUMBER)


def test_options_are_given_as_a_value_or_by_name_and_the_rest_has_its_default() -> None:
    wanted = {"order": "random", "rounds": 5}
    assert SPEC.settle(OwnOptions(order="random")) == wanted
    assert SPEC.settle({"order": "random"}) == wanted
    assert SPEC.settle({}) == {"order": "file", "rounds": 5}


def test_options_cannot_be_changed() -> None:
    options: Any = OwnOptions()
    with pytest.raises(FrozenInstanceError):
        options.rounds = 6


def test_a_choice_is_one_of_its_words() -> None:
    assert WORD.read("random") == "random"
    with pytest.raises(InputError, match=r"options.order: 'x' is unknown \(give file or random\)"):
        WORD.read("x")


@pytest.mark.parametrize("given", [7, "7"])
def test_a_count_is_a_whole_number_however_it_is_written(given: object) -> None:
    assert NUMBER.read(given) == 7


@pytest.mark.parametrize("given", ["0", "-1", "1.5", "", "many", "\u00b2", True])
def test_a_count_refuses_what_is_none_or_too_small(given: object) -> None:
    with pytest.raises(InputError, match=r"options.rounds: .* does not fit \(give a whole number"):
        NUMBER.read(given)


@dataclass(frozen=True, slots=True, kw_only=True)
class ExactOptions(PlannerOptions):
    """Options of a planner of another package that takes exact numbers."""

    factor: Annotated[Fraction, make_number(1, 2), "How much worse a plan may be."] = Fraction(6, 5)


(FACTOR,) = ExactOptions.described()


@pytest.mark.parametrize("given", [1.05, "1.05", Decimal("1.05"), Fraction(21, 20), "21/20"])
def test_an_exact_number_is_kept_however_it_is_written(given: Any) -> None:
    """A float is the shortest decimal that stands for it: 1.05 is 21/20."""
    assert ExactOptions(factor=given).as_dict() == {"factor": Fraction(21, 20)}


@pytest.mark.parametrize("given", ["0.99", "201/100", "many", True, float("nan"), "1/0", None])
def test_an_exact_number_refuses_what_is_none_or_out_of_its_limits(given: object) -> None:
    with pytest.raises(InputError, match=r"options.factor: .* \((give|write it like) "):
        FACTOR.read(given)


def test_an_exact_option_is_described_by_its_limits() -> None:
    assert FACTOR.kind.bounds == (1, 2)
    assert FACTOR.kind.name == "a number from 1 to 2"


def test_features_are_named_by_words() -> None:
    assert sorted(find("paper").features) == ["barred edges", "leaves swaps"]
    able = [name for name, spec in find_all().items() if Feature.IMPROVES in spec.features]
    assert able[:3] == ["auto", "local-search", "lns"]


@pytest.mark.parametrize("planner", sorted(find_all()))
def test_options_of_a_planner_hold_their_own_defaults(planner: str) -> None:
    spec = find_all()[planner]
    assert spec.settle(spec.options_type()) == spec.settle({})
    assert [option.name for option in spec.options] == list(spec.settle({}))


ASKS_TWICE = """
import shutil, sys
from rightofway.planners import find_all
first = find_all()
first.pop("auto")
shutil.rmtree(sys.argv[1])
print(list(first)[-1], list(find_all())[-1], "auto" in find_all())
"""


def test_planners_of_other_packages_are_searched_once_for_a_path(tmp_path: Path) -> None:
    """The package is not installed any more at the second call; a caller's changes do not stay."""
    metadata = tmp_path / "own-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: own\nVersion: 1.0\n")
    (metadata / "entry_points.txt").write_text("[rightofway.planners]\nown = own:SPEC\n")
    (tmp_path / "own.py").write_text(
        "from rightofway.planners import PlannerOptions, PlannerSpec\n"
        "SPEC = PlannerSpec('own', 'own:own', 'A planner of another package.', PlannerOptions)\n"
    )
    command = [sys.executable, "-c", ASKS_TWICE, str(metadata)]
    paths = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")]).rstrip(os.pathsep)
    run = subprocess.run(
        command, env={**os.environ, "PYTHONPATH": paths}, capture_output=True, text=True, check=True
    )
    assert run.stdout.split() == ["own", "own", "True"]


def test_our_own_planners_plan_without_a_search_of_installed_packages(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """LaCAM knows no turn rates: the planners that do are looked for where a fleet needs them."""

    def search(_path: tuple[str, ...]) -> dict[str, Any]:
        raise AssertionError("packages were searched")

    monkeypatch.setattr("rightofway.planners.registry._list_of_other_packages", search)
    fleet = FleetBuilder(grid=[".."]).add_robot("R1", home="N0", target="N1")
    assert solve(fleet.build_scenario(), "lacam").flowtime > 0
