"""Pages of laps and of runs on the floor, from the command line."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rightofway import cyclic
from tests.builders.payloads import payload_in
from tests.cli.conftest import EXAMPLES, SWAP, Cli


def told(page: str) -> Any:
    """Return what a page was told."""
    return payload_in(Path(page).read_text("utf-8"))


@pytest.fixture
def plan(cli: Cli, door: Path) -> str:
    cli("plan", door, "--planner", "two-level", "-o", "plan.json")
    return "plan.json"


def test_laps_are_written_as_a_page(cli: Cli) -> None:
    """They repeat themselves every 16 ticks, from 4 on."""
    ended = cli("laps", EXAMPLES / "crossroad.yaml", "--page", "laps.html")
    assert (ended.code, ended.err.strip()) == (0, "wrote laps.html")
    group = told("laps.html")["steady"][0]
    assert group["robots"] == [0, 1]
    assert (group["start"], group["period"]) == (4, 16)
    assert group["until"] >= 4 + 4 * 16


def test_a_plan_of_laps_tells_its_page_from_when_on_it_repeats_itself(cli: Cli) -> None:
    """The page of the plan marks what the page of the laps does; its plan is shorter."""
    cli("laps", EXAMPLES / "crossroad.yaml", "-o", "plan.json", "--page", "laps.html")
    assert cli("show", "plan.json", "-o", "plan.html").code == 0
    laps, plan = told("laps.html")["steady"][0], told("plan.html")["steady"][0]
    assert {**plan, "until": laps["until"]} == laps
    assert 4 + 16 <= plan["until"] < laps["until"]


def test_a_run_on_the_floor_is_written_as_a_page(cli: Cli, plan: str) -> None:
    """R1 stands still for 5 from 3 on, in every run: R2 waits for it, or R1 is late alone."""
    ended = cli("simulate", plan, "--delays", "stop:R1@3+5", "--runs", 3, "--page", "late.html")
    assert (ended.code, ended.err.strip()) == (0, "wrote late.html: run 1 of 3")
    floor = told("late.html")["floor"]
    assert floor["robots"][0]["still"] == [[3, 5]]
    assert floor["robots"][0]["completion"] == 15  # planned for 10


def test_the_run_on_the_page_can_be_chosen(cli: Cli, plan: str) -> None:
    ended = cli("simulate", plan, "--runs", 8, "--run", 7, "--page", "late.html")
    assert ended.err.strip() == "wrote late.html: run 7 of 8"
    ended = cli("simulate", plan, "--runs", 8, "--run", 8, "--page", "late.html")
    assert ended.code == 2
    assert "--run 8 is not among the 8 runs" in ended.err


def test_a_plan_made_anew_is_on_the_page(cli: Cli) -> None:
    """R1 breaks down at the crossing; what the other does then is no longer the plan."""
    cli("plan", EXAMPLES / "crossroad.yaml", "--planner", "two-level", "-o", "plan.json")
    late = ("--delays", "stop:R1@4", "--replan", "--runs", 1)
    ended = cli("simulate", "plan.json", *late, "--page", "new.html")
    assert ended.code == 0
    one, two = told("new.html")["floor"]["robots"]
    assert one["completion"] is None
    assert two["completion"] is not None


@pytest.mark.parametrize("page", ["page.html", "-"])
def test_a_page_that_shows_faults_is_not_written_without_a_word(cli: Cli, page: str) -> None:
    Path("swap.yaml").write_text(SWAP, encoding="utf-8")
    ended = cli(
        "plan", "swap.yaml", "--planner", "paper", "-o", "plan.json", "--page", "paper.html"
    )
    fault = "1 fault: 1 swap conflict; time 7: swap conflict: R1 and R2 exchange"
    assert f"paper.html shows {fault}" in ended.err
    assert told("paper.html")["faults"]["count"] == 1
    assert f"{page} shows {fault}" in cli("show", "plan.json", "-o", page).err


def test_a_page_of_laps_that_shows_faults_is_not_written_without_a_word(
    cli: Cli, monkeypatch: pytest.MonkeyPatch
) -> None:
    """R2 is made four ticks late, so that both are in N17 at 10."""
    make = cyclic.make_excerpt

    def make_faulty(run: cyclic.CyclicResult) -> Any:
        plan, steady = make(run)
        first, second = plan.tracks
        late = np.concatenate((second.enter[:1], second.enter[1:] + 4))
        return replace(plan, tracks=(first, replace(second, enter=late))), steady

    monkeypatch.setattr(cyclic, "make_excerpt", make_faulty)
    ended = cli("laps", EXAMPLES / "crossroad.yaml", "--page", "laps.html")
    assert "laps.html shows " in ended.err
    assert told("laps.html")["faults"]["count"] > 0
