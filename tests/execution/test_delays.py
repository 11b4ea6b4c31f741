"""What makes robots late, as users write it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.execution import CAUSES, delay_model_of, read_delays
from rightofway.io import load_delays
from rightofway.model import NEVER, Scenario
from tests.builders.fleets import grid_fleet


@pytest.fixture
def scenario() -> Scenario:
    return grid_fleet(["...", "..."], [("N0", "N2"), ("N3", "N5")])


def test_random_delays_become_numbers_of_the_kernel(scenario: Scenario) -> None:
    text = "exponential:0.2, uniform:-1/4..1/2,normal:0.1~0.05,chance:0.01x20,breaks:1/8"
    assert delay_model_of(read_delays(text, scenario), scenario).random == (
        ("exponential", 0.2, 0.0),
        ("uniform", -0.25, 0.5),
        ("normal", 0.1, 0.05),
        ("chance", 0.01, 20.0),
        ("breaks", 0.125, 0.0),
    )


def test_what_befalls_one_robot_befalls_no_other(scenario: Scenario) -> None:
    text = ["slow:R2x1.5", "stop:R1@12,stop:R1@3+9/2", "early:R2x1/2"]
    delays = delay_model_of(read_delays(text, scenario), scenario)
    assert delays.pace == (1.0, 0.75)
    assert delays.stoppages == (((3, 5), (12, NEVER)), ())  # 9/2 takes 5 ticks of 1


@pytest.mark.parametrize(
    "text", ["- slow:R1x2\n- breaks:0.1\n", "delays: ['slow:R1x2,breaks:0.1']"]
)
def test_a_file_holds_the_same(tmp_path: Path, scenario: Scenario, text: str) -> None:
    path = tmp_path / "late.yaml"
    path.write_text(text, encoding="utf-8")
    assert [delay.text for delay in read_delays(load_delays(path), scenario)] == [
        "slow:R1x2",
        "breaks:0.1",
    ]


def test_robots_may_have_any_name() -> None:
    scenario = grid_fleet(["..", ".."], [("N0", "N1")])
    odd = replace(scenario, robots=(replace(scenario.robots[0], name="x@2,x"),))
    delays = read_delays("stop:x@2,x@5+1,slow:x@2,xx2", odd)
    assert [(delay.kind, delay.robot) for delay in delays] == [("stop", "x@2,x"), ("slow", "x@2,x")]


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("late:1", "delays: late:1: 'late' is no kind of delay (one of exponential, "),
        ("stop:R9@1", "delays: stop:R9@1: there is no robot 'R9' (there are R1, R2)"),
        ("stop:R1", "delays: stop:R1: 'R1' cannot be read (write it like stop:R3@12+30)"),
        ("slow:R1x0.5", "1/2 is below 1 (say early for that)"),
        ("early:R1x2", "2 is above 1 (say slow for that)"),
        ("early:R1x0", "0 is not positive (give a factor above 0)"),
        ("uniform:1..0", "1 is above 0 (give the smaller bound first)"),
        ("chance:2x3", "2 is no chance (give 0 to 1)"),
        ("exponential:-1", "-1 is negative (give 0 or more)"),
        ("exponential:many", "'many' is not a number (write it like 3, 0.5 or 1/3)"),
        ("normal:-1~0", "-1 is not above -1 (nothing takes no time)"),
        ("late.yaml", "delays: late.yaml: 'late.yaml' is no kind of delay (one of exponential, "),
    ],
)
def test_what_cannot_be_read_is_told_with_what_to_do(
    scenario: Scenario, text: str, complaint: str
) -> None:
    with pytest.raises(InputError) as caught:
        read_delays(text, scenario)
    assert complaint in str(caught.value)


@pytest.mark.parametrize("text", ["slow:R1x2", "{delays: 3}", "[1, 2]", "{late: []}"])
def test_a_file_that_is_no_list_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "late.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=r"late.yaml: is no list of delays \(write lines like"):
        load_delays(path)


def test_every_example_can_be_read() -> None:
    """Their robots are R1 to R3."""
    scenario = grid_fleet(["...", "..."], [("N0", "N1"), ("N1", "N2"), ("N2", "N0")])
    examples = [example for cause in CAUSES.values() for example, _ in cause.examples]
    assert [delay.text for delay in read_delays(examples, scenario)] == examples
    assert [delay.kind for delay in read_delays(",".join(examples), scenario)] == [
        example.partition(":")[0] for example in examples
    ]
