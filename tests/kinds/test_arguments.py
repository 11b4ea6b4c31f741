"""Arguments at the front door: refused by their annotations, and only in calls from outside."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rightofway as rw
from rightofway.kinds.arguments import checks_arguments, read_annotation
from rightofway.kinds.table import Kind

ROOT = Path(__file__).parents[2]
DOOR = rw.load(ROOT / "examples" / "door.yaml")


def list_checked() -> Iterator[str]:
    """Yield the names of functions and methods in the package that check their arguments."""
    for path in (ROOT / "src" / "rightofway").rglob("*.py"):
        tree = ast.parse(path.read_text("utf-8"))
        for owner in ast.walk(tree):
            for item in owner.body if isinstance(owner, ast.Module | ast.ClassDef) else ():
                if isinstance(item, ast.FunctionDef) and any(
                    isinstance(mark, ast.Name) and mark.id == "checks_arguments"
                    for mark in item.decorator_list
                ):
                    prefix = f"{owner.name}." if isinstance(owner, ast.ClassDef) else ""
                    yield f"{prefix}{item.name}"


def test_the_front_door_and_only_the_front_door_checks_arguments_by_annotations() -> None:
    exported = {name: getattr(rw, name) for name in rw.__all__}
    doors = {name for name, value in exported.items() if inspect.isfunction(value)}
    checked = set(list_checked())
    assert {name for name in checked if "." not in name} == doors
    classes = {name.partition(".")[0] for name in checked if "." in name}
    assert classes <= {name for name, value in exported.items() if inspect.isclass(value)}


def fits(kind: Kind[Any], value: object) -> bool:
    try:
        kind.read(value)
    except ValueError:
        return False
    return True


@pytest.mark.parametrize(
    ("annotation", "good", "bad"),
    [
        (int, [0, -5, np.int32(3)], [True, 1.0, "1", None, 10**30]),
        (float, [1, 2.5, Fraction(1, 3)], [float("nan"), True, "1", 10**400]),
        (str | None, ["a", None], [b"a", 1, ["a"]]),
        (rw.Scenario, [DOOR], [DOOR.roadmap, None, "door.yaml"]),
        (list[int], [[1], (1, 2), np.array([1])], [[1, "a"], "ab", {1: 2}, {1}, iter([1]), 1]),
        (tuple[str, str], [("a", "b")], [("a",), "ab", None]),
        (dict[str, int], [{"a": 1}], [[("a", 1)], "ab", None]),
        (tuple[str, int], [("a", 1)], [("a", "b"), (1, 1), ("a",), {"a": 1}]),
        (Iterable[int], [[1], {1}, iter(["a"])], ["ab", {1: 1}, 1]),
        (Fraction, [1, 0.5, "1/3", Fraction(1, 3)], [True, "half", float("nan"), None]),
        (Any, [1, None, [object()]], []),
        (Callable[[int], int], [abs], [1, "abs"]),
    ],
)
def test_an_annotation_admits_what_it_names_and_nothing_else(
    annotation: Any, good: list[Any], bad: list[Any]
) -> None:
    kind = read_annotation(annotation)
    assert [value for value in good if not fits(kind, value)] == []
    assert [value for value in bad if fits(kind, value)] == []


def test_all_arguments_that_do_not_fit_are_named_with_their_items() -> None:
    @checks_arguments
    def travel(names: list[str], *, laps: int = 1) -> int:
        return len(names) * laps

    assert travel(["R1"], laps=2) == 2
    with pytest.raises(rw.InputError) as refusal:
        travel(["R1", 7], laps="two")  # type: ignore[list-item, arg-type]
    assert str(refusal.value) == (
        "names[1]: 7 is no text (give text)\nlaps: 'two' does not fit (give a whole number)"
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
