"""Long measurements go on where they were interrupted."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.kept import Kept, Row


def test_what_was_measured_is_not_measured_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    measured = []

    def measure(name: str) -> Row:
        if name == "three":
            raise KeyboardInterrupt
        measured.append(name)
        return {"name": name}

    path = tmp_path / "build" / "rows.jsonl"
    for name in ("one", "two"):
        Kept(path).take(("rows", name), measure, name)
    with pytest.raises(KeyboardInterrupt):
        Kept(path).take(("rows", "three"), measure, "three")
    again = Kept(path)
    for name in ("one", "two", "four"):
        again.take(("rows", name), measure, name)
    assert measured == ["one", "two", "four"]
    assert again["rows", "two"] == {"name": "two"}
    assert [line.split("  ")[-1] for line in capsys.readouterr().err.splitlines()] == [
        "rows, one",
        "rows, two",
        "rows, four",
    ]
    with pytest.raises(KeyError):
        again["rows", "three"]
