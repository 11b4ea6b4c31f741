"""The native search for one robot finds what trying every tick finds."""

from __future__ import annotations

from functools import partial

from hypothesis import strategies as st

from rightofway.model import Scenario, compute_completions, compute_cost
from rightofway.search import Distances, compute_least_completions, find_earliest_track
from tests.builders.any_fleet import any_fleet
from tests.builders.booked import booked_on, table_of
from tests.builders.laws import law, leave
from tests.oracles.sipp import Booked, least_cost
from tests.oracles.turning import turn

HORIZON = 90

# The oracle has bookings of vertices only, and drives a robot along every edge at its own pace.
UNKNOWN = {"passed", "sizes", "zones", "closures", "barred", "laps", "spacing"}
"""Laps would outlast the horizon, as do lanes in pieces."""

problems = any_fleet(robots=(1, 1), without=UNKNOWN, tiny=True).flatmap(
    lambda fleet: st.tuples(st.just(fleet), booked_on(fleet.roadmap))
)


@law(problems)
def test_the_search_finds_the_least_completion_and_surcharges(
    drawn: tuple[Scenario, list[Booked]],
) -> None:
    scenario, booked = drawn
    problem = scenario.problem
    itinerary = problem.itineraries[0]
    alone = compute_least_completions(scenario)
    if alone is None or alone[0] < 0:
        leave("no way leads to a stop")
    track = find_earliest_track(0, table_of(problem, booked), Distances(scenario.roadmap))
    best = least_cost(
        scenario.roadmap,
        itinerary,
        booked,
        headway=problem.booking_rules.headway,
        books_ahead=problem.booking_rules.books_ahead,
        horizon=HORIZON,
        turn=partial(turn, scenario, 0),
    )
    if track is None or len(track) == 1:  # a trip that stays at home needs no time to get there
        assert best is None or track is not None
        return
    cost, done = compute_cost(scenario, [track]), compute_completions(scenario, [track])[0]
    assert cost == best or (done > HORIZON and (best is None or cost < best))
