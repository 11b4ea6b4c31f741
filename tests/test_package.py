"""The package as it is imported."""

import inspect
import re
from fractions import Fraction
from typing import Any

import pytest

import rightofway
from rightofway import viz
from rightofway.quantities import Units
from tests.builders.fleets import PAPER, paper_scenario


def test_every_public_name_can_be_imported() -> None:
    assert sorted(rightofway.__all__) == list(rightofway.__all__)
    for name in rightofway.__all__:
        assert getattr(rightofway, name) is not None
        assert name in dir(rightofway)


def test_nothing_but_the_public_names_is_listed() -> None:
    listed = [name for name in dir(rightofway) if not name.startswith("__")]
    assert listed == rightofway.__all__


FUNCTIONS = [
    getattr(rightofway, name)
    for name in rightofway.__all__
    if inspect.isfunction(getattr(rightofway, name))
]


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda function: function.__name__)
def test_whatever_a_public_function_takes_or_returns_is_public(function: Any) -> None:
    """Names in the annotations that are classes of this package can be imported from its top."""
    written = " ".join(map(str, function.__annotations__.values()))
    module = inspect.getmodule(function)
    names = {name for name in re.findall(r"\b[A-Z]\w+", written) if is_own(module, name)}
    assert names <= set(rightofway.__all__)


def is_own(module: Any, name: str) -> bool:
    """Tell whether a name in a module is a class of this package."""
    found = getattr(module, name, None)
    return inspect.isclass(found) and found.__module__.startswith("rightofway.")


def test_an_earlier_name_works_and_warns_of_the_new_one() -> None:
    with pytest.warns(DeprecationWarning, match="save_plan is now write_plan") as warned:
        assert rightofway.save_plan is rightofway.write_plan
    assert warned[0].filename == __file__
    assert "save_plan" not in dir(rightofway)


@pytest.mark.parametrize("earlier", viz._EARLIER)
def test_an_earlier_name_of_the_views_works_and_warns(earlier: str) -> None:
    with pytest.warns(DeprecationWarning, match=f"{earlier} is now make_") as warned:
        assert getattr(viz, earlier) is getattr(viz, viz._EARLIER[earlier])
    assert warned[0].filename == __file__
    assert earlier not in viz.__all__


def test_an_earlier_name_of_a_method_works_and_says_the_new_one() -> None:
    fleet = rightofway.FleetBuilder(grid=[".."])
    message = r"FleetBuilder.roadmap is now build_roadmap \(use that name\)"
    with pytest.warns(DeprecationWarning, match=message) as warned:
        assert fleet.roadmap() is fleet.build_roadmap()
    assert warned[0].filename == __file__
    quantities = rightofway.Quantities(units=Units(), tick=Fraction(1))
    with pytest.warns(DeprecationWarning, match="Quantities.duration is now format_duration"):
        assert quantities.duration(3) == "3 time units"


def test_what_is_not_there_is_said_as_usual() -> None:
    with pytest.raises(AttributeError, match="module 'rightofway' has no attribute 'plot'"):
        rightofway.plot  # noqa: B018 (the access is the test)


def test_check_and_solve_are_functions_and_not_the_modules_of_that_name() -> None:
    assert rightofway.check(rightofway.solve(paper_scenario(PAPER[0]))).ok


def test_a_plan_shows_itself_in_a_notebook() -> None:
    plan = rightofway.solve(paper_scenario(PAPER[0]))
    assert plan._repr_html_().startswith("<div")
