"""Chaos over a real broker: the real processes, killed at random; an observer of what is sent.

Each run is a plan of some robots with trouble of their own. Its control is killed and started again
on its journal, its broker is killed, until all robots are home. A fault is a place that two robots
hold, an order with two contents, a message that is not valid, a job lost or done twice, or a run
that does not end.

With ``--jobs`` jobs become known, change and are withdrawn meanwhile, and each stop is counted.
"""

from __future__ import annotations

import argparse
import math
import random
import sys
import tempfile
import time
import traceback
from collections import Counter
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from itertools import count
from pathlib import Path
from random import SystemRandom

import rightofway
from rightofway.control.commands import Commands
from rightofway.io import parse_scenario, write_plan
from tests.builders.brokers import Command, Mosquitto, WarmCommand, wait_for
from tests.builders.floor_jobs import count_finished, floor_document, read_pool
from tests.builders.observers import Observer
from tests.builders.warehouses import warehouse

__all__ = ["run_chaos_at_a_broker", "run_jobs_at_a_broker"]

TROUBLES = {"late": 0.5, "stop": 0.05, "error": 0.05, "offline": 0.05, "reset": 0.05}
"""The largest share of each kind of trouble."""

LONGEST = 600.0
"""Seconds after which a run counts as stuck."""

BEHIND = 60.0
"""Seconds that the observer may be behind, on a machine with much else to do."""

KILLS = 12
"""Kills of a run, at most: afterwards it has to come to its end."""


def run_chaos_at_a_broker(seed: int, robots: int | None = None) -> Counter[str]:
    """Make one run; return what happened.

    Raises
    ------
    AssertionError
        At a fault.
    """
    draw = random.Random(seed)  # noqa: S311
    robots = robots or draw.randint(3, 8)
    plan = warehouse(robots, seed=draw.getrandbits(30))
    options = ["--broker", "", "--seed", str(seed), "--time-scale", str(draw.choice([20, 50]))]
    for kind, most in TROUBLES.items():
        options += ["--trouble", f"{kind}:{draw.uniform(0, most):.3f}"]
    counts = Counter({"runs": 1, "robots": robots})
    with tempfile.TemporaryDirectory(prefix="rightofway-chaos-") as name:
        folder = Path(name)
        write_plan(plan, folder / "plan.json")
        broker = Mosquitto(folder)
        options[1] = broker.url
        observer = Observer(broker.port)
        own = ("plan.json", *options, "--write-identities", "robots.yaml")
        try:
            with Command(folder, "robots", *own).running():
                wait_for((folder / "robots.yaml").exists, LONGEST, "the file of identities")
                asked = ("--broker", broker.url, "--identities", "robots.yaml")
                with WarmCommand(folder, "drive", "plan.json", *asked).running() as drive:
                    _kill(drive, broker, observer, draw, counts)
                    assert drive.wait(LONGEST) == 0, drive.log[-3000:]
                assert "is faulty" not in drive.log, drive.log[-3000:]
                # What was finished while the observer was away, it has not seen: control has.
                wanted = {f"robot{number}" for number in range(robots)}

                def list_missed() -> set[str]:
                    return wanted - {robot for robot, _ in observer.finished}

                if not counts["broker kills"]:
                    wait_for(lambda: not list_missed(), BEHIND, "the observer to hear of all jobs")
            missed = list_missed()
            assert len(observer.finished) == robots - len(missed), "a job was done twice"
            counts.update({f"{key}s": value for key, value in observer.counts.items()})
            observer.close()
        finally:
            broker.kill()
    return counts


def run_jobs_at_a_broker(seed: int) -> Counter[str]:
    """Make one run in which people ask for jobs; return what happened.

    Raises
    ------
    AssertionError
        At a fault.
    """
    draw = random.Random(seed)  # noqa: S311
    options = ["--seed", str(seed), "--time-scale", str(draw.choice([5, 10, 20]))]
    for kind in ("late", "offline", "reset"):
        options += ["--trouble", f"{kind}:{draw.uniform(0, TROUBLES[kind]):.3f}"]
    counts = Counter({"runs": 1})
    with tempfile.TemporaryDirectory(prefix="rightofway-chaos-") as name:
        folder, broker = Path(name), Mosquitto(Path(name))
        document = floor_document()
        del document["batteries"]["small"]["on"]  # else robots that wait for a kill run empty
        write_plan(rightofway.solve(parse_scenario(document), "prioritized"), folder / "plan.json")
        observer = Observer(broker.port)
        own = ("plan.json", "--broker", broker.url, *options, "--write-identities", "robots.yaml")
        asked = ("--broker", broker.url, "--identities", "robots.yaml", "--stay")
        journal = folder / "plan.journal"
        try:
            with Command(folder, "robots", *own).running():
                wait_for((folder / "robots.yaml").exists, LONGEST, "the file of identities")
                with WarmCommand(folder, "drive", "plan.json", *asked).running() as drive:
                    wait_for(lambda: "sets out" in drive.log, LONGEST, "robots")
                    names = _ask_for_jobs(
                        drive, broker, observer, journal, draw=draw, counts=counts
                    )
                    try:
                        wait_for(lambda: read_pool(journal).keys() >= names, LONGEST, "all jobs")
                    except AssertionError as error:
                        error.add_note(f"{names - read_pool(journal).keys()}: {drive.log[-3000:]}")
                        raise
            _judge_jobs(journal, counts)
            counts.update({f"{key}s": value for key, value in observer.counts.items()})
            observer.close()
        finally:
            broker.kill()
    return counts


