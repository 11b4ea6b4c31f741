"""The period as a function of one parameter: exact pieces, breakpoints, and the circuit of each.

In a chosen order each arc is as long as a constant plus a multiple of the parameter: a work time, a
headway, the time for a length unit. So is the mean of each circuit, and the period, the largest of
them, is a convex function of straight pieces: the upper envelope of lines. It is found from its
ends: where the lines of two critical circuits cross, either nothing is above them, and this is a
breakpoint, or the critical circuit there is a line between them (Eisner and Severance).

References
----------
Eisner & Severance, "Mathematical techniques for efficient record segmentation in large shared
databases", *Journal of the ACM* 23(4), 1976.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.precedence.timed_event_graph import TimedEventGraph, trace_circuit


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Growth:
    """The lengths of arcs for a parameter ``x``: ``(fixed + slope * x) / parts`` [ticks].

    Attributes
    ----------
    of
        The arc of the graph that each entry is about; where there are several entries, the arc is
        as long as the longest; int64, shape (N,).
    fixed, slope
        At least 0; int64, shape (N,).
    parts
        The divisor of both.
    """

    of: NDArray[np.int64]
    fixed: NDArray[np.int64]
    slope: NDArray[np.int64]
    parts: int = 1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PeriodPiece:
    """The period between two breakpoints: ``fixed + slope * x`` [ticks].

    Attributes
    ----------
    start, until
        The least and the largest parameter of the piece.
    fixed, slope
        Mean constant and mean multiple of the critical circuit; exact.
    arcs
        The critical circuit: arcs of the graph in order; int64.
    """

    start: Fraction
    until: Fraction
    fixed: Fraction
    slope: Fraction
    arcs: NDArray[np.int64]

    def compute_period(self, x: Fraction) -> Fraction:
        """Return the mean of the circuit for a parameter [ticks]."""
        return self.fixed + self.slope * x


def compute_period_curve(
    graph: TimedEventGraph,
    growth: Growth,
    start: Fraction,
    until: Fraction,
    *,
    time_limit: float | None = None,
) -> tuple[PeriodPiece, ...]:
    """Return the period for each parameter of a range as pieces from left to right.

    Parameters
    ----------
    graph
        Laps and orders; they are kept for every parameter.
    growth
        How long arcs are.
    start, until
        The range, from at least 0.
    time_limit
        For each search [s].

    Returns
    -------
    tuple of PeriodPiece
        Each begins where the one before ends, and rises more. A single piece that is a point, at
        ``start``, if robots would wait for each other for ever with any larger parameter: where
        three or more of them hand places round in a circle, and the parameter is the headway.

    Raises
    ------
    GaveUp
        If time ran out, or numbers become too large for the native core.
    """

    def line_at(x: Fraction) -> PeriodPiece | None:
        line = find_line_at(graph, growth, x, time_limit=time_limit)
        return None if line is None else replace(line, until=until)

    first, last = line_at(start), line_at(until)
    assert first is not None, "orders that are live for some parameter are live for less"
    if last is None:
        return (replace(first, until=start),)
    lines, ahead = [first], [last]
    while ahead:
        low, high = lines[-1], ahead[-1]
        if high.slope <= low.slope:
            ahead.pop()
            continue
        cross = (low.fixed - high.fixed) / (high.slope - low.slope)
        between = line_at(cross)
        if between is not None and between.compute_period(cross) > low.compute_period(cross):
            ahead.append(between)
        else:
            lines[-1] = replace(low, until=cross)
            lines.append(replace(ahead.pop(), start=cross))
    return tuple(line for line in lines if line.until > line.start or start == until)


def find_line_at(
    graph: TimedEventGraph, growth: Growth, x: Fraction, *, time_limit: float | None = None
) -> PeriodPiece | None:
    """Return the line of the critical circuit at a parameter, as a point; None for a deadlock.

    Raises
    ------
    GaveUp
        If time ran out, or numbers become too large for the native core.
    """
    arcs = graph.arcs.choose(growth.of.astype(np.int32))
    length = growth.fixed * x.denominator + growth.slope * x.numerator
    try:
        circuit = trace_circuit(len(graph), arcs.stretch(length), time_limit)
    except ValueError as error:
        raise GaveUp(Fact("numbers too large for a period", limit=str(error))) from None
    if circuit is None:
        return None
    chosen = circuit.arcs
    height = int(arcs.height[chosen].sum()) or 1  # no arcs: no circuit takes any time
    parts = height * growth.parts
    return PeriodPiece(
        start=x,
        until=x,
        fixed=Fraction(int(growth.fixed[chosen].sum()), parts),
        slope=Fraction(int(growth.slope[chosen].sum()), parts),
        arcs=growth.of[chosen],
    )
