"""Jobs that arrive, change and are withdrawn in chaos, for as many seeds as are wanted.

``python -m tests.campaigns.jobs 0 100`` makes a hundred runs of each kind. A run with a fault is
named with its traceback, the others go on, and the exit code is 1.
"""

from __future__ import annotations

import sys
import time
import traceback
from collections import Counter

from tests.builders.chaos_jobs import JOB_KINDS, run_job_chaos

__all__ = ["run_all"]


def run_all(first: int, last: int) -> tuple[Counter[str], int]:
    """Run the seeds of a range in each kind of chaos; count what happened, and faults."""
    counts, faults = Counter[str](), 0
    for seed in range(first, last):
        for kind, chaos in JOB_KINDS.items():
            counts["runs"] += 1
            try:
                counts += run_job_chaos(seed, chaos)
            except Exception:  # noqa: BLE001 (whatever it is, it is a fault)
                faults += 1
                _say(f"in chaos {kind!r}, seed {seed}: {traceback.format_exc()}")
        if (seed + 1 - first) % 10 == 0:
            _say(f"… {counts['runs']} runs, {faults} with a fault, before seed {seed + 1}")
    return counts, faults


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def main(first: int, last: int) -> int:
    """Make runs; return the exit code."""
    began = time.perf_counter()
    counts, faults = run_all(first, last)
    _say(", ".join(f"{counts[name]} {name}" for name in sorted(counts)))
    _say(f"chaos-jobs: {counts['runs']} runs, {faults} faults, {time.perf_counter() - began:.0f} s")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2])))
