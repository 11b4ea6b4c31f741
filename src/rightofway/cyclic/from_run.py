"""The timetable of a large group: the closing of a long stretch of the best simulation.

Hundreds of robots leave no time to place each robot several times. A simulation under a native rule
makes dozens of laps per second, and closing a stretch costs about half a lap per robot (`closing`).
Therefore simulations are compared: on clear or direct routes, under ``least-loss`` or
``first-come``. Each simulation is tried for a short time; the best continues until time is over.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from rightofway.cyclic.closing import Stretch, close_stretch, find_stretches
from rightofway.cyclic.problem import Candidate, CyclicProblem
from rightofway.cyclic.result import GroupResult
from rightofway.cyclic.route import GroupContext
from rightofway.cyclic.run import advance
from rightofway.cyclic.simulator import CyclicSimulator
from rightofway.planners import Deadline


@dataclass(frozen=True, slots=True, kw_only=True)
class RunChoiceParams:
    """Division of time between simulations; shares of the time left."""

    least_share: float = 0.03  # Least share of a trial.
    most_share: float = 0.15  # Largest share of a trial.
    laps_tried: float = 3  # Duration of a trial between these shares [longest laps].
    laps_dispersing: float = 1  # Preceding first-come simulation [longest laps].
    looks: int = 10  # Number of checks of the duration of a trial.
    good: Fraction = Fraction(1005, 1000)  # A run of baseline value times this ends the trials.
    continuing_share: float = 0.8  # Share for continuing the best run before closing.
    slices: int = 4  # Number of parts of this share, each with a new choice.
    seam: float = 0.55  # Estimated loss of a closing [laps per robot].
    stretches_each: int = 2  # Attempted closings per simulation.
    most_stretches: int = 4  # Attempted closings in total.


DEFAULT = RunChoiceParams()


class SimulatedRun:
    """A simulation of a group on given routes, after a short trial, with its result so far.

    ``known``: simulated time [ticks]; ``pace``: speed of the last advance [ticks/s].
    """

    def __init__(
        self,
        problem: CyclicProblem,
        context: GroupContext,
        rule: str,
        params: RunChoiceParams = DEFAULT,
    ) -> None:
        self._problem = problem
        self._simulator = CyclicSimulator(context, "first-come")
        self.known, self.pace = 0, 0.0
        self.result = advance(self._simulator, Deadline.after(0))
        left = problem.deadline.measure_seconds_left() or 0.0
        most, look = params.most_share * left, params.most_share * left / params.looks
        if rule != "first-come":
            self._run_laps(params.laps_dispersing, look, most)
            if self.result.ends == "open":
                self._simulator.set_rule(rule)
        before, tried = self.known, params.least_share * left
        self.advance(tried)
        tried += self._run_laps(params.laps_tried, look, most - tried, since=before)
        self.pace = (self.known - before) / tried if tried else 0.0

    def _run_laps(self, laps: float, look: float, most: float, *, since: int = 0) -> float:
        """Continue until ``laps`` longest laps after a tick; return the time taken [s]."""
        until, seconds = since + laps * self.result.context.longest, 0.0
        while self.result.ends == "open" and self.known < until and seconds < most:
            self.advance(look)
            seconds += look
        return seconds

    def advance(self, seconds: float) -> None:
        """Continue for some seconds if the end is open."""
        self._value: Fraction | None = None
        if self.result.ends == "open" and seconds > 0:
            before = self.known
            self.result = advance(self._simulator, Deadline.after(seconds))
            self.known = max(past[-1] for past in self.result.history)
            self.pace = (self.known - before) / seconds

    @property
    def value(self) -> Fraction:
        """The value of laps per tick; 0 if a robot makes no lap, or an unfair number."""
        if self._value is None:
            self._value, problem, result = Fraction(0), self._problem, self.result
            means = result.compute_mean_laps() if result.ends != "deadlock" else (None,)
            if None not in means:
                rows = zip(problem.alone, means, strict=True)
                if min(alone / mean for alone, mean in rows if mean) >= problem.least_fairness:
                    self._value = result.compute_rate(problem.weights)
        return self._value


def choose_runs(
    problem: CyclicProblem, baseline: SimulatedRun, params: RunChoiceParams = DEFAULT
) -> list[GroupResult]:
    """Return simulations to extract a timetable from, with the most promising one continued.

    Precondition: the last lap in each robot's ``ways`` is its direct lap.
    """
    context, deadline = problem.context, problem.deadline
    ways = zip(context.routes, problem.ways, strict=True)
    direct = GroupContext(
        scenario=context.scenario,
        routes=tuple(replace(route, lap=own[-1]) for route, own in ways),
    )
    rest = iter(((direct, "least-loss"), (direct, "first-come"), (context, "least-loss")))
    tried, enough = [baseline], params.good * baseline.value
    loss = params.seam * float(problem.compute_worth([1] * len(problem)))
    reserve = (1 - params.continuing_share) * (deadline.measure_seconds_left() or 0)

    def is_over() -> bool:
        """Return whether only the time for a closing is left."""
        return (deadline.measure_seconds_left() or 0) <= reserve

    def best() -> SimulatedRun:
        """Return the run with the largest estimated value after continuing and closing."""
        seconds = max((deadline.measure_seconds_left() or 0) - reserve, 0)
        return max(
            tried,
            key=lambda run: float(run.value) - loss / max(run.known + run.pace * seconds, 1),
        )

    for left in range(params.slices, 0, -1):
        run = best()
        if is_over():
            break
        while run.value <= enough and not is_over() and (another := next(rest, None)):
            tried.append(SimulatedRun(problem, *another, params))
            run = best()
        run.advance(max((deadline.measure_seconds_left() or 0) - reserve, 0) / left)
    return [run.result for run in tried if all(run.result.count_laps())]


def extract_cycle(
    problem: CyclicProblem, runs: Sequence[GroupResult], params: RunChoiceParams = DEFAULT
) -> Candidate | None:
    """Return the timetable of a long stretch of a run; None without a fair closing.

    A closing ends at the deadline: the best runs end early enough for one of them.
    """
    candidates: list[tuple[float, Stretch, int]] = []
    for number, run in enumerate(runs):
        some = find_stretches(problem, run)[: params.stretches_each]
        candidates += [(value, stretch, number) for value, stretch in some]
    candidates.sort(key=lambda candidate: candidate[:2], reverse=True)
    for _, stretch, number in candidates[: params.most_stretches]:
        if problem.is_out_of_time:
            break
        closed = close_stretch(problem, runs[number], stretch)
        if closed is not None and problem.accepts(closed):
            return closed
    return None
