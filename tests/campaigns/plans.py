"""Campaigns: plans judged, delayed runs, or chaos, so many on random fleets and on all cores.

They hold the laws of ``tests/laws`` on more cases than a test can have. What is found is written
to ``build/campaigns``, one plan file for each finding, and the exit code is 1.
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import os
import random
import sys
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from random import SystemRandom

from hypothesis import HealthCheck, Phase, given, seed, settings

import rightofway
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.io import format_plan, format_scenario
from rightofway.metrics import derive_outcome
from rightofway.model import Objective, Plan, Scenario, Tick
from rightofway.precedence import ReleaseGraph
from rightofway.repair.bounds import prove_bound
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import ALL, QUICK, STRICT, broken, by_both_judges, knows
from tests.builders.chaos import KINDS, Fault, run_chaos
from tests.builders.chaos import knows as can_be_driven
from tests.builders.executions import any_delays, wrong_in

FLEETS = {"judge": 20, "delay": 20, "chaos": 10, "bound": 20}
"""Fleets of a round, which takes at most a minute; each round has a seed of its own."""

BROKEN = 20
"""Broken plans made of a plan without fault."""

SHARE = 0.5
"""Of the broken plans, those that the second judge sees, too; it sees all others."""

RUNS = (500, 3, 2)
"""Runs of a plan and its delays: as planned, with switching, with replanning."""

SLOW = 60
"""Seconds that planning must not take, half of it of the processor: it takes some ms."""

FOUND = Path("build/campaigns")


class Round:
    """The counts of a round, and its findings as (what, file ending, text)."""

    def __init__(self) -> None:
        self.counts = Counter[str]()
        self.findings: list[tuple[str, str, str]] = []

    def find(self, what: str, of: Plan | Scenario) -> None:
        """Add a finding."""
        is_plan = isinstance(of, Plan)
        text = format_plan(of) if isinstance(of, Plan) else format_scenario(of)
        self.findings.append((what, "plan.json" if is_plan else "yaml", text))

    @contextmanager
    def unless_it_fails(self, scenario: Scenario) -> Iterator[None]:
        """Make a finding of an exception that the package does not raise on purpose."""
        try:
            yield
        except Exception:  # noqa: BLE001 (whatever it is, it is a finding)
            self.find(traceback.format_exc(), scenario)

    def plan(self, scenario: Scenario, planner: str, seed: int, **options: str) -> Plan | None:
        """Return a plan, None where there is none; count it."""
        began = time.process_time()
        try:
            found: Plan | None = rightofway.solve(
                scenario,
                planner,
                time_limit=SLOW,
                seed=seed,
                options={**QUICK.get(planner, {}), **options},
            )
            self.counts[f"plans of {planner}"] += 1
        except NoPlanExists:
            self.counts["no plan exists"] += 1
            raise
        except GaveUp:
            self.counts["gave up"] += 1
            found = None
        if time.process_time() - began > SLOW / 2:
            self.find(f"{planner} took more than {SLOW / 2} s", scenario)
        return found


def judge(scenario: Scenario, chance: int, into: Round) -> None:
    """Judge plans of all planners, and broken ones made of them, by both judges."""
    draw, ends = random.Random(chance), set()  # noqa: S311
    for planner in ALL:
        if not knows(planner, scenario):
            continue
        with into.unless_it_fails(scenario):
            try:
                plan = into.plan(scenario, planner, chance)
            except NoPlanExists:
                ends.add("none exists")
                continue
            if plan is None:
                continue
            if planner in STRICT:
                ends.add("a plan")
                _judge_good(plan, into)
                if plan.flowtime < plan.lower_bound:
                    into.find(f"{planner}: flowtime {plan.flowtime} < {plan.lower_bound}", plan)
            else:
                _judge_broken(plan, into, by_both=True)
            for _ in range(BROKEN):
                _judge_broken(broken(plan, draw), into, by_both=draw.random() < SHARE)
    if len(ends) > 1:
        into.find("one planner proves that there is no plan, another one has a plan", scenario)


def _judge_good(plan: Plan, into: Round) -> None:
    into.counts.update(["judged", "judged by both"])
    found = by_both_judges(plan)
    if any(found):
        into.find(f"{plan.run.name}: check: {found[0]}; second judge: {found[1]}", plan)


def _judge_broken(plan: Plan, into: Round, *, by_both: bool) -> None:
    into.counts.update(["judged", "broken"])
    if not by_both:
        into.counts["with faults"] += not rightofway.check(plan).ok
        return
    into.counts["judged by both"] += 1
    by_check, by_the_other = by_both_judges(plan)
    into.counts["with faults"] += bool(by_check)
    into.counts.update(f"found by both: {kind}" for kind, _ in by_check & by_the_other)
    if by_check != by_the_other:
        into.counts["disagreements"] += 1
        into.find(f"check: {sorted(by_check)}; second judge: {sorted(by_the_other)}", plan)


PROVERS: list[tuple[str, dict[str, str]]] = [
    *((planner, {}) for planner in STRICT),
    ("cbs", {"objective": "makespan"}),
]
"""Planners and options whose plans have a proven bound."""


def bound(scenario: Scenario, chance: int, into: Round) -> None:
    """Compare plans of all planners with all that is proven of the fleet, by few steps or many."""
    steps = random.Random(chance).choice([1, 10, 100])  # noqa: S311
    plans: list[Plan] = []
    proofs: list[tuple[str, Tick, Objective]] = []
    impossible = []
    for planner, options in PROVERS:
        is_refused = "objective" in options and scenario.roadmap.has_surcharges
        if is_refused or not knows(planner, scenario):
            continue
        with into.unless_it_fails(scenario):
            try:
                plan = into.plan(scenario, planner, chance, **options)
            except NoPlanExists:
                impossible.append(planner)
                continue
            if plan is not None:
                outcome = derive_outcome(plan)
                plans.append(plan)
                proofs.append((planner, outcome.bound or Tick(0), outcome.objective))
    with into.unless_it_fails(scenario):
        try:
            proof, _ = prove_bound(scenario, nodes=steps, steps=steps)
            proofs.append(("bound", proof.bound, proof.objective))
        except NoPlanExists:
            impossible.append("bound")
    into.counts.update({"bounds": len(proofs), "judged": len(plans)})
    for plan in plans:
        if impossible:
            into.find(f"{impossible} prove that there is no plan", plan)
        _compare(plan, proofs, into)


def _compare(plan: Plan, proofs: list[tuple[str, Tick, Objective]], into: Round) -> None:
    for prover, least, objective in proofs:
        cost = objective.compute_cost(plan.scenario, plan.tracks)
        into.counts["comparisons"] += 1
        if cost < least:
            into.counts["above a plan"] += 1
            into.find(f"{prover} proves {least}, but {plan.run.name} has {cost}", plan)


def delay(scenario: Scenario, chance: int, into: Round) -> None:
    """Run a plan with delays, also with switching and replanning; judge traces of it."""
    draw = random.Random(chance)  # noqa: S311
    planner = draw.choice([name for name in STRICT if knows(name, scenario)])
    with into.unless_it_fails(scenario):
        try:
            plan = into.plan(scenario, planner, chance)
        except NoPlanExists:
            return
        if plan is None:
            return
        for delays in (any_delays(draw, scenario) for _ in range(3)):
            _run(plan, delays, chance, into)


def _run(plan: Plan, delays: str, chance: int, into: Round) -> None:
    for how, runs in zip(("as planned", "switching", "replanning"), RUNS, strict=True):
        is_changed = how != "as planned"
        if is_changed and plan.scenario.closures:
            continue  # refused: replanning does not know closures
        outcome = rightofway.simulate(
            plan, delays, runs, chance, switch=is_changed, replan=how == "replanning"
        )
        traces = range(1)
        into.counts.update({"judged": runs, f"runs {how}": runs, "traces judged": len(traces)})
        into.counts["collisions"] += outcome.collisions
        into.counts["deadlocks"] += outcome.deadlocks
        for wrong in wrong_in(outcome, traces):
            into.find(f"{delays}, seed {chance}, {how}: {wrong}", plan)


def chaos(scenario: Scenario, chance: int, into: Round) -> None:
    """Drive a plan on simulated robots through each kind of chaos."""
    draw = random.Random(chance)  # noqa: S311
    planner = draw.choice([name for name in STRICT if knows(name, scenario)])
    with into.unless_it_fails(scenario):
        try:
            plan = into.plan(scenario, planner, chance)
        except NoPlanExists:
            return
        if plan is None or scenario.closures:
            return
        if ReleaseGraph.of(scenario, plan.tracks).find_rotation():
            into.counts["rotations, refused"] += 1
            return
        for kind, how in KINDS.items():
            if not can_be_driven(kind, plan):
                continue
            into.counts["judged"] += 1
            try:
                into.counts += run_chaos(plan, chance, how)
            except Fault as fault:
                into.counts["faults"] += 1
                into.find(f"{kind}, seed {chance}: {fault}", plan)


Case = Callable[[Scenario, int, Round], None]
CAMPAIGNS: dict[str, Case] = {"judge": judge, "delay": delay, "chaos": chaos, "bound": bound}


COUNTS = {
    "judge": ("disagreements",),
    "delay": ("collisions", "deadlocks"),
    "chaos": ("faults",),
    "bound": ("above a plan",),
}
"""What a campaign reports even where there is none."""


def one_round(campaign: str, session: int, most: int, number: int) -> tuple[int, Round]:
    """Return the number of a round, and what became of its cases, until ``most`` are judged."""
    into, draw = Round(), random.Random(f"{session} {number}")  # noqa: S311

    @seed(draw.getrandbits(64))
    @settings(
        max_examples=FLEETS[campaign],
        deadline=None,
        database=None,
        phases=(Phase.generate,),
        suppress_health_check=list(HealthCheck),
    )
    @given(any_fleet())
    def cases(scenario: Scenario) -> None:
        if into.counts["judged"] >= most:
            return
        into.counts["fleets"] += 1
        CAMPAIGNS[campaign](scenario, draw.getrandbits(32), into)

    cases()
    return number, into


def rounds_until(
    seconds: float, play: Callable[[int], tuple[int, Round]], numbers: Sequence[int]
) -> Iterator[tuple[int, Round]]:
    """Yield rounds of all cores as they end, until time is over; those under way then are lost."""
    ends = time.perf_counter() + seconds
    with multiprocessing.Pool() as pool:
        rounds = pool.imap_unordered(play, numbers)
        while (left := ends - time.perf_counter()) > 0:
            try:
                yield rounds.next(None if math.isinf(left) else left)
            except (StopIteration, multiprocessing.TimeoutError):
                return


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def main() -> int:
    """Run a campaign; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.campaigns.plans", description=__doc__)
    parser.add_argument("campaign", choices=CAMPAIGNS)
    parser.add_argument("count", type=int, help="plans to judge, or delayed runs to make")
    parser.add_argument("--seed", type=int, default=SystemRandom().randrange(10**9))
    parser.add_argument("--round", type=int, help="make only this round of the seed")
    parser.add_argument("--seconds", type=float, default=math.inf, help="end then, with all counts")
    given_ = parser.parse_args()
    began, found = time.perf_counter(), 0
    names = COUNTS[given_.campaign]
    total = Counter(dict.fromkeys(names, 0))
    share = math.ceil(given_.count / (os.cpu_count() or 1))  # of each core
    play = partial(one_round, given_.campaign, given_.seed, share)
    rounds = range(10**9) if given_.round is None else [given_.round]
    _say(f"{given_.campaign} {given_.count} --seed {given_.seed}")
    for number, made in rounds_until(given_.seconds, play, rounds):
        total += made.counts
        for what, ending, text in made.findings:
            found += 1
            FOUND.mkdir(parents=True, exist_ok=True)
            path = FOUND / f"{given_.campaign}-{given_.seed}-{number}-{found}.{ending}"
            path.write_text(text, encoding="utf-8")
            _say(f"{path}: round {number}: {what}")
        if total["judged"] >= given_.count:
            break
        _say(f"… {total['judged']} judged, {found} findings, after round {number}")
    seconds = time.perf_counter() - began
    _say(", ".join(f"{total[name]} {name}" for name in sorted(total)))
    _say(
        f"{given_.campaign}: {total['judged']} judged, {found} findings,"
        f" {seconds:.0f} s, {total['judged'] / seconds:.0f} a second, --seed {given_.seed}"
    )
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
