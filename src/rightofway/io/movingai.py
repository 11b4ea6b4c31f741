"""MovingAI files: `.map` grids and `.scen` lists of starts and goals.

References
----------
Sturtevant, *Benchmarks for Grid-Based Pathfinding*, IEEE T-CIAIG 2012; Stern et al., *Multi-Agent
Pathfinding: Definitions, Variants, and Benchmarks*, SoCS 2019. In a `.scen` file x is the column
and y the row; the first k rows are the k-robot instance.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from rightofway.errors import InputError, InputFault, Location, name_file, quote
from rightofway.files import write_whole
from rightofway.io.content import is_regular, read_text
from rightofway.io.faults import Faults
from rightofway.model import Robot, Rules, Scenario, Stop
from rightofway.site import Grid, Roadmap, make_grid_roadmap

_SIZE = re.compile(r"[0-9]{1,9}")
_COLUMNS = "bucket, map, width, height, start x, start y, goal x, goal y, optimal length"


@dataclass(frozen=True, slots=True, kw_only=True)
class ScenRow:
    """One robot of a `.scen` file; start and goal are (row, column) of cells."""

    line: int  # in the file, from 1
    map_name: str
    width: int  # of the map [cells]
    height: int
    start: tuple[int, int]
    goal: tuple[int, int]


def load_map(path: Path | str) -> tuple[str, ...]:
    """Return the rows of a `.map` file.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    InputError
        For a header without height and width, a type other than a grid's, or rows that do not
        agree with the header; the place is the line.
    """
    with name_file(str(path)):
        lines = read_text(Path(path)).rstrip().split("\n")
        header: dict[str, str] = {}
        for number, line in enumerate(lines, start=1):
            key, _, value = line.strip().partition(" ")
            if key == "map":
                return _check_rows(lines[number:], header, number)
            _check_header(key, value.strip(), Location(line=number))
            header[key] = value.strip()
        message = "the header has no line 'map' (put it before the rows)"
        raise InputError.at(Location(line=len(lines)), message)


def _check_header(key: str, value: str, where: Location) -> None:
    if key not in {"type", "height", "width"}:
        remedy = "give type, height, width, map, in this order"
        raise InputError.at(where, f"{quote(key)} is no line of a header ({remedy})")
    if key == "type" and value not in {"octile", "tile"}:
        raise InputError.at(where, f"type {quote(value)} is not known (give octile)")
    if key != "type" and not (_SIZE.fullmatch(value) and int(value)):
        raise InputError.at(where, f"{key} {quote(value)} is no size (give a count of cells)")


def _check_rows(lines: list[str], header: dict[str, str], above: int) -> tuple[str, ...]:
    """Return the rows below the header's lines, if they have the size that it says."""
    for key in ("height", "width"):
        if key not in header:
            raise InputError.at("", f"the header has no {key} (give a line like '{key} 32')")
    faults, height, width = Faults(), int(header["height"]), int(header["width"])
    rows = tuple(row.rstrip() for row in lines)
    for line, row in enumerate(rows[:height], start=above + 1):
        if len(row) != width:
            message = f"{len(row)} cells, but width is {width} (mend the row)"
            faults.note(Location(line=line), message)
    if len(rows) != height:
        message = f"{len(rows)} rows, but height is {height} (mend the rows, or the header)"
        faults.note(Location(line=above + 1 + min(len(rows), height)), message)
    faults.stop()
    return rows


def find_beside(path: Path, named: str, folder: str) -> Path | None:
    """Return a file that another file names, or None if there is none.

    Its name may be a path from there that does not lead upwards. The last part is also looked for
    next to the file that names it, and in a folder of a given name next to that file's folder.
    """
    parts = re.split(r"[\\/]", named)
    inside = path.parent.joinpath(*parts) if not {"", ".."}.intersection(parts) else path.parent
    beside = path.parent / parts[-1], path.parent / ".." / folder / parts[-1]
    return next((file for file in (inside, *beside) if is_regular(file)), None)


def load_scen(path: Path | str) -> tuple[ScenRow, ...]:
    """Return the rows of a `.scen` file.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    InputError
        For rows that are not made of nine columns; the place is the line.
    """
    faults, rows = Faults(), list[ScenRow | None]()
    with name_file(str(path)):
        lines = read_text(Path(path)).rstrip().split("\n")
        for number, line in enumerate(lines, start=1):
            if number > 1 or not line.startswith("version"):
                rows.append(faults.attempt(Location(line=number), _read_scen_row, number, line))
        faults.stop()
        if not rows:
            raise InputError.at("", "there is no row (give one for each robot)")
    return tuple(row for row in rows if row is not None)


