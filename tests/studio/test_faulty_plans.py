"""A plan with faults is not shown as a good one: in the panel, in lists, in the workbook."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import openpyxl  # type: ignore[import-untyped]
import pytest
import yaml

from tests.builders.browsers import needs_browser
from tests.builders.drawing import Opener, StudioPage, begin
from tests.builders.studios import Client, planned

if TYPE_CHECKING:
    from playwright.sync_api import Locator

DOOR = (Path(__file__).parents[2] / "examples/paper/door-5.yaml").read_text()
"""The paper's planner leaves one swap in its plan: R1 and R2 between N7 and N4 at 7."""

VERDICT = "1 fault: do not run this plan"


@pytest.fixture
def faulty(opened: Opener) -> StudioPage:
    """Return the page with the plan of the paper's planner."""
    studio = opened(DOOR)
    begin(studio, planner="paper")
    alert(studio).wait_for()
    return studio


def alert(studio: StudioPage) -> Locator:
    """Return what the panel says before all else."""
    return studio.page.get_by_role("alert", name=VERDICT)


@needs_browser
def test_the_panel_says_first_that_a_plan_must_not_be_run(faulty: StudioPage) -> None:
    panel = faulty.page.get_by_role("tabpanel")
    caption = panel.get_by_role("figure")
    caption.get_by_text("waits only").wait_for()
    assert "flowtime" not in caption.inner_text()  # its times are worth nothing
    status = faulty.page.get_by_label("Map", exact=True).locator("xpath=..").get_by_role("status")
    status.get_by_text(VERDICT).wait_for()


@needs_browser
def test_a_press_on_a_fault_goes_to_its_place_and_time(faulty: StudioPage) -> None:
    fault = alert(faulty).get_by_role("button")
    said = "R1 and R2 exchange N7 and N4"
    assert fault.inner_text() == f"{said}, at time 7"
    fault.click()
    faulty.page.get_by_role("complementary").get_by_text(f"{said}.", exact=True).wait_for()
    assert fault.get_attribute("aria-pressed") == "true"
    time = faulty.page.get_by_role("region", name="Time", exact=True).get_by_role("status")
    assert time.inner_text().startswith("7")


@needs_browser
def test_list_comparison_and_what_if_name_the_faults(faulty: StudioPage) -> None:
    page = faulty.page
    rows = page.get_by_role("region", name="Plans", exact=True).get_by_role("row")
    rows.get_by_text("1 fault", exact=True).wait_for()
    begin(faulty, planner="two-level")
    alert(faulty).wait_for(state="detached")
    for number in (1, 2):
        page.get_by_role("checkbox", name=f"Compare: {number} ").check()
    figures = page.get_by_role("region", name="Compared").get_by_role("table").first
    faults = figures.get_by_role("row").filter(has_text="Faults")
    faults.get_by_text(VERDICT).wait_for()
    arrivals = figures.get_by_role("row").filter(has_text="Flowtime")
    assert "best" not in arrivals.get_by_role("cell").first.inner_text()


def test_the_summary_sheet_of_a_workbook_begins_with_the_faults(client: Client) -> None:
    run = planned(client, yaml.safe_load(DOOR), planner="paper")
    assert run["figures"]["faults"] == 1
    content = client.get(f"/runs/{run['number']}/export/xlsx").content
    sheet = openpyxl.load_workbook(BytesIO(content))["summary"]
    assert (sheet["A1"].value, sheet["A1"].font.color.rgb) == (VERDICT, "00C00000")


def test_a_good_plan_has_no_faults_among_its_figures(client: Client) -> None:
    run = planned(client)
    assert run["figures"]["faults"] == 0


@needs_browser
def test_a_what_if_that_leaves_faults_says_so(faulty: StudioPage) -> None:
    """The work of R2 is changed, and the plan is made again beside the table."""
    page = faulty.page
    page.get_by_role("checkbox", name="Plan again at each change").check()
    faulty.tab("Robots")
    page.get_by_label("Work, R2").press("6")
    page.get_by_label("Work, R2").press("Enter")
    change = page.get_by_role("main").get_by_role("status").filter(has_text="R2: work")
    change.get_by_text(VERDICT).wait_for()
