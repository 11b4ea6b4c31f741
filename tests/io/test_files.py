"""Files are read strictly as text."""

from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.io.text import read_text


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
        with pytest.raises(InputError, match=r"\(check the path|\(give a file in it") as caught:
            read_text(path)
        assert fault in str(caught.value)


def test_a_file_longer_than_any_of_ours_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rightofway.io.text.MAX_BYTES", 3)
    (tmp_path / "long").write_text("1234", encoding="utf-8")
    with pytest.raises(InputError, match="longer than 3 bytes"):
        read_text(tmp_path / "long")
