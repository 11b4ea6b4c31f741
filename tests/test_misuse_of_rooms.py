"""What the rooms export, called with what does not belong there."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rightofway as rw
from rightofway.arguments import (
    ArgumentKind,
    checks_arguments,
    checks_its_arguments,
    read_annotation,
)

ROOT = Path(__file__).parents[1]
ROOMS = sorted(page.stem for page in (ROOT / "docs" / "api").glob("*.md") if page.stem != "index")
"""The rooms that the documentation has a page of."""

DOOR = rw.load(ROOT / "examples" / "door.yaml")


@pytest.fixture(scope="module")
def plan() -> rw.Plan:
    return rw.solve(DOOR, seed=1, time_limit=None, iterations=5)


STRANGE: list[Any] = [
    None,
    -1,
    True,
    float("nan"),
    -0.5,
    10**30,
    10**400,
    "",
    "a\0b",
    "\ud800",
    b"x",
    [],
    [None],
    (None, None),
    {"a": 1},
    {"x"},
    object(),
    np.array([1.5]),
    np.array([-1, 2**40]),
    iter(()),
    lambda *_: None,
    Path("no/such/file"),
]
"""None, numbers out of range, text, lists, arrays, a mapping, a function, a path."""


def functions() -> dict[str, Callable[..., Any]]:
    """Return the functions of the rooms by room and name; those of `rightofway` are tried there."""
    found = {}
    for room in ROOMS:
        module = import_module(f"rightofway.{room}")
        for name in getattr(module, "__all__", ()):
            value = getattr(module, name)
            is_function = inspect.isroutine(inspect.unwrap(value))
            if is_function and value is not getattr(rw, name, None):
                found[f"{room}.{name}"] = value
    return found


FUNCTIONS = functions()
CHECKED = sorted(name for name, call in FUNCTIONS.items() if checks_its_arguments(call))


@pytest.fixture(scope="module")
def fitting(plan: rw.Plan) -> dict[str, Any]:
    """Return arguments that fit, by their names."""
    return {
        "scenario": DOOR,
        "before": DOOR,
        "after": DOOR,
        "plan": plan,
        "tracks": plan.tracks,
        "plans": [plan, plan],
        "path": Path("no/such/file"),
        "seed": 1,
    }


@pytest.mark.parametrize("name", CHECKED)
def test_what_does_not_belong_there_is_refused_with_a_reason(
    name: str, fitting: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    call = FUNCTIONS[name]
    parameters = inspect.signature(call).parameters.values()
    needed = [
        parameter.name
        for parameter in parameters
        if parameter.default is parameter.empty
        and parameter.kind not in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
    ]
    for strange in STRANGE:
        for good in ({}, fitting):
            for changed in needed:
                arguments = {key: good.get(key, strange) for key in needed} | {changed: strange}
                try:
                    call(**arguments)
                except rw.RightOfWayError as refusal:
                    message = str(refusal)
                    assert message.strip(), strange
                    assert "truth value" not in message


@pytest.mark.parametrize(
    ("annotation", "fits", "does_not"),
    [
        (int, [0, -5, np.int32(3)], [True, 1.0, "1", None, 10**30]),
        (float, [1, 2.5, Fraction(1, 3)], [float("nan"), True, "1", 10**400]),
        (str | None, ["a", None], [b"a", 1, ["a"]]),
        (rw.Scenario, [DOOR], [DOOR.roadmap, None, "door.yaml"]),
        (list[int], [[1], (1, 2), np.array([1])], [[1, "a"], "ab", {1: 2}, {1}, iter([1]), 1]),
        (tuple[str, str], [("a", "b")], [("a",), "ab", None]),
        (dict[str, int], [{"a": 1}], [{"a": "b"}, [("a", 1)], None]),
        (Callable[[int], int], [abs], [1, "abs"]),
    ],
)
def test_an_annotation_admits_what_it_names_and_nothing_else(
    annotation: Any, fits: list[Any], does_not: list[Any]
) -> None:
    kind: ArgumentKind = read_annotation(annotation)
    assert [value for value in fits if kind.find_fault(("it",), value)] == []
    assert [value for value in does_not if not kind.find_fault(("it",), value)] == []


def test_all_arguments_that_do_not_fit_are_named_with_their_items() -> None:
    @checks_arguments
    def travel(names: list[str], *, laps: int = 1) -> int:
        return len(names) * laps

    assert travel(["R1"], laps=2) == 2
    with pytest.raises(rw.InputError) as refusal:
        travel(["R1", 7], laps="two")  # type: ignore[list-item, arg-type]
    assert str(refusal.value) == (
        "names[1]: 7 does not fit (give text)\nlaps: 'two' does not fit (give a whole number)"
    )


@checks_arguments
def double(count: int) -> int:
    return 2 * count


def module_with(name: str, text: str) -> dict[str, Any]:
    """Return the names of a module of that name, which has `double`."""
    names = {"__name__": name, "double": double}
    exec(text, names)  # noqa: S102 - a module is only its name here
    return names


@pytest.mark.parametrize(
    ("module", "is_checked"),
    [
        ("rightofway.metrics.lost_time", False),
        ("rightofway.cli.laps", True),
        ("rightofway.studio.server", True),
        ("rightofway_planner", True),
        ("__main__", True),
    ],
)
def test_only_calls_that_enter_the_package_are_checked(module: str, is_checked: bool) -> None:
    """Also out of a generator that goes on later, and in another thread."""
    source = "call = lambda count: double(count)\ndef each(counts): yield from map(double, counts)"
    names = module_with(module, source)
    with ThreadPoolExecutor(1) as pool:
        calls: list[Callable[[], object]] = [
            lambda: names["call"]("ab"),
            lambda: next(names["each"](["ab"])),
            lambda: pool.submit(names["call"], "ab").result(),
        ]
        for call in calls:
            if is_checked:
                with pytest.raises(rw.InputError, match="count: 'ab' does not fit"):
                    call()
            else:
                assert call() == "abab"


def test_a_function_of_a_caller_is_outside_wherever_it_is_called() -> None:
    def double_of(text: Any) -> int:
        return double(text)

    names = module_with("rightofway.cyclic.run", "def report_to(report): return report('ab')")
    with pytest.raises(rw.InputError, match="count: 'ab' does not fit"):
        names["report_to"](double_of)


def test_planning_checks_no_argument_of_its_own_calls(monkeypatch: pytest.MonkeyPatch) -> None:
    looked_at = list[object]()

    def fault(_: ArgumentKind, place: object, value: object) -> None:
        looked_at.append((place, value))

    monkeypatch.setattr(ArgumentKind, "find_fault", fault)
    rw.solve(DOOR, "two-level", seed=1, time_limit=None)
    assert looked_at == []
    assert double(1) == 2
    assert looked_at == [(("count",), 1)]
