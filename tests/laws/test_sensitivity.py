"""What a part saved is worth: the exact gain holds as far as it says, and no further."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from hypothesis import strategies as st

from rightofway.precedence import (
    TimedEventGraph,
    compute_sensitivity,
    find_critical_circuit_without,
)
from tests.builders.laws import law
from tests.builders.periodic import patterns

LITTLE = Fraction(1, 10**5)
"""A part so small that no other circuit of these small fleets takes over within it."""


@law(patterns(), st.randoms(use_true_random=False))
def test_gain_loss_and_reach_are_those_of_the_cycle_time_itself(
    graph: TimedEventGraph, draw: np.random.Generator
) -> None:
    lengths = graph.arcs.length.tolist()
    share = np.array([draw.choice((0, length)) for length in lengths], np.int64)
    effect = compute_sensitivity(graph, share)

    def at(part: Fraction) -> Fraction:
        return find_critical_circuit_without(graph, share, part).cycle_time

    now = effect.cycle_time
    assert at(Fraction(0)) == now == graph.find_critical_circuit().cycle_time
    assert at(Fraction(1)) == effect.at_best
    assert at(-LITTLE) == now + effect.loss * LITTLE
    assert effect.until > 0
    assert at(LITTLE) == now - effect.gain * LITTLE
    assert at(effect.until) == now - effect.gain * effect.until
    if effect.until < 1:
        beyond = min(Fraction(1), effect.until + LITTLE)
        assert at(beyond) > now - effect.gain * beyond
