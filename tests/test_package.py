"""The package as it is imported."""

import ast
import inspect
import pickle
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import rightofway
from rightofway.planners.registry import PLANNERS
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


def test_the_options_of_each_planner_can_be_imported_from_the_room_of_planners() -> None:
    of_planners = {spec.options_type.__name__ for spec in PLANNERS}
    assert of_planners <= set(rightofway.planners.__all__)


def test_type_checkers_see_no_function_that_takes_any_name() -> None:
    """With a module's `__getattr__` in sight, `rightofway.sovle` would be an object to them."""
    for path in Path(rightofway.__file__).parent.rglob("__init__.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        defined = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
        assigned = {
            target.id
            for node in tree.body
            if isinstance(node, ast.Assign)
            for target in node.targets
            if isinstance(target, ast.Name)
        }
        assert "__getattr__" not in defined | assigned, path


def list_results() -> Iterator[Any]:
    """Yield a result of each function that computes one, for the door of the paper."""
    plan = rightofway.solve(paper_scenario(PAPER[3]))
    yield from (plan, plan.scenario, rightofway.check(plan), rightofway.measure(plan))
    yield from (rightofway.compute_lost_time(plan), rightofway.waits(plan))
    laps = rightofway.run_laps(plan.scenario)
    yield from (laps, rightofway.plan_of_laps(laps))
    yield from (rightofway.simulate(plan, runs=2), rightofway.simulate(plan, runs=2).trace(1))


def test_results_can_be_pickled() -> None:
    """Programs send them to other processes."""
    for result in list_results():
        copy = pickle.loads(pickle.dumps(result))  # noqa: S301 (our own bytes)
        assert type(copy) is type(result)
        if isinstance(result, rightofway.SimulationResult):
            assert copy.trace(1).tracks == result.trace(1).tracks


def is_own(module: Any, name: str) -> bool:
    """Tell whether a name in a module is a class of this package."""
    found = getattr(module, name, None)
    return inspect.isclass(found) and found.__module__.startswith("rightofway.")


def test_what_is_not_there_is_said_as_usual() -> None:
    with pytest.raises(AttributeError, match="module 'rightofway' has no attribute 'plot'"):
        rightofway.plot  # noqa: B018 (the access is the test)


def test_check_and_solve_are_functions_and_not_the_modules_of_that_name() -> None:
    assert rightofway.check(rightofway.solve(paper_scenario(PAPER[0]))).ok


def test_a_plan_shows_itself_in_a_notebook() -> None:
    plan = rightofway.solve(paper_scenario(PAPER[0]))
    assert plan._repr_html_().startswith("<div")
