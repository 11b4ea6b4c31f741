"""Files are read strictly as text, and written whole or not at all."""

import sys
from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.io.files import read_text, write_text


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (b"", "the file is empty (give it some content)"),
        (b" \n\n", "the file is empty"),
        (b"\x7fELF\0\0", "the file is not text: byte 4 is 0 (give a text file)"),
        ("map".encode("utf-16"), "the file is UTF-16 text (save it as UTF-8)"),
        (b"a\nb: \xe4", "line 2: byte 0xe4 is not UTF-8 (save the file as UTF-8)"),
    ],
)
def test_what_is_no_utf_8_text_is_refused(tmp_path: Path, content: bytes, fault: str) -> None:
    path = tmp_path / "file.yaml"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        read_text(path)
    assert str(caught.value).startswith(f"{path}: {fault}")


def test_marks_and_line_ends_of_other_systems_are_taken_off(tmp_path: Path) -> None:
    path = tmp_path / "file.yaml"
    path.write_bytes(b"\xef\xbb\xbfa: 1\r\nb: 2\rc: \xc3\xa4\n")
    assert read_text(path) == "a: 1\nb: 2\nc: ä\n"


def test_what_cannot_be_opened_is_told(tmp_path: Path) -> None:
    for path, fault in [
        (tmp_path / "none.yaml", "there is no such file (check the path)"),
        (tmp_path, "this is a directory (give a file in it)"),
        (tmp_path / ("x" * 300), "the file cannot be read: File name too long"),
        (Path("a\0b"), "the file cannot be read: embedded null byte"),
    ]:
        with pytest.raises(InputError, match="check the path|give a file in it") as caught:
            read_text(path)
        assert fault in str(caught.value)


def test_a_file_longer_than_any_of_ours_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rightofway.io.files.MAX_BYTES", 3)
    (tmp_path / "long").write_text("1234", encoding="utf-8")
    with pytest.raises(InputError, match="longer than 3 bytes"):
        read_text(tmp_path / "long")


def test_a_file_that_could_not_be_written_is_as_it_was(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    write_text(path, "old")
    with pytest.raises(InputError, match="the file cannot be written"):
        write_text(path, "new \ud800")  # no UTF-8: writing fails half way
    assert path.read_text(encoding="utf-8") == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_an_interrupt_leaves_nothing_half_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_text(tmp_path / "plan.json", "new")
    assert list(tmp_path.iterdir()) == []


def test_where_nothing_can_be_written_is_told(tmp_path: Path) -> None:
    for path, fault in [
        (tmp_path / "no" / "plan.json", f"there is no directory '{tmp_path / 'no'}' (make it first)"),
        (tmp_path, "this is a directory (give a file name in it)"),
        (Path("a\0b"), "the file cannot be written: embedded null byte"),
    ]:
        with pytest.raises(InputError) as caught:
            write_text(path, "text")
        assert str(caught.value) == f"{path}: {fault}" or fault in str(caught.value)


def test_a_link_is_followed_and_kept(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old", encoding="utf-8")
    (tmp_path / "link").symlink_to("real")
    write_text(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text(encoding="utf-8") == "new"


def test_a_device_is_written_to_not_replaced() -> None:
    if sys.platform != "win32":
        write_text(Path("/dev/null"), "text")
        assert not Path("/dev/null").is_file()
