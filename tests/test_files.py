"""Files are written whole or not at all."""

import sys
from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.files import write_whole


def test_a_file_that_could_not_be_written_is_as_it_was(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    write_whole(path, "old")
    with pytest.raises(InputError, match="the file cannot be written"):
        write_whole(path, "new \ud800")  # no UTF-8: writing fails half way
    assert path.read_text(encoding="utf-8") == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_an_interrupt_leaves_nothing_half_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_whole(tmp_path / "plan.json", "new")
    assert list(tmp_path.iterdir()) == []


def test_where_nothing_can_be_written_is_told(tmp_path: Path) -> None:
    for path, fault in [
        (
            tmp_path / "no" / "plan.json",
            f"there is no directory '{tmp_path / 'no'}' (make it first)",
        ),
        (tmp_path, "this is a directory (give a file name in it)"),
        (Path("a\0b"), "the file cannot be written: embedded null byte"),
    ]:
        with pytest.raises(InputError) as caught:
            write_whole(path, "text")
        assert str(caught.value) == f"{path}: {fault}" or fault in str(caught.value)


def test_a_link_is_followed_and_kept(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old", encoding="utf-8")
    (tmp_path / "link").symlink_to("real")
    write_whole(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text(encoding="utf-8") == "new"


def test_a_device_is_written_to_not_replaced() -> None:
    if sys.platform != "win32":
        write_whole(Path("/dev/null"), "text")
        assert not Path("/dev/null").is_file()
