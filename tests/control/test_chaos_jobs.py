"""Jobs that arrive in chaos: each stop is done once, in order; nobody stands without a reason."""

from __future__ import annotations

from collections import Counter

import pytest

from rightofway.control import FleetControl
from tests.builders.chaos import Chaos
from tests.builders.chaos_jobs import JOB_KINDS, run_job_chaos

SEEDS = 3
"""Of each kind; `python -m tests.campaigns.jobs` makes as many runs as are wanted."""


@pytest.mark.parametrize("kind", JOB_KINDS)
def test_each_stop_is_done_once_and_a_job_that_nobody_does_has_a_reason(kind: str) -> None:
    for seed in range(SEEDS):
        run_job_chaos(seed, JOB_KINDS[kind])


@pytest.mark.parametrize(
    ("kind", "seed"),
    [
        ("arrive, all", 207),  # a robot was placed while a round was under way
        ("arrive, cancels", 219),  # a job had changed before a kill
        ("arrive, resets", 205),
        ("arrive, all", 730020),  # a robot was placed after a job had changed
        ("floor, all", 0),  # a kept part led into what is closed for good
        ("floor, all", 15),  # a robot was placed while another one was in a chain
        ("floor, all", 720001),  # an order was withdrawn in a chain
        ("arrive, joins", 52),  # rounds without routes followed each other without a report
        ("arrive, wrong fields", 326),  # a withdrawn stop came before one that was asked for
    ],
)
def test_runs_that_had_a_fault_have_none(kind: str, seed: int) -> None:
    run_job_chaos(seed, JOB_KINDS[kind])


def test_chaos_with_jobs_does_what_it_says() -> None:
    """Jobs arrive, change and are withdrawn; places close; the control is killed."""
    chaos = Chaos(kills=0.03, jobs=0.06, people=0.01)
    counts = sum((run_job_chaos(seed, chaos) for seed in range(3)), Counter[str]())
    for what in ("add", "change", "withdraw", "close", "kills", "rounds", "jobs done"):
        assert counts[what] > 0, what


class AnyWorkAtOnce(FleetControl):
    """Work begins when its robot is there: before its time, and after a stop that has failed."""

    def _may_begin(self, robot: int, item: str) -> bool:  # noqa: ARG002
        return True


class WorkDuringRounds(FleetControl):
    """Work begins while a round is under way that may give it to another robot."""

    def _may_begin(self, robot: int, item: str) -> bool:
        return self.may_begin(robot, item)


@pytest.mark.parametrize("wording", [AnyWorkAtOnce, WorkDuringRounds])
def test_a_broken_wording_of_rounds_is_found(wording: type[FleetControl]) -> None:
    """Within forty seeds the observer or the control itself stops a run."""
    for seed in range(40):
        try:
            run_job_chaos(seed, Chaos(kills=0.0, jobs=0.06, people=0.02), wording)
        except Exception:  # noqa: BLE001 (some wordings end in a contradiction within control)
            return
    pytest.fail(f"nobody noticed: {wording.__doc__}")
