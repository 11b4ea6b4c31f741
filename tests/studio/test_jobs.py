"""Jobs in the studio: the table, drawing, pasted rows, batteries, and what a plan says of them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import pytest

from tests.builders.browsers import CHROMIUM, expect
from tests.builders.drawing import StudioPage, studio_page
from tests.builders.languages import english_on
from tests.builders.suites import soon

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.builders.studios import Client

HALL: dict[str, Any] = {
    "format": "rightofway-scenario/1",
    "map": {"grid": ["......", ".@@.@.", "......"]},
    "robots": [
        {"name": "R1", "home": "N0", "battery": "small", "charging": ["N0"]},
        {"name": "R2", "home": "N5", "capacity": 2},
    ],
    "batteries": {"small": {"drive": "1/40", "charge": "1/10", "reserve": "1/10"}},
    "jobs": [
        {"name": "A", "pickup": "N12", "dropoff": "N15", "pickup_work": 2},
        {"name": "B", "at": "N17", "work": 3, "robot": "R2"},
        {"name": "C", "pickup": "N0", "dropoff": "N17", "latest": 1},
    ],
    "rules": {"turn": 0},
}

PASTE = """(field, text) => {
  const clipboardData = new DataTransfer();
  clipboardData.setData("text", text);
  field.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true }));
}"""


def _survey(client: Client, document: dict[str, Any]) -> dict[str, Any]:
    answer: dict[str, Any] = client.post("survey", json={"document": document, "folder": ""}).json()
    return answer


def test_rows_of_a_spreadsheet_are_read_as_the_reader_of_files_does(empty: Client) -> None:
    rows = "Name\tPickup\tDropoff\tDue [s]\tAfter\nA\tN0\tN3\t4,5\t\nB\tN1\tN2\t\tA\n"
    answer = empty.post("rows", json={"text": rows})
    assert answer.json() == {
        "jobs": [
            {"name": "A", "pickup": "N0", "dropoff": "N3", "due": "4.5"},
            {"name": "B", "pickup": "N1", "dropoff": "N2", "after": ["A"]},
        ]
    }


def test_rows_with_an_unknown_heading_are_refused_with_a_remedy(empty: Client) -> None:
    answer = empty.post("rows", json={"text": "name\tpickupp\nA\tN0\n"})
    assert answer.status_code == 422
    (fault,) = answer.json()["error"]["faults"]
    assert fault["message"] == "line 1: 'pickupp' is no key of a job (did you mean pickup?)"


def test_a_map_shows_charging_places_of_the_scenario(empty: Client) -> None:
    assert _survey(empty, HALL)["site"]["map"]["charging"] == [0]


@pytest.mark.parametrize(
    ("changes", "path"),
    [
        ({"jobs": [{"name": "A", "at": "N99"}]}, ["jobs", 0, "at"]),
        ({"batteries": {"small": {"drive": -1}}}, ["batteries", "small", "drive"]),
    ],
)
def test_robots_stay_on_the_map_where_jobs_or_batteries_have_faults(
    empty: Client, changes: dict[str, Any], path: list[str | int]
) -> None:
    answer = _survey(empty, {**HALL, **changes})
    assert [fault["path"] for fault in answer["faults"]] == [path]
    assert [robot["name"] for robot in answer["site"]["robots"]] == ["R1", "R2"]


def test_a_plan_with_jobs_is_made_and_told_with_its_reasons(empty: Client) -> None:
    """The second plan of a search would tell progress in words that languages have."""
    body = {"kind": "plan", "document": HALL, "folder": "", "time_limit": 2}
    number = empty.post("runs", json=body).json()["number"]
    assert soon(lambda: empty.get(f"runs/{number}").json()["ended"])
    run = empty.get(f"runs/{number}").json()
    assert run["state"] == "done", run["error"]
    work = empty.get(f"runs/{number}/payload").json()["work"]
    assert [job.get("robot") for job in work["jobs"]][1:] == [1, None]
    assert "reason" in work["jobs"][2]


if CHROMIUM:

    @pytest.fixture
    def hall(browser: Browser, empty: Client) -> Iterator[StudioPage]:
        """Return the page with three jobs, at their table."""
        with _open(browser, empty) as studio:
            studio.tab("Jobs")
            yield studio

    def _open(browser: Browser, client: Client, **settings: Any) -> Any:
        text = {"document": HALL, "folder": "", "revision": ""}
        assert client.put("documents/hall.yaml", json=text).status_code == 200
        client.studio.file = "hall.yaml"
        return studio_page(browser, client, **settings)

    def test_the_table_has_a_row_for_each_job_and_its_keys(hall: StudioPage) -> None:
        hall.opened()
        names = [
            field.input_value() for field in hall.page.locator("table.jobs td.name input").all()
        ]
        assert names == ["A", "B", "C", ""]
        assert hall.page.get_by_label("Pickup, A", exact=True).input_value() == "N12"
        assert hall.page.get_by_label("Robot, B", exact=True).input_value() == "R2"

    def test_a_job_is_changed_removed_and_both_are_undone(hall: StudioPage) -> None:
        due = hall.page.get_by_label("Due, A", exact=True)
        due.fill("40")
        due.press("Tab")
        hall.settle()
        assert hall.document["jobs"][0]["due"] == 40
        hall.page.locator("table.jobs tr[data-row='1'] .do button").click()
        hall.settle()
        assert [job["name"] for job in hall.document["jobs"]] == ["A", "C"]
        hall.button("Undo").click()
        hall.button("Undo").click()
        hall.settle()
        assert hall.document["jobs"] == HALL["jobs"]

    def test_a_job_is_drawn_by_dragging_and_one_at_a_place_by_a_press(hall: StudioPage) -> None:
        hall.opened()
        hall.drag((1.5, 0.5), (4.5, 2.5))
        hall.press((3.5, 1.5))
        assert hall.document["jobs"][3:] == [
            {"name": "J4", "pickup": "N1", "dropoff": "N16"},
            {"name": "J5", "at": "N9"},
        ]
        assert hall.page.locator("table.jobs tr[aria-selected=true]").count() == 1
        hall.button("Undo").click()
        hall.settle()
        assert len(hall.document["jobs"]) == 4

    def test_pasted_rows_with_headings_become_jobs(hall: StudioPage) -> None:
        field = hall.page.get_by_label("Name, new job", exact=True)
        field.evaluate(PASTE, "name\tat\tdue\nD\tN3\t12,5\nE\tN9\t\n")
        expect(hall.page.get_by_label("At, E", exact=True)).to_have_value("N9")
        hall.settle()
        assert hall.document["jobs"][3:] == [
            {"name": "D", "at": "N3", "due": "12.5"},
            {"name": "E", "at": "N9"},
        ]

    def test_rows_that_cannot_be_read_change_nothing_and_say_why(hall: StudioPage) -> None:
        field = hall.page.get_by_label("Name, new job", exact=True)
        field.evaluate(PASTE, "name\tat\tdeu\nD\tN3\t12\n")
        hall.page.get_by_text("did you mean due?").first.wait_for()
        assert hall.document["jobs"] == HALL["jobs"]

    def test_batteries_and_charging_places_are_edited(hall: StudioPage) -> None:
        hall.page.get_by_label("Reserve, small", exact=True).fill("0,2")
        hall.page.get_by_label("new battery", exact=True).fill("large")
        hall.page.get_by_label("Charging places").fill("N0; N17")
        hall.page.keyboard.press("Tab")
        hall.settle()
        assert hall.document["batteries"]["small"]["reserve"] == 0.2
        assert hall.document["batteries"]["large"] == {}
        assert hall.document["charging"] == ["N0", "N17"]

    def test_a_fault_of_a_job_stands_at_its_cell(hall: StudioPage) -> None:
        field = hall.page.get_by_label("Dropoff, A", exact=True)
        field.fill("N99")
        field.press("Tab")
        expect(field).to_have_attribute("aria-invalid", "true")
        hall.page.get_by_role("alert").get_by_text("outside the map").first.wait_for()

    def test_the_plan_lists_jobs_and_why_one_is_not_served(hall: StudioPage) -> None:
        hall.button("Plan").click()
        hall.planned()
        jobs = hall.page.locator(".jobs-of-plan")
        assert jobs.locator("button").first.inner_text().startswith("C is not served")
        jobs.get_by_role("button").filter(has_text="B: R2").click()
        card = hall.page.locator("#card")
        assert card.get_by_role("heading").first.inner_text() == "B"
        assert "Why this robot" in card.inner_text()

    def test_trips_become_jobs_where_one_begins_with_jobs(browser: Browser, empty: Client) -> None:
        trips = {
            **HALL,
            "robots": [{"name": "R1", "home": "N0", "target": "N3", "work": 2}],
        }
        for key in ("jobs", "batteries"):
            trips.pop(key)
        text = {"document": trips, "folder": "", "revision": ""}
        assert empty.put("documents/trips.yaml", json=text).status_code == 200
        empty.studio.file = "trips.yaml"
        with studio_page(browser, empty) as studio:
            studio.opened()
            studio.tab("Jobs")
            studio.button("Begin with jobs").click()
            studio.settle()
            assert studio.document["robots"] == [{"name": "R1", "home": "N0"}]
            assert studio.document["jobs"] == [{"name": "J1", "at": "N3", "work": 2, "robot": "R1"}]

    def test_jobs_are_german_in_a_german_browser(browser: Browser, empty: Client) -> None:
        with _open(browser, empty, locale="de-DE") as studio:
            studio.opened()
            studio.tab("Aufträge")
            for _ in range(studio.page.locator(".under button").count() - 1):
                studio.page.locator(".under button").first.click()
            studio.settle()
            assert english_on(studio, "pickup", "dropoff", "due", "name", "small") == []
            studio.button("Planen").click()
            studio.planned()
            studio.page.locator(".jobs-of-plan button").first.click()
            studio.settle()
            assert english_on(studio, "small") == []
