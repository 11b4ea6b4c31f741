"""Files are read strictly as text; JSON becomes plain data, or its line or key is reported."""

import gc
from decimal import Decimal
from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.io.collector import FEW, pause_garbage_collection
from rightofway.io.content import read_text
from rightofway.io.json_text import parse_json
from rightofway.io.layouts import read_layout
from rightofway.io.layouts.xml_tree import Element, parse_xml


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (b"", " the file is empty (give it some content)"),
        (b" \n\n", " the file is empty"),
        (b"\x7fELF\0\0", " the file is not text: byte 4 is 0 (give a text file)"),
        ("map".encode("utf-16"), " the file is UTF-16 text (save it as UTF-8)"),
        (b"a\nb: \xe4", "2: byte 0xe4 is not UTF-8 (save the file as UTF-8)"),
    ],
)
def test_what_is_no_utf_8_text_is_refused(tmp_path: Path, content: bytes, fault: str) -> None:
    path = tmp_path / "file.yaml"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        read_text(path)
    assert str(caught.value).startswith(f"{path}:{fault}")


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
    monkeypatch.setattr("rightofway.io.content.MAX_BYTES", 3)
    (tmp_path / "long").write_text("1234", encoding="utf-8")
    with pytest.raises(InputError, match="longer than 3 bytes"):
        read_text(tmp_path / "long")


def test_json_decimals_stay_exact() -> None:
    assert parse_json('{"a": [0.1, 1e-3, 7], "b": null}') == {
        "a": [Decimal("0.1"), Decimal("0.001"), 7],
        "b": None,
    }


def test_json_words_for_no_number_stay_words() -> None:
    assert parse_json("[NaN, -Infinity, 1e999999999]") == ["NaN", "-Infinity", "1e999999999"]


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        (
            "{\n1",
            "line 2: Expecting property name enclosed in double quotes (check the JSON there)",
        ),
        ("[1] 2", "line 1: Extra data (check the JSON there)"),
        (  # the fault is behind 10 * 9 characters
            "[\n" + '{"a": 1},' * 10 + "{,}\n]",
            (
                "line 2: Expecting property name enclosed in double quotes at column 92,"
                """ in '": 1},{"a": 1},{"a": 1},{,}' (check the JSON there)"""
            ),
        ),
        pytest.param("[" * 100_000, "values are nested more than 64 deep", id="open"),
        pytest.param("[" * 65 + "]" * 65, "values are nested more than 64 deep", id="closed"),
    ],
)
def test_json_faults_are_told_with_their_line(text: str, fault: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_json(text)
    assert fault in str(caught.value)


def test_json_keys_given_twice_are_told_with_their_place() -> None:
    with pytest.raises(InputError) as caught:
        parse_json('{"a": [{}, {"b": 1, "b": 2, "b": 3}], "c": 1, "c": 2}')
    assert str(caught.value).splitlines() == [
        "a[1]: the key 'b' is given twice (take one out)",
        "the key 'c' is given twice (take one out)",
    ]


def test_whole_numbers_of_any_length_are_read_at_once() -> None:
    digits = "9" * 1_000_000
    assert parse_json(f"[{digits}]") == [digits]


@pytest.mark.parametrize("was_enabled", [True, False])
def test_garbage_is_collected_after_a_file_as_before_also_a_wrong_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, was_enabled: bool
) -> None:
    """No collection begins while a layout is read; a fault leaves no pause behind."""
    seen = list[bool]()

    def parse(text: str, run_of: str) -> Element:
        seen.append(gc.isenabled())
        return parse_xml(text, run_of)

    monkeypatch.setattr("rightofway.io.layouts.formats.parse_xml", parse)
    (tmp_path / "wrong.graphml").write_text("<graphml><graph><node/></graph></graphml>")
    (gc.enable if was_enabled else gc.disable)()
    try:
        with pytest.raises(InputError):
            read_layout(tmp_path / "wrong.graphml")
        assert (gc.isenabled(), set(seen)) == (was_enabled, {False})
    finally:
        gc.enable()


def test_a_small_file_is_read_without_a_count_of_what_is_frozen(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The count goes through all objects that a program has frozen, 20 ms in a long-lived one."""
    monkeypatch.setattr(gc, "get_freeze_count", lambda: pytest.fail("it counts"))
    with pause_garbage_collection():
        made = [[] for _ in range(1000)]  # type: ignore[var-annotated]
    assert len(made) == 1000


def test_the_collector_does_not_look_at_all_that_was_made_while_it_paused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(gc, "get_freeze_count", lambda: 0)  # the tests have frozen their modules
    with pause_garbage_collection():
        made = [[] for _ in range(2 * FEW)]  # type: ignore[var-annotated]
    n_young = gc.get_count()[0]
    gc.freeze()
    assert n_young < len(made) / 10
