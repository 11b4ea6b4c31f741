"""The time/space table against the paper's, and its marks, windows and text."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import pytest

from rightofway.check import check
from rightofway.errors import InputError
from rightofway.model import Plan, PlannerRun, Robot, Rules, Scenario, Stop, Track
from rightofway.site import Edge, VertexId, make_roadmap
from rightofway.solve import solve
from rightofway.viz.table import Row, TimeSpaceTable, as_csv, as_text, make_table
from rightofway.viz.table.timespace import StepsTo
from tests.builders.fleets import PAPER, grid_fleet, paper_scenario

CASES = {case["name"]: case for case in PAPER}

WAYS_OUT = {
    "door": {"R1": [0, 1, 4, 7, 6], "R2": [2, 1, 4, 7, 8]},
    "cross": {"R1": [0, 5, 10, 11, 12, 13, 14, 19], "R2": [4, 3, 2, 7, 12, 17, 22]},
}
"""The paper's routes, from home to target; robots return the same way."""


def make_plan(scenario: Scenario, *trips: tuple[Sequence[int], Sequence[int]]) -> Plan:
    """Make a plan of cells and enter."""
    vertex = scenario.roadmap.get_vertex
    tracks = (Track.of([vertex(f"N{cell}") for cell in cells], enter) for cells, enter in trips)
    return Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun(name="by hand"))


def leisurely(case: dict[str, Any]) -> Plan:
    """Return the routes of a case at times that leave room for everything."""
    ways = WAYS_OUT[case["name"].split("-")[0]].values()
    trips = [(way + way[-2::-1], range(0, 100 * (2 * len(way) - 1), 100)) for way in ways]
    return make_plan(paper_scenario(case), *trips)


def published(name: str) -> Plan:
    """Return the final rows of a case as a plan: a visit begins where the node changes."""
    trips = []
    for row in CASES[name]["final"].values():
        enter = [tick for tick, cell in enumerate(row) if not tick or row[tick - 1] != cell]
        trips.append(([row[tick] for tick in enter], enter))
    return make_plan(paper_scenario(CASES[name]), *trips)


def rows(table: TimeSpaceTable, kind: str) -> dict[str, Row]:
    return {row.robot: row for row in table.rows if row.kind == kind}


def marked(row: Row, mark: str) -> list[int]:
    return [tick for run in row.runs if run.cell.mark == mark for tick in range(run.start, run.end)]


@pytest.mark.parametrize("case", PAPER, ids=list(CASES))
def test_planned_rows_are_the_published_ones(case: dict[str, Any]) -> None:
    """All eight tables; some are printed in part, so the printed ticks are compared."""
    found, first = rows(make_table(leisurely(case)), "planned"), case["first_tick"]
    for robot, row in case["planned"].items():
        assert found[robot].places[first : first + len(row)] == row


@pytest.mark.parametrize("name", ["door-1", "door-3", "cross-3"])
def test_both_rows_of_a_whole_table_are_the_published_ones(name: str) -> None:
    plan = published(name)
    assert check(plan).ok
    for kind in ("planned", "final"):
        found = {robot: row.places for robot, row in rows(make_table(plan), kind).items()}
        assert found == CASES[name][kind]


def test_collisions_are_marked_in_planned_rows_and_waits_in_final_ones() -> None:
    """Table 4: the door both ways; R1 waits at home in tick 0."""
    table = make_table(published("door-1"))
    for row in rows(table, "planned").values():
        assert marked(row, "collision") == [1, 2, 3, 6, 7, 8]
        assert marked(row, "wait") == []
    final = rows(table, "final")
    assert [marked(final["R1"], "wait"), marked(final["R2"], "wait")] == [[0], []]


