"""The page writes times, lengths and speeds as the commands do."""

import json
from fractions import Fraction
from pathlib import Path

import numpy as np

from rightofway.quantities import Quantities, Units
from tests.builders.plans import door
from tests.viewer.conftest import Opener

CASES = json.loads((Path(__file__).parents[1] / "data" / "quantities.json").read_text())
"""Values and their texts; the package is tested with the same ones."""

UNITS = [Units(), *(Units(length="m", time=time) for time in ("ms", "s", "min", "h"))]


def test_the_page_passes_the_cases_of_the_commands(show: Opener) -> None:
    viewer = show(door())
    decimals = [value for value, _ in CASES["decimal"]]
    written = viewer.ask(f"{json.dumps(decimals)}.map((value) => decimal(fraction(value)))")
    assert written == [text for _, text in CASES["decimal"]]
    durations = [(unit, time) for unit, time, _ in CASES["duration"]]
    written = viewer.ask(
        f"{json.dumps(durations)}.map(([time, value]) =>"
        " new Quantities({ time, length: null }, [1, 1]).duration(value))"
    )
    assert written == [text for *_, text in CASES["duration"]]


def test_both_write_random_times_alike(show: Opener) -> None:
    """Numbers of ticks that are whole, or in between while the clock runs, at random ticks."""
    rng = np.random.default_rng(1)
    viewer = show(door())
    for units in UNITS:
        tick = Fraction(*rng.integers(1, 900, 2).tolist())
        ticks = [
            *rng.integers(0, 10 ** rng.integers(1, 8, 40)).tolist(),
            *(rng.random(40) * 10.0 ** rng.integers(-8, 6, 40)).tolist(),
        ]
        ours = Quantities(units=units, tick=tick)
        expected = [[ours.duration(n), ours.moment(n), ours.cell(n)] for n in ticks]
        named = json.dumps({"length": units.length, "time": units.time})
        written = viewer.ask(
            f"((q) => {json.dumps(ticks)}.map((n) => [q.duration(n), q.moment(n), q.cell(n)]))"
            f"(new Quantities({named}, [{tick.numerator}, {tick.denominator}]))"
        )
        assert written == expected


def test_lengths_and_speeds_have_the_units_of_the_scenario_or_none(show: Opener) -> None:
    viewer = show(door())
    named = 'new Quantities({ length: "m", time: "s" }, [1, 4])'
    assert viewer.ask(f'{named}.length("9/20")') == "0.45 m"
    assert viewer.ask(f'{named}.speed("6/5")') == "1.2 m/s"
    plain = "new Quantities({ length: null, time: null }, [1, 1])"
    assert viewer.ask(f'{plain}.length("9/20")') == "0.45 length units"
    assert viewer.ask(f'{plain}.speed("6/5")') == "1.2"


def test_a_running_time_keeps_its_decimals(show: Opener) -> None:
    viewer = show(door())
    seconds = 'new Quantities({ length: "m", time: "s" }, [1, 2])'
    assert viewer.ask(f"[0, 1, 2.5, 120, 121.3].map((n) => {seconds}.running(n))") == [
        "0.0 s", "0.5 s", "1.3 s", "1 min 0.0 s", "1 min 0.7 s",
    ]  # fmt: skip
    assert viewer.ask("plan.quantities.running(3, 2)") == "3.00"
