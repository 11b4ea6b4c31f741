"""Signatures on the API pages."""

import ast
import inspect
from importlib.util import module_from_spec, spec_from_file_location
from typing import Any

import pytest

import rightofway
from rightofway.io import make_schema
from tests.builders.pages import DOCS

_SPEC = spec_from_file_location("as_written", DOCS / "_ext" / "as_written.py")
assert _SPEC
assert _SPEC.loader
as_written = module_from_spec(_SPEC)
_SPEC.loader.exec_module(as_written)

PUBLIC = [
    value
    for value in (getattr(rightofway, name) for name in rightofway.__all__)
    if inspect.isfunction(value)
]


@pytest.mark.parametrize("function", PUBLIC, ids=lambda function: function.__name__)
def test_a_signature_is_that_of_the_function_with_defaults_as_values(function: Any) -> None:
    text, _ = as_written.signature_of(None, "function", function.__name__, function)
    [shown] = ast.parse(f"def function{text}: ...").body
    assert isinstance(shown, ast.FunctionDef)
    assert list_names(shown.args) == list_names_of(function)
    defaults = [default for default in shown.args.defaults + shown.args.kw_defaults if default]
    constants = [node for default in defaults for node in ast.walk(default) if is_constant(node)]
    assert constants == []


def list_names(shown: ast.arguments) -> list[str]:
    """Return the parameters of a signature as it is shown, with their stars."""
    return [
        *(each.arg for each in shown.posonlyargs + shown.args),
        *(f"*{each.arg}" for each in (shown.vararg,) if each),
        *(each.arg for each in shown.kwonlyargs),
        *(f"**{each.arg}" for each in (shown.kwarg,) if each),
    ]


def list_names_of(function: Any) -> list[str]:
    """Return the parameters of a function, with their stars."""
    stars: dict[Any, str] = {
        inspect.Parameter.VAR_POSITIONAL: "*",
        inspect.Parameter.VAR_KEYWORD: "**",
    }
    parameters = inspect.signature(function).parameters.values()
    return [stars.get(each.kind, "") + each.name for each in parameters]


def is_constant(node: ast.AST) -> bool:
    """Tell whether a part of a default is the name of a constant, as `DEFAULT_PLANNER`."""
    return isinstance(node, ast.Name) and node.id.isupper()


def test_a_signature_has_the_stars_of_further_arguments() -> None:
    text, _ = as_written.signature_of(None, "function", "solve", rightofway.solve)
    assert "planner: str = 'auto'" in text
    assert "**named: Any" in text


@pytest.mark.parametrize(
    ("part", "method", "other"),
    [
        ("RobotDocument", rightofway.FleetBuilder.add_robot, {"return": "ends"}),
        ("JobDocument", rightofway.FleetBuilder.add_job, {}),
        ("BatteryDocument", rightofway.FleetBuilder.add_battery, {}),
    ],
    ids=["robots", "jobs", "batteries"],
)
def test_a_fleet_builder_takes_every_key_of_a_file(
    part: str, method: Any, other: dict[str, str]
) -> None:
    node = make_schema("scenario")["$defs"][part]
    keys = node.get("anyOf", [node])[-1]["properties"]
    taken = set(inspect.signature(method).parameters)
    assert {other.get(key, key) for key in keys} <= taken
