"""The paper's table, a row for a robot and a column for a tick; lists of events and collisions."""

from rightofway.viz.table.listing import ListColumn, Listing
from rightofway.viz.table.lists import (
    MAX_ROWS,
    choose_events,
    count_conflicts_before,
    tabulate_collision_ticks,
    tabulate_collisions,
    tabulate_decisions,
    tabulate_events,
)
from rightofway.viz.table.timespace import (
    Cell,
    CellRun,
    Row,
    TimeSpaceTable,
    choose_robots,
    end_of,
    make_table,
    make_table_of_groups,
)
from rightofway.viz.table.writing import as_csv, as_text, write_csv, write_xlsx

__all__ = [
    "MAX_ROWS",
    "Cell",
    "CellRun",
    "ListColumn",
    "Listing",
    "Row",
    "TimeSpaceTable",
    "as_csv",
    "as_text",
    "choose_events",
    "choose_robots",
    "count_conflicts_before",
    "end_of",
    "make_table",
    "make_table_of_groups",
    "tabulate_collision_ticks",
    "tabulate_collisions",
    "tabulate_decisions",
    "tabulate_events",
    "write_csv",
    "write_xlsx",
]
