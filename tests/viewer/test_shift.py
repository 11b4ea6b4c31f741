"""The page of a shift: its figures, the use of robots, jobs as they become known, and rounds."""

from __future__ import annotations

from dataclasses import replace

from rightofway.dispatch.record import DoneStep
from rightofway.model import Tick
from tests.builders.accessibility import serious
from tests.builders.browsers import needs_browser
from tests.builders.players import overlap
from tests.builders.shifts import make_shift
from tests.viewer.conftest import Opener

pytestmark = needs_browser


def test_the_top_has_the_figures_of_a_shift_and_none_of_a_plan(show: Opener) -> None:
    viewer = show(make_shift(), title="hall")
    figures = viewer.text("#figures")
    assert "Jobs done\n3 of 4\nIn time\n2 of 3" in figures
    assert "Not served\n1" in figures
    assert "All home" not in figures
    assert "alone" not in viewer.text("body").lower()
    assert not viewer.page.locator("#tab-decisions, #about-open").filter(visible=True).count()
    assert viewer.complaints == []


def test_jobs_are_listed_once_they_are_known(show: Opener) -> None:
    viewer = show(make_shift())
    viewer.page.click("#tab-jobs")
    viewer.seek(0)
    assert viewer.text("#tab-jobs").split() == ["Jobs", "2"]
    assert "J2" not in viewer.text("#job-list")
    viewer.seek(4)
    assert viewer.text("#job-list").startswith("J2 is not begun\nknown since 4 s")
    viewer.seek(viewer.end)
    assert viewer.text("#tab-jobs").split() == ["Jobs", "4"]
    assert "J1: R1, done" in viewer.text("#job-list")
    assert "J4 is not begun" in viewer.text("#job-list")
    assert "No robot would end it in time" in viewer.text("#job-list")


def test_a_job_leads_to_its_begin_and_names_when_it_became_known(show: Opener) -> None:
    viewer = show(make_shift())
    viewer.seek(viewer.end)
    viewer.page.click("#tab-jobs")
    viewer.page.get_by_role("option").filter(has_text="J2").click()
    assert viewer.chosen == "J2"
    assert "Known\n4 s" in viewer.text("#card")
    assert "Why this robot" not in viewer.text("#card")


def test_the_use_of_each_robot_is_a_bar(show: Opener) -> None:
    viewer = show(make_shift())
    assert viewer.page.get_attribute("#tab-shift", "aria-selected") == "true"
    assert viewer.page.locator("#use-list .use-bar:visible").count() == 2
    widths = (
        viewer.page.locator("#use-list .use-bar")
        .first.locator("i")
        .evaluate_all("parts => parts.map((part) => Number.parseFloat(part.style.width))")
    )
    assert abs(sum(widths) - 100) < 0.01
    viewer.page.locator("#use-list .row").first.click()
    assert viewer.chosen == "R1"
    assert "Jobs done" in viewer.text("#card")
    assert "State of charge" in viewer.text("#card")


def test_late_jobs_and_those_not_served_are_counted_with_their_reasons(show: Opener) -> None:
    # J3 is known at 30, due at 31, and 1 s late; nobody is at N3 by 2, as J4 wants it.
    viewer = show(make_shift())
    late = viewer.page.locator("#shift-figures .go").filter(has_text="J3 most")
    assert late.inner_text().startswith("1\n")
    viewer.page.locator("#shift-figures .go").filter(has_text="No robot would end it").click()
    assert viewer.chosen == "J4"
    late.click()
    assert viewer.chosen == "J3"
    assert viewer.complaints == []


def test_rounds_lead_to_their_begin_and_tell_if_the_old_plan_stood(show: Opener) -> None:
    record = make_shift()
    first = replace(record.rounds[0], seconds=0.25, stands=True)
    viewer = show(replace(record, rounds=(first, *record.rounds[1:])))
    viewer.page.click("#tab-rounds")
    lines = viewer.text("#round-list").split("\n")
    assert lines[:2] == ["0 s: 2 jobs in 0.25 s", "The old plan stands · the shift began"]
    second = record.rounds[1].begin
    viewer.page.locator("#round-list .row").nth(1).click()
    assert viewer.tick == second
    assert viewer.complaints == []


