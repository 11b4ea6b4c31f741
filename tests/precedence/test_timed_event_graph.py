"""Two robots through one door, by paper and pencil.

R1 lives in the west (0) and works in the north (3), R2 lives in the east (1) and works in the south
(4); the door (2) is in the middle, each edge takes a tick. R1 goes in and comes out, then R2.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from rightofway.errors import GaveUp
from rightofway.model import BookingRules, Lap, Tick
from rightofway.precedence import TimedEventGraph, compute_sensitivity, unroll_schedule
from rightofway.site import VertexId
from tests.builders.periodic import timetable_of


def lap(home: int, target: int, *, work: int, turn: int = 0) -> Lap:
    return Lap(
        vertices=tuple(VertexId(v) for v in (home, 2, target, 2)),
        dwell=(Tick(turn), Tick(0), Tick(work), Tick(0)),
        drive=(Tick(1),) * 4,
    )


def door(*, turn: int = 0) -> TimedEventGraph:
    """R1 works for 4 ticks, R2 for 2; R2 turns at home."""
    r1, r2 = lap(0, 3, work=4), lap(1, 4, work=2, turn=turn)
    timetable = timetable_of([r1, r2], [[8, 21, 22, 27], [13, 28, 29, 32]], period=20)
    return TimedEventGraph(timetable, rules=BookingRules())


def test_the_period_is_both_stays_beyond_the_door() -> None:
    # From R1's entering the door until it has left it for home: 1 + 4 + 1 + 1. The same for R2:
    # 1 + 2 + 1 + 1. Alone their laps take 8 and 6.
    found = door().find_critical_circuit()
    assert found.cycle_time == 7 + 5
    assert len(found.arcs) == 8


def test_each_change_at_the_door_costs_headway_and_the_drive_into_it() -> None:
    timetable = door().timetable
    headway = TimedEventGraph(timetable, rules=BookingRules(headway=Tick(3), books_ahead=False))
    assert headway.find_critical_circuit().cycle_time == 12 + 2 * 3
    both = TimedEventGraph(timetable, rules=BookingRules(headway=Tick(0), books_ahead=True))
    assert both.find_critical_circuit().cycle_time == 12 + 2 * 1


def test_the_period_of_two_periods_is_twice_as_long() -> None:
    timetable = unroll_schedule(door().timetable, 2)
    assert timetable.counts == (2, 2)
    assert timetable.enter[1].tolist() == [13, 28, 29, 32, 33, 48, 49, 52]
    graph = TimedEventGraph(timetable, rules=BookingRules())
    assert graph.find_critical_circuit().cycle_time == 24


def test_a_slow_robot_sets_the_pace_of_all_that_take_turns_with_it() -> None:
    # R2 turns for 9 ticks at home: its lap takes 15, longer than both stays.
    found = door(turn=9).find_critical_circuit()
    assert found.cycle_time == 15
    assert len(found.arcs) == 4


def test_the_earliest_timetable_has_no_slack_on_the_critical_circuit() -> None:
    graph = door()
    found = graph.compute_earliest(Tick(12))
    # R1 is home at 0, and R2 in the door (12 is 0); R2 is home at 5 = 17, and R1 in the door.
    assert [ticks.tolist() for ticks in found.enter] == [[0, 5, 6, 11], [5, 12, 13, 16]]
    again = TimedEventGraph(found, rules=BookingRules())
    assert again.compute_slack()[graph.find_critical_circuit().arcs].tolist() == [0] * 8


def test_a_period_below_the_cycle_time_is_refused() -> None:
    with pytest.raises(ValueError, match="period: 11 is less than the cycle time 12"):
        door().compute_earliest(Tick(11))


def test_time_that_runs_out_is_told() -> None:
    with pytest.raises(GaveUp, match="give a longer time limit"):
        door().find_critical_circuit(time_limit=0)


def share_of_work(graph: TimedEventGraph) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
    """R1's work: the arc that leaves its visit 2."""
    share = np.zeros(len(graph.arcs), np.int64)
    share[2] = 4
    return share


def told(*fractions: Fraction) -> list[float]:
    return [float(fraction) for fraction in fractions]


def test_work_on_the_bottleneck_is_worth_its_ticks_down_to_none() -> None:
    effect = compute_sensitivity(door(), share_of_work(door()))
    assert told(effect.gain, effect.loss, effect.until) == [4, 4, 1]
    assert effect.at_best == 8  # R1's and R2's stays, 3 + 5; alone, R1 needs 4 and R2 6


def test_a_gain_ends_where_another_circuit_takes_over() -> None:
    # R2 turns for 5 ticks: its own lap takes 11, so no more than 1 of the 4 ticks can be won.
    graph = door(turn=5)
    effect = compute_sensitivity(graph, share_of_work(graph))
    assert told(effect.gain, effect.until, effect.at_best) == [4, 1 / 4, 11]


def test_where_two_circuits_are_critical_better_helps_nothing_and_worse_harms() -> None:
    # R2 turns for 6 ticks: its own lap takes 12 as well.
    graph = door(turn=6)
    effect = compute_sensitivity(graph, share_of_work(graph))
    assert told(effect.gain, effect.loss, effect.until, effect.at_best) == [0, 4, 1, 12]


def test_what_is_on_no_critical_circuit_does_not_matter() -> None:
    graph = door(turn=9)
    effect = compute_sensitivity(graph, share_of_work(graph))
    assert told(effect.gain, effect.loss, effect.at_best) == [0, 0, 15]


def ring(robots: int) -> TimedEventGraph:
    """Each robot goes round a ring as long as the fleet, all moving on at the same ticks."""
    laps = [
        Lap(
            vertices=tuple(VertexId((robot + k) % robots) for k in range(robots)),
            dwell=(Tick(0),) * robots,
            drive=(Tick(1),) * robots,
        )
        for robot in range(robots)
    ]
    enter = [[3 * k for k in range(robots)]] * robots
    timetable = timetable_of(laps, enter, period=3 * robots)
    return TimedEventGraph(timetable, rules=BookingRules())


def test_a_swap_is_told_from_a_rotation() -> None:
    assert ring(2).has_swaps()
    assert not ring(3).has_swaps()
    assert not door().has_swaps()