def _read_scen_row(line: int, text: str) -> ScenRow:
    columns = text.split("\t") if "\t" in text else text.split()
    if len(columns) not in {8, 9}:
        raise InputError.at("", f"{len(columns)} columns (give {_COLUMNS})")
    numbers = list(map(str.strip, columns[2:8]))
    if not all(map(_SIZE.fullmatch, numbers)):
        number = next(number for number in numbers if not _SIZE.fullmatch(number))
        raise InputError.at("", f"{quote(number)} is no count of cells (give {_COLUMNS})")
    width, height, start_x, start_y, goal_x, goal_y = map(int, numbers)
    return ScenRow(
        line=line,
        map_name=columns[1].strip(),
        width=width,
        height=height,
        start=(start_y, start_x),
        goal=(goal_y, goal_x),
    )


def write_map(roadmap: Roadmap, path: Path | str) -> None:
    """Write a grid as a `.map` file.

    Parameters
    ----------
    roadmap
        A grid.
    path
        The file.

    Raises
    ------
    InputError
        If the roadmap is no grid, or the file cannot be written.
    """
    grid = _require_grid(roadmap)
    header = ("type octile", f"height {grid.rows}", f"width {grid.columns}", "map")
    write_whole(path, "\n".join((*header, *grid.as_lines())) + "\n")


def write_scen(scenario: Scenario, path: Path | str, *, map_name: str) -> tuple[str, ...]:
    """Write the homes and targets of a fleet as a `.scen` file.

    Parameters
    ----------
    scenario
        On a grid, with one stop for each robot.
    path
        The file.
    map_name
        Name of the map file in the same folder, for the rows.

    Returns
    -------
    tuple of str
        Parts of the scenario that a `.scen` file cannot hold: a sentence each.

    Raises
    ------
    InputError
        If the roadmap is no grid, a robot has several stops, or the file cannot be written.
    NoPlanExists
        If no way leads from a home to its target.

    Notes
    -----
    The optimal length is the number of moves on a shortest path without diagonal moves, as in
    multi-agent path finding; the benchmark's own files count diagonal moves. The bucket is 0.
    """
    grid = _require_grid(scenario.roadmap)
    faults = [
        InputFault(
            ("robots", index, "stops"),
            f"{len(robot.stops)} stops, a .scen row has one goal (leave one, or write .yaml)",
        )
        for index, robot in enumerate(scenario.robots)
        if len(robot.stops) > 1
    ]
    if faults:
        raise InputError(faults)
    lines = ["version 1"]
    for robot, moves in zip(scenario.robots, _measure_optimal_lengths(scenario), strict=True):
        (start_y, start_x), (goal_y, goal_x) = map(grid.get_cell, (robot.home, robot.stops[0].at))
        columns = (0, map_name, grid.columns, grid.rows, start_x, start_y, goal_x, goal_y, moves)
        lines.append("\t".join(map(str, columns)))
    write_whole(path, "\n".join(lines) + "\n")
    return tuple(_list_left_out(scenario, grid))


def _measure_optimal_lengths(scenario: Scenario) -> Iterator[int]:
    """Yield for each robot the moves on a shortest path from its home to its target."""
    from rightofway.metrics import compute_alone_completions

    robots = [Robot(name=robot.name, home=robot.home, stops=(Stop(at=robot.stops[0].at),))
              for robot in scenario.robots]  # fmt: skip
    there_and_back = Scenario(
        roadmap=scenario.roadmap, robots=tuple(robots), rules=Rules(turn=Fraction(0))
    )
    return (moves // 2 for moves in compute_alone_completions(there_and_back))


def _require_grid(roadmap: Roadmap) -> Grid:
    if roadmap.grid is None:
        message = "the roadmap is no grid, MovingAI files hold nothing else (choose another format)"
        raise InputError.at("map", message)
    return roadmap.grid


def _list_left_out(scenario: Scenario, grid: Grid) -> Iterator[str]:
    robots = scenario.robots
    if any(robot.speed != 1 for robot in robots) or grid.cell_size != 1:
        yield "speeds and the size of cells are left out; .scen robots drive one cell a tick"
    if any(robot.stops[0].work for robot in robots):
        yield "work times are left out"
    if any(robot.radius for robot in robots):
        yield "radii are left out; .scen robots are points"
    if scenario.closures:
        yield "closures are left out"
    if scenario.roadmap.frame != make_grid_roadmap(["."], cell_size=grid.cell_size).frame:
        yield "y and origin of the map are left out"
    if any((robot.ends or scenario.rules.ends) == "home" for robot in robots):
        yield "ways back and laps are left out; .scen robots stay at their goals"
