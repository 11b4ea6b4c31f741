"""Settings of a simulated shift, in the units of its scenario."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from rightofway.dispatch.known import plan_arrivals
from rightofway.dispatch.record import ShiftRecord
from rightofway.dispatch.reveal import Reveal
from rightofway.dispatch.shift import ShiftRules, run_shift
from rightofway.execution.delays import delay_model_of, read_delays
from rightofway.facts import Fact
from rightofway.model import Scenario

__all__ = ["ShiftSettings"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ShiftSettings:
    """The settings of a simulated shift, as users write them.

    Attributes
    ----------
    until
        When the shift ends [time unit]; None: when all jobs are done.
    reveal
        Number of the first unfinished jobs that are known; None: jobs become known by time.
    known
        When jobs become known, as `plan_arrivals` reads it; None: at their `earliest`.
    delays
        Causes of delay, as `read_delays` reads them.
    round_time
        Time limit of the planning of a round [s], positive.
    lead
        How long robots drive while a round is planned [time unit]; None: as long as the round may
        take, where a time unit that is not known counts as a second.
    seed
        For all that is drawn.
    """

    until: Fraction | None = None
    reveal: int | None = None
    known: str | None = None
    delays: tuple[str, ...] = ()
    round_time: float = 1.0
    lead: Fraction | None = None
    seed: int = 0

    def simulate(
        self, scenario: Scenario, *, report: Callable[[Fact], None] = lambda _: None
    ) -> ShiftRecord:
        """Return the record of a shift.

        Parameters
        ----------
        scenario
            A scenario with jobs.
        report
            Takes a fact on the progress after each round.

        Raises
        ------
        InputError
            If `known` or `delays` cannot be read.
        """
        causes = read_delays(self.delays, scenario)
        opened, times = scenario, None
        if self.known is not None:
            opened, times = plan_arrivals(self.known, scenario, self.seed)
        reveal = Reveal(opened.jobs or (), opened.problem.clock, known=times, first=self.reveal)
        return run_shift(
            opened,
            reveal,
            self._make_rules(opened),
            delays=delay_model_of(causes, opened) if causes else None,
            report=report,
        )

    def _make_rules(self, scenario: Scenario) -> ShiftRules:
        clock = scenario.problem.clock
        lead = self.lead
        if lead is None:
            lead = Fraction(str(self.round_time)) / (scenario.units.seconds or Fraction(1))
        return ShiftRules(
            until=None if self.until is None else clock.count_ticks(self.until),
            step=clock.count_ticks(max(Fraction(1), self.lead or Fraction(0))),
            lead=clock.count_ticks(lead),
            time_limit=self.round_time,
            seed=self.seed,
        )
