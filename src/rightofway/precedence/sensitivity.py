"""Remedies: how the cycle time follows each duration, exactly, both ways and how far.

Let something that takes time (a robot's driving, a work time, the headway) take less of it, by the
same part everywhere. Each circuit's mean falls in proportion to how much of that is on it, so the
cycle time, the largest of them, is convex and made of straight pieces: it falls at first by as much
as on that critical circuit which has least of it, until another circuit takes over; and it rises
by as much as on the one that has most. So whatever is on no critical circuit does neither.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.precedence.period_curve import Growth, PeriodPiece, find_line_at
from rightofway.precedence.timed_event_graph import Circuit, TimedEventGraph, trace_circuit


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensitivity:
    """The change of the cycle time with a parameter that takes time; fractions are exact.

    Attributes
    ----------
    cycle_time
        As it is [ticks].
    gain
        By how much it falls at first, for each part of that time that is saved: saving the part
        ``x`` saves ``gain * x`` [ticks].
    loss
        By how much it rises, in the same way, if that takes longer [ticks].
    until
        The part up to which the gain holds, 0 to 1; beyond, another circuit decides.
    at_best
        The cycle time if that took no time at all [ticks].
    """

    cycle_time: Fraction
    gain: Fraction
    loss: Fraction
    until: Fraction
    at_best: Fraction


def compute_sensitivity(
    graph: TimedEventGraph,
    share: NDArray[np.int64] | Growth,
    *,
    tight: NDArray[np.bool_] | None = None,
    time_limit: float | None = None,
) -> Sensitivity:
    """Return the sensitivity of the cycle time to a duration that has a share of the arcs.

    Parameters
    ----------
    graph
        Laps and orders.
    share
        How much of each arc's length it is [ticks]; int64, shape (M,), at most the length. Or the
        lengths of the arcs as a function of the part of that time that is left: 1 is as it is.
    tight
        The result of `find_tight_arcs`, where several shares are asked for.
    time_limit
        For each search [s].

    Raises
    ------
    GaveUp
        If time ran out.
    """
    mask = find_tight_arcs(graph, time_limit=time_limit) if tight is None else tight
    growth, now = (
        _compute_growth(graph, share),
        graph.find_critical_circuit(time_limit=time_limit).cycle_time,
    )
    as_it_is = growth.fixed + growth.slope == graph.arcs.length[growth.of] * growth.parts
    on_critical = mask[growth.of] & as_it_is
    critical = graph.arcs.choose(growth.of[on_critical].astype(np.int32))

    def mean(length: NDArray[np.int64]) -> Fraction:
        circuit = trace_circuit(len(graph), critical.stretch(length[on_critical]), time_limit)
        assert circuit is not None, "the orders of the graph are live, also with other lengths"
        return circuit.cycle_time / growth.parts

    gain, loss = now - mean(growth.fixed), mean(growth.slope)
    until, at_best = _measure_reach(graph, growth, now, gain, time_limit)
    return Sensitivity(cycle_time=now, gain=gain, loss=loss, until=until, at_best=at_best)


def find_tight_arcs(
    graph: TimedEventGraph, *, time_limit: float | None = None
) -> NDArray[np.bool_]:
    """Return a mask of arcs with no slack at the cycle time: all critical circuits are of these.

    Parameters
    ----------
    graph
        Laps and orders.
    time_limit
        When to stop [s].

    Raises
    ------
    GaveUp
        If time ran out.
    """
    arcs = graph.arcs
    cycle_time = graph.find_critical_circuit(time_limit=time_limit).cycle_time
    period, parts = cycle_time.numerator, cycle_time.denominator
    times = _core.earliest_times(
        len(graph), arcs.tail, arcs.head, arcs.length, arcs.height, period, parts, time_limit
    )
    if times is None:
        raise GaveUp(Fact("time over for critical circuits"))
    due = times[arcs.tail] + arcs.length * parts
    return np.asarray(times[arcs.head] + arcs.height.astype(np.int64) * period == due)


def find_critical_circuit_without(
    graph: TimedEventGraph,
    share: NDArray[np.int64] | Growth,
    part: Fraction,
    *,
    time_limit: float | None = None,
) -> Circuit:
    """Return a critical circuit, with the cycle time, if a part (0 to 1) of that share is saved.

    Parameters
    ----------
    graph
        Laps and orders.
    share
        The time that can be saved, as in `compute_sensitivity`.
    part
        The part of the share that is saved, 0 to 1.
    time_limit
        When to stop [s].

    Raises
    ------
    GaveUp
        If time ran out.
    """
    line = _find_line(graph, _compute_growth(graph, share), part, time_limit)
    return Circuit(cycle_time=line.compute_period(1 - part), arcs=line.arcs.astype(np.int32))


def _compute_growth(graph: TimedEventGraph, share: NDArray[np.int64] | Growth) -> Growth:
    """Return the lengths of arcs as a function of the part of a time that is left."""
    if isinstance(share, Growth):
        return share
    return Growth(of=np.arange(len(share)), fixed=graph.arcs.length - share, slope=share)


def _find_line(
    graph: TimedEventGraph, growth: Growth, saved: Fraction, time_limit: float | None
) -> PeriodPiece:
    """Return the line of the critical circuit where a part is saved."""
    line = find_line_at(graph, growth, 1 - saved, time_limit=time_limit)
    assert line is not None, "the orders of the graph are live, also with other lengths"
    return line


def _measure_reach(
    graph: TimedEventGraph,
    growth: Growth,
    now: Fraction,
    gain: Fraction,
    time_limit: float | None,
) -> tuple[Fraction, Fraction]:
    """Return how far the gain holds, and the cycle time with all of it saved.

    From the end back: where the circuit that decides there takes over from the first line, look
    which one decides there, until it is the first line itself.
    """
    until = Fraction(1)
    other = _find_line(graph, growth, until, time_limit)
    at_best = other.fixed
    while other.compute_period(1 - until) > now - gain * until:
        until = (now - other.compute_period(Fraction(1))) / (gain - other.slope)
        other = _find_line(graph, growth, until, time_limit)
    return until, at_best
