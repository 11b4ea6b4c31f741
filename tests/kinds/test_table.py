"""The table of kinds: which values belong to a kind, in which type, and whether schemas agree."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator
from pydantic import TypeAdapter, ValidationError

from rightofway.errors import InputError
from rightofway.kinds.table import (
    COORDINATE,
    COUNT,
    LINE,
    NAME,
    NAMES,
    NOT_NEGATIVE,
    NUMBER,
    PATH,
    POSITION,
    POSITIVE,
    SEED,
    SHARE,
    TEXT,
    TRUTH,
    TURNING,
    TYPE_SPEEDS,
    VERTEX,
    Kind,
    allow_none,
    list_of,
    make_class,
    make_number,
    make_range,
    make_whole,
    make_words,
    require_index,
    tuple_of,
)

HALF = Fraction(1, 2)


@pytest.mark.parametrize(
    ("kind", "given", "value"),
    [
        (NUMBER, 0.1, Fraction(1, 10)),
        (NUMBER, "1/3", Fraction(1, 3)),
        (NUMBER, Fraction(1, 10**30), Fraction(1, 10**30)),
        (NUMBER, np.int64(7), Fraction(7)),
        (NUMBER, np.float64(0.5), HALF),
        (POSITIVE, Decimal("0.5"), HALF),
        (NOT_NEGATIVE, 0, Fraction(0)),
        (SHARE, "1", Fraction(1)),
        (SHARE, 0.0, Fraction(0)),
        (TURNING, "cell", "cell"),
        (TURNING, "1/2", HALF),
        (COUNT, np.int32(1), 1),
        (SEED, 2**32 - 1, 2**32 - 1),
        (VERTEX, np.int32(3), 3),
        (TRUTH, np.bool_(True), True),
        (NAMES, {"b", "a"}, frozenset({"a", "b"})),
        (NAMES, iter(["a"]), frozenset({"a"})),
        (TYPE_SPEEDS, {"b": 2, "a": "1/2"}, (("a", HALF), ("b", Fraction(2)))),
        (TYPE_SPEEDS, (("a", HALF),), (("a", HALF),)),
        (POSITION, [1, "0.5"], (Fraction(1), HALF)),
        (make_words("one", "both"), "both", "both"),
        (make_number(1, 2), "1.5", Fraction(3, 2)),
        (make_range(0, 2), Fraction(3, 2), 1.5),
        (allow_none(POSITIVE), None, None),
        (list_of(COUNT), iter([1, 2]), (1, 2)),
        (list_of(COUNT), np.array([1, 2]), (1, 2)),
        (LINE, "", ""),
    ],
)
def test_a_value_is_read_in_the_one_type_of_its_kind(
    kind: Kind[Any], given: object, value: object
) -> None:
    read = kind.read(given)
    assert read == value
    assert type(read) is type(value)


@pytest.mark.parametrize(
    ("kind", "values"),
    [
        (NUMBER, [True, np.True_, None, "", "x", math.nan, math.inf, "1/0", b"1", [1], 10**19]),
        (POSITIVE, [0, "0", -1, "-1/2", Fraction(0), None]),
        (NOT_NEGATIVE, [-1, "-0", Fraction(-1, 10**30)]),
        (SHARE, [1.01, "3/2", -0.5]),
        (TURNING, [-1, "Cell", None, True]),
        (COUNT, [0, True, 1.0, "1", None, Fraction(1), 10**400 * 0]),
        (SEED, [-1, 2**32, 0.0]),
        (VERTEX, ["N0", True, 0.0, None]),
        (TRUTH, [0, 1, "true", None]),
        (TEXT, [b"a", 1, None, ["a"]]),
        (NAME, ["", "a\0b", "\ud800", 1, None]),
        (LINE, ["a\nb", 1]),
        (NAMES, ["ab", [1], {"a": 1}, None]),
        (TYPE_SPEEDS, [{1: 2}, [("a", 1, 2)], [1], "a", None]),
        (PATH, [b"a", 1, None]),
        (COORDINATE, [10**19, "x"]),
        (POSITION, [[1], [1, 2, 3], "ab", {1: 2}, np.array([1, 2]), None]),
        (make_words("one", "both"), ["One", "", 1, None, ["one"]]),
        (make_whole(2, 3), [1, 4, 2.0, True]),
        (make_number(1, 2), ["0.99", "201/100"]),
        (make_range(0, 2), [-0.5, 3, math.nan, True, "1", 10**400]),
        (make_class(Path), ["a", None]),
        (list_of(COUNT), ["ab", {1: 2}, 3, None]),
        (list_of(COUNT, admits=list | tuple), [{1}, iter([1])]),
        (tuple_of(COUNT, "tail", "head"), [[1], "ab", {1, 2}]),
    ],
)
def test_other_values_are_refused_with_a_remedy(kind: Kind[Any], values: list[object]) -> None:
    for value in values:
        with pytest.raises(ValueError, match=r"\(.+\)"):
            kind.read(value)


def test_a_value_out_of_place_is_refused_at_its_place() -> None:
    with pytest.raises(InputError, match=r"^speeds\[1\]: 0 is not positive \(give a number above"):
        list_of(POSITIVE).read_at("speeds", [1, 0])
    with pytest.raises(InputError, match=r"^limits\.truck: 0 is not positive"):
        TYPE_SPEEDS.read_at("limits", {"truck": 0})
    with pytest.raises(InputError, match=r"^robot: 2 is none of 2 \(give 0 to 1\)"):
        require_index("robot", 2, 2)


IN_DOCUMENTS: dict[str, Kind[Any]] = {
    "number": NUMBER,
    "positive": POSITIVE,
    "not negative": NOT_NEGATIVE,
    "share": SHARE,
    "turning": TURNING,
    "count": COUNT,
    "seed": SEED,
    "name": NAME,
    "line": LINE,
    "truth": TRUTH,
    "words": make_words("one", "both"),
    "position": POSITION,
    "list": list_of(POSITIVE),
}

JSON: list[Any] = [None, True, False, -1, 0, 1, 2, 2**32, 0.5, -0.5, 1.5, "", "a", "one", "cell"]
JSON += ["1", "-1", "1/2", "3/2", [], [1, 2], [1, 0], ["1", 0.5], [1, 2, 3], {}, {"x": 1}]


@pytest.mark.parametrize("name", IN_DOCUMENTS)
def test_a_document_accepts_only_values_that_fit_the_schema_of_their_kind(name: str) -> None:
    """The schema may accept more: text that is a number, of which it cannot compare the size."""
    kind = IN_DOCUMENTS[name]
    adapter: TypeAdapter[Any] = TypeAdapter(Annotated[Any, kind])
    schema = Draft202012Validator(adapter.json_schema())
    accepted = 0
    for value in JSON:
        try:
            read = adapter.validate_python(value)
        except ValidationError:
            with pytest.raises(ValueError, match=r"\(.+\)"):
                kind.read(value)
            assert isinstance(value, str | list) or not schema.is_valid(value), value
        else:
            assert schema.is_valid(value), value
            assert read == kind.read(value)
            accepted += 1
    assert accepted
