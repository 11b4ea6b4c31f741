"""Lists of events, collisions and decisions."""

from __future__ import annotations

import io
from dataclasses import replace
from typing import Any

import openpyxl  # type: ignore[import-untyped]  # it ships no types
import pytest

import rightofway
from rightofway.errors import InputError
from rightofway.metrics import NamedCollision, free_running, name_collisions
from rightofway.model import Plan, Tick, compute_completions
from rightofway.repair.routing import free_running_tracks
from rightofway.report.quantities import Quantities
from rightofway.units import Units
from rightofway.viz.table import (
    ListColumn,
    Listing,
    choose_events,
    count_conflicts_before,
    tabulate_collision_ticks,
    tabulate_collisions,
    tabulate_decisions,
    tabulate_events,
)
from rightofway.viz.table.workbook import make_sheets
from tests.builders.fleets import PAPER, paper_scenario, random_fleet

CASES = {case["name"]: case for case in PAPER}


def published(name: str) -> Plan:
    return rightofway.solve(paper_scenario(CASES[name]), "two-level", swaps="leave")


def in_seconds() -> Plan:
    """One robot at 0.4 m/s over two cells of 1 m: a cell takes 2.5 s, which is the tick."""
    fleet = rightofway.FleetBuilder(grid=["..."])
    scenario = fleet.add_robot("R1", home="N0", target="N2", speed="0.4").build_scenario()
    return rightofway.solve(replace(scenario, units=Units(length="m", time="s")))


def test_events_for_people_have_the_unit_under_the_heading() -> None:
    lines = tabulate_events(in_seconds()).as_text().splitlines()
    assert lines[:4] == [
        "robot  place  purpose        enter  leave  waits  waits for  to leave",
        "                               [s]    [s]    [s]",
        "R1     N0     home               0    2.5",
        "R1     N1     drive through    2.5      5",
    ]


def test_events_for_programs_have_times_in_the_unit_and_in_ticks() -> None:
    lines = tabulate_events(in_seconds()).as_csv().splitlines()
    assert lines[0] == (
        "robot,visit,place,purpose,enter [s],leave [s],waits [s],waits for,to leave,"
        "enter [ticks],leave [ticks],waits [ticks]"
    )
    assert lines[1] == "R1,0,N0,home,0,2.5,,,,0,1,0"


def test_a_window_keeps_the_visits_that_have_a_part_in_it() -> None:
    """Table 4: R2 is in N1 in [1, 2), in N4 in [2, 3), in N7 in [3, 4)."""
    plan = published("door-1")
    chosen = choose_events(plan, first_tick=2, last_tick=3, robots=["R2"])
    assert [plan.scenario.roadmap.name(each.vertex) for each in chosen] == ["N4", "N7"]


def test_collisions_of_free_running_robots_are_the_marked_cells_of_table_4() -> None:
    scenario = paper_scenario(CASES["door-1"])
    found = name_collisions(scenario, free_running_tracks(scenario))
    assert [(each.start, each.places) for each in found] == [
        (1, ("N1",)), (2, ("N4",)), (3, ("N7",)), (6, ("N7",)), (7, ("N4",)), (8, ("N1",)),
    ]  # fmt: skip


def test_the_paper_lists_a_collision_for_each_tick() -> None:
    """Collision(R1, R2, t) = N7 for t = 3, 4; one that never ends is listed until tick 6."""
    found = [
        NamedCollision("R1", "R2", Tick(3), Tick(5), ("N7",), "collision"),
        NamedCollision("R1", "R3", Tick(5), None, ("N4",), "collision"),
        NamedCollision("R2", "R3", Tick(5), Tick(5), ("N1", "N4"), "swap"),
    ]
    quantities = Quantities.of(paper_scenario(CASES["door-1"]))
    assert list(tabulate_collision_ticks(found, quantities, Tick(6)).list_rows()) == [
        ("R1", "R2", 3, "N7", "collision"),
        ("R1", "R2", 4, "N7", "collision"),
        ("R1", "R3", 5, "N4", "collision"),
        ("R2", "R3", 5, "N1 and N4", "swap"),
        ("R1", "R3", 6, "N4", "collision"),
    ]
    assert "permanently" in tabulate_collisions(found, quantities).as_text()


def test_the_swap_that_the_published_method_leaves_is_listed() -> None:
    plan = published("door-5")
    assert tuple(name_collisions(plan.scenario, plan.tracks)) == (
        NamedCollision("R1", "R2", Tick(7), Tick(7), ("N7", "N4"), "swap"),
    )


@pytest.mark.parametrize("case", PAPER, ids=list(CASES))
def test_conflicts_before_the_first_decision_are_counted_tick_by_tick(case: dict[str, Any]) -> None:
    plan = published(case["name"])
    scenario, tracks = plan.scenario, free_running_tracks(plan.scenario)
    end = max(compute_completions(scenario, tracks))
    listed = tabulate_collision_ticks(
        name_collisions(scenario, tracks), Quantities.of(scenario), end
    )
    assert count_conflicts_before(plan)[0] == [row[4] for row in listed.list_rows()].count(
        "collision"
    )


def test_the_published_method_does_not_count_the_swaps_that_it_does_not_see() -> None:
    plan = rightofway.solve(random_fleet(7, robots=10), "paper")
    found = name_collisions(plan.scenario, free_running(plan))
    assert "swap" in [each.kind for each in found]
    ticks = [each.until - each.start for each in found if each.until is not None]
    assert count_conflicts_before(plan)[0] == sum(ticks)


def test_a_list_of_too_many_ticks_is_refused() -> None:
    found = [NamedCollision("R1", "R2", Tick(0), Tick(10**9), ("N7",), "collision")]
    with pytest.raises(
        InputError, match=r"--each-tick: the collisions last 1000000000 ticks, more"
    ):
        tabulate_collision_ticks(found, Quantities.of(in_seconds().scenario), Tick(6))


def test_each_decision_goes_on_from_what_the_one_before_has_left() -> None:
    """door-2: R2 waits, which leaves one conflict (three if R1 waited); then none is left."""
    rows = list(tabulate_decisions(published("door-2")).list_rows())
    assert [row[9:13] for row in rows] == [(rows[0][9], 3, 1, 1), (1, 0, 0, 0)]


def test_a_long_list_is_cut_and_says_so() -> None:
    made = Listing(
        title="numbers",
        columns=(ListColumn(heading="n", values=range(5), kind="number"),),
        quantities=Quantities.of(in_seconds().scenario),
    )
    assert made.as_text(3).splitlines() == [
        "n", "0", "1", "2", "… and 2 more rows (-o FILE.txt or -o FILE.csv writes all)",
    ]  # fmt: skip
    assert made.as_text(None).splitlines() == ["n", "0", "1", "2", "3", "4"]


def test_a_sheet_has_numbers_a_heading_that_stays_and_filters() -> None:
    workbook = openpyxl.load_workbook(io.BytesIO(make_sheets([tabulate_events(in_seconds())])))
    sheet = workbook["events"]
    assert [cell.value for cell in sheet[3]][:6] == ["R1", 1, "N1", "drive through", 2.5, 5]
    assert (sheet.freeze_panes, sheet.auto_filter.ref) == ("A2", "A1:L6")
