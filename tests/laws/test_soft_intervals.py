"""With prices for overlaps, the native search finds the cheapest track there is."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from rightofway import _core
from rightofway.model import Rules, Scenario
from rightofway.search import Distances
from tests.builders.fleets import grid_fleet
from tests.oracles.sipp import Booked
from tests.oracles.soft_sipp import cheapest_track

GRIDS = (["...."], ["...", ".@."], ["..", ".."])
HORIZON = 40


@st.composite
def problems(draw: st.DrawFn) -> tuple[Scenario, list[Booked], list[int]]:
    """Draw a robot on a small grid, bookings of others that may overlap, and prices."""
    grid = draw(st.sampled_from(GRIDS))
    free = [f"N{k}" for k, cell in enumerate("".join(grid)) if cell == "."]
    rules = Rules(
        occupancy=draw(st.sampled_from(["one", "both"])),
        ends=draw(st.sampled_from(["home", "none"])),
    )
    trip = (draw(st.sampled_from(free)), draw(st.sampled_from(free)))
    scenario = grid_fleet(grid, [trip], rules=rules, work=[draw(st.integers(0, 2))])
    booked = [
        Booked(vertex, start, start + draw(st.integers(1, 6)), robot)
        for robot in range(draw(st.integers(0, 5)))
        for vertex in [draw(st.integers(0, scenario.roadmap.n_vertices - 1))]
        for start in [draw(st.integers(0, 12))]
    ]
    return scenario, booked, [draw(st.integers(0, 9)) for _ in booked]


@settings(max_examples=200, deadline=None, derandomize=True)
@given(problems())
def test_the_search_finds_the_least_completion_and_prices(
    problem: tuple[Scenario, list[Booked], list[int]],
) -> None:
    scenario, booked, prices = problem
    itinerary, roadmap = scenario.problem.itineraries[0], scenario.roadmap
    table = _core.BookingTable(roadmap.n_vertices)
    for one in booked:
        table.insert(one.vertex, one.start, one.end, one.robot)
    distances = Distances(roadmap)
    end, _, _, cost = _core.earliest_track(
        roadmap.indptr,
        roadmap.heads,
        roadmap.length_class,
        np.array(itinerary.edge_ticks, np.int32),
        table,
        int(scenario.problem.headway),
        scenario.rules.books_ahead,
        int(itinerary.home),
        np.array([stage.vertex for stage in itinerary.stages], np.int32),
        np.array([stage.work for stage in itinerary.stages], np.int64),
        np.array([stage.turn for stage in itinerary.stages], np.int64),
        [distances.to(stage.vertex, itinerary.edge_ticks) for stage in itinerary.stages],
        np.array(prices, np.int64),
        None,
    )
    best = cheapest_track(
        roadmap,
        itinerary,
        booked,
        prices,
        headway=scenario.problem.headway,
        books_ahead=scenario.rules.books_ahead,
        horizon=HORIZON,
    )
    if prices:
        assert (end, cost) == (0, best)