def test_the_place_of_the_longest_waits_is_marked(show: Opener) -> None:
    record = make_shift()
    record.robots[0].waits_at[2] += 9
    viewer = show(record)
    assert viewer.text("#bottleneck-legend").endswith("Robots waited longest at N2: 9 s")
    x, y = viewer.on_map((2.5, 0.5))
    on_ring = (x + 28, y)
    lit = viewer.colour(on_ring)
    viewer.page.click("#bottleneck")
    viewer.painted()
    assert viewer.colour(on_ring) != lit
    assert not viewer.page.is_visible("#bottleneck-legend")


def test_no_mark_covers_the_name_of_a_robot(show: Opener) -> None:
    """R1 charges at N0 at 20; at 3 it is at N3, where J4 waits: its diamond is beside the disc."""
    viewer = show(make_shift(), color_scheme="light")
    viewer.seek(20)
    x, y = viewer.on_map((0.5, 0.5))
    (name,) = (text.box for text in viewer.names() if text.text == "R1")
    near = [disc for disc in viewer.discs() if abs(disc.x - x) + abs(disc.y - y) < 1]
    radius = max(disc.radius for disc in near)
    assert radius > 20
    assert not overlap(name, (x - radius, y - radius * 0.5, x + radius, y + radius * 0.5))
    viewer.seek(3)
    x, y = viewer.on_map((3.5, 0.5))
    away = (radius + 4) / 2**0.5
    assert sum(viewer.colour((x + away, y + away))[:3]) < 150  # nearly black
    (name,) = (text.box for text in viewer.names() if text.text == "R1")
    assert name[0] < x < name[2]


def test_the_diagram_has_throughput_service_times_and_rounds(show: Opener) -> None:
    viewer = show(make_shift())
    assert viewer.text("#diagram-title").startswith("Jobs done, service time")
    viewer.page.locator("#use-list .row").first.click()
    assert viewer.text("#diagram-title") == "R1: states and battery"


def test_a_shift_speaks_german(show: Opener) -> None:
    viewer = show(make_shift(), locale="de-DE")
    assert "Aufträge erledigt\n3 von 4" in viewer.text("#figures")
    assert "Nutzung der Roboter" in viewer.text("#shift")
    viewer.page.click("#tab-rounds")
    assert "2 Aufträge in" in viewer.text("#round-list")
    assert viewer.complaints == []


def test_a_narrow_page_of_a_shift_need_not_be_scrolled_to_the_side(show: Opener) -> None:
    viewer = show(make_shift(), "#robot=R1", viewport={"width": 360, "height": 740})
    assert viewer.is_as_wide_as(360)


def test_on_paper_it_has_a_table_of_the_use_of_robots(show: Opener) -> None:
    viewer = show(make_shift())
    viewer.page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    table = viewer.page.locator("#paper-robots").text_content() or ""
    assert table.startswith("RobotJobs donedrivewaitworkchargeidleR1")


def test_of_a_long_tour_the_card_has_the_part_from_the_moment_that_is_shown_on(
    show: Opener,
) -> None:
    """R1 charges 301 times, from 100 on in each tick: at 250 it begins the one after 150 others."""
    record = make_shift()
    robot = record.robots[0]
    robot.steps[:] = [DoneStep(len(robot.vertices) - 1, 100 + k, 101 + k) for k in range(301)]
    viewer = show(replace(record, until=Tick(500)))
    viewer.seek(250)
    viewer.page.locator("#use-list .row").first.click()
    lines = viewer.page.locator("#card ol li")
    assert lines.count() == 152
    assert lines.first.inner_text().startswith("4 min 10 s")
    assert lines.last.inner_text() == "and 150 more"


def test_the_page_of_a_shift_has_no_serious_barriers(show: Opener) -> None:
    for scheme in ("light", "dark"):
        viewer = show(make_shift(), "#robot=R1", color_scheme=scheme)
        assert serious(viewer) == []
