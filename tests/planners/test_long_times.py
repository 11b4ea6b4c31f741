"""Times of up to 2**39 ticks: planners need no more memory for them than for short ones."""

from __future__ import annotations

import subprocess
import sys

import pytest

PROGRAM = """
import resource, sys
resource.setrlimit(resource.RLIMIT_AS, (2**32, 2**32))
from rightofway import FleetBuilder, solve
from rightofway.planners.registry import PLANNERS

for time in (10**6, 10**9, 2**39):
    long = {sys.argv[1]: time}
    rules, own = (long, {}) if sys.argv[1] == "headway" else ({}, long)
    fleet = FleetBuilder(grid=["...", "@.@", "..."], **rules)
    fleet.add_robot("R1", home="N0", target="N6", **own).add_robot("R2", home="N2", target="N8")
    for spec in PLANNERS:
        if spec.name != "paper":
            print(spec.name, solve(fleet.build_scenario(), spec.name).flowtime - time)
"""


@pytest.mark.parametrize(
    ("what", "rest"),
    [
        ("headway", 26),  # the first robot leaves the door at 8, and needs 9 as the other one does
        ("work", 19),  # 9 for each robot, and 1 at the door
        ("turn", 18),  # the same, of which 1 is R1's turning in a cell's time
    ],
)
def test_long_times_are_planned_in_four_gigabytes(what: str, rest: int) -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, what],
        capture_output=True, text=True, check=False, timeout=300,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    flowtimes = [line.split() for line in done.stdout.splitlines()]
    assert len(flowtimes) == 3 * 10
    assert {more for name, more in flowtimes if name != "lacam"} == {str(rest)}
