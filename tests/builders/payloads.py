"""What pages are made from, kept as files, so that tests of their modules run without Python.

`python -m tests.builders.payloads` writes the files; a test compares them with the package.
"""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

import rightofway
from rightofway.io import parse_scenario
from rightofway.model import ExecutionTrace, Plan, PlannerRun, Status, Tick, Track
from rightofway.report.quantities import Quantities
from rightofway.solve import solve
from rightofway.units import Units
from rightofway.viz.motion import make_trips
from rightofway.viz.page.document import as_compact_json
from rightofway.viz.page.payload import make_payload
from rightofway.viz.page.schema import Payload
from rightofway.viz.placement import lay_out_roadmap
from tests.builders.planned_jobs import make_plan
from tests.builders.plans import counter, counter_late, counter_steady, crowd, door, loop, yard

__all__ = [
    "FOLDER",
    "MADE",
    "cross",
    "in_metres",
    "payload_in",
    "payload_text_in",
    "template_in",
    "written",
]

FOLDER = Path(__file__).parents[1] / "data" / "pages"

CROSS = {
    "vertices": {"A": [0, 0], "B": [8, 0], "C": [4, -4], "D": [4, 4]},
    "edges": [["A", "B"], ["C", "D"]],
}


def template_in(payload: Payload, index: int) -> str:
    """Return the English template of a phrase of a payload."""
    phrase = payload["phrases"][index]
    assert isinstance(phrase, list)
    template = payload["phrases"][phrase[0]]
    assert isinstance(template, str)
    return template


def cross(**more: Any) -> Plan:
    """Return two robots on lanes that cross: R1 is by before R2 starts.

    R1 drives from A to B from 0 to 8; R2 waits at C until 8 and drives to D until 16.

    Parameters
    ----------
    more
        Keys of the roadmap, beside vertices and edges or instead of them.
    """
    robots = [
        {"name": "R1", "home": "A", "target": "B", "radius": 1, "return": "none"},
        {"name": "R2", "home": "C", "target": "D", "radius": "1/2", "return": "none"},
    ]
    document: dict[str, Any] = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {**CROSS, **more}, "y": "up", "spacing": "whole"},
        "units": {"length": "m", "time": "s"},
        "robots": robots,
        "rules": {"clearance": "1/10"},
    }
    scenario = parse_scenario(document)
    tick, times = scenario.problem.clock.tick, ([0, 8], [0, 16])
    return Plan(
        scenario=scenario,
        tracks=tuple(
            Track.of([tail, head], [int(at / tick) for at in enter])
            for tail, head, enter in zip((0, 2), (1, 3), times, strict=True)
        ),
        run=PlannerRun(name="by hand", status=Status("other", text="valid")),
    )


def in_metres(plan: Plan) -> Plan:
    """Return a plan whose lengths are metres; its cells are as wide as one."""
    return replace(plan, scenario=replace(plan.scenario, units=Units(length="m", time="s")))


def _aisle() -> object:
    """Two lanes that cross, one of them in a zone."""
    zones = [{"name": "aisle", "vertices": ["C"], "edges": [["C", "D"]]}]
    return make_payload(cross(zones=zones))


def _packed() -> object:
    """Four robots nearly as wide as a cell, whose ways cross, as a planner leads them."""
    robots = [
        {"name": f"R{k}", "home": [0, 2 * k], "target": [6, 6 - 2 * k], "radius": "45/100"}
        for k in range(4)
    ]
    document = {"format": "rightofway-scenario/1", "map": {"grid": ["." * 7] * 7}, "robots": robots}
    plan = solve(parse_scenario(document), time_limit=None, planner="prioritized")
    return make_payload(plan)


def _corner() -> Plan:
    """A robot that goes round a corner, works for 3 and comes back."""
    fleet = rightofway.FleetBuilder(grid=["...", "@@."], turn_rate=45)
    scenario = fleet.add_robot("R1", home="N0", target="N5", work=3).build_scenario()
    return rightofway.solve(scenario, time_limit=None)


def _corner_late() -> object:
    """The same robot, twice as slow in all."""
    plan = _corner()
    trace = rightofway.simulate(plan, "slow:R1x2", runs=1).trace(0)
    return make_payload(plan, actual=trace)


