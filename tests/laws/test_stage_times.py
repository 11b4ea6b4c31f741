"""The native search keeps the times of stages and finds what trying every tick finds."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from hypothesis import strategies as st

from rightofway.model import Scenario, find_stays
from rightofway.model.stays import compute_costs
from rightofway.search import Distances, compute_least_completions, find_earliest_track
from tests.builders.any_fleet import any_fleet
from tests.builders.booked import booked_on, table_of
from tests.builders.laws import law, leave
from tests.builders.timed import LATE, draw_times
from tests.oracles.sipp import Booked
from tests.oracles.stage_times import MUCH, least_cost_in_time
from tests.oracles.turning import turn

HORIZON = 90

# As the oracle of tracks without times (test_earliest_track.py).
UNKNOWN = {"passed", "sizes", "zones", "closures", "barred", "laps", "spacing"}

problems = any_fleet(robots=(1, 1), without=UNKNOWN, tiny=True).flatmap(
    lambda fleet: st.tuples(draw_times(fleet), booked_on(fleet.roadmap))
)


def least_cost_of(scenario: Scenario, booked: list[Booked], **more: Any) -> object:
    itinerary = scenario.problem.itineraries[0]

    def turned(before: int, at: int, to: int) -> int:
        if before >= 0 or not itinerary.first_turns:
            return turn(scenario, 0, before, at, to)
        edge = int(scenario.roadmap.find_edges(np.array([at]), np.array([to]))[0])
        return itinerary.first_turns[edge - int(scenario.roadmap.indptr[itinerary.home])]

    return least_cost_in_time(
        scenario.roadmap,
        itinerary,
        booked,
        headway=scenario.problem.booking_rules.headway,
        books_ahead=scenario.problem.booking_rules.books_ahead,
        horizon=HORIZON,
        turn=turned,
        **more,
    )


priced = any_fleet(robots=(1, 1), without={*UNKNOWN, "weights"}, tiny=True).flatmap(
    lambda fleet: st.tuples(draw_times(fleet, costs=True), booked_on(fleet.roadmap))
)


@law(problems)
def test_the_search_finds_the_least_completion_with_times_of_stages(
    drawn: tuple[Scenario, list[Booked]],
) -> None:
    scenario, booked = drawn
    alone = compute_least_completions(scenario)
    if alone is None or alone[0] < 0:
        leave("no way leads to a stop")
    track = find_earliest_track(0, table_of(scenario.problem, booked), Distances(scenario.roadmap))
    best = least_cost_of(scenario, booked)
    if track is None:
        assert best is None
        return
    (stay,) = find_stays(scenario, [track])
    assert len(stay.serves) == len(scenario.problem.itineraries[0].stages_to_serve)
    assert stay.waits.min() >= 0
    cost = Fraction(*compute_costs(scenario, [track]))
    assert cost == best or (max(stay.completion, track.enter[-1]) > HORIZON - 20)


@law(priced)
def test_the_search_finds_the_least_cost_of_ends(drawn: tuple[Scenario, list[Booked]]) -> None:
    scenario, booked = drawn
    alone = compute_least_completions(scenario)
    if alone is None or alone[0] < 0:
        leave("no way leads to a stop")
    track = find_earliest_track(0, table_of(scenario.problem, booked), Distances(scenario.roadmap))
    best = least_cost_of(scenario, booked, late=LATE)
    if track is None:
        assert best is None
        return
    (stay,) = find_stays(scenario, [track])
    cost = Fraction(*compute_costs(scenario, [track]))
    stages = scenario.problem.itineraries[0].stages_to_serve
    for stage, end in zip(stages, stay.ends, strict=True):
        delay = 0 if stage.due is None else max(0, end - stage.due)
        cost += MUCH * stage.weight * (end + LATE * delay)
    assert cost == best or max(stay.completion, track.enter[-1]) > HORIZON - 20
