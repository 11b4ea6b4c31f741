"""The cycle time by theory is that of the running fleet, to the tick; the kernel's is Karp's."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import strategies as st

from rightofway import _core
from rightofway.model import Tick
from rightofway.precedence import CyclicSchedule, TimedEventGraph, unroll_schedule
from tests.builders.laws import law
from tests.builders.periodic import patterns
from tests.oracles import timed_event_graph as oracle


def slow_arcs(graph: TimedEventGraph) -> list[oracle.Arc]:
    return oracle.arcs_of(
        graph.timetable, headway=graph.rules.headway, books_ahead=graph.rules.books_ahead
    )


@law(patterns())
def test_arcs_are_those_of_the_visits_laid_out_one_by_one(graph: TimedEventGraph) -> None:
    arcs = graph.arcs
    rows = zip(arcs.tail, arcs.head, arcs.length, arcs.height, strict=True)
    assert sorted(tuple(map(int, row)) for row in rows) == sorted(slow_arcs(graph))


@law(patterns())
def test_the_period_by_theory_is_the_period_of_the_running_fleet(graph: TimedEventGraph) -> None:
    arcs = oracle.turned(graph.timetable, slow_arcs(graph))
    assert graph.find_critical_circuit().cycle_time == oracle.run_until_it_repeats(len(graph), arcs)


@law(patterns())
def test_policy_iteration_finds_what_karp_does(graph: TimedEventGraph) -> None:
    arcs = oracle.turned(graph.timetable, slow_arcs(graph))
    assert graph.find_critical_circuit().cycle_time == oracle.karp(len(graph), arcs)


@law(patterns())
def test_the_critical_circuit_is_one_and_as_long_as_it_says(graph: TimedEventGraph) -> None:
    found, arcs = graph.find_critical_circuit(), graph.arcs
    on = arcs.choose(found.arcs)
    assert np.array_equal(on.head, np.roll(on.tail, -1))
    assert Fraction(int(on.length.sum()), int(on.height.sum())) == found.cycle_time


@law(patterns(), st.integers(0, 50))
def test_the_earliest_timetable_keeps_all_arcs_and_all_orders(
    graph: TimedEventGraph, spare: int
) -> None:
    cycle_time = graph.find_critical_circuit().cycle_time
    times = cycle_time.denominator
    wide = TimedEventGraph(unroll_schedule(graph.timetable, times), rules=graph.rules)
    assert wide.find_critical_circuit().cycle_time == cycle_time.numerator
    found = wide.compute_earliest(Tick(cycle_time.numerator + spare))
    again = TimedEventGraph(found, rules=graph.rules)
    assert again.compute_slack().min() >= 0
    assert spare or (again.compute_slack() == 0).any()
    assert again.find_critical_circuit().cycle_time == cycle_time.numerator
    is_well_formed(found)


def is_well_formed(timetable: CyclicSchedule) -> None:
    for enter in timetable.enter:
        assert 0 <= enter[0] < timetable.period
        assert (np.diff(enter) > 0).all()
        assert enter[-1] < enter[0] + timetable.period


@law(patterns())
def test_nothing_is_possible_below_the_cycle_time(graph: TimedEventGraph) -> None:
    cycle_time = graph.find_critical_circuit().cycle_time
    with pytest.raises(ValueError, match="is less than the cycle time"):
        graph.compute_earliest(Tick((cycle_time.numerator - 1) // cycle_time.denominator))


@st.composite
def graphs(draw: st.DrawFn) -> tuple[int, list[oracle.Arc]]:
    """Any graph whose arcs of height 0 lead on from lower to higher numbers."""
    n = draw(st.integers(1, 7))
    node = st.integers(0, n - 1)
    arcs = draw(
        st.lists(
            st.builds(oracle.Arc, node, node, st.integers(0, 9), st.integers(0, 3)), max_size=16
        )
    )
    return n, [
        arc if arc.tail < arc.head else arc._replace(height=max(1, arc.height)) for arc in arcs
    ]


@law(graphs())
def test_policy_iteration_finds_what_karp_does_on_any_graph(
    graph: tuple[int, list[oracle.Arc]],
) -> None:
    n, arcs = graph
    rows = np.array(arcs, np.int64).reshape(-1, 4).T
    tail, head, height = (rows[k].astype(np.int32) for k in (0, 1, 3))
    found = _core.critical_circuit(n, tail, head, np.ascontiguousarray(rows[2]), height, None)
    assert found is not None
    assert Fraction(found[0], found[1]) == oracle.karp(n, arcs)
    assert found[0] == 0 or len(found[2])