def _rerouted() -> object:
    """The door, where R2 breaks down in N4 at 3; R1 turns back in N1 and is home at 6."""
    actual = ExecutionTrace(
        tracks=(Track.of([0, 1, 0], [0, 2, 6]), Track.of([2, 1, 3], [0, 1, 2])),
        dwell=(np.zeros(3, np.int64), np.zeros(3, np.int64)),
        drive=(np.array([0, 1, 1]), np.array([0, 1, 1])),
        completion=(None, None),
        stoppages=((), ((Tick(3), None),)),
    )
    return make_payload(door(), actual=actual)


def _closed() -> object:
    """A lane that is closed from 8 until 24."""
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": CROSS},
        "robots": [{"name": "R1", "home": "A", "target": "B"}],
        "closures": [{"edge": ["C", "D"], "from": 8, "until": 24, "radius": 1}],
    }
    return make_payload(solve(parse_scenario(document), time_limit=None))


def _positions() -> object:
    """Where the pictures of the package have robots: x, y [units] and activity, at some ticks."""
    found = {}
    for name, plan in {"door": door(), "loop": loop(), "crowd": crowd(6)}.items():
        plane = lay_out_roadmap(plan.scenario.roadmap)
        moments = []
        for tick in (0, 0.5, 3, 4.25, 9, 12.5, 40, 200):
            robots: list[tuple[float, float, str]] = []
            for trip in make_trips(plan):
                moment = trip.locate(tick)
                tail, head = plane.points[moment.tail], plane.points[moment.head]
                x, y = (tail + (head - tail) * moment.share).tolist()
                robots.append((round(x, 6), round(y, 6), moment.activity.value))
            moments.append({"tick": tick, "robots": robots})
        found[name] = {"payload": make_payload(plan), "moments": moments}
    return found


def _times() -> object:
    """Times as the package writes them, whole and in between, of ticks at random."""
    draw = random.Random(1)  # noqa: S311 (no secret depends on it)
    found = []
    for units in [Units(), *(Units(length="m", time=time) for time in ("ms", "s", "min", "h"))]:
        tick = Fraction(draw.randint(1, 900), draw.randint(1, 900))
        ours = Quantities(units=units, tick=tick)
        ticks = [
            *(draw.randrange(10 ** draw.randint(1, 7)) for _ in range(40)),
            *(draw.random() * 10.0 ** draw.randint(-8, 5) for _ in range(40)),
        ]
        found.append({
            "units": {"length": units.length, "time": units.time},
            "tick": [tick.numerator, tick.denominator],
            "written": [
                [n, ours.format_duration(n), ours.format_moment(n), ours.format_cell(n)]
                for n in ticks
            ],
        })  # fmt: skip
    return found


MADE: dict[str, Callable[[], object]] = {
    "door": lambda: make_payload(door()),
    "measured": lambda: make_payload(in_metres(door())),
    "yard": lambda: make_payload(yard()),
    "loop": lambda: make_payload(loop()),
    "laps": lambda: make_payload(counter(), steady=[counter_steady()]),
    "late": lambda: make_payload(counter(), actual=counter_late()),
    "late_laps": lambda: make_payload(counter(), steady=[counter_steady()], actual=counter_late()),
    "cross": lambda: make_payload(cross()),
    "aisle": _aisle,
    "packed": _packed,
    "corner": lambda: make_payload(_corner()),
    "corner_late": _corner_late,
    "closed": _closed,
    "rerouted": _rerouted,
    "jobs": lambda: make_payload(make_plan()),
    "positions": _positions,
    "times": _times,
}
"""The files, by their names without ``.json``."""


def written(name: str) -> str:
    """Return what a file has to hold."""
    return f"{as_compact_json({'made': MADE[name]()})}\n"


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for each in MADE:
        (FOLDER / f"{each}.json").write_text(written(each), encoding="utf-8")


def payload_text_in(page: str) -> str:
    """Return the JSON that a page was written with."""
    start = '<script type="application/json" id="payload">'
    return page.split(start)[1].split("</script>", maxsplit=1)[0]


def payload_in(page: str) -> Any:
    """Return the data that a page was written with, without its texts."""
    payload = json.loads(payload_text_in(page))
    del payload["texts"]
    return payload
