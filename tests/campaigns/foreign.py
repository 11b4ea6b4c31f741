"""Laps of robots that others wrote, for a while of robot time, with kills of control and broker.

With ``--seconds`` there are rounds, each with the next seed, and none begins after them.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from itertools import count
from pathlib import Path

from tests.builders.foreign import drive_laps
from tests.builders.plans import door
from tests.builders.warehouses import warehouse


def main() -> None:
    """Make rounds, and print a line after each."""
    parser = argparse.ArgumentParser(prog="python -m tests.campaigns.foreign", description=__doc__)
    parser.add_argument("minutes", type=float, help="of robot time")
    parser.add_argument("--robots", type=int, default=2, help="2: the door; more: a warehouse")
    parser.add_argument("--kills", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=0, help="0: one round")
    given = parser.parse_args()
    plan = door() if given.robots == 2 else warehouse(given.robots)
    lap = float(plan.scenario.problem.clock.convert_to_time(max(plan.completions)))
    laps, began = max(round(given.minutes * 60 / lap), 1), time.perf_counter()
    for seed in count(given.seed):
        with tempfile.TemporaryDirectory(prefix="rightofway-foreign-") as name:
            finished = drive_laps(plan, laps, Path(name), kills=given.kills, seed=seed)
        seconds = time.perf_counter() - began
        line = f"{given.robots} robots, {laps} laps each, {given.kills} kills, seed {seed}"
        line = f"{line}: {len(finished)} jobs seen to be done, {seconds:.0f} s, no fault"
        sys.stdout.write(f"{line}\n")
        sys.stdout.flush()
        if seconds > given.seconds:
            return


if __name__ == "__main__":
    main()
