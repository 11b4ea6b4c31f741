"""All of a plan in one workbook: summary, time/space table, diagram, events, collisions, decisions.

The diagram is a chart of the spreadsheet itself: places over time, a line for each robot.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any

from rightofway.errors import InputError, NoPlanExists
from rightofway.extras import load_library
from rightofway.files import make_archive, write_whole
from rightofway.metrics import compute_lost_time, free_running, measure, name_collisions
from rightofway.model import Plan
from rightofway.report.plan import ROBOT_COLUMNS
from rightofway.report.quantities import Quantities
from rightofway.viz.motion import Phase, make_trips
from rightofway.viz.palette import choose_colours
from rightofway.viz.placement import make_edge_length, order_in_line
from rightofway.viz.table.listing import ListColumn, Listing
from rightofway.viz.table.lists import (
    tabulate_collisions,
    tabulate_decisions,
    tabulate_events,
    tabulate_stops,
)
from rightofway.viz.table.timespace import MAX_CELLS, make_table
from rightofway.viz.table.workbook import (
    BOLD,
    WRONG,
    make_cell,
    widen,
    write_legend,
    write_list,
    write_table,
)
from rightofway.viz.table.writing import MAX_TICKS_OF_SHEET
from rightofway.viz.verdict import give_verdict

openpyxl, charts = (load_library(name, "a workbook") for name in ("openpyxl", "openpyxl.chart"))

MOST_LINES = 100
"""Robots in the chart; a chart has 255 series, and nobody can tell more lines apart."""

MOST_POINTS = 32_000
"""Points of a line that spreadsheets draw."""

CHART_SIZE = (32, 17)
"""Width and height of the chart [cm]."""

NAME_SHARE = 0.007
"""The part of the chart's width that a letter of a place takes."""

GRID_GREY = "E3E1DA"


def write_result(plan: Plan, path: str | os.PathLike[str]) -> None:
    """Write all that is known of a plan as an Excel workbook.

    Raises
    ------
    InputError
        If the file cannot be written; one that was there before is untouched.

    Notes
    -----
    A sheet that would be too large is left out, and the summary says so.
    """
    write_whole(path, make_result(plan))


