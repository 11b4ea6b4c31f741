"""The quick reader returns the document of pydantic, or leaves the data to it."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import strategies as st

from rightofway.errors import InputError
from rightofway.io.documents import parse_document
from rightofway.io.faults import list_keys, validate
from rightofway.io.fields import Document
from rightofway.io.models import make_adapter
from rightofway.io.plan import shape as plan_shape
from rightofway.io.quick_reader import read_quickly
from rightofway.io.scenario import shape, work_shape
from rightofway.io.scenario.shape import MapDocument, RobotDocument, ScenarioFrame
from tests.builders.laws import law

EXAMPLES = Path(__file__).parents[2] / "examples"

DOCUMENTS = [
    item
    for module in (shape, work_shape, plan_shape)
    for item in vars(module).values()
    if isinstance(item, type) and issubclass(item, Document) and item.__module__ == module.__name__
]

WORDS = ("N0", "", "a\nb", "down", "auto", "cell", "vertex", "06:00", "1/2", "-0", "clustered")
LEAVES = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-2, 3),
    st.just(2**70),
    st.sampled_from([0.5, -0.25, float("nan"), Fraction(1, 3), np.int64(1), np.bool_(True)]),
    st.sampled_from(WORDS),
)
VALUES = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        st.lists(inner, max_size=3),
        st.lists(inner, max_size=2).map(tuple),
        st.dictionaries(st.sampled_from([*WORDS, "at", "work"]), inner, max_size=2),
    ),
    max_leaves=4,
)
FITTING = st.one_of(LEAVES, st.tuples(st.integers(0, 3), st.integers(0, 3)).map(list), VALUES)


@st.composite
def documents(draw: st.DrawFn) -> tuple[type[Document], Any]:
    """Return a kind of document, and data with some of its keys."""
    document = draw(st.sampled_from(DOCUMENTS))
    keys = [field.alias or name for name, field in document.fields.items()]
    given = draw(st.lists(st.sampled_from([*keys, "other"]), unique=True))
    return document, {key: draw(FITTING) for key in given}


def as_plain(value: Any) -> Any:
    """Return a value with its types, for a comparison."""
    if isinstance(value, Document):
        return type(value), {name: as_plain(own) for name, own in value.get_all().items()}
    if isinstance(value, list | tuple):
        return type(value), [as_plain(item) for item in value]
    if isinstance(value, dict):
        return {key: as_plain(item) for key, item in value.items()}
    return type(value), repr(value)


def assert_equal(document: type[Document], data: Any) -> None:
    found = read_quickly(document, data)
    if found is not None:
        adapter: Any = make_adapter(document)  # type: ignore[arg-type]
        thorough = adapter.validate_python(data)
        assert as_plain(found) == as_plain(thorough)
        assert found.given == thorough.given


@law(documents())
def test_data_are_read_as_by_pydantic_or_not_at_all(drawn: tuple[type[Document], Any]) -> None:
    assert_equal(*drawn)


@law(st.sampled_from(sorted(EXAMPLES.glob("*.yaml"))), st.data())
def test_a_changed_example_is_read_as_by_pydantic_or_not_at_all(
    path: Path, draws: st.DataObject
) -> None:
    document = parse_document(path.read_text(), path)
    robots = document.get("robots")
    parts: list[tuple[type[Document], Any]] = [(MapDocument, document.get("map"))]
    if isinstance(robots, list) and robots:
        parts.append((RobotDocument, draws.draw(st.sampled_from(robots))))
    kind, data = draws.draw(st.sampled_from(parts))
    assert_equal(kind, data)
    if isinstance(data, dict):
        key = draws.draw(st.sampled_from([*data, *list_keys(kind)]))
        assert_equal(kind, data | {key: draws.draw(FITTING)})


def test_every_example_is_read_quickly() -> None:
    left = []
    for path in EXAMPLES.glob("*.yaml"):
        document = parse_document(path.read_text(), path)
        if not isinstance(document, dict) or "map" not in document:
            continue
        robots = document["robots"]
        parts = [(ScenarioFrame, document), (MapDocument, document["map"])]
        parts += [(RobotDocument, robot) for robot in robots if isinstance(robots, list)]
        left += [path.name for kind, data in parts if read_quickly(kind, data) is None]
    assert left == []


@pytest.mark.parametrize("data", [None, [], "text", {1: 2}, {"name": "R1", "speed": True}])
def test_faults_are_left_to_pydantic(data: Any) -> None:
    assert read_quickly(RobotDocument, data) is None
    with pytest.raises(InputError):
        validate(RobotDocument, data)