def test_a_conflict_left_in_the_plan_is_marked_in_its_final_row() -> None:
    scenario = grid_fleet(["...", "..."], [("N0", "N1"), ("N2", "N4")], rules=Rules(ends="none"))
    # R2 passes N1 in [2, 3), where R1 is from tick 1 on for ever.
    table = make_table(make_plan(scenario, ([0, 1], [0, 1]), ([2, 1, 4], [0, 2, 3])))
    assert marked(rows(table, "final")["R2"], "collision") == [2]


def test_a_collision_outdoes_a_wait() -> None:
    scenario = grid_fleet(["...", "..."], [("N0", "N1"), ("N2", "N4")], rules=Rules(ends="none"))
    # R2 waits in N1 in [2, 4), which is R1's for ever.
    table = make_table(make_plan(scenario, ([0, 1], [0, 1]), ([2, 1, 4], [0, 2, 5])))
    final = rows(table, "final")["R2"]
    assert (marked(final, "collision"), marked(final, "wait")) == ([2, 3, 4], [0])


def test_a_row_ends_at_the_completion() -> None:
    # One way: in N1 from tick 1, and 3 of work.
    scenario = grid_fleet(["..."], [("N0", "N1")], rules=Rules(ends="none"), work=[3])
    table = make_table(make_plan(scenario, ([0, 1], [0, 1])))
    assert table.last_tick == 4
    assert table.rows[0].places == [0, 1, 1, 1, 1]


def test_a_window_shows_only_its_ticks() -> None:
    table = make_table(published("door-1"), first_tick=3, last_tick=5)
    assert list(table.ticks) == [3, 4, 5]
    assert [row.places for row in table.rows] == [[7, 6, 6], [4, 7, 6], [7, 8, 8], [7, 8, 8]]


def test_a_window_after_the_end_has_empty_rows() -> None:
    table = make_table(published("door-1"), first_tick=10, last_tick=12)
    assert [row.places for row in table.rows] == [[], [0], [], []]


def test_a_swap_is_marked_at_both_robots_before_and_after_it() -> None:
    """Door-5 as published: R1 goes from N7 to N4 and R2 from N4 to N7 at tick 7."""
    plan = solve(paper_scenario(CASES["door-5"]), "two-level", swaps="leave")
    final = rows(make_table(plan), "final")
    assert [marked(final[name], "swap") for name in ("R1", "R2")] == [[6, 7], [6, 7]]
    assert "7!  4!" in as_text(make_table(plan))
    assert "R1,final marks,,,,,,,swap,swap,,\n" in as_csv(make_table(plan))


def test_a_table_just_fits_where_there_is_room_for_its_ticks() -> None:
    table = make_table(published("door-1"))
    table.refuse_more_than(11)
    with pytest.raises(InputError, match="11 columns, room is for 10"):
        table.refuse_more_than(10)


def test_chosen_robots_come_in_the_scenarios_order_with_all_their_collisions() -> None:
    table = make_table(published("door-1"), robots=["R2"])
    assert [(row.robot, row.kind) for row in table.rows] == [("R2", "planned"), ("R2", "final")]
    assert marked(table.rows[0], "collision") == [1, 2, 3, 6, 7, 8]
    both = make_table(published("door-1"), robots=["R2", "R1"])
    assert [row.robot for row in both.rows] == ["R1", "R1", "R2", "R2"]


