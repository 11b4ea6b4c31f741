"""New plans of a rest that does not know what has begun."""

from __future__ import annotations

import rightofway
from rightofway.execution.monitor import ExecutionMonitor, ExecutionPolicy
from rightofway.io import parse_scenario
from rightofway.model import NEVER, Scenario, Tick
from rightofway.planners import Deadline
from rightofway.precedence import ActionDependencyGraph, DelayModel, Stoppage

AT = {"a": (5, 3), "b": (4, 4), "c": (0, 0), "d": (0, 3), "e": (6, 3), "f": (0, 1)}
AT |= {"g": (1, 1), "h": (1, 4), "i": (6, 1)}
LENGTHS = {"ab": "3/2", "ad": 5, "af": "11/2", "ai": "9/4", "bc": "23/4", "bg": "17/4"}
LENGTHS |= {"bi": "15/4", "ce": "27/4", "ef": "13/2", "eh": "21/4", "fi": 6, "gh": 3}


def lane_through_a_corner() -> Scenario:
    """R2 drives from f to i and back along the lane that passes g, which R3 with its radius needs.

    R1 leaves its home c only at 8, after the lane from there was closed; b is closed from 15 to 16.
    """
    edges = [{"from": e[0], "to": e[1], "length": length} for e, length in LENGTHS.items()]
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"roadmap": {"vertices": AT, "edges": edges}, "spacing": "whole"},
            "robots": [
                {"name": "R1", "home": "c", "target": "h", "work": 2, "speed": 1},
                {"name": "R2", "home": "f", "target": "i", "work": 2, "speed": 1},
                {"name": "R3", "home": "h", "target": "b", "speed": 1, "radius": "3/10"},
            ],
            "rules": {"occupancy": "both", "rotations": False},
            "closures": [
                {"edge": ["c", "e"], "from": 6, "until": 8},
                {"at": "b", "from": 15, "until": 16, "radius": "1/2"},
            ],
        }
    )


def test_a_plan_that_is_slower_after_what_has_begun_is_not_taken() -> None:
    """R1 breaks down at home at 3, while R2 drives to i, until 6, and keeps R3 off g.

    For the rest, LNS lets R3 go first: without the drive it would be at b and away before 15. But
    it can leave only at 6, has to wait until b is open again, and R2 would wait for it: the sum
    would be 242 ticks of 1/4. With the old order R2 is home at 14, and R3 follows: 170.
    """
    plan = rightofway.solve(lane_through_a_corner(), "two-level")
    assert plan.scenario.problem.clock.tick == 1 / 4
    broken = (Stoppage(Tick(12), NEVER),)
    delays = DelayModel(random=(), pace=(1.0,) * 3, stoppages=(broken, (), ()))
    adg = ActionDependencyGraph(plan.scenario, plan.tracks, delays)
    monitor = ExecutionMonitor(adg, ExecutionPolicy(switch=False, replan=True), 5, 0, Deadline())
    assert monitor.replans == 1
    assert monitor.completion.tolist() == [NEVER, 56, 114]
