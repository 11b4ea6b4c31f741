"""What would help: how the cycle time follows what takes time, exactly, both ways and how far.

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
from rightofway.arguments import checks_arguments
from rightofway.errors import GaveUp
from rightofway.precedence.timed_event_graph import Arcs, Circuit, TimedEventGraph, trace_circuit


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensitivity:
    """How the cycle time follows something that takes time; fractions are exact.

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


@checks_arguments
def compute_sensitivity(
    graph: TimedEventGraph,
    share: NDArray[np.int64],
    *,
    tight: NDArray[np.bool_] | None = None,
    time_limit: float | None = None,
) -> Sensitivity:
    """Return how the cycle time follows what takes its share of the arcs.

    Parameters
    ----------
    graph
        Laps and orders.
    share
        How much of each arc's length it is [ticks]; int64, shape (M,), at most the length.
    tight
        What `find_tight_arcs` returns, where several shares are asked for.
    time_limit
        For each search [s].

    Raises
    ------
    GaveUp
        If time ran out.
    """
    mask = find_tight_arcs(graph, time_limit=time_limit) if tight is None else tight
    critical, on_critical = graph.arcs.choose(mask), share[mask]

    def mean(length: NDArray[np.int64]) -> Fraction:
        return _circuit(graph, critical.stretch(length), time_limit).cycle_time

    now = mean(critical.length)
    gain = now - mean(critical.length - on_critical)
    loss = mean(on_critical)
    until, at_best = _reach(graph, share, now, gain, time_limit)
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
        raise GaveUp("time ran out in the search for critical circuits (give more time)")
    due = times[arcs.tail] + arcs.length * parts
    return np.asarray(times[arcs.head] + arcs.height.astype(np.int64) * period == due)


def find_critical_circuit_without(
    graph: TimedEventGraph,
    share: NDArray[np.int64],
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
        The part of each arc that can be saved [ticks]; int64, shape (M,).
    part
        The part of the share that is saved, 0 to 1.
    time_limit
        When to stop [s].

    Raises
    ------
    GaveUp
        If time ran out.
    """
    whole, saved = part.denominator, part.numerator
    arcs = graph.arcs.stretch(graph.arcs.length * whole - share * saved)
    circuit = _circuit(graph, arcs, time_limit)
    return Circuit(cycle_time=circuit.cycle_time / whole, arcs=circuit.arcs)


def _circuit(graph: TimedEventGraph, arcs: Arcs, time_limit: float | None) -> Circuit:
    circuit = trace_circuit(len(graph), arcs, time_limit)
    assert circuit is not None, "the orders of the graph are live, also with other lengths"
    return circuit


def _reach(
    graph: TimedEventGraph,
    share: NDArray[np.int64],
    now: Fraction,
    gain: Fraction,
    time_limit: float | None,
) -> tuple[Fraction, Fraction]:
    """Return how far the gain holds, and the cycle time with all of it saved.

    From the end back: where the circuit that decides there takes over from the first line, look
    which one decides there, until it is the first line itself.
    """
    until = Fraction(1)
    other_circuit = find_critical_circuit_without(graph, share, until, time_limit=time_limit)
    at_best = other_circuit.cycle_time
    while other_circuit.cycle_time > now - gain * until:
        arcs = graph.arcs.choose(other_circuit.arcs)
        height = int(arcs.height.sum())
        mean = Fraction(int(arcs.length.sum()), height)
        slope = Fraction(int(share[other_circuit.arcs].sum()), height)
        until = (now - mean) / (gain - slope)
        other_circuit = find_critical_circuit_without(graph, share, until, time_limit=time_limit)
    return until, at_best