def _ask_for_jobs(
    drive: Command,
    broker: Mosquitto,
    observer: Observer,
    journal: Path,
    *,
    draw: random.Random,
    counts: Counter[str],
) -> set[str]:
    """Add, change and withdraw jobs, and kill control and broker; return the names of all jobs."""
    names, commands = {"J1", "J2", "J3"}, Commands(journal)
    places = ["N0", "N2", "N3", "N5", "N7", "N10", "N12", "N13"]
    for number in range(draw.randrange(4, 20)):
        kind = draw.choice(["add", "add", "add", "change", "withdraw", "kill", "broker", "wait"])
        name = draw.choice(sorted(names))
        if kind == "add":
            name = f"A{number}" if draw.random() < 0.8 else name  # else it is asked for again
            given = {"pickup": draw.choice(places), "dropoff": draw.choice(places)}
            commands.ask({"kind": kind, "name": name, **given, "urgent": draw.random() < 0.2})
            names.add(name)
        elif kind in {"change", "withdraw"}:
            commands.ask({"kind": kind, "name": name, "at": draw.choice(places)})
        elif kind == "kill":
            drive.kill()
            drive.start()
        elif kind == "broker" and draw.random() < 0.3:
            broker.kill()
            broker.start()
        counts[f"{kind}s"] += 1
        _wait_for_states(drive, observer, draw.randrange(1, 30))
    commands.close()
    return names


def _judge_jobs(journal: Path, counts: Counter[str]) -> None:
    """Raise where a stop was done twice, or in the wrong order, or a withdrawn job was done."""
    finished, left = count_finished(journal), read_pool(journal)
    stops: dict[str, list[int]] = {}
    for item, times in finished.items():
        assert times == 1, f"{item} was done {times} times"
        name, _, stop = item.rpartition("/")
        stops.setdefault(name, []).append(int(stop))
    for name, numbers in stops.items():
        assert numbers == sorted(numbers), f"stops of {name} were done in the order {numbers}"
        assert left[name] == "done", f"{name} has left as {left[name]}, with stops {numbers}"
    counts.update(f"jobs {state}" for state in left.values())


def _kill(
    drive: Command, broker: Mosquitto, observer: Observer, draw: random.Random, counts: Counter[str]
) -> None:
    """Kill control and broker, each time after some states."""
    for _ in range(draw.randrange(KILLS + 1)):
        _wait_for_states(drive, observer, draw.randrange(1, 80))
        if drive.code is not None:
            return
        if draw.random() < 0.25:
            broker.kill()
            broker.start()
            counts["broker kills"] += 1
        else:
            drive.kill()
            drive.start()
            counts["control kills"] += 1


def _wait_for_states(drive: Command, observer: Observer, count: int) -> None:
    """Wait for some more states, or for the end of the control."""
    due = observer.counts["state"] + count
    wait_for(lambda: observer.counts["state"] >= due or drive.code is not None, LONGEST, "states")


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def main() -> int:
    """Make runs; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.campaigns.broker", description=__doc__)
    parser.add_argument("count", type=int, help="runs to make; 0 for no end")
    parser.add_argument("--seed", type=int, default=SystemRandom().randrange(10**9))
    parser.add_argument("--at-once", type=int, default=6, help="runs beside each other")
    parser.add_argument("--jobs", action="store_true", help="ask for jobs meanwhile")
    parser.add_argument("--seconds", type=float, default=math.inf, help="begin no run after them")
    given = parser.parse_args()
    _say(f"chaos-broker {given.count} --seed {given.seed}")
    run = run_jobs_at_a_broker if given.jobs else run_chaos_at_a_broker
    began, total, faults = time.perf_counter(), Counter[str](), 0
    seeds = iter(range(given.seed, given.seed + given.count) if given.count else count(given.seed))
    with ThreadPoolExecutor(given.at_once) as pool:
        running: dict[Future[Counter[str]], int] = {}
        while True:
            while (
                len(running) < given.at_once
                and time.perf_counter() - began < given.seconds
                and (seed := next(seeds, None)) is not None
            ):
                running[pool.submit(run, seed)] = seed
            if not running:
                break
            for ended in wait(running, return_when=FIRST_COMPLETED).done:
                seed = running.pop(ended)
                if error := ended.exception():
                    faults += 1
                    _say(f"--seed {seed}: {''.join(traceback.format_exception(error))}")
                else:
                    total += ended.result()
                _say(f"… {total['runs']} runs without a fault, {faults} with one, after {seed}")
    seconds = time.perf_counter() - began
    _say(", ".join(f"{total[name]} {name}" for name in sorted(total)))
    _say(f"chaos-broker: {total['runs'] + faults} runs, {faults} faults, {seconds:.0f} s")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
