"""YAML becomes plain data, or the reader says which line is at fault."""

import time
from decimal import Decimal
from typing import Any

import pytest
import yaml

from rightofway.errors import InputError
from rightofway.io.yaml_text import MAX_ALIASED, parse_yaml


@pytest.fixture(params=["CSafeLoader", "SafeLoader"])
def _either_parser(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """PyYAML comes with libyaml or without."""
    monkeypatch.setattr(yaml, "CSafeLoader", getattr(yaml, request.param), raising=False)


either_parser = pytest.mark.usefixtures("_either_parser")


@pytest.mark.parametrize(
    ("text", "data"),
    [
        ("3", 3),
        ("-3", -3),
        ("0.1", Decimal("0.1")),
        ("1.0e-3", Decimal("0.001")),
        ("1/3", "1/3"),
        ("N0", "N0"),
        ("'3'", "3"),
        ("true", True),
        ("yes", "yes"),
        ("no", "no"),
        ("1:30", "1:30"),
        ("010", "010"),
        ("0x10", "0x10"),
        ("2026-01-02", "2026-01-02"),
        (".inf", ".inf"),
        ("1e999999999", "1e999999999"),
        ("~", None),
        ("", None),
        ("[1, [2]]", [1, [2]]),
        ("a: {b: c}\nd:", {"a": {"b": "c"}, "d": None}),
        ("a: &x [1, 2]\nb: *x", {"a": [1, 2], "b": [1, 2]}),
        ("a: &x 1\nb: &x 2\nc: *x", {"a": 1, "b": 2, "c": 2}),
        ("<<: {a: 1}", {"<<": {"a": 1}}),
        ("|\n  ..\n  @.\n", "..\n@.\n"),
    ],
)
@either_parser
def test_yaml_scalars_are_numbers_only_where_all_versions_agree(text: str, data: Any) -> None:
    assert parse_yaml(text) == data


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("a: 1\na: 2", "line 2: the key 'a' is given twice (take one out)"),
        ("a: &x [*x]", "line 1: the alias *x stands inside what it names (write the value out)"),
        ("a: &x 1\nb: &x [*x]", "line 2: the alias *x stands inside what it names"),
        ("a: *x", "line 1: the alias *x names nothing before it (write the value out)"),
        ("a\n---\nb", "line 2: a second document begins (keep one in a file)"),
        ("1: a", "line 1: the key 1 is not text (put it in quotes, or add what is missing)"),
        ("? [a]\n: b", "line 1: the key ['a'] is not text"),
        ("true: a", "line 1: the key true is not text"),
        ("a: !!float 1", "line 1: the tag 'tag:yaml.org,2002:float' is not allowed (take it out)"),
        ("a: !x {}", "line 1: the tag '!x' is not allowed (take it out)"),
        ("a: b: c", "line 1: mapping values are not allowed"),
        ("a: [", "(check the YAML there)"),
        ("a: '\x01'", "not allowed (save the file as plain text)"),
        ('"\\UFFFFFFFF"', ""),
        pytest.param("[" * 100_000, "line 1: values are nested more than 64 deep", id="lists"),
        pytest.param("{a: " * 100_000, "line 1: values are nested more than", id="mappings"),
        pytest.param("- " * 100_000, "line 1: values are nested more than", id="dashes"),
    ],
)
@either_parser
def test_yaml_faults_are_told_with_their_line(text: str, fault: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_yaml(text)
    assert fault in str(caught.value)


@either_parser
def test_a_tab_in_yaml_is_called_a_tab() -> None:
    """Nobody sees a tab in an editor: "a character that cannot start any token" is no help."""
    with pytest.raises(InputError) as caught:
        parse_yaml("a:\n\t- b\n")
    assert str(caught.value) == "line 2: a tab stands where YAML wants spaces (use spaces)"


def test_aliases_are_counted_in_full_before_they_are_followed() -> None:
    # 10 values in each list of aliases: the fifth level stands for 10^5 and more.
    levels = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    levels += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 40)]
    began = time.perf_counter()
    with pytest.raises(InputError, match=f"aliases stand for more than {MAX_ALIASED} values"):
        parse_yaml("\n".join(levels))
    assert time.perf_counter() - began < 1


@either_parser
def test_whole_numbers_of_any_length_are_read_at_once() -> None:
    digits = "9" * 1_000_000
    assert parse_yaml(f"[{digits}]") == [digits]
