"""Cases on the cores of this machine."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed

from rightofway.bench.cases import Case
from rightofway.bench.machine import cores, machine
from rightofway.bench.process import Processes
from rightofway.bench.rows import Row

__all__ = ["run_here"]


def run_here(cases: Iterable[Case], *, jobs: int | None = None) -> Iterator[Row]:
    """Yield the row of each case, in the order in which they end.

    Parameters
    ----------
    cases
        What to run.
    jobs
        How many at a time; as many as there are cores by default.

    Notes
    -----
    When the iteration is left early, running cases are ended and have no row.
    """
    machine()  # before any thread asks for it
    processes = Processes()
    pool = ThreadPoolExecutor(jobs or cores())
    try:
        for future in as_completed([pool.submit(processes.run, case) for case in cases]):
            yield future.result()
    finally:
        processes.end()
        pool.shutdown(cancel_futures=True)
