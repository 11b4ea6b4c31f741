"""Laps and delays on the page of the studio: sliders that answer at once, runs that are replayed.

With ``RIGHTOFWAY_PICTURES=docs/images`` the pictures of docs/studio/index.md are written again.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from tests.builders.browsers import needs_browser
from tests.builders.drawing import StudioPage, studio_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator

    from tests.builders.studios import Client

pytestmark = needs_browser

BAY = Path(__file__).parents[2] / "examples" / "bay.yaml"


@pytest.fixture
def studio(browser: Browser, site: Client) -> Iterator[StudioPage]:
    """Yield a studio that shows three robots and one bay, at its tab of plans."""
    site.studio.file = "bay.yaml"
    with studio_page(browser, site) as studio:
        studio.opened()
        studio.tab("Plan")
        yield studio


def repeat(studio: StudioPage) -> Any:
    """Let the robots repeat their trips; return what the report says of their group."""
    studio.page.locator("details.laps summary").click()
    studio.button("Repeat").click()
    studio.planned()
    studio.page.locator(".parameter").first.wait_for()
    return report(studio)["groups"][0]


def simulate(studio: StudioPage, runs: int) -> Any:
    """Plan, execute the plan with delays, and return the report."""
    studio.page.locator(".settings [type=submit]").click()
    studio.planned()
    delay(studio, runs)
    return report(studio)


def delay(studio: StudioPage, runs: int) -> None:
    """Execute the plan that is shown some times with delays."""
    studio.page.locator("details.delays summary").click()
    studio.page.fill("#run-count", str(runs))
    studio.button("Simulate").click()
    studio.planned()
    studio.button("Worst").wait_for()


def report(studio: StudioPage) -> Any:
    """Return the report of the run that was begun last."""
    return studio.api(f"runs/{studio.runs[0]['number']}/report")


def answered(studio: StudioPage) -> Locator:
    """Wait until it is known what laps in a new order achieve; return that row."""
    row = studio.page.locator(".orders tbody tr:last-child[data-known=true]")
    row.wait_for()
    return row


def slider(studio: StudioPage, name: str) -> Locator:
    """Return the slider of a name."""
    return studio.page.get_by_role("slider", name=name)


def circle(studio: StudioPage) -> str:
    """Return the places of the circle that is lit on the map, once the page is painted."""
    studio.settle()
    return studio.page.locator(".holder").get_attribute("data-bottleneck") or ""


def arrivals(studio: StudioPage) -> list[int]:
    """Return when each robot arrives in the run that is played, as its card says."""
    studio.settle()
    found = []
    for robot in studio.page.locator(".sufferers .watch").all():
        robot.click()
        studio.settle()
        done = studio.page.locator("#card").get_by_text(re.compile(r"^[0-9]+ \("))
        found.append(int(done.inner_text().split()[0]))
    return found


def test_laps_say_their_period_and_light_the_bottleneck(studio: StudioPage) -> None:
    group = repeat(studio)
    assert studio.text(".pace .figure output") == str(group["period"]) == "32"
    assert studio.page.locator("#bottleneck-legend").is_visible()
    steps = studio.page.locator(".circle .watch")
    texts = [step.split("\n") for step in steps.all_inner_texts()]
    assert texts[:2] == [["R3 enters N7 once R1 has left N7"], ["R3 drives to N17", "2"]]
    studio.button("Show 6 more steps").click()
    times = [Fraction(text) for text in steps.locator("small").all_inner_texts()]
    assert sum(times) == 32  # what the steps take is the period
    rows = studio.page.locator(".lap-robots tbody tr").all_inner_texts()
    assert rows[1].split() == ["R2", "1", "32", "72", "%", "23", "for", "R1"]
    studio.page.locator(".exports summary").click()
    command = studio.text(".command code")
    assert command.startswith("rightofway laps bay.yaml --rule first-come")


def test_a_slider_says_the_period_at_once_and_lights_the_circle_that_takes_over(
    studio: StudioPage,
) -> None:
    repeat(studio)
    before = circle(studio)
    speed = slider(studio, "R2: speed")
    described = speed.get_attribute("aria-describedby")
    says = studio.page.locator(f"#{described}")
    assert says.inner_text() == "10 % faster: 0.55 time units less; no further gain above 1.2."
    studio.requests.clear()
    speed.focus()
    for _ in range(2):
        studio.page.keyboard.press("ArrowRight")
    assert speed.get_attribute("aria-valuetext") == "1.1: period 31.45 time units"
    assert studio.text(".pace .figure output") == "31.45"
    assert circle(studio) == before
    for _ in range(4):
        studio.page.keyboard.press("ArrowRight")
    assert speed.get_attribute("aria-valuetext") == "1.3: period 31 time units"
    assert says.inner_text() == "A higher speed gains nothing; below 1.2 the period grows."
    assert circle(studio) != before
    answered(studio)
    # The page knows the whole function; only the new order is asked for, where the slider rests.
    asked = [request.rpartition("/")[2] for request in studio.requests if "/runs/" in request]
    assert set(asked) == {"laps"}
    studio.keep("studio-laps")
    rows = studio.page.locator(".orders tbody tr").all_inner_texts()
    assert [row.split()[:3] for row in rows[:2]] == [["as", "it", "is"], ["same", "order", "31"]]
    studio.button("Back").click()
    assert studio.text(".pace .figure output") == "32"
    assert circle(studio) == before
    assert studio.complaints == []


def test_a_value_that_is_taken_gives_the_laps_of_the_new_order(studio: StudioPage) -> None:
    repeat(studio)
    slider(studio, "R3: work at N17").press("ArrowRight")
    assert studio.text(".pace .figure output") == "32.5"
    promised = answered(studio).get_by_role("cell").all_inner_texts()
    studio.button("Take the value, repeat the laps").click()
    studio.shown(2)
    assert studio.document["robots"][2]["work"] == 3.5
    now = studio.page.locator(".orders tbody tr:first-child td").all_inner_texts()
    assert now == promised != ["32.5", "443.1"]


def test_the_group_of_the_robot_that_is_chosen_is_shown(studio: StudioPage) -> None:
    """R4 drives in a corner of its own, and meets nobody: 2 edges, 2 turns, 2 of work."""
    document = studio.document
    robots = [{**robot, "stops": [{"at": "N23", "work": 1}]} for robot in document["robots"]]
    robots.append({"name": "R4", "home": "N6", "target": "N13", "work": 2})
    grid = [".@.@.@.", ".....@.", "@@.@@@@", "@@.@@@@"]
    studio.draw({**document, "map": {"grid": grid}, "robots": robots})
    studio.tab("Plan")
    repeat(studio)
    assert slider(studio, "R4: speed").count() == 0
    studio.press((6.5, 0.5))
    slider(studio, "R4: speed").wait_for()
    assert studio.text(".pace .figure output") == "6"
    assert slider(studio, "Headway").count() == 0
    assert "R4" in studio.text(".study h3")


def test_delays_show_their_spread_and_replay_any_run(studio: StudioPage) -> None:
    report = simulate(studio, 200)
    counts = report["spread"]["counts"]
    assert sum(counts) == 200
    assert studio.page.locator(".spread rect").count() == len(counts)
    assert "200" not in studio.text(".spread")
    studio.button("Worst").click()
    studio.settle()
    held = studio.page.locator(".held-up .watch")
    assert "more than planned" in held.first.inner_text()
    places = [re.findall(r" in (\w+) for", text)[0] for text in held.all_inner_texts()]
    assert studio.lit() == places
    assert sum(arrivals(studio)) == report["ranks"]["flowtime"][-1]
    studio.keep("studio-delays")
    rank = slider(studio, "A run, from the best to the worst")
    rank.press("Home")
    assert sum(arrivals(studio)) == report["ranks"]["flowtime"][0]
    best = report["ranks"]["run"][0]
    assert f"Run {best}: flowtime" in str(rank.get_attribute("aria-valuetext"))
    picture = studio.page.locator(".spread svg")
    box = picture.bounding_box()
    assert box is not None
    picture.click(position={"x": box["width"] - 2, "y": box["height"] - 2})
    assert sum(arrivals(studio)) == report["ranks"]["flowtime"][-1]
    assert len(studio.runs) == 2  # no run of the studio for each replay
    held.first.click()
    assert studio.page.locator("#card").is_visible()
    assert studio.page.locator(".sufferers .watch").count() == 3
    assert studio.complaints == []


def test_a_replay_of_laps_shows_beside_each_robot_where_the_plan_has_it(
    studio: StudioPage,
) -> None:
    """At tick 20 the plan has R1 in N5 since 20 and R3 in N17 since 18, at 45 R1 in N17 since 42
    and R2 at home in N2 since 40; a robot that is where it should be has no ring."""
    repeat(studio)
    delay(studio, 20)
    for tick, cells in ((20, [(0.5, 1.5), (2.5, 3.5)]), (45, [(2.5, 0.5), (2.5, 3.5)])):
        studio.seek(tick)
        scale, _, _, _, left, top = studio.view()
        rings = [disc for disc in studio.discs() if disc.is_dashed]
        found = sorted(((ring.x - left) / scale, (ring.y - top) / scale) for ring in rings)
        assert found == [pytest.approx(cell) for cell in cells]


def test_a_period_of_several_laps_is_said_with_the_time_for_each(studio: StudioPage) -> None:
    """R1 makes two laps while R2 and R3 make one each; with R2 faster, each makes one."""
    repeat(studio)
    assert studio.text(".pace .figure span") == "period of 4 laps, 8 each"
    speed = slider(studio, "R2: speed")
    for _ in range(5):
        speed.press("ArrowRight")
    answered(studio)
    assert studio.text(".pace > .hint") == (
        "R2: speed 1.25. New order: the pattern repeats every 3 laps: 22.8, 7.6 for each lap."
    )


def test_causes_of_delay_are_fields(studio: StudioPage) -> None:
    studio.page.locator(".settings [type=submit]").click()
    studio.planned()
    studio.page.locator("details.delays summary").click()
    studio.button("Another cause").click()
    kinds = studio.page.get_by_role("combobox", name="Cause of delay")
    studio.page.get_by_label("on average by").fill("12,5")
    kinds.nth(1).select_option("One robot stops")
    studio.page.locator(".causes label select").select_option("R3")
    studio.page.get_by_label("from time").fill("4")
    studio.page.fill("#run-count", "50")
    studio.button("Simulate").click()
    studio.planned()
    assert report(studio)["delays"] == ["exponential:0.125", "stop:R3@4+30"]
    studio.page.locator(".exports summary").click()
    assert "--delays exponential:0.125 --delays stop:R3@4+30" in studio.text(".command code")
    assert studio.page.locator(".sufferers b").first.inner_text() == "R3"


def test_a_simulation_that_is_stopped_keeps_the_runs_that_were_made(studio: StudioPage) -> None:
    studio.page.locator(".settings [type=submit]").click()
    studio.planned()
    request = {"kind": "simulate", "based_on": 1, "delays": ["chance:0.2x9"], "runs": 100_000}
    studio.post("runs", {**request, "replan": True, "time_limit": 600})
    studio.reload()
    studio.page.locator("[data-run='2'][data-state=running]").wait_for()
    studio.button("Stop, keep the best").click()
    studio.failed(2)
    assert studio.run(2)["state"] == "stopped"
    assert 0 < report(studio)["runs"] < 100_000


def test_both_studies_are_whole_in_german(studio: StudioPage) -> None:
    studio.page.locator("header select").select_option("de")
    studio.page.locator("details.laps summary").click()
    studio.page.locator("details.laps button").click()
    studio.page.locator(".parameter").first.wait_for()
    assert "Engpass" in studio.text(".study")
    assert "undefined" not in studio.text(".study")


def test_a_plan_is_driven_and_watched_inside_the_studio(studio: StudioPage) -> None:
    """The live page is over all else; its buttons hold robots, and the studio ends the drive."""
    studio.page.locator(".settings [type=submit]").click()
    studio.planned()
    studio.page.locator("details.drives summary").click()
    studio.page.fill("#pace", "0.5")
    studio.button("Drive").click()
    dialog = studio.page.get_by_role("dialog", name="Watch the robots")
    live = dialog.frame_locator("iframe")
    live.get_by_role("button", name="Hold all robots").click()
    live.get_by_text("carried out").wait_for()
    robots = live.locator("#robot-list")
    robots.get_by_text("held by a person").first.wait_for()
    studio.keep("drive")
    dialog.get_by_role("button", name="Stop the robots").click()
    live.get_by_text("the control has ended").wait_for()
    studio.keep("drive-ended")
    dialog.get_by_role("button", name="Close").click()
    dialog.wait_for(state="hidden")
    status = studio.page.locator("details.drives .drive")
    assert status.inner_text() == "Stopped while robots drove plan 1."
    studio.button("Watch the robots").click()
    dialog.get_by_role("button", name="Close").wait_for()
    assert studio.complaints == []


def test_why_a_plan_cannot_be_driven_is_said_on_the_page(studio: StudioPage) -> None:
    studio.page.locator(".settings [type=submit]").click()
    studio.planned()
    studio.page.locator("details.drives summary").click()
    drives = studio.page.locator("details.drives")
    drives.get_by_role("button", name="Another cause").click()
    drives.get_by_label("Cause").select_option("breaks")
    drives.locator(".causes input").fill("100")
    studio.button("Drive").click()
    studio.page.get_by_text("would never complete, and a demo ends when").wait_for()
    studio.keep("drive-refused")
    drives.locator(".causes").get_by_role("button").click()  # it was the only one
    assert drives.locator(".causes li").count() == 0
