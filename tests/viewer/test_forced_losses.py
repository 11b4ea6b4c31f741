"""The page of an optimal plan says why no plan is better: who loses time to whom, and where."""

from __future__ import annotations

import pytest

import rightofway
from rightofway.model import Plan
from tests.builders.fleets import grid_fleet
from tests.viewer.conftest import Opener


@pytest.fixture(scope="module")
def plan() -> Plan:
    """Return the best plan of R1 and R2, who both need the door in N6, and R3, who needs nothing.

    One of the two is a time unit later than alone, in every plan.
    """
    trips = [("N0", "N10"), ("N2", "N12"), ("N4", "N14")]
    scenario = grid_fleet(["...@.", "@.@@.", "...@."], trips)
    return rightofway.solve(scenario, "cbs", time_limit=None)


def test_a_forced_loss_leads_to_its_robots_and_their_place(plan: Plan, show: Opener) -> None:
    viewer = show(plan)
    door, aside = (1.5, 1.5), (4.5, 1.5)  # N6, and N9 on the way of R3
    before = viewer.colour(viewer.on_map(door)), viewer.colour(viewer.on_map(aside))
    viewer.page.click("#tab-decisions")
    viewer.page.click("#decision-list .row >> nth=0")
    row = "R1 and R2 lose 1 time unit\nWhy no plan is better"
    assert viewer.text("#decision-list") == row
    assert viewer.text("#tab-decisions b") == "1"
    card = viewer.text("#card")
    assert "In every plan, R1 and R2 lose at least 1 time unit to each other" in card
    assert viewer.colour(viewer.on_map(door)) != before[0]
    assert viewer.colour(viewer.on_map(aside)) == before[1]


def test_the_card_of_a_robot_has_its_forced_losses(plan: Plan, show: Opener) -> None:
    card = show(plan, "#robot=R1").text("#card")
    assert "In every plan\n2\nR1 and R2 lose 1 time unit" in card
    assert "In every plan" not in show(plan, "#robot=R3").text("#card")


def test_an_address_leads_to_a_forced_loss(plan: Plan, show: Opener) -> None:
    viewer = show(plan, "#forced=1")
    assert "In every plan, R1 and R2" in viewer.text("#card")
    assert viewer.complaints == []


def test_a_forced_loss_is_said_in_german(plan: Plan, show: Opener) -> None:
    card = show(plan, "#forced=1", locale="de-DE").text("#card")
    assert "Warum kein Plan besser ist" in card
    assert "In jedem Plan verlieren R1 und R2 mindestens 1 Zeiteinheit aneinander" in card


@pytest.fixture(scope="module")
def soonest(plan: Plan) -> Plan:
    """Return the plan of the same fleet that ends soonest: when R1 and R2 have both passed."""
    return rightofway.solve(plan.scenario, "cbs", time_limit=None, objective="makespan")


def test_the_robots_that_force_the_makespan_are_named_and_shown(
    soonest: Plan, show: Opener
) -> None:
    viewer = show(soonest)
    door = viewer.on_map((1.5, 1.5))
    before = viewer.colour(door)
    viewer.page.click("#tab-decisions")
    viewer.page.click("#decision-list .row >> nth=0")
    head = f"R1 and R2 need {soonest.makespan} time units"
    assert viewer.text("#decision-list") == f"{head}\nWhy no plan is better"
    words = f"No plan ends before {soonest.makespan} time units: R1 and R2 need as long"
    assert words in viewer.text("#card")
    assert viewer.colour(door) != before


def test_the_robots_that_force_the_makespan_are_named_in_german(
    soonest: Plan, show: Opener
) -> None:
    card = show(soonest, "#forced=1", locale="de-DE").text("#card")
    assert f"Kein Plan endet vor {soonest.makespan} Zeiteinheiten: R1 und R2 brauchen" in card
