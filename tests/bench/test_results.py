"""The file of results: what is kept, mended, refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rightofway.bench import COLUMNS, Results, Row
from rightofway.errors import InputError

KINDS: dict[str, Any] = {"text": "text", "int": 7, "float": 0.25, "bool": True}


def row(key: str, **values: Any) -> Row:
    return {**{column.name: KINDS[column.kind] for column in COLUMNS}, "key": key, **values}


def test_rows_come_back_as_they_were(tmp_path: Path) -> None:
    rows = [
        row("a"),
        row("b", solved=False, valid=None, flowtime=None, ratio=None, message=""),
        row("c", message='a "quoted", long; → Zoë', limit=1e-7, flowtime=2**60),
    ]
    with Results(tmp_path / "r.csv") as results:
        for each in rows:
            results.add(each)
    with Results(tmp_path / "r.csv") as results:
        assert list(results.rows.values()) == rows


def test_a_row_is_a_line_whatever_its_message(tmp_path: Path) -> None:
    with Results(tmp_path / "r.csv") as results:
        results.add(row("a", message="one\ntwo\r\nthree\u2028four\x0cfive"))
    assert (tmp_path / "r.csv").read_text(encoding="utf-8").splitlines()[1].startswith("a,text,")
    with Results(tmp_path / "r.csv") as results:
        assert results.rows["a"]["message"] == "one two three four five"


def test_a_row_is_in_the_file_as_soon_as_it_is_added(tmp_path: Path) -> None:
    results = Results(tmp_path / "r.csv")
    results.add(row("a"))
    assert (tmp_path / "r.csv").read_text(encoding="utf-8").count("\n") == 2
    results.close()


def test_a_key_is_kept_once(tmp_path: Path) -> None:
    with Results(tmp_path / "r.csv") as results:
        results.add(row("a", seed=1))
        results.add(row("a", seed=2))
    assert (tmp_path / "r.csv").read_text(encoding="utf-8").count("\n") == 2
    with Results(tmp_path / "r.csv") as results:
        results.add(row("a", seed=3))
        assert results.rows["a"]["seed"] == 1


def test_wherever_a_write_was_cut_the_rows_before_it_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "r.csv"
    with Results(path) as results:
        results.add(row("a"))
        results.add(row("b", message="with, a comma"))
    content = path.read_bytes()
    first, second = (content.index(b"\n", content.index(b"\n" + key) + 1) for key in (b"a", b"b"))
    for cut in range(len(content)):
        path.write_bytes(content[:cut])
        with Results(path) as results:
            kept = [key for key, end in (("a", first), ("b", second)) if cut > end]
            assert list(results.rows) == kept
            for key in "ab":
                results.add(row(key, message="with, a comma" if key == "b" else "text"))
        assert path.read_bytes() == content


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        ("name,age\n", "1: this is no file of results as they are now (give another file)"),
        ("precious", "1: this is no file of results as they are now (give another file)"),
        ("{header}\n{row}\na,b\n", "3: this is no row of results: "),
        (
            "{header}\n{bad}\n",
            "2: this is no row of results: 'perhaps' is not yes or no (take",
        ),
    ],
)
def test_another_file_is_refused_and_left_alone(tmp_path: Path, content: str, fault: str) -> None:
    path = tmp_path / "r.csv"
    with Results(path) as results:
        results.add(row("a"))
    header, line = path.read_text(encoding="utf-8").splitlines()
    content = content.format(header=header, row=line, bad=line.replace("yes", "perhaps", 1))
    path.write_text(content, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        Results(path)
    assert str(caught.value).startswith(f"{path}:{fault}")
    assert path.read_text(encoding="utf-8") == content


def test_a_file_that_cannot_be_opened_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"cannot be opened: Is a directory \(check the path"):
        Results(tmp_path)
