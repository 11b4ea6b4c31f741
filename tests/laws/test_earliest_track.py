"""The native search for one robot finds what trying every tick finds."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

from rightofway.model import Rules, Scenario, route_of
from rightofway.search import Distances, earliest_track
from tests.builders.booked import booked_on, table_of
from tests.builders.fleets import grid_fleet
from tests.builders.laws import law
from tests.oracles.sipp import Booked, earliest_completion

GRIDS = (["...", ".@.", "..."], ["....", "@.@@"], [".....", "..@..", "....."])
HORIZON = 60


@st.composite
def problems(draw: st.DrawFn) -> tuple[Scenario, list[Booked]]:
    """Draw a robot on a small grid and bookings of others that do not overlap."""
    grid = draw(st.sampled_from(GRIDS))
    free = [f"N{k}" for k, cell in enumerate("".join(grid)) if cell == "."]
    rules = Rules(
        occupancy=draw(st.sampled_from(["one", "both"])),
        headway=Fraction(draw(st.integers(0, 2))),
        ends=draw(st.sampled_from(["home", "none"])),
    )
    trip = (draw(st.sampled_from(free)), draw(st.sampled_from(free)))
    speed = Fraction(1, draw(st.integers(1, 2)))
    scenario = grid_fleet(grid, [trip], rules=rules, speeds=[speed], work=[draw(st.integers(0, 2))])
    return scenario, draw(booked_on(scenario.roadmap))


@law(problems())
def test_the_search_finds_the_earliest_completion(drawn: tuple[Scenario, list[Booked]]) -> None:
    scenario, booked = drawn
    problem, both = scenario.problem, scenario.rules.occupancy == "both"
    itinerary = problem.itineraries[0]
    track = earliest_track(0, table_of(problem, booked), Distances(scenario.roadmap))
    best = earliest_completion(
        scenario.roadmap,
        itinerary,
        booked,
        headway=problem.headway,
        books_ahead=both,
        horizon=HORIZON,
    )
    if track is None or len(track) == 1:  # a trip that stays at home needs no time to get there
        assert (track is None) == (best is None)
    else:
        last_visit = route_of(scenario.roadmap, itinerary, track).dwell[-1]
        assert int(track.enter[-1]) + last_visit == best
