"""The rule of release in chaos: no fault in the rule, and each broken wording of it is found."""

from __future__ import annotations

import pytest

from tests.builders.broken_wordings import RARE, WORDINGS
from tests.builders.chaos import KINDS, chaotic_plan, run_chaos

SEEDS = 5
"""Of each kind; `just chaos` makes as many runs as are wanted."""


@pytest.mark.parametrize("kind", KINDS)
def test_robots_hold_nothing_together_and_do_each_job_once(kind: str) -> None:
    for seed in range(SEEDS):
        run_chaos(chaotic_plan(seed, kind), seed, KINDS[kind])


def test_chaos_does_what_it_says() -> None:
    """Kills, plans of the rest, lost orders, wrong fields and withdrawals all take place."""
    counts = run_chaos(chaotic_plan(3), 3, KINDS["all"])
    for what in ("kills", "splices", "resets", "wrong fields", "cancels"):
        assert counts[what] > 0, what


@pytest.mark.parametrize("wording", WORDINGS)
def test_a_broken_wording_is_found(wording: str) -> None:
    """Within forty seeds the observer, the journal or the control itself stops a run."""
    control, kind = WORDINGS[wording]
    first = RARE.get(wording, 0)
    for seed in range(first, first + 40):
        try:
            run_chaos(chaotic_plan(seed, kind), seed, KINDS[kind], control)
        except Exception:  # noqa: BLE001 (some wordings end in a contradiction within control)
            return
    pytest.fail(f"nobody noticed: {control.__doc__}")
