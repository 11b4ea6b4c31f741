"""The paper's table: a row for a robot, a column for a tick, in the cell the place it holds."""

from rightofway.viz.table.timespace import Cell, Row, Run, TimeSpaceTable, table_of
from rightofway.viz.table.writing import as_text, write_csv, write_xlsx

__all__ = ["Cell", "Row", "Run", "TimeSpaceTable", "as_text", "table_of", "write_csv", "write_xlsx"]
