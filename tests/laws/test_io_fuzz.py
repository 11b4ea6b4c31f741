"""Whatever is in a document or a file: a scenario or plan, or an InputError that can be printed."""

import copy
import json
from collections.abc import Callable, Iterator
from decimal import Decimal
from pathlib import Path
from typing import Any

import jsonschema
from hypothesis import given, settings
from hypothesis import strategies as st

from rightofway.errors import InputError, InputFault
from rightofway.io import (
    dump_plan,
    make_schema,
    parse_plan,
    parse_scenario,
)
from rightofway.io.json_text import parse_json
from rightofway.io.locations import locate
from rightofway.io.yaml_text import parse_yaml
from rightofway.model import Plan, PlannerRun, Status, Track

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
FITS = {
    kind: jsonschema.Draft202012Validator(make_schema(kind)).is_valid
    for kind in ("scenario", "plan")
}

ROADMAP = {
    "format": "rightofway-scenario/1",
    "map": {
        "roadmap": {
            "vertices": {"dock": [0, 0], "shelf": [3, 4], "gate": [6, 8]},
            "edges": [["dock", "shelf"], ["shelf", "gate", "5/2"], {"from": "gate", "to": "dock"}],
        }
    },
    "robots": [
        {"name": "R1", "home": "dock", "target": "gate", "work": "1/2", "laps": 2},
        {"name": "R2", "home": "shelf", "stops": [{"at": "gate"}, {"at": "dock", "work": 1}]},
    ],
    "rules": {"occupancy": "both", "headway": 0.5, "turn": 1, "return": "home"},
}
DOCUMENTS = [
    ROADMAP,
    *(parse_yaml((EXAMPLES / f"{name}.yaml").read_text("utf-8")) for name in ("door", "floor")),
    {
        "format": "rightofway-scenario/1",
        "map": {"grid": ["...", "..@"], "cell_size": "1/2", "y": "up", "origin": [-3.25, "1/3"]},
        "units": {"length": "m", "time": "s"},
        "robots": [{"name": "R1", "home": {"x": -3, "y": 1}, "target": {"x": -1.8, "y": "1.2"}}],
    },
    {
        "format": "rightofway-scenario/1",
        "map": {"file": "hall.map"},
        "robots": {"scen": "hall.scen", "count": 1, "speeds": [1], "work": [0, "1/2"], "turn": 0},
    },
]

scalars = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-3, 12),
    st.integers(),
    st.decimals(allow_nan=False),
    st.floats(),
    st.text(max_size=6),
    st.sampled_from(["N0", "N7", "N999", "R1", "home", "none", "cell", "one", "both", "clustered"]),
    st.sampled_from(["1/0", "1/3", "-1", "1e999999999", "9" * 5000, "\ud800", "\0", "a\nb"]),
    st.sampled_from([10**400, -(2**63), 2**64, Decimal("1e-999999"), "dock", "hall.map", "."]),
)
values = st.recursive(
    scalars,
    lambda inner: st.one_of(
        st.lists(inner, max_size=4), st.dictionaries(st.text(max_size=4), inner, max_size=3)
    ),
    max_leaves=6,
)


def _spots(node: Any) -> Iterator[tuple[Any, Any]]:
    """Return every container of a document with each of its keys or indices."""
    steps = node.items() if isinstance(node, dict) else enumerate(node)
    for step, child in list(steps):
        yield node, step
        if isinstance(child, dict | list):
            yield from _spots(child)


def _mutated(draw: st.DrawFn, document: Any) -> Any:
    document = copy.deepcopy(document)
    for _ in range(draw(st.integers(0, 3))):
        container, step = draw(st.sampled_from(list(_spots(document)) or [({}, 0)]))
        change = draw(st.sampled_from(["replace", "remove", "copy", "add"]))
        if change == "remove":
            container.pop(step, None) if isinstance(container, dict) else container.clear()
        elif change == "copy":
            other, key = draw(st.sampled_from(list(_spots(document)) or [({}, 0)]))
            container[step] = copy.deepcopy(other[key]) if other else None
        elif change == "add" and isinstance(container, dict):
            container[draw(st.sampled_from(["laps", "grid", "speed", "turn", "x", "file"]))] = draw(
                values
            )
        else:
            container[step] = draw(values)
    return document


@st.composite
def mutated_scenarios(draw: st.DrawFn) -> Any:
    return _mutated(draw, draw(st.sampled_from(DOCUMENTS)))


@st.composite
def mutated_plans(draw: st.DrawFn) -> Any:
    scenario = parse_scenario(draw(st.sampled_from([ROADMAP, DOCUMENTS[1]])))
    plan = Plan(
        scenario=scenario,
        tracks=tuple(Track.of([robot.home, 0], [0, 5]) for robot in scenario.robots),
        run=PlannerRun(name="x", options={"a": 1}, status=Status("other", text="s")),
    )
    return _mutated(draw, dump_plan(plan))


def accepts(read: Callable[..., object], *arguments: Any) -> bool:
    """Return whether something is read; if not, it must be an InputError that can be printed."""
    told = _told(read, *arguments)
    if told is not None:
        assert all(line and line.isprintable() for line in told.split("\n"))
    return told is None


def _faults(read: Callable[..., object], *arguments: Any) -> tuple[InputFault, ...]:
    try:
        read(*arguments)
    except InputError as error:
        return error.faults
    return ()


def _told(read: Callable[..., object], *arguments: Any) -> str | None:
    try:
        read(*arguments)
    except InputError as error:
        return str(error)
    return None


HALL = ROOT / "tests" / "data" / "bad"


@given(mutated_scenarios())
@settings(max_examples=400, deadline=None)
def test_scenario_documents(document: Any) -> None:
    if accepts(parse_scenario, document, HALL):
        assert FITS["scenario"](document)


@given(mutated_plans())
@settings(max_examples=200, deadline=None)
def test_plan_documents(document: Any) -> None:
    if accepts(parse_plan, document):
        assert FITS["plan"](document)


@given(mutated_scenarios(), st.sampled_from([None, 1]))
@settings(max_examples=200, deadline=None)
def test_marks_say_the_same_faults_with_lines_of_the_text(
    document: Any, indent: int | None
) -> None:
    try:
        text = json.dumps(document, indent=indent)
    except TypeError:  # no JSON has decimals
        return
    faults = _faults(parse_scenario, parse_json(text), HALL)
    found = tuple(locate(faults, text))
    assert [(one.place, one.message) for one in found] == [
        (one.place, one.message) for one in faults
    ]
    lines = range(1, text.count("\n") + 2)
    assert all(one.line is None or one.line in lines for one in found)
    assert all(str(one).isprintable() for one in found)


@given(values)
def test_any_data(data: Any) -> None:
    assert not accepts(parse_scenario, data)
    assert not accepts(parse_plan, data)


@given(st.text(alphabet="[]{}:-,&*!|>'\"\n #ab1.~?%@`\t", max_size=40))
@settings(max_examples=300, deadline=None)
def test_any_text(text: str) -> None:
    accepts(parse_yaml, text)
    accepts(parse_json, text)
