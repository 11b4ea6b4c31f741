"""A closed stretch of a run keeps every rule, and promises no more than it has time for."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rightofway.cyclic.closing import Stretch, closed, stretches
from rightofway.cyclic.groups import independent_groups
from rightofway.cyclic.native_rules import Native
from rightofway.cyclic.result import GroupRun
from rightofway.cyclic.route import cyclic_routes
from rightofway.cyclic.run import go_on, make_simulator
from rightofway.errors import InputError, NoPlanExists
from rightofway.model import Rules, Scenario
from rightofway.planners import Deadline, Task
from tests.builders.fleets import random_fleet
from tests.laws.test_windows import shift_of
from tests.oracles import periodic_bookings as oracle

law = settings(max_examples=60, derandomize=True, deadline=None)
RULES = [Rules(), Rules(headway=Fraction(2)), Rules(occupancy="both"), Rules(rotations=False)]
LEAST, MOST = 3, 15
"""How many of the longest laps a stretch has."""

KNOWN = 20
"""How many of them a run has at least."""


@st.composite
def runs(draw: st.DrawFn) -> tuple[Scenario, GroupRun]:
    """The largest group of a small fleet, as it went on for some laps."""
    try:
        scenario = random_fleet(
            draw(st.integers(0, 10**6)),
            size=draw(st.integers(4, 7)),
            robots=draw(st.integers(2, 6)),
            rules=draw(st.sampled_from(RULES)),
        )
        routes = draw(st.sampled_from(["clear", "direct"]))
        group = max(independent_groups(cyclic_routes(scenario, routes)), key=len)
    except (InputError, NoPlanExists):
        assume(False)
    rule = draw(st.sampled_from(["first-come", "least-loss"]))
    going = make_simulator(Task(scenario=scenario), group, rule)
    assume(len(group) > 1 and isinstance(going, Native))
    longest = max(endless.lap.duration for endless in group)
    run = go_on(going, Deadline())
    while run.ends == "repeats" and max(past[-1] for past in run.history) < KNOWN * longest:
        assert isinstance(going, Native)
        going.forget()
        run = go_on(going, Deadline())
    assume(all(run.mean_laps()) and run.ends == "repeats")
    return scenario, run


@law
@given(runs(), st.integers(LEAST, MOST), st.integers(1, 3))
def test_a_closed_stretch_keeps_every_rule_round_the_seam(
    told: tuple[Scenario, GroupRun], laps: int, begins: int
) -> None:
    scenario, run = told
    shift = shift_of(scenario, run)
    longest = max(endless.lap.duration for endless in run.group)
    stretch = Stretch(value=1, begins=begins * longest, period=laps * longest)
    assume(stretch.begins + stretch.period <= max(past[-1] for past in run.history))
    timetable = closed(shift, run, stretch)
    assume(timetable is not None)
    assert timetable is not None
    assert timetable.period == stretch.period
    graph = shift.graph(timetable)
    assert graph.slack().min() >= 0
    assert not graph.has_swaps()
    if sum(map(len, timetable.enter)) <= 400:  # the judge looks at every two visits
        ahead = scenario.rules.books_ahead
        assert oracle.faults(timetable, headway=shift.headway, books_ahead=ahead) == []


@law
@given(runs())
def test_a_stretch_promises_no_more_than_it_has_time_for(
    told: tuple[Scenario, GroupRun],
) -> None:
    scenario, run = told
    shift = shift_of(scenario, run)
    for stretch in stretches(shift, run)[:2]:
        timetable = closed(shift, run, stretch)
        if timetable is not None:
            assert float(shift.worth(timetable.counts)) / stretch.period <= stretch.value + 1e-9
            assert stretch.value <= shift.bound
