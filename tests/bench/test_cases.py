"""What cases a suite has, what their scenarios are, and what they are known by."""

from __future__ import annotations

import hashlib
from fractions import Fraction
from pathlib import Path

import pytest

from rightofway.bench import Case, read_suite
from rightofway.bench.fleets import draw_grid, find_largest_part
from rightofway.errors import InputError
from rightofway.model import Scenario

HEAD = 'format = "rightofway-suite/1"\n'
ONE = 'planners = [{name = "two-level"}]\n'
MAP = "type octile\nheight 2\nwidth 3\nmap\n...\n.@.\n"
SCEN = (
    "version 1\n0\thall.map\t3\t2\t0\t0\t2\t0\t2\n0\thall.map\t3\t2\t2\t1\t0\t1\t4\n"
    "0\thall.map\t3\t2\t1\t0\t1\t0\t0\n"
)


def cases(directory: Path, text: str) -> tuple[Case, ...]:
    path = directory / "suite.toml"
    path.write_text(HEAD + text, encoding="utf-8")
    return read_suite(path)


def ends(scenario: Scenario) -> list[tuple[str, str]]:
    name = scenario.roadmap.name
    return [(name(robot.home), name(robot.stops[0].at)) for robot in scenario.robots]


def test_every_combination_is_a_case_and_planners_stand_side_by_side(tmp_path: Path) -> None:
    found = cases(
        tmp_path,
        "counts = [2, 3]\nseeds = [7, 8]\nlimits = [1, 2]\n"
        "maps = [{random = {size = [4, 4]}}, {random = {size = [5, 5]}, counts = [4]}]\n"
        'fleets = [{name = "a"}, {name = "b", return = "none"}]\n'
        'planners = [{name = "two-level"}, {name = "two-level", options = {swaps = "leave"}}]\n',
    )
    # 3 maps with counts x 2 fleets x 2 seeds x 2 limits x 2 planners
    assert len(found) == len({case.key for case in found}) == 48
    assert [str(case).partition(" routes")[0] for case in found[:3]] == [
        "random-4-4-0, a, 2 robots, seed 7, 1 s, two-level objective=flowtime swaps=resolve",
        "random-4-4-0, a, 2 robots, seed 7, 1 s, two-level objective=flowtime swaps=leave",
        "random-4-4-0, a, 2 robots, seed 7, 2 s, two-level objective=flowtime swaps=resolve",
    ]


def test_the_key_depends_on_what_is_run_and_on_nothing_else(tmp_path: Path) -> None:
    text = ONE + 'counts = [2]\nmaps = [{random = {size = [4, 4]}}]\nfleets = [{name = "a"}]\n'
    [case] = cases(tmp_path, text)
    [renamed] = cases(tmp_path, text.replace('"a"', '"b"').replace("{random", '{name="c", random'))
    assert (renamed.key, renamed.fleet, renamed.map) == (case.key, "b", "c")
    for old, new in [
        ("[2]", "[3]"),
        ("[4, 4]", "[4, 5]"),
        ('"a"', '"a", work = [0, 1]'),
        ('"a"', '"a", speeds = [2]'),
        ('"a"', '"a", headway = 1'),
        ('"two-level"', '"two-level", options = {swaps = "leave"}'),
        ("counts", "limits = [3]\ncounts"),
        ("counts", "seeds = [1]\ncounts"),
    ]:
        [other] = cases(tmp_path, text.replace(old, new))
        assert other.key != case.key


def test_the_key_is_the_same_in_every_version() -> None:
    """Results that are there already are known by it."""
    case = Case(
        map="", scen="", fleet="", robots=2, seed=1, limit=Fraction(1, 2), planner="p",
        options={"a": "b"}, problem={"grid": (".",)}, fleet_data={"work": (0, 1)},
    )  # fmt: skip
    text = '[{"grid":["."]},{"work":[0,1]},2,1,"1/2","p",{"a":"b"}]'
    assert case.key == hashlib.sha256(text.encode()).hexdigest()[:16]


def test_the_key_of_a_map_file_depends_on_what_is_in_it(tmp_path: Path) -> None:
    (tmp_path / "hall.map").write_text(MAP, encoding="utf-8")
    (tmp_path / "hall.scen").write_text(SCEN, encoding="utf-8")
    text = ONE + 'counts = [1]\nmaps = [{file = "hall.map", scens = ["hall.scen"]}]\n'
    [case] = cases(tmp_path, text)
    (tmp_path / "hall.scen").write_text("\n".join(SCEN.split("\n")[:3]) + "\n", encoding="utf-8")
    assert cases(tmp_path, text)[0].key == case.key, "rows that it does not use do not matter"
    (tmp_path / "hall.map").write_text(MAP.replace("@", "."), encoding="utf-8")
    assert cases(tmp_path, text)[0].key != case.key


