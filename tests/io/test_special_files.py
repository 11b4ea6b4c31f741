"""Only files are read where a document names one; a pipe that the user names is read once."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from rightofway.cli.main import run
from rightofway.cli.terminal import complain
from rightofway.errors import InputError, InputFault, Location
from rightofway.io import load, load_map, load_plan, parse_scenario, read_layout
from rightofway.io.content import read_content
from rightofway.io.faults import validate
from rightofway.io.scenario.shape import MapDocument

ROOT = Path(__file__).parents[2]
LAYOUTS = ROOT / "tests" / "data" / "layouts"
GRID = {"grid": ["..."]}
ROBOT = {"name": "R1", "home": "N0", "target": "N1"}


def document(shape: dict[str, Any], robots: Any = None) -> dict[str, Any]:
    return {"format": "rightofway-scenario/1", "map": shape, "robots": robots or [ROBOT]}


@pytest.mark.parametrize(
    ("shape", "robots", "place"),
    [
        ({"file": "/dev/zero"}, None, "map.file"),
        ({"layout": "/dev/zero"}, None, "map.layout"),
        (GRID, {"scen": "/dev/zero"}, "robots.scen"),
        (GRID, {"table": "/dev/zero"}, "robots.table"),
        ({**GRID, "picture": {"file": "/dev/zero", "scale": 1}}, None, "map.picture.file"),
    ],
)
def test_a_device_that_a_document_names_is_not_read(
    tmp_path: Path, shape: dict[str, Any], robots: Any, place: str
) -> None:
    """It would be read up to the limit of a file, half a gigabyte."""
    with pytest.raises(InputError) as caught:
        parse_scenario(document(shape, robots), tmp_path)
    assert "is a device or a pipe, not a file (name a file)" in str(caught.value)
    assert str(caught.value).startswith(f"{place}: '/dev/zero'")


def test_a_pipe_that_a_document_names_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match=r"map.file: '.* is a device or a pipe, not a file"):
        parse_scenario(document({"file": "pipe"}), tmp_path)
    (tmp_path / "map.yaml").write_text(
        "image: pipe\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.2\n",
        "utf-8",
    )
    with pytest.raises(InputError, match=r"image: '.* is a device or a pipe, not a file"):
        read_layout(tmp_path / "map.yaml")


def test_standard_input_is_no_file_of_a_document() -> None:
    """``-`` beside a file in the working directory has the path of standard input."""
    with pytest.raises(InputError, match=r"map.file: '-' names no file here"):
        parse_scenario(document({"file": "-"}), Path())


def test_a_device_that_the_user_names_is_refused() -> None:
    with pytest.raises(InputError, match=r"/dev/zero: this is a device \(give a file\)"):
        load_plan("/dev/zero")


def test_the_size_of_a_file_is_looked_at_first(tmp_path: Path) -> None:
    """A file with a hole of 2 TB takes no room on the disk."""
    with (tmp_path / "huge.map").open("wb") as file:
        file.truncate(2**41)
    for read in (load_map, load_plan):
        with pytest.raises(InputError, match="longer than 536870912 bytes"):
            read(tmp_path / "huge.map")
    with pytest.raises(InputError, match="longer than 2 bytes"):
        read_content(LAYOUTS / "hall.lif.json", 2)


@pytest.fixture
def piped() -> Iterator[Any]:
    """Return a function that makes a pipe with some content, named as shells name it."""
    ends: list[int] = []

    def pipe(content: bytes) -> Path:
        end, begin = os.pipe()
        ends.append(end)

        def fill() -> None:
            with os.fdopen(begin, "wb") as file:
                file.write(content)

        threading.Thread(target=fill, daemon=True).start()
        return Path(f"/dev/fd/{end}")

    yield pipe
    for end in ends:
        os.close(end)


@pytest.mark.parametrize(
    "name", ["hall.lif.json", "hall.graphml", "two-rooms.map", "hall.nav.yaml"]
)
def test_a_layout_comes_through_a_pipe(piped: Any, name: str) -> None:
    """The beginning of a file, its text, and maps once more are read one after another."""
    found = read_layout(piped((LAYOUTS / name).read_bytes()))
    assert found == read_layout(LAYOUTS / name)


def test_a_plan_and_a_scenario_come_through_a_pipe(
    piped: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    door = ROOT / "examples" / "door.yaml"
    assert load(piped(door.read_bytes())) == load(door)
    assert run(["plan", str(door), "-q", "-o", str(tmp_path / "plan.json")]) == 0
    assert run(["table", str(tmp_path / "plan.json")]) == 0
    table = capsys.readouterr().out
    assert run(["table", str(piped((tmp_path / "plan.json").read_bytes()))]) == 0
    assert capsys.readouterr() == (table, "")


def test_a_layout_through_a_pipe_is_said_to_be_one(piped: Any) -> None:
    """What is read to describe the layout was read before, to recognize it."""
    with pytest.raises(InputError, match="this is a LIF layout with 4 vertices, 8 lanes"):
        load(piped((LAYOUTS / "hall.lif.json").read_bytes()))


def test_a_scen_file_with_a_map_of_a_long_name_is_refused(tmp_path: Path) -> None:
    name = "a" * 500
    (tmp_path / "long.scen").write_text(f"version 1\n0\t{name}\t3\t3\t0\t0\t1\t1\t2\n", "utf-8")
    with pytest.raises(InputError, match=r"its map 'a{58}… is neither beside it nor in ../maps"):
        load(tmp_path / "long.scen")


@pytest.mark.parametrize(
    ("text", "escaped"),
    [
        ("speed\u202edeeps", r"speed\u202edeeps"),  # turns the direction of what follows
        ("\x1b[2Jspeed", r"\x1b[2Jspeed"),  # clears a terminal
        ("speed\ud800", r"speed\ud800"),  # half of a pair of UTF-16 that is no character
        ("speed\nR2: fine", r"speed\nR2: fine"),
        ("speed\u2066", r"speed\u2066"),
    ],
)
def test_a_message_has_no_characters_that_a_terminal_obeys(text: str, escaped: str) -> None:
    fault = InputFault(Location(path=("robots", 0), names=("", text)), f"{text} is wrong")
    assert fault.message == f"{escaped} is wrong"
    assert str(InputError([fault], text)) == f"{escaped}: robots[0] ({escaped}): {escaped} is wrong"
    other = {**document(GRID), "rules": {text: 1}}
    with pytest.raises(InputError) as caught:
        parse_scenario(other)
    assert str(caught.value).isprintable()


def test_a_level_with_a_name_that_a_terminal_obeys_is_refused(tmp_path: Path) -> None:
    building = (LAYOUTS / "hall.nav.yaml").read_text("utf-8").replace("L2:", '"L\\e[2J\\u202e":')
    (tmp_path / "hall.yaml").write_text(building, "utf-8")
    with pytest.raises(InputError) as caught:
        read_layout(tmp_path / "hall.yaml")
    assert str(caught.value).endswith(r"levels: 'L\x1b[2J\u202e' is no name (give printable text)")


def test_notes_on_the_terminal_are_escaped(capsys: pytest.CaptureFixture[str]) -> None:
    complain("a\x1b[2Jb\nc\u202ed")
    assert capsys.readouterr().err == "a\\x1b[2Jb\nc\\u202ed\n"


def test_the_wrong_radius_is_refused_before_a_floor_is_cut() -> None:
    """Cutting would say that the smallest cells are too large for the floor."""
    floor = {"floor": {"size": [6, 100_000]}, "cell_size": "adaptive", "smallest": 7}
    robot = {**ROBOT, "home": {"x": 1, "y": 1}, "target": {"x": 2, "y": 2}, "radius": -1}
    assert validate(MapDocument, floor)
    with pytest.raises(InputError) as caught:
        parse_scenario(document(floor, [robot]))
    assert [fault.place for fault in caught.value.faults] == ["robots[0].radius"]


def test_the_pieces_of_a_curve_are_counted_before_any_is_made() -> None:
    """10 m in pieces of 1 nm are 10^10 points; sampled, they would fill the memory."""
    edge = {"from": "A", "to": "B", "curve": [[5, 0]]}
    lane = {"roadmap": {"vertices": {"A": [0, 0], "B": [10, 0]}, "edges": [edge]}}
    robot = {"name": "R1", "home": "A", "target": "B"}
    with pytest.raises(InputError, match=r"a spacing of 1/1000000000 makes 20+ pieces, more than"):
        parse_scenario(document({**lane, "spacing": "1/1000000000"}, [robot]))