@pytest.mark.parametrize(
    ("window", "message"),
    [
        ({"robots": ["R22"]}, "robots: no robot is named 'R22' (did you mean 'R2'?)"),
        ({"first_tick": -1}, "first_tick: -1 is negative (give 0 or more)"),
        (
            {"first_tick": 50},
            "first_tick: 50 is after the end: all robots are done at tick 10 (give less)",
        ),
        (
            {"first_tick": 5, "last_tick": 4},
            "last_tick: 4 is before the first tick, 5 (give 5 or more)",
        ),
    ],
)
def test_what_cannot_be_shown_is_refused(window: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as raised:
        make_table(published("door-1"), **window)
    assert str(raised.value) == message


TABLE_4 = """\
time         0   1   2   3   4   5   6   7   8   9  10
R1 planned   0   1*  4*  7*  6   6   7*  4*  1*  0
R1 final     0=  0   1   4   7   6   6   7   4   1   0
R2 planned   2   1*  4*  7*  8   8   7*  4*  1*  2
R2 final     2   1   4   7   8   8   7   4   1   2

* two robots in one place   = waits"""


def test_the_text_of_table_4() -> None:
    assert as_text(make_table(published("door-1"))) == TABLE_4


IN_BLOCKS = """\
time         8   9
R1 planned   1*  0
R1 final     4   1
R2 planned   1*  2
R2 final     1   2

time        10
R1 final     0

* two robots in one place"""


def test_text_comes_in_blocks_that_fit_without_rows_that_have_ended() -> None:
    text = as_text(make_table(published("door-1"), first_tick=8), width=19)
    assert text == IN_BLOCKS
    assert "time         8\n" in as_text(make_table(published("door-1"), first_tick=8), width=18)


def test_a_terminal_too_narrow_for_a_tick_still_gets_one() -> None:
    text = as_text(make_table(published("door-1"), first_tick=9, last_tick=10), width=1)
    assert [line for line in text.splitlines() if "R1 final" in line] == [
        "R1 final     1",
        "R1 final     0",
    ]


def named() -> Plan:
    """One robot on a roadmap whose vertices have names; a tick is 1/2."""
    edges = [
        Edge(tail="dock", head="棚", length=Fraction(1)),
        Edge(tail="棚", head="dock", length=Fraction(3, 2)),
    ]
    scenario = Scenario(
        roadmap=make_roadmap({"dock": (0.0, 0.0), "棚": (1.0, 0.0)}, edges),
        robots=(Robot(name="Zoë", home=VertexId(0), stops=(Stop(at=VertexId(1)),)),),
    )
    track = Track.of([0, 1, 0], [0, 2, 6])
    return Plan(scenario=scenario, tracks=(track,), run=PlannerRun(name="by hand"))


def test_vertices_with_names_are_shown_by_name() -> None:
    assert make_table(named()).rows[0].places == ["dock", "dock", "棚", "棚", "棚", "dock"]


def test_wide_letters_take_two_columns_and_a_tick_of_its_own_length_is_reported() -> None:
    """Drives 2 and 3 ticks; the plan waits one tick in between."""
    assert as_text(make_table(named())) == (
        "time            0   0.5     1   1.5     2   2.5     3\n"
        "Zoë planned  dock  dock    棚    棚    棚  dock\n"
        "Zoë final    dock  dock    棚=   棚    棚    棚  dock\n"
        "\n"
        "= waits   a column lasts 0.5 time units"
    )


def test_a_table_of_a_thousand_years_is_made_but_not_written_out() -> None:
    scenario = grid_fleet(["..."], [("N0", "N1")], rules=Rules(ends="none"))
    table = make_table(make_plan(scenario, ([0, 1], [0, 10**11])))
    assert table.last_tick == 10**11
    with pytest.raises(InputError, match=r"choose fewer with --from and --to"):
        as_text(table, max_lines=None)
    short = as_text(make_table(make_plan(scenario, ([0, 1], [0, 10**11])), last_tick=2))
    assert "left out" not in short


def test_a_long_text_is_cut_and_says_where_and_how_to_see_the_rest() -> None:
    scenario = grid_fleet(["..."], [("N0", "N1")], rules=Rules(ends="none"))
    enter = [10**6 + k for k in range(100)]
    text = as_text(make_table(make_plan(scenario, ([0, 1] * 50, [0, *enter[1:]]))), max_lines=8)
    # Columns of "1000099" and a sign, 80 - 12 - 2 + 1 over 9: 7 columns in each of two blocks.
    assert text.splitlines()[-3:] == [
        "… columns after 13, up to 1000099 are left out",
        "  (choose with --from, --to, --step and --robots; -o FILE.txt writes all;",
        "  --events lists each visit in one line)",
    ]
    assert len(text.splitlines()) < 15


def test_a_table_of_many_robots_says_that_rows_are_left_out() -> None:
    scenario = grid_fleet(["." * 60], [(f"N{k}", f"N{k}") for k in range(60)])
    table = make_table(make_plan(scenario, *(([k], [0]) for k in range(60))), last_tick=1)
    assert "… rows are left out\n" in as_text(table, max_lines=20)
    assert "left out" not in as_text(table, max_lines=121)


def test_a_long_text_leaves_out_columns_without_a_change() -> None:
    scenario = grid_fleet(["..."], [("N0", "N1")], rules=Rules(ends="none"))
    table = make_table(make_plan(scenario, ([0, 1], [0, 10**6])))
    assert as_text(table).splitlines() == [
        "time              0        1   999999  1000000",
        "R1 planned        0        1",
        "R1 final          0=       0=       0        1",
        "",
        "= waits   columns without a change are left out",
    ]


def test_a_table_of_too_many_robots_is_not_written_out() -> None:
    scenario = grid_fleet(["." * 60], [(f"N{k}", f"N{k}") for k in range(60)])
    table = make_table(make_plan(scenario, *(([k], [0]) for k in range(60))), last_tick=20_000)
    with pytest.raises(InputError) as raised:
        as_text(table, max_lines=None)
    assert str(raised.value) == (
        "table: 120 rows of 20001 columns are more than 2000000 cells"
        " (choose fewer with --robots, or with --from and --to)"
    )


def test_columns_may_be_several_ticks_apart() -> None:
    """Table 4, R1 planned: 0 1* 4* 7* 6 6 7* 4* 1* 0; a mark within a step is shown."""
    table = make_table(published("door-1"), robots=["R1"], step=4)
    planned, final = table.rows
    assert list(table.ticks) == [0, 4, 8, 10]
    cells = planned.list_cells_at(table.ticks, table.step)
    assert [(cell.place, cell.mark) for cell in cells] == [
        (0, "collision"), (6, "collision"), (1, "collision"), (0, None),
    ]  # fmt: skip
    places = [cell.place for cell in final.list_cells_at(table.ticks, table.step)]
    assert places == [0, 7, 4, 0]


def test_a_long_text_of_short_ticks_has_round_columns() -> None:
    """A tick is 1/2, and 4 lines are one block of 4 columns; steps go up to one time unit."""
    plan = named()
    text = as_text(make_table(plan), width=40, max_lines=4)
    assert text.splitlines()[0] == "time            0     1     2     3"
    assert text.splitlines()[-1] == "= waits"
    assert make_table(plan).limit_columns(3).step == 4
    assert make_table(plan).limit_columns(3, Fraction(1)).step == 2


@pytest.mark.parametrize("last", range(7))
@pytest.mark.parametrize("step", [1, 2, 3, 9])
def test_columns_a_step_apart_end_with_the_last_tick(step: int, last: int) -> None:
    columns = StepsTo(range(0, last + 1, step), last)
    listed = sorted({*range(0, last + 1, step), last})
    assert list(columns) == listed
    assert [list(columns[k:]) for k in range(-3, 9)] == [listed[k:] for k in range(-3, 9)]


def test_columns_of_a_long_plan_are_counted_without_a_list() -> None:
    """A list of the columns would take terabytes: the longer steps do not end with the plan."""
    fleet = grid_fleet(["..."], [("N0", "N1")], rules=Rules(ends="none"), work=[2**40 - 2])
    table = make_table(solve(fleet)).limit_columns(1000)
    assert table.step == 2 * 10**9
    assert len(table.ticks) == 551
    assert table.ticks[-2:] == [1098 * 10**9, 2**40 - 1]
