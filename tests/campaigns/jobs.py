"""Jobs that arrive, change and are withdrawn in chaos, for as many seeds as are wanted.

``python -m tests.campaigns.jobs 0 100`` makes a hundred runs of each kind.
"""

from __future__ import annotations

import sys
from collections import Counter

from tests.builders.chaos_jobs import JOB_KINDS, run_job_chaos

__all__ = ["run_all"]


def run_all(first: int, last: int) -> Counter[str]:
    """Run the seeds of a range in each kind of chaos; return what happened.

    Raises
    ------
    Exception
        Of the first run with a fault, with a note that names it.
    """
    counts = Counter[str]()
    for seed in range(first, last):
        for kind, chaos in JOB_KINDS.items():
            try:
                counts += run_job_chaos(seed, chaos)
            except Exception as error:
                error.add_note(f"in chaos {kind!r}, seed {seed}")
                raise
            counts["runs"] += 1
    return counts


if __name__ == "__main__":
    print(dict(run_all(int(sys.argv[1]), int(sys.argv[2]))))  # noqa: T201