def test_the_same_case_twice_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        cases(
            tmp_path,
            "counts = [2]\nmaps = [{random = {size = [4, 4]}}]\n"
            'planners = [{name = "two-level"}, {name = "two-level", options = {}}]\n',
        )
    [twin] = cases(tmp_path, ONE + "counts = [2]\nmaps = [{random = {size = [4, 4]}}]\n")
    assert str(caught.value) == (
        f"suite: two cases are the same: {twin}; and {twin} (take one of them out)"
    )


def test_the_first_rows_of_a_scen_are_the_fleet_and_speeds_go_round(tmp_path: Path) -> None:
    (tmp_path / "hall.map").write_text(MAP, encoding="utf-8")
    (tmp_path / "hall.scen").write_text(SCEN, encoding="utf-8")
    two, three = cases(
        tmp_path,
        ONE + 'counts = [2, 3]\nmaps = [{file = "hall.map", scens = ["hall.scen"]}]\n'
        'fleets = [{name = "a", speeds = [1, "1/3"], occupancy = "both", turn = "1/2"}]\n',
    )
    (tmp_path / "hall.map").unlink()  # a case needs no files
    assert (two.map, two.scen) == ("hall", "hall.scen")
    assert ends(two.make_scenario()) == [("N0", "N2"), ("N5", "N3")]
    scenario = three.make_scenario()
    assert ends(scenario) == [("N0", "N2"), ("N5", "N3"), ("N1", "N1")]
    speeds = [robot.speed for robot in scenario.robots]
    assert speeds == [Fraction(1), Fraction(1, 3), Fraction(1)]
    assert (scenario.rules.occupancy, scenario.rules.turn) == ("both", Fraction(1, 2))


def test_a_scenario_file_has_its_own_fleet(tmp_path: Path) -> None:
    (tmp_path / "lane.yaml").write_text(
        "format: rightofway-scenario/1\nmap: {grid: ['...']}\n"
        "robots: [{name: Ada, home: N0, target: N2, speed: 1/7}]\n",
        encoding="utf-8",
    )
    [case] = cases(tmp_path, ONE + 'maps = [{scenario = "lane.yaml"}]\nfleets = [{name = "a"}]\n')
    assert (case.map, case.fleet, case.robots) == ("lane", "", 1)
    [robot] = case.make_scenario().robots
    assert (robot.name, robot.speed) == ("Ada", Fraction(1, 7))


def drawn(directory: Path, *, count: int, seed: int) -> Scenario:
    [case] = cases(
        directory,
        ONE + f"counts = [{count}]\nseeds = [{seed}]\n"
        "maps = [{random = {size = [9, 7], walls = 0.3, seed = 5}}]\n"
        'fleets = [{name = "a", speeds = [1, 2, 3], deal = "by seed", work = [2, 4]}]\n',
    )
    return case.make_scenario()


def test_the_same_seed_draws_the_same_fleet_and_a_smaller_one_is_its_beginning(
    tmp_path: Path,
) -> None:
    large, small = drawn(tmp_path, count=20, seed=1), drawn(tmp_path, count=5, seed=1)
    assert large == drawn(tmp_path, count=20, seed=1)
    assert large.robots[:5] == small.robots
    assert large.roadmap == small.roadmap
    other = drawn(tmp_path, count=20, seed=2)
    assert other.roadmap == large.roadmap, "its walls have a seed of their own"
    assert ends(other) != ends(large)


def test_what_is_drawn_is_within_bounds_and_all_of_it_comes_up(tmp_path: Path) -> None:
    robots = drawn(tmp_path, count=25, seed=3).robots
    assert {robot.speed for robot in robots} == {1, 2, 3}
    assert {robot.stops[0].work for robot in robots} == {2, 3, 4}
    for places in ({robot.home for robot in robots}, {robot.stops[0].at for robot in robots}):
        assert len(places) == 25


def test_a_drawn_grid_is_the_same_everywhere() -> None:
    """Python promises the numbers of `random()` for a seed; so these rows hold everywhere."""
    assert draw_grid(width=6, height=3, walls=0.3, seed=0) == ["..@...", "..@...", "......"]


def test_the_largest_part_is_found() -> None:
    assert find_largest_part(["..@.", "@@@.", "..@."]) == [(0, 3), (1, 3), (2, 3)]
    assert find_largest_part(["@@"]) == []
