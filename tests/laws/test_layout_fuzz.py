"""Whatever is in a layout's file: a layout, or an InputError that can be printed."""

import copy
import json
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rightofway.io.text import parse_yaml
from tests.builders.broken_layouts import BOMBS, failures, limited, opened

HERE = Path(__file__).parents[1] / "data" / "layouts"
FILES = sorted(path for path in HERE.iterdir() if path.suffix != ".md")
DATA = [path for path in FILES if path.suffix in {".json", ".geojson", ".yaml"}]

oddities = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-3, 4),
    st.integers(),
    st.floats(),
    st.text(max_size=4),
    st.sampled_from(["1e999", "1/0", "nan", "9" * 5000, "\0", "", "a\nb", "dock", "room.pgm"]),
    st.lists(st.integers(-1, 3), max_size=4),
    st.dictionaries(st.sampled_from(["name", "x", "mutex", "distance"]), st.integers(), max_size=2),
)
junk = st.one_of(
    st.binary(max_size=6),
    st.sampled_from([b"-1", b".nan", b"1e999", b"&a ", b"*a", b"<", b"!!python/none", b'"', b"[["]),
)


def steps_in(value: Any) -> Iterator[tuple[Any, ...]]:
    """Yield the way to every value inside a document."""
    inside = value.items() if isinstance(value, dict) else enumerate(value)
    for key, child in inside:
        yield (key,)
        if isinstance(child, dict | list):
            yield from ((key, *rest) for rest in steps_in(child))


@settings(max_examples=150, deadline=None)
@given(data=st.data())
def test_values_of_wrong_kinds_are_refused(data: st.DataObject) -> None:
    source = data.draw(st.sampled_from(DATA))
    document = copy.deepcopy(parse_yaml(source.read_text("utf-8"), number_keys=True))
    for _ in range(data.draw(st.integers(1, 3))):
        *way, last = data.draw(st.sampled_from(list(steps_in(document))))
        part = document
        for step in way:
            part = part[step]
        part[last] = data.draw(oddities)
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(HERE / "room.pgm", folder)
        path = Path(folder) / "layout.json"
        path.write_text(json.dumps(document, default=float), encoding="utf-8")
        opened(path)


@settings(max_examples=150, deadline=None)
@given(data=st.data())
def test_files_that_are_cut_or_swapped_are_refused(data: st.DataObject) -> None:
    source = data.draw(st.sampled_from(FILES))
    text = source.read_bytes()
    begin = data.draw(st.integers(0, len(text)))
    length = data.draw(st.sampled_from([0, 1, 3, 20, len(text)]))
    other = data.draw(st.sampled_from(FILES)).read_bytes()
    start = data.draw(st.integers(0, len(other)))
    swapped = data.draw(st.one_of(junk, st.just(other[start : start + length])))
    with tempfile.TemporaryDirectory() as folder:
        for file in FILES:
            shutil.copy(file, folder)
        path = Path(folder) / source.name
        path.write_bytes(text[:begin] + swapped + text[begin + length :])
        opened(path.with_name("room.yaml") if path.name == "room.pgm" else path)


def test_broken_files_are_refused_soon() -> None:
    """The first files of the large run, `just fuzz-layouts`."""
    *failed, (_, _, longest) = failures(seed=0, numbers=range(150))
    assert failed == []
    assert longest < 10


@pytest.mark.parametrize("number", range(len(BOMBS)))
@pytest.mark.parametrize("name", ["bomb.json", "bomb.yaml", "bomb.xml", "nodes.csv", "bomb.map"])
def test_bombs_are_refused_soon(tmp_path: Path, name: str, number: int) -> None:
    path = tmp_path / name
    path.write_bytes(BOMBS[number])
    with limited(5):
        assert not opened(path)
