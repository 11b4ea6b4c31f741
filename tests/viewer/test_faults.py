"""The page of a plan that breaks rules says so, and leads to each fault."""

import pytest

from rightofway.viz.palette import LIGHT
from tests.builders.plans import door, door_shifted
from tests.builders.players import Player
from tests.viewer.conftest import Opener


def ringed(viewer: Player) -> int:
    """Return how many robots have a red ring round them on the map."""
    return sum(disc.colour == LIGHT.held and not disc.is_filled for disc in viewer.discs())


@pytest.fixture
def faulty(show: Opener) -> Player:
    """R1 does not wait for R2: both drive through N1, N4 and N7 at once, both ways."""
    return show(door_shifted(-1), title="bad.json")


def test_the_head_counts_faults_and_praises_nothing(faulty: Player) -> None:
    head = faulty.text("header.summary")
    assert "faults: do not run this plan" in head
    assert "vertex conflict" in head
    assert "All home at" not in head
    assert faulty.page.locator("body.faulty").count() == 1


def test_a_faulty_plan_does_not_play_by_itself(show: Opener) -> None:
    viewer = show(door_shifted(-1), reduced_motion="no-preference")
    assert viewer.page.get_by_role("button", name="Play", exact=True).is_visible()


def test_the_details_of_a_faulty_plan_have_no_figures(faulty: Player) -> None:
    faulty.page.click("#about-open")
    details = faulty.text("#made")
    assert "Planner" in details
    assert "Flowtime" not in details


def test_faults_are_listed_first_and_lead_to_their_moment_and_place(faulty: Player) -> None:
    row = faulty.page.locator("#fault-list .row").first
    sentence = "R1 books N1 from time 1 to 2 and R2 from time 1 to 2"
    assert row.inner_text() == f"{sentence}\nat time 1 · vertex conflict"
    row.click()
    assert faulty.tick == 1
    card = faulty.text("#card")
    assert "R1 books N1 from time 1 to 2 and R2 from time 1 to 2" in card
    assert "Let one come when the other has left." in card
    faulty.page.wait_for_url("**&fault=1")


def test_faulty_robots_are_marked_on_the_map(faulty: Player) -> None:
    assert ringed(faulty) == 2


def test_the_address_leads_to_a_fault(show: Opener) -> None:
    viewer = show(door_shifted(-1), "#fault=2")
    second = viewer.page.locator("#fault-list").get_by_role("option").nth(1)
    assert second.get_attribute("aria-selected") == "true"


def test_a_plan_that_keeps_the_rules_has_no_list_of_faults(show: Opener) -> None:
    viewer = show(door())
    assert not viewer.page.locator("#tab-faults").is_visible()
    assert ringed(viewer) == 0
