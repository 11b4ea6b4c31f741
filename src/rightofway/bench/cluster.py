"""Cases on a cluster, through Dask: one case is one task; if its worker dies, another has it."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from textwrap import shorten
from typing import Any

from rightofway.bench.process import make_lost_row, run_on_worker
from rightofway.bench.results import Row
from rightofway.bench.suite import Case
from rightofway.errors import InputError
from rightofway.extras import load_library

PATIENCE = 30
"""Time limit for the answer of a scheduler [s]."""

LONGEST = 200
"""Characters of a worker's error that a message shows."""

IN_FLIGHT = 2
"""Tasks that the scheduler has at a time for each thread of its workers, so that none is idle."""


def run_on_cluster(
    cases: Iterable[Case], address: str, *, report: Callable[[str], None] = lambda _: None
) -> Iterator[Row]:
    """Yield the row of each case, in the order in which they end.

    Parameters
    ----------
    cases
        The cases to run.
    address
        Of the scheduler: ``tcp://host:8786``. Its workers need this package, of this version.
    report
        Called with a sentence if the cluster has no workers yet.

    Raises
    ------
    InputError
        If no scheduler answers there, or it goes away. The rows that came are good.

    Notes
    -----
    If a worker dies, the scheduler gives its cases, and results it held, to another worker; a case
    whose workers die four times is a row with this reason.
    """
    distributed = load_library("distributed", "a cluster")
    try:
        client = distributed.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        message = f"no scheduler answers: {reason} (start one with: dask scheduler)"
        raise InputError.at("", message, address) from None
    try:
        if not client.nthreads():
            report(f"{address} has no workers yet; waiting for some")
        yield from _yield_rows(distributed, client, iter(cases))
    except InputError as error:
        raise InputError(error.faults, address) from None
    except Exception as error:
        is_cut_off = isinstance(error, OSError)  # the client may not have noticed yet
        if client.status == "running" and not is_cut_off:
            raise
        message = "the scheduler went away (run the same command again to go on)"
        raise InputError.at("", message, address) from None
    finally:
        client.close(timeout=PATIENCE)


def _yield_rows(distributed: Any, client: Any, cases: Iterator[Case]) -> Iterator[Row]:
    run, waiting = uuid.uuid4().hex, dict[Any, Case]()

    def submit(case: Case) -> Any:
        future = client.submit(run_on_worker, case, key=f"rightofway-{run}-{case.key}", pure=False)
        waiting[future] = case
        return future

    def room() -> int:
        threads: int = sum(client.nthreads().values())
        return max(0 if waiting else 1, IN_FLIGHT * threads - len(waiting))

    done = distributed.as_completed(
        [submit(case) for case in islice(cases, room())], loop=client.loop
    )
    for future in done:
        case = waiting.pop(future)
        try:
            row: Row = future.result()
        except distributed.KilledWorker:
            row = make_lost_row(case, "each worker that tried it died, perhaps for its memory")
        except Exception as error:
            if future.status != "error":
                raise
            reason = shorten(f"{type(error).__name__}: {error}", LONGEST, placeholder=" …")
            message = (
                f"a worker cannot run cases: {reason} (install this rightofway on all workers)"
            )
            raise InputError.at("", message) from None
        yield row
        done.update([submit(case) for case in islice(cases, room())])