def make_result(plan: Plan) -> bytes:
    """Return the workbook of `write_result`."""
    workbook = openpyxl.Workbook(write_only=True)
    summary = _add_sheet(workbook, "summary")
    diagram, left_out = _add_sheet(workbook, "diagram"), list[tuple[str, str]]()
    try:
        table = make_table(plan)
        table = table.limit_columns(min(MAX_TICKS_OF_SHEET, MAX_CELLS // len(table.rows)))
        write_table(_add_sheet(workbook, "time and space"), table)
        write_legend(_add_sheet(workbook, "legend"), table)
    except InputError as error:
        left_out.append(("time and space", f"is left out: {error.faults[0].message}"))
    quantities = Quantities.of(plan.scenario)
    free = name_collisions(plan.scenario, free_running(plan))
    left = name_collisions(plan.scenario, plan.tracks)
    for listing in (
        *(() if plan.tours is None else (tabulate_stops(plan),)),
        tabulate_events(plan),
        tabulate_collisions(free, quantities),
        tabulate_collisions(left, quantities, "left in the plan"),
        tabulate_decisions(plan),
    ):
        try:
            write_list(_add_sheet(workbook, listing.title), listing)
        except InputError as error:
            left_out.append((listing.title, f"is left out: {error.faults[0].message}"))
    _write_diagram(diagram, _add_sheet(workbook, "diagram data"), plan)
    _write_summary(summary, plan, left_out)
    return make_archive(workbook.save)


def _add_sheet(workbook: Any, title: str) -> Any:
    """Add a sheet that is printed on paper as wide as the sheet."""
    sheet = workbook.create_sheet(title)
    sheet.page_setup.orientation = "landscape"
    sheet.page_setup.fitToWidth, sheet.page_setup.fitToHeight = 1, 0
    sheet.sheet_properties.pageSetUpPr = openpyxl.worksheet.properties.PageSetupProperties(
        fitToPage=True
    )
    return sheet


def _write_summary(sheet: Any, plan: Plan, more: Sequence[tuple[str, str]]) -> None:
    """Write the costs of the plan, then a row for each robot: where its completion time goes."""
    rows, robots = [*_list_figures(plan), *more], _list_robots(plan)
    headings = robots.list_headings()
    widen(sheet, 1, 1, {*(key for key, _ in rows), *map(str, robots.columns[0].values)})
    for number, heading in enumerate(headings[1:], 2):
        widen(sheet, number, number, {heading})
    if faults := give_verdict(plan).total:
        words = f"{faults} fault{'s' if faults > 1 else ''}: do not run this plan"
        sheet.append([make_cell(sheet, words, font=WRONG)])
        sheet.append([])
    for key, text in rows:
        sheet.append([make_cell(sheet, key, font=BOLD), make_cell(sheet, text)])
    sheet.append([])
    sheet.append([make_cell(sheet, heading, font=BOLD) for heading in headings])
    for row in robots.list_rows():
        sheet.append([None if value is None else make_cell(sheet, value) for value in row])


def _list_figures(plan: Plan) -> Iterator[tuple[str, str]]:
    quantities, count = Quantities.of(plan.scenario), len(plan.tracks)
    status = "" if plan.run.status is None else f": {plan.run.status}"
    yield "planner", f"{plan.run.name}{status}"
    yield "robots", str(count)
    yield "flowtime", quantities.format_duration(plan.flowtime)
    yield "makespan", quantities.format_duration(plan.makespan)
    try:
        metrics = measure(plan)
    except NoPlanExists:
        return
    if metrics.gap is not None:
        bound = quantities.format_duration(metrics.lower_bound)
        yield "lower bound of the flowtime", f"{bound}; this plan is {metrics.gap:.1%} above it"
    yield "waiting in all", quantities.format_duration(metrics.waiting)


def _list_robots(plan: Plan) -> Listing:
    names = [robot.name for robot in plan.scenario.robots]
    try:
        lost = compute_lost_time(plan)
        times = {heading: [*map(get, lost)] for heading, get in ROBOT_COLUMNS.items()}
    except NoPlanExists:  # a robot has no way, so there is nothing to compare with
        times = {"completes": list(plan.completions)}
    columns = (ListColumn(heading=key, values=column, kind="time") for key, column in times.items())
    return Listing(
        title="robots",
        columns=(ListColumn(heading="robot", values=names), *columns),
        quantities=Quantities.of(plan.scenario),
    )


def _write_diagram(sheet: Any, data: Any, plan: Plan) -> None:
    """Write a chart into a sheet, and the points of each robot's line into another one."""
    trips, scenario = make_trips(plan)[:MOST_LINES], plan.scenario
    routes = [trip.vertices for trip in trips]
    line = list(order_in_line(routes, make_edge_length(scenario.roadmap)))
    rows = {vertex: row for row, vertex in enumerate(line)}
    grid = scenario.roadmap.grid
    cells = grid.cells.tolist() if grid is not None and scenario.roadmap.labels is None else None
    chart = charts.ScatterChart()
    chart.style, chart.scatterStyle = 13, "lineMarker"
    chart.width, chart.height = CHART_SIZE
    chart.title = None
    chart.x_axis.title = Quantities.of(scenario).format_heading("time")
    chart.x_axis.delete = False
    chart.x_axis.scaling.min = 0
    chart.x_axis.majorGridlines = None
    chart.x_axis.crosses = "min"
    chart.y_axis.delete = bool(line)  # the names of the places stand there instead
    chart.y_axis.title = None if line else "place"
    chart.y_axis.majorGridlines.spPr = _make_stroke(GRID_GREY)
    if line:
        names = [scenario.roadmap.name(vertex) for vertex in line]
        left = min(NAME_SHARE * (2 + max(map(len, names))), 0.3)
        room = charts.layout.ManualLayout(
            layoutTarget="inner", xMode="edge", yMode="edge", x=left, y=0.1, w=0.96 - left, h=0.76
        )
        chart.layout = charts.layout.Layout(manualLayout=room)
        chart.y_axis.scaling.min, chart.y_axis.scaling.max = -1, len(line)
        chart.y_axis.majorUnit = 1
    elif cells is not None:
        chart.y_axis.number_format = '"N"0'
    tick = Quantities.of(scenario).tick
    columns: list[list[float | str]] = []
    for trip, robot, colour in zip(
        trips, scenario.robots, choose_colours(len(trips)), strict=False
    ):
        points = [
            (float(at * tick), rows.get(vertex, cells[vertex] if cells else vertex))
            for at, vertex in _trace_line(trip)
        ][:MOST_POINTS]
        first = len(columns) + 1
        columns += [[f"{robot.name} time", *(x for x, _ in points)]]
        columns += [[robot.name, *(y for _, y in points)]]
        series = _make_series(data, first, 2, len(points) + 1)
        series.graphicalProperties.line.solidFill = colour.lstrip("#").upper()
        series.graphicalProperties.line.width = 22_000  # EMU, 12 700 to a point
        chart.series.append(series)
    _name_places(chart, data, columns, [scenario.roadmap.name(vertex) for vertex in line])
    height = max(map(len, columns))
    for row in range(height):
        data.append(
            [make_cell(data, column[row]) if row < len(column) else None for column in columns]
        )
    chart.legend.position = "t"
    sheet.add_chart(chart, "A2")
    shown = len(trips)
    words = f"{shown} robots" if shown == len(plan.tracks) else f"the first {shown} robots"
    sheet.append([f"Places over time, {words}. A robot that stands still is a level line."])


def _trace_line(trip: Any) -> Iterator[tuple[int, int]]:
    """Yield the corners of a robot's line: when, and at which vertex."""
    yield trip.enter[0], trip.vertices[0]
    for visit, begin, end, activity in trip.trace_all_phases():
        if activity is Phase.DRIVE:
            yield begin, trip.vertices[visit]
            yield end, trip.vertices[visit + 1]


def _make_series(data: Any, column: int, first: int, last: int) -> Any:
    """Return the series of two columns of a sheet, named by the heading of the second one."""
    x = charts.Reference(data, min_col=column, min_row=first, max_row=last)
    y = charts.Reference(data, min_col=column + 1, min_row=first - 1, max_row=last)
    series = charts.Series(y, x, title_from_data=True)
    series.marker.symbol, series.smooth = "none", False
    return series


def _name_places(
    chart: Any, data: Any, columns: list[list[float | str]], names: Sequence[str]
) -> None:
    """Add a point at time 0 for each place; its label is the name of the place."""
    robots = len(chart.series)
    for row, name in enumerate(names):
        first = len(columns) + 1
        columns += [["place", 0], [name, row]]
        series = _make_series(data, first, 2, 2)
        series.graphicalProperties.line.noFill = True
        series.dLbls = charts.label.DataLabelList()
        series.dLbls.showSerName, series.dLbls.position = True, "l"
        series.dLbls.showVal = series.dLbls.showLegendKey = series.dLbls.showCatName = False
        chart.series.append(series)
    chart.legend.legendEntry = [
        charts.legend.LegendEntry(idx=robots + number, delete=True) for number in range(len(names))
    ]


def _make_stroke(colour: str) -> Any:
    properties = charts.shapes.GraphicalProperties()
    properties.line.solidFill = colour
    return properties
