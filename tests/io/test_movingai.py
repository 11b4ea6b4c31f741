"""MovingAI files are read with their headers checked, and written as others expect them."""

from fractions import Fraction
from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.io import load, load_map, load_scen, write_map, write_scen
from rightofway.model import Robot, Rules, Scenario, Stop
from rightofway.site import Edge, make_roadmap
from tests.builders.fleets import grid_fleet

MAP = "type octile\nheight 2\nwidth 3\nmap\n..T\nG@S\n"
SCEN = "version 1\n0\thall.map\t3\t2\t1\t0\t2\t1\t1.41421356\n3\thall.map\t3\t2\t0\t0\t0\t1\t1\n"


@pytest.fixture
def hall(tmp_path: Path) -> Path:
    (tmp_path / "hall.map").write_text(MAP, encoding="utf-8")
    (tmp_path / "hall.scen").write_text(SCEN, encoding="utf-8")
    return tmp_path / "hall.scen"


@pytest.mark.parametrize(
    "text",
    [
        MAP,
        MAP.replace("\n", "\r\n"),
        MAP.rstrip(),
        MAP + "\n\n",
        MAP.replace("type octile\n", ""),
        "width 3\nheight 2\ntype tile\nmap\n..T  \nG@S\n",
    ],
)
def test_a_map_is_its_rows(tmp_path: Path, text: str) -> None:
    (tmp_path / "hall.map").write_bytes(text.encode())
    assert load_map(tmp_path / "hall.map") == ("..T", "G@S")


@pytest.mark.parametrize(
    ("old", "new", "faults"),
    [
        ("type octile", "type hex", ["1: type 'hex' is not known (give octile)"]),
        ("height 2", "hight 2", ["2: 'hight' is no line of a header"]),
        ("height 2", "height two", ["2: height 'two' is no size (give a count of cells)"]),
        ("height 2", "height 0", ["2: height '0' is no size (give a count of cells)"]),
        ("height 2\n", "", [" the header has no height (give a line like 'height 32')"]),
        ("map\n", "", ["4: '..T' is no line of a header"]),
        ("\nmap\n..T\nG@S", "", ["3: the header has no line 'map'"]),
        ("G@S", "G@", ["6: 2 cells, but width is 3 (mend the row)"]),
        ("\nG@S", "", ["6: 1 rows, but height is 2 (mend the rows, or the header)"]),
        ("G@S", "G@S\n...", ["7: 3 rows, but height is 2"]),
        ("..T\nG@S", "..\nG@S.", ["5: 2 cells", "6: 4 cells"]),
    ],
)
def test_what_is_wrong_with_a_map_is_told_with_its_line(
    tmp_path: Path, old: str, new: str, faults: list[str]
) -> None:
    path = tmp_path / "hall.map"
    path.write_text(MAP.replace(old, new), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load_map(path)
    told = str(caught.value).splitlines()
    assert len(told) == len(faults)
    for line, fault in zip(told, faults, strict=True):
        assert line.startswith(f"{path}:{fault}")


def test_a_scen_row_says_x_then_y(hall: Path) -> None:
    first, second = load_scen(hall)
    assert (first.line, first.map_name, first.width, first.height) == (2, "hall.map", 3, 2)
    assert (first.start, first.goal) == ((0, 1), (1, 2))  # x 1, y 0 to x 2, y 1
    assert (second.start, second.goal) == ((0, 0), (1, 0))


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("version 1\n", " there is no row (give one for each robot)"),
        ("version 1\n0 hall.map 3 2", "2: 4 columns (give bucket, map, width"),
        ("0 hall.map 3 2 0 0 x 1 0", "1: 'x' is no count of cells"),
        ("0 hall.map 3 2 0 0 -1 1 0", "1: '-1' is no count of cells"),
    ],
)
def test_what_is_wrong_with_a_scen_is_told_with_its_line(
    tmp_path: Path, text: str, fault: str
) -> None:
    path = tmp_path / "hall.scen"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load_scen(path)
    assert str(caught.value).startswith(f"{path}:{fault}")


def test_a_scen_by_itself_is_classic_mapf(hall: Path) -> None:
    scenario = load(hall)
    assert scenario.rules == Rules(turn=Fraction(0), ends="none", occupancy="one")
    assert [(robot.name, robot.speed) for robot in scenario.robots] == [
        ("R1", Fraction(1)),
        ("R2", Fraction(1)),
    ]
    name = scenario.roadmap.name
    assert [(name(robot.home), name(robot.stops[0].at)) for robot in scenario.robots] == [
        ("N1", "N5"),
        ("N0", "N3"),
    ]
    assert scenario.problem.itineraries[0].stages[0].turn == 0


def test_the_first_robots_of_a_scen_are_taken_by_number(hall: Path) -> None:
    assert load(hall, count=1).robots == load(hall).robots[:1]
    with pytest.raises(InputError, match=r"hall\.scen: count: 3 is more than the 2 rows"):
        load(hall, count=3)
    with pytest.raises(InputError, match=r"hall\.scen: count: 0 does not fit"):
        load(hall, count=0)


