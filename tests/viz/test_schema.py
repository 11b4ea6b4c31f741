"""What pages are given is what the types for Python and JavaScript say."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import pytest
from PIL import Image
from pydantic import TypeAdapter, ValidationError

from rightofway import load, solve
from rightofway.errors import NoPlanExists
from rightofway.io.sites import Choice, read_sites
from rightofway.metrics import inspect
from rightofway.repair.impossible import put_fleet_at_home
from rightofway.viz import Background, make_inspection_page, make_payload
from rightofway.viz.page.document import as_compact_json
from rightofway.viz.page.schema import InspectionPayload, Payload
from rightofway.viz.page.shift_data import make_shift_payload
from tests.builders.closures import closed_fleet
from tests.builders.fleets import grid_fleet
from tests.builders.payloads import payload_in
from tests.builders.plans import (
    counter,
    counter_late,
    counter_steady,
    door,
    door_shifted,
    loop,
    yard,
)
from tests.builders.shifts import make_shift
from tests.builders.sizes import sized_on_lanes, zoned
from tests.builders.typescript import stale, type_of

TESTS = Path(__file__).parents[1]
EXAMPLES = TESTS.parent / "examples"
PAYLOAD = TypeAdapter(Payload)
INSPECTION = TypeAdapter(InspectionPayload)


def validate(payload: Payload) -> None:
    """Raise `ValidationError` for a key or a value that the types do not have."""
    PAYLOAD.validate_json(as_compact_json(payload), strict=True, extra="forbid")


PLANS: dict[str, Callable[[], Payload]] = {
    "decisions": lambda: make_payload(door()),
    "curves": lambda: make_payload(loop()),
    "shift": lambda: make_shift_payload(make_shift()),
    "sizes": lambda: make_payload(yard()),
    "laps": lambda: make_payload(counter(), steady=[counter_steady()]),
    "floor": lambda: make_payload(counter(), actual=counter_late()),
    "compared": lambda: make_payload(door(), others=[(door_shifted(2), "B"), (loop(), "C")]),
    "closures": lambda: make_payload(solve(closed_fleet(1), "prioritized")),
    "zones": lambda: make_payload(solve(zoned(1))),
    "lanes": lambda: make_payload(solve(sized_on_lanes(1))),
}


@pytest.mark.parametrize("made", PLANS.values(), ids=PLANS)
def test_the_payload_of_every_kind_of_plan_has_the_declared_types(
    made: Callable[[], Payload],
) -> None:
    validate(made())


@pytest.mark.parametrize("name", ["bay", "crossroad", "door", "floor", "warehouse"])
def test_the_payload_of_every_example_has_the_declared_types(name: str) -> None:
    validate(make_payload(solve(load(EXAMPLES / f"{name}.yaml"), "prioritized")))


def test_the_payload_with_a_picture_has_the_declared_types(tmp_path: Path) -> None:
    Image.new("L", (60, 30), 200).save(tmp_path / "hall.png")
    validate(make_payload(door(), background=Background(picture=tmp_path / "hall.png", yaw=1)))


def test_the_payload_of_a_fleet_without_a_plan_has_the_declared_types() -> None:
    scenario = grid_fleet(["...", "@@@", "..."], [("N0", "N2"), ("N2", "N0"), ("N6", "N8")])
    with pytest.raises(NoPlanExists) as caught:
        solve(scenario)
    validate(make_payload(put_fleet_at_home(scenario), no_plan=caught.value))


@pytest.mark.parametrize("name", ["edges.csv", "hall.building.yaml", "two-rooms.map"])
def test_the_payload_of_every_inspection_has_the_declared_types(name: str) -> None:
    sites = read_sites(TESTS / "data" / "layouts" / name, Choice())
    levels = [(level, site, inspect(site)) for level, site in sites.sites]
    page = make_inspection_page(levels, title=name, description="a hall", notes=["one"])
    INSPECTION.validate_json(json.dumps(payload_in(page)), strict=True, extra="forbid")


def test_a_key_that_no_type_has_is_found() -> None:
    payload = make_payload(door())
    cast("dict[str, Any]", payload["robots"][0])["age"] = 3
    with pytest.raises(ValidationError, match=r"robots.0.age"):
        validate(payload)


def test_the_types_for_javascript_are_those_of_the_models() -> None:
    assert stale() == []


@pytest.mark.parametrize(
    ("schema", "expected"),
    [
        (
            {"type": "array", "items": {"anyOf": [{"type": "integer"}, {"type": "null"}]}},
            "(number | null)[]",
        ),
        (
            {"type": "array", "prefixItems": [{"type": "string"}, {"type": "number"}]},
            "[string, number]",
        ),
        (
            {"type": "object", "additionalProperties": {"$ref": "#/$defs/Run"}},
            "Record<string, Run>",
        ),
        ({"enum": ["a", 1]}, '"a" | 1'),
        ({}, "unknown"),
    ],
)
def test_a_schema_becomes_the_type_of_its_values(schema: dict[str, object], expected: str) -> None:
    assert type_of(schema) == expected
