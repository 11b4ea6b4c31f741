"""The paper's table: a row for a robot, a column for a tick, in the cell the place it holds."""

from rightofway.viz.table.files import write_csv, write_xlsx
from rightofway.viz.table.rows import table_of
from rightofway.viz.table.text import as_text
from rightofway.viz.table.timespace import Cell, Row, Run, TimeSpaceTable

__all__ = ["Cell", "Row", "Run", "TimeSpaceTable", "as_text", "table_of", "write_csv", "write_xlsx"]
