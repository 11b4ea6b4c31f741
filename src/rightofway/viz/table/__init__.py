"""The paper's table, a row for a robot and a column for a tick; lists of events and collisions."""

from rightofway.viz.table.listing import ListColumn, Listing, parquet_of
from rightofway.viz.table.lists import (
    chosen_events,
    collision_list,
    collision_ticks,
    conflicts_before,
    decision_list,
    event_list,
)
from rightofway.viz.table.timespace import (
    Cell,
    CellRun,
    Row,
    TimeSpaceTable,
    chosen_robots,
    end_of,
    table_of,
    table_of_groups,
)
from rightofway.viz.table.writing import as_csv, as_text, write_csv, write_xlsx

__all__ = [
    "Cell",
    "CellRun",
    "ListColumn",
    "Listing",
    "Row",
    "TimeSpaceTable",
    "as_csv",
    "as_text",
    "chosen_events",
    "chosen_robots",
    "collision_list",
    "collision_ticks",
    "conflicts_before",
    "decision_list",
    "end_of",
    "event_list",
    "parquet_of",
    "table_of",
    "table_of_groups",
    "write_csv",
    "write_xlsx",
]
