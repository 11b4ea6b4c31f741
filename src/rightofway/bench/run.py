"""One case in this process, which is made for it: ``python -m rightofway.bench.run``.

The case comes as a pickle on standard input, its outcome goes as JSON to standard output. When
the process that waits for the outcome closes standard input, this process ends.
"""

from __future__ import annotations

import json
import os
import pickle
import sys
import threading
import time
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.bench.shifts import SHIFT, make_settings, run_shift_case
from rightofway.bench.suite import LAPS, Case
from rightofway.check import check
from rightofway.errors import GaveUp, InputError, InvalidPlan, NoPlanExists
from rightofway.metrics import measure
from rightofway.model import Plan, Scenario
from rightofway.planners import find
from rightofway.solve import solve

if TYPE_CHECKING:
    from rightofway.cyclic import GroupResult

ENDINGS: dict[type[BaseException], str] = {
    NoPlanExists: "no plan exists",
    GaveUp: "gave up",
    InvalidPlan: "invalid plan",
    InputError: "bad input",
    MemoryError: "out of memory",
}
"""Every other exception is a ``defect``."""


def run(case: Case) -> dict[str, Any]:
    """Plan a case, have the plan judged and measured; return a row's columns from ``solved`` on."""
    clock = _Clock()
    try:
        scenario = case.make_scenario()
        if case.planner == LAPS:
            clock = _Clock()
            return {**_run_laps(case, scenario), **clock.measure()}
        if case.planner == SHIFT:
            clock = _Clock()
            settings = make_settings(case.options, case.limit, case.seed)
            return {**run_shift_case(scenario, settings), **clock.measure()}
        find(case.planner).load()  # importing it is not planning
        clock = _Clock()
        plan = solve(
            scenario, case.planner,
            time_limit=float(case.limit), seed=case.seed, options=case.options,
        )  # fmt: skip
        spent = clock.measure()
        return {**_judge(plan), **spent}
    except Exception as error:  # noqa: BLE001 (a planner may raise anything, and the next case runs)
        status = next((name for kind, name in ENDINGS.items() if isinstance(error, kind)), "defect")
        words = f"{type(error).__name__}: {error}" if status == "defect" else str(error)
        valid = False if status == "invalid plan" else None
        return {**_make_end(status, words, valid=valid), **clock.measure()}


def _make_end(status: str, message: str, *, valid: bool | None) -> dict[str, Any]:
    return {"solved": status == "solved", "valid": valid, "status": status, "message": message}


def _judge(plan: Plan) -> dict[str, Any]:
    report = check(plan)
    if not report.ok:
        return _make_end("invalid plan", report.summary, valid=False)
    metrics, first = measure(plan), plan.run.first_plan_seconds
    levels = Counter(decision.level for decision in plan.run.decisions)
    figures = {"decisions": dict(levels), "rerouted": len(plan.run.reroutes)}
    return {
        **_make_end("solved", str(plan.run.status), valid=True),
        "flowtime": int(metrics.flowtime),
        "makespan": int(metrics.makespan),
        "lower_bound": int(metrics.flowtime_alone),
        "ratio": round(metrics.flowtime / alone, 6) if (alone := metrics.flowtime_alone) else None,
        "tick": str(plan.scenario.problem.clock.tick),
        "figures": json.dumps(figures),
        "first_plan_seconds": None if first is None else round(first, 6),
    }


def _run_laps(case: Case, scenario: Scenario) -> dict[str, Any]:
    """Let a fleet repeat its work; it is solved if the pattern of each group is known."""
    from rightofway.cyclic import TIMETABLE, find_best_timetable, run_laps

    limit = float(case.limit)
    if case.options["rule"] == TIMETABLE:
        result = find_best_timetable(scenario, time_limit=limit, seed=case.seed)
    else:
        result = run_laps(scenario, **case.options, time_limit=limit)
    groups = [_group(group) for group in result.groups]
    ends = Counter(group.ends for group in result.groups)
    status = "solved" if set(ends) == {"repeats"} else ", ".join(sorted(set(ends) - {"repeats"}))
    count = ", ".join(f"{number} {end}" for end, number in sorted(ends.items()))
    figures = {"throughput": float(result.compute_throughput()), "groups": groups}
    return {
        **_make_end(status, f"groups: {count}", valid=None),
        "tick": str(scenario.problem.clock.tick),
        "figures": json.dumps(figures),
    }


def _group(group: GroupResult) -> dict[str, Any]:
    """Return the figures of a group of robots; times in ticks."""
    alone = [lap.duration for lap in group.context.laps]
    means = group.compute_mean_laps()
    figures = {
        "robots": len(group.robots),
        "ends": group.ends,
        "longest_lap": group.context.longest,
        "starves": sum(mean is None for mean in means),
        "fairness": min(
            float(lap / mean) if mean else 0.0 for lap, mean in zip(alone, means, strict=True)
        ),
    }
    if group.pattern is None:
        return figures
    first, steady = (
        {(wait.vertex, wait.pair) for wait in waits}
        for waits in (group.list_first_waits(), group.waits())
    )
    shares = [float(share) for share in group.compute_waiting_shares() if share is not None]
    return figures | {
        "transient": group.pattern.transient,
        "period": group.pattern.period,
        "first_waits": len(first),
        "steady_waits": len(steady),
        "common_waits": len(first & steady),
        "waiting": sum(shares) / len(shares) if shares else None,
    }


class _Clock:
    """The time and memory that this process spends from now on."""

    def __init__(self) -> None:
        self._wall, self._cpu = time.perf_counter(), _measure_cpu_seconds()

    def measure(self) -> dict[str, float]:
        return {
            "wall_seconds": round(time.perf_counter() - self._wall, 6),
            "cpu_seconds": round(_measure_cpu_seconds() - self._cpu, 6),
            "peak_memory": round(_measure_peak_memory() / 1e6, 1),
        }


def _measure_cpu_seconds() -> float:
    """Return the CPU time of this process and of those it started and waited for [s]."""
    spent = os.times()
    return time.process_time() + spent.children_user + spent.children_system


def _measure_peak_memory() -> int:
    """Return the most memory that this process held [bytes].

    On Linux from ``/proc``: ``getrusage`` includes the process that started this one.
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
