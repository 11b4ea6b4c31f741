"""The page of a plan with jobs: the list, the cards, the diagram and the map."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from rightofway.model import Plan
from tests.builders.browsers import needs_browser
from tests.builders.planned_jobs import JOBS, make_plan
from tests.viewer.conftest import Opener

pytestmark = needs_browser


def _make_late_plan() -> Plan:
    """J1 is due at 7 and ends at 9."""
    return make_plan(jobs=(replace(JOBS[0], due=Fraction(7)), *JOBS[1:]))


def test_jobs_are_listed_those_that_nobody_does_first(show: Opener) -> None:
    viewer = show(_make_late_plan())
    assert viewer.text("#tab-jobs").split() == ["Jobs", "4"]
    viewer.page.click("#tab-jobs")
    assert viewer.text("#job-list").split("\n") == [
        "J4 is not served", "No place in a tour was found for it",
        "J1: R1, 2 late", "3 to 9 · service time 6",
        "J3: R2", "4 to 4 · service time 4",
        "J2: R2", "9 to 12 · service time 12",
    ]  # fmt: skip
    assert viewer.complaints == []


def test_the_top_counts_jobs_and_adds_up_their_service_times(show: Opener) -> None:
    figures = show(make_plan()).text("#figures")
    assert "Jobs done\n3 of 4\nService time\n22" in figures  # 6 + 4 + 12


def test_a_job_leads_to_its_moment_its_robot_and_back(show: Opener) -> None:
    viewer = show(_make_late_plan())
    viewer.page.click("#tab-jobs")
    viewer.page.get_by_role("option").filter(has_text="J1: R1").click()
    assert (viewer.chosen, viewer.tick) == ("J1", 3)
    card = viewer.text("#card")
    assert "Service time\n6\nDue\n7\nLate by\n2" in card
    assert "3\nN1, loads 1, works 2 time units" in card
    viewer.page.locator(".card .facts .link").click()
    assert viewer.chosen == "R1"
    viewer.page.locator(".card .go").filter(has_text="J1").last.click()
    assert (viewer.chosen, viewer.tick) == ("J1", 8)


def test_the_card_of_a_job_compares_the_robots_that_may_do_it(show: Opener) -> None:
    viewer = show(make_plan(), "#job=J1")
    rows = viewer.page.locator(".job-costs tr").all_inner_texts()
    assert [row.split("\t")[0] for row in rows] == ["R1", "R2"]
    assert viewer.page.locator(".job-costs .taken").inner_text().startswith("R1")
    viewer.page.locator(".job-costs .link").filter(has_text="R2").click()
    assert viewer.chosen == "R2"


def test_the_card_of_a_robot_has_its_tour_and_its_battery(show: Opener) -> None:
    viewer = show(make_plan(), "#robot=R1")
    card = viewer.text("#card")
    assert "100 % at first, 61 % at last, never below 21 %; reserve 20 %" in card
    assert "J1: N1, loads 1, works 2 time units, then 1 on board" in card
    assert "13\ncharges at N0 for 2 time units" in card
    assert viewer.page.locator(".soc-curve .charge").count() == 1
    viewer.page.locator(".soc-curve svg").click()  # in the middle
    assert abs(viewer.tick - viewer.end / 2) < 0.2
    assert "State of charge" not in show(make_plan(), "#robot=R2").text("#card")


def test_the_map_shows_the_way_of_a_job_and_a_press_on_a_stop_chooses_it(show: Opener) -> None:
    viewer = show(make_plan())
    first, between = (1.5, 0.5), (2.5, 0.5)  # N1, N2 of J1, which goes from N1 to N3
    before = viewer.colour(viewer.on_map(between))
    viewer.seek(1)
    viewer.page.mouse.click(*viewer.at((3.5, 0.5)))
    assert viewer.chosen == "J1"
    assert viewer.colour(viewer.on_map(between)) != before
    assert viewer.colour(viewer.on_map(first)) != before


def test_work_and_charges_have_marks_in_the_diagram(show: Opener) -> None:
    """The block of J1 has its name where it has room; a charge is paper within a frame."""
    viewer = show(make_plan(), viewport={"width": 1600, "height": 900})
    assert viewer.complaints == []
    y, x = viewer.diagram_y("N0"), viewer.diagram_x(13.3)
    assert viewer.pixel("diagram", x, y) != viewer.pixel("diagram", viewer.diagram_x(15.5), y)


def test_an_address_leads_to_a_job(show: Opener) -> None:
    viewer = show(make_plan(), "#job=J4")
    assert viewer.chosen == "J4"
    assert "No place in a tour was found for it." in viewer.text("#card")
    assert "On each robot" in viewer.text("#card")
    viewer.page.wait_for_function("() => location.hash.includes('job=J4')")


def test_shares_have_decimal_commas_in_german(show: Opener) -> None:
    battery = make_plan().scenario.batteries[0][1]
    plan = make_plan(batteries={"large": replace(battery, reserve=Fraction(35, 1000))})
    card = show(plan, "#robot=R1", locale="de-DE").text("#card")
    assert "Reserve 3,5 %" in card


def test_a_narrow_page_need_not_be_scrolled_to_the_side(show: Opener) -> None:
    viewer = show(make_plan(), "#job=J1", viewport={"width": 360, "height": 740})
    assert viewer.is_as_wide_as(360)


def test_a_robot_that_charges_is_said_to_charge(show: Opener) -> None:
    """R1 charges from 13 to 15."""
    viewer = show(make_plan())
    viewer.seek(12)
    assert "charging 0" in " ".join(viewer.text("#states").split())
    viewer.seek(14)
    assert "charging 1" in " ".join(viewer.text("#states").split())
