"""Whether a control stays as small as it is: memory, journal and states in a day of laps.

Simulated robots repeat their laps in one process, as in a demo, and the journal is on the disk. The
time is that of the robots; nobody waits for it.
"""

from __future__ import annotations

import argparse
import math
import sys
import tempfile
import time
from fractions import Fraction
from pathlib import Path

from rightofway.control import demo
from rightofway.control.endpoints import Letter
from rightofway.control.journal import BatchedJournal, SqliteJournal
from tests.builders.warehouses import warehouse


def resident() -> float:
    """Return the memory of this process [MB]."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * 4096 / 1e6


def main() -> None:
    """Print a line for each hour of robot time."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=20)
    parser.add_argument("--hours", type=float, default=24)
    parser.add_argument("--every", type=float, default=1, help="hours between two lines")
    parser.add_argument("--seconds", type=float, default=math.inf, help="end then")
    given = parser.parse_args()
    plan = warehouse(given.robots)
    clock, largest, due = plan.scenario.problem.clock, 0, 0.0
    began, ends = time.process_time(), time.monotonic() + given.seconds
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "plan.journal"
        journal = BatchedJournal(SqliteJournal(path))
        setattr(demo, "NothingKept", lambda: journal)  # noqa: B010 (the demo keeps none)

        def watch(letter: Letter) -> None:
            nonlocal largest
            largest = max(largest, len(letter.payload))

        def take_down(tick: Fraction) -> None:
            nonlocal largest, due
            journal.flush()
            hours = float(clock.tick * tick) / 3600
            is_over = hours >= given.hours or time.monotonic() > ends
            if hours < due and not is_over:
                return
            kilobytes = sum(file.stat().st_size for file in Path(name).iterdir()) / 1e3
            cpu = time.process_time() - began
            line = f"{hours:5.2f} h  {resident():6.1f} MB  journal {kilobytes:7.0f} kB"
            sys.stdout.write(f"{line}  largest message {largest} bytes  {cpu:.0f} s of CPU\n")
            sys.stdout.flush()
            largest, due = 0, due + given.every
            if is_over:
                raise KeyboardInterrupt

        result = demo.drive_demo(plan, laps=0, wait_until=take_down, watch=watch)
    sys.stdout.write(f"{sum(result.laps)} laps, {sum(result.jobs)} jobs\n")


if __name__ == "__main__":
    main()
