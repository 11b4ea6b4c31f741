"""The script of the tables of cbs still draws and proves, and its tables are those of the page."""

from __future__ import annotations

from benchmarks.common import tables_in
from benchmarks.switches import (
    FAMILIES,
    FEW,
    NODES_OF,
    PAGE,
    draw_aisles,
    draw_rooms,
    make_families_table,
    make_nodes_table,
)

SECONDS = 0.002
"""For each search here, of which few end."""


def outline(table: str) -> tuple[str, list[str]]:
    """Return the heads of a table, and the first cell of each of its lines."""
    heads, _, *lines = table.splitlines()
    return heads, [line.split(" | ")[0] for line in lines]


def test_rooms_have_doors_and_aisles_have_ends() -> None:
    assert draw_rooms(2)[5:8] == ["@.....@.....@", "@@@.@@@@@.@@@", "@.....@.....@"]
    assert draw_rooms(2)[3] == "@...........@"
    assert draw_aisles(2, 2) == ["...", ".@.", ".@.", "..."]


def test_the_page_of_cbs_has_a_line_for_each_option_and_each_kind_of_fleets() -> None:
    """One fleet of each kind is drawn and searched for a moment."""
    published = tables_in(PAGE, "switches")
    one_of = [family._replace(fleets=1) for family in (*NODES_OF, FEW, *FAMILIES)]
    nodes = make_nodes_table(one_of[:2], one_of[2], seconds=SECONDS)
    families = make_families_table(one_of[3:], seconds=SECONDS)
    assert outline(nodes) == outline(published["nodes"])
    assert outline(families) == outline(published["families"])
