"""The package as it is imported."""

import pytest

import rightofway
from tests.builders.fleets import PAPER, paper_scenario


def test_every_public_name_can_be_imported() -> None:
    assert sorted(rightofway.__all__) == list(rightofway.__all__)
    for name in rightofway.__all__:
        assert getattr(rightofway, name) is not None
        assert name in dir(rightofway)


def test_what_is_not_there_is_said_as_usual() -> None:
    with pytest.raises(AttributeError, match="module 'rightofway' has no attribute 'plot'"):
        rightofway.plot  # noqa: B018 (the access is the test)


def test_check_and_solve_are_functions_and_not_the_modules_of_that_name() -> None:
    assert rightofway.check(rightofway.solve(paper_scenario(PAPER[0]))).ok


def test_a_plan_shows_itself_in_a_notebook() -> None:
    plan = rightofway.solve(paper_scenario(PAPER[0]))
    assert plan._repr_html_().startswith("<iframe")