def test_a_map_without_a_free_cell_is_named(hall: Path) -> None:
    blocked = hall.parent / "hall.map"
    blocked.write_text("type octile\nheight 2\nwidth 3\nmap\n@@@\n@@@\n", encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load(hall)
    assert str(caught.value).startswith(f"{blocked}: no free cell in 6")


def test_its_map_may_be_in_the_folder_of_maps(hall: Path) -> None:
    folder = hall.parent / "scens"
    folder.mkdir()
    (hall.parent / "maps").mkdir()
    (hall.parent / "hall.map").rename(hall.parent / "maps" / "hall.map")
    moved = hall.rename(folder / "hall.scen")
    assert len(load(moved).robots) == 2


def test_what_is_wrong_with_a_scen_by_itself_is_told_with_its_line(hall: Path) -> None:
    hall.write_text(SCEN.replace("0\t0\t0\t1\t1\n", "1\t0\t1\t1\t1\n"), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load(hall)
    assert str(caught.value).splitlines() == [
        f"{hall}:3: goal: [1, 1] is blocked by '@' (N1 is free)",
    ]
    hall.write_text(SCEN.replace("\t0\t0\t0\t1\t1\n", "\t1\t0\t0\t1\t1\n"), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load(hall)
    assert str(caught.value) == (
        f"{hall}:3: start: line 2 starts there already (a cell holds one robot)"
    )


def test_a_scen_without_its_map_says_where_it_was_looked_for(hall: Path) -> None:
    (hall.parent / "hall.map").unlink()
    with pytest.raises(InputError) as caught:
        load(hall)
    assert str(caught.value) == (
        f"{hall}: its map 'hall.map' is neither beside it nor in ../maps (put it there)"
    )


def test_a_scen_for_a_map_of_another_name_is_refused(hall: Path) -> None:
    (hall.parent / "room.map").write_text(MAP, encoding="utf-8")
    document = hall.parent / "room.yaml"
    document.write_text(
        "format: rightofway-scenario/1\nmap: {file: room.map}\nrobots: {scen: hall.scen}\n",
        encoding="utf-8",
    )
    with pytest.raises(InputError, match=r"scen:2: is for 'hall\.map', but the map is 'room\.map'"):
        load(document)


def test_a_map_by_itself_has_no_robots(hall: Path) -> None:
    with pytest.raises(InputError, match=r"a map has no robots \(write a scenario"):
        load(hall.with_suffix(".map"))


def test_what_is_written_is_read_back(tmp_path: Path) -> None:
    fleet = grid_fleet(["..@", "..."], [("N0", "N5"), ("N4", "N1")])
    scenario = Scenario(
        roadmap=fleet.roadmap,
        robots=fleet.robots,
        rules=Rules(turn=Fraction(0), ends="none", occupancy="one"),
    )
    write_map(scenario.roadmap, tmp_path / "a.map")
    assert write_scen(scenario, tmp_path / "a.scen", map_name="a.map") == ()
    assert (tmp_path / "a.map").read_text(encoding="utf-8") == (
        "type octile\nheight 2\nwidth 3\nmap\n..@\n...\n"
    )
    assert (tmp_path / "a.scen").read_text(encoding="utf-8") == (
        "version 1\n0\ta.map\t3\t2\t0\t0\t2\t1\t3\n0\ta.map\t3\t2\t1\t1\t1\t0\t1\n"
    )
    assert load(tmp_path / "a.scen") == scenario


def test_what_a_scen_cannot_say_is_told(tmp_path: Path) -> None:
    fleet = grid_fleet(["...."], [("N0", "N3")], speeds=[Fraction(1, 2)], work=[3])
    assert write_scen(fleet, tmp_path / "a.scen", map_name="a.map") == (
        "speeds and the size of cells are left out; .scen robots drive one cell a tick",
        "work times are left out",
        "ways back and laps are left out; .scen robots stay at their goals",
    )


def test_the_optimal_length_counts_moves_whatever_the_cells_and_speeds(tmp_path: Path) -> None:
    """Two robots with one target, 3 moves away for the first and 1 for the second."""
    fleet = grid_fleet(["....", "...."], [("N0", "N3"), ("N7", "N3")], speeds=[Fraction(1, 3)] * 2)
    write_scen(fleet, tmp_path / "a.scen", map_name="a.map")
    assert [
        line.split("\t")[-1] for line in (tmp_path / "a.scen").read_text().splitlines()[1:]
    ] == [
        "3",
        "1",
    ]


def test_several_stops_and_roadmaps_fit_in_no_movingai_file(tmp_path: Path) -> None:
    fleet = grid_fleet(["...."], [("N0", "N3")])
    robot = Robot(name="R", home=fleet.robots[0].home, stops=(*fleet.robots[0].stops,) * 2)
    busy = Scenario(roadmap=fleet.roadmap, robots=(robot,))
    with pytest.raises(InputError, match=r"robots\[0\].stops: 2 stops, a .scen row has one goal"):
        write_scen(busy, tmp_path / "a.scen", map_name="a.map")
    drawn = make_roadmap({"A": (0, 0), "B": (1, 0)}, [Edge(tail="A", head="B", length=Fraction(1))])
    with pytest.raises(InputError, match="map: the roadmap is no grid"):
        write_map(drawn, tmp_path / "a.map")
    one_way = Scenario(
        roadmap=drawn,
        robots=(
            Robot(name="R", home=drawn.get_vertex("A"), stops=(Stop(at=drawn.get_vertex("B")),)),
        ),
    )
    with pytest.raises(InputError, match="map: the roadmap is no grid"):
        write_scen(one_way, tmp_path / "a.scen", map_name="a.map")
    assert list(tmp_path.iterdir()) == []
