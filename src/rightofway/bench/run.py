"""One case in this process, which is made for it: ``python -m rightofway.bench.run``.

The case comes as a pickle on standard input, its outcome goes as JSON to standard output. Standard
input stays open for as long as somebody waits for the outcome; when it is closed, the process ends.
"""

from __future__ import annotations

import json
import math
import os
import pickle
import sys
import threading
import time
from pathlib import Path
from typing import Any

from rightofway.bench.cases import Case
from rightofway.check import check
from rightofway.errors import GaveUp, InputError, InvalidPlan, NoPlanExists
from rightofway.metrics import measure
from rightofway.model import Plan
from rightofway.planners import find
from rightofway.solve import solve

__all__ = ["main", "run"]

ENDINGS: dict[type[BaseException], str] = {
    NoPlanExists: "no plan exists",
    GaveUp: "gave up",
    InvalidPlan: "invalid plan",
    InputError: "bad input",
    MemoryError: "out of memory",
}
"""Every other exception is a ``defect``."""


def run(case: Case) -> dict[str, Any]:
    """Plan a case, have the plan judged and measured; whatever happens is an outcome.

    Returns
    -------
    dict
        Columns of a row, from ``solved`` to ``peak_memory``.
    """
    clock = _Clock()
    try:
        scenario = case.scenario()
        find(case.planner).load()  # importing it is not planning
        clock = _Clock()
        plan = solve(
            scenario, case.planner,
            time_limit=float(case.limit), seed=case.seed, options=case.options,
        )  # fmt: skip
        spent = clock.spent()
        return {**_judged(plan), **spent}
    except Exception as error:  # noqa: BLE001 (a planner may raise anything, and the next case runs)
        status = next((name for kind, name in ENDINGS.items() if isinstance(error, kind)), "defect")
        valid = False if status == "invalid plan" else None
        words = f"{type(error).__name__}: {error}" if status == "defect" else str(error)
        return {
            "solved": False, "valid": valid, "status": status, "message": words, **clock.spent(),
        }  # fmt: skip


def _judged(plan: Plan) -> dict[str, Any]:
    report = check(plan)
    if not report.ok:
        return {
            "solved": False, "valid": False, "status": "invalid plan", "message": report.summary,
        }  # fmt: skip
    metrics = measure(plan)
    return {
        "solved": True,
        "valid": True,
        "status": "solved",
        "message": plan.run.status,
        "flowtime": int(metrics.flowtime),
        "makespan": int(metrics.makespan),
        "lower_bound": int(metrics.lower_bound),
        "ratio": round(1 + metrics.gap, 6) if math.isfinite(metrics.gap) else None,
        "tick": str(plan.scenario.problem.clock.tick),
        "first_plan_seconds": _rounded(plan.run.first_plan_seconds),
    }


def _rounded(seconds: float | None) -> float | None:
    return None if seconds is None else round(seconds, 6)


class _Clock:
    """What this process spends from now on."""

    def __init__(self) -> None:
        self._wall, self._cpu = time.perf_counter(), _cpu_seconds()

    def spent(self) -> dict[str, float]:
        return {
            "wall_seconds": round(time.perf_counter() - self._wall, 6),
            "cpu_seconds": round(_cpu_seconds() - self._cpu, 6),
            "peak_memory": round(_peak_memory() / 1e6, 1),
        }


def _cpu_seconds() -> float:
    """Return the CPU time of this process and of those it started and waited for [s]."""
    spent = os.times()
    return time.process_time() + spent.children_user + spent.children_system


def _peak_memory() -> int:
    """Return the most memory that this process held [bytes].

    On Linux from the process itself: what ``getrusage`` tells includes the process that started it.
    """
    status = Path("/proc/self/status")
    if status.exists():
        lines = status.read_text(encoding="utf-8").splitlines()
        return 1024 * next(int(line.split()[1]) for line in lines if line.startswith("VmHWM:"))
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else 1024 * peak


def main() -> None:
    """Run the case of standard input."""
    source, result = sys.stdin.buffer, os.dup(1)
    os.dup2(2, 1)  # what planners print is no result
    case = pickle.load(source)  # noqa: S301 (from the process that started this one)
    threading.Thread(target=_end_when_nobody_waits, args=(source.fileno(),), daemon=True).start()
    outcome = json.dumps(run(case)).encode()
    os.write(result, outcome)


def _end_when_nobody_waits(source: int) -> None:
    while os.read(source, 1):
        pass
    os._exit(1)


if __name__ == "__main__":
    main()
