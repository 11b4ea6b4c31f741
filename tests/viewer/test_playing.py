"""The page plays a plan: clock, slider, keys, motion."""

import pytest

from rightofway.model import Plan
from rightofway.viz.motion import trips_of
from rightofway.viz.placement import plane_of
from tests.builders.plans import crowd, door, hostile, loop
from tests.viewer.conftest import Opener


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_page_loads_without_complaint_and_without_the_network(show: Opener, scheme: str) -> None:
    viewer = show(door(), color_scheme=scheme)
    assert viewer.text("#headline") == "2 robots"
    assert (viewer.complaints, viewer.requests) == ([], [])


def test_play_lets_time_run_and_pause_stops_it(show: Opener) -> None:
    viewer = show(door())
    viewer.page.click("#play")
    viewer.wait_for("clock.tick > 0.2")
    viewer.page.click("#play")
    stopped = viewer.ask("clock.tick")
    viewer.ask("new Promise((done) => setTimeout(done, 100))")
    assert viewer.ask("clock.tick") == stopped
    assert viewer.page.get_attribute("#play", "aria-label") == "Play"


def test_it_plays_by_itself_unless_the_user_wants_less_motion(show: Opener) -> None:
    assert show(door(), reduced_motion="no-preference").ask("clock.playing") is True
    assert show(door(), reduced_motion="reduce").ask("clock.playing") is False


def test_a_plan_stops_at_its_end_and_starts_again_from_there(show: Opener) -> None:
    viewer = show(door(), "#tick=9.9")
    viewer.page.keyboard.press("Space")
    viewer.wait_for("!clock.playing")
    assert viewer.ask("clock.tick") == 10
    viewer.page.keyboard.press("Space")
    viewer.wait_for("clock.tick < 5")


def test_the_slider_seeks(show: Opener) -> None:
    viewer = show(door())
    viewer.page.fill("#slider", "4")
    assert viewer.ask("clock.tick") == 4
    viewer.wait_for("document.querySelector('#readout b').textContent === '4'")


def test_slider_and_needle_show_the_moment_at_the_same_place(show: Opener) -> None:
    viewer = show(door(), "#tick=7")
    slider, needle = (
        viewer.page.locator(f"#{name}").bounding_box() for name in ("slider", "needle")
    )
    assert slider
    assert needle
    thumb = 16  # its middle moves over the slider's width less its own
    middle = slider["x"] + thumb / 2 + 0.7 * (slider["width"] - thumb)
    assert needle["x"] + needle["width"] / 2 == pytest.approx(middle, abs=1)


@pytest.mark.parametrize(
    ("start", "keys", "tick"),
    [
        (3, ["ArrowRight"], 4),
        (3, ["ArrowLeft"], 2),
        (3.4, ["ArrowLeft"], 3),
        (3.4, ["ArrowRight"], 4),
        (0, ["ArrowLeft"], 0),
        (3, ["End"], 10),
        (3, ["Home"], 0),
        (4, ["Shift+ArrowRight"], 5),
    ],
)
def test_keys_move_through_time(show: Opener, start: float, keys: list[str], tick: float) -> None:
    viewer = show(door(), f"#tick={start}")
    for key in keys:
        viewer.page.keyboard.press(key)
    assert viewer.ask("clock.tick") == tick


def test_events_are_those_of_the_chosen_robot(show: Opener) -> None:
    """The cart drives at 0 and 2, works from 4, turns from 8, waits from 10, drives from 11."""
    viewer = show(loop(), "#tick=4&robot=Cart")
    seen = []
    for _ in range(4):
        viewer.page.keyboard.press("Shift+ArrowRight")
        seen.append(viewer.ask("clock.tick"))
    viewer.page.keyboard.press("Shift+ArrowLeft")
    assert [*seen, viewer.ask("clock.tick")] == [8, 10, 11, 14, 11]


@pytest.mark.parametrize(("tick", "shown"), [(7, "3.5 of 8"), (0.5, "0.25 of 8"), (4, "2 of 8")])
def test_the_clock_shows_the_very_moment_in_units(show: Opener, tick: float, shown: str) -> None:
    """A tick is half a unit; a moment within a tick is shown, too."""
    assert show(loop(), f"#tick={tick}").text("#readout") == shown


@pytest.mark.parametrize("plan", [door(), loop(), crowd(40)])
def test_the_page_has_robots_where_the_pictures_have_them(show: Opener, plan: Plan) -> None:
    """Both know the same motion, each in its own language."""
    viewer = show(plan)
    plane = plane_of(plan.scenario.roadmap)
    for tick in (0, 0.5, 3, 4.25, 9, 12.5, 40, 200):
        found = viewer.ask(
            f"motion.moveTo({tick}), plan.robots.map((_, i) =>"
            " [motion.x[i], motion.y[i], motion.activity[i]])"
        )
        for trip, (x, y, activity) in zip(trips_of(plan), found, strict=True):
            moment = trip.at(tick)
            tail, head = plane.points[moment.tail], plane.points[moment.head]
            middle = tail + (head - tail) * moment.share
            assert (x, y) == pytest.approx(tuple(middle), abs=1e-3)
            assert ["drive", "wait", "work", "turn", "done"][activity] == moment.activity.value


def test_names_are_text_and_nothing_else(show: Opener) -> None:
    evil = "</script><script>window.hacked=1</script><img src=x onerror=window.hacked=1>"
    viewer = show(hostile(evil), "#robot=" + evil.replace("<", "%3C"))
    assert viewer.text("#card h2") == evil
    assert evil in viewer.text("#card dl")
    viewer.page.click("#tab-decisions")
    assert evil in viewer.text("#decision-list")
    assert viewer.ask("window.hacked") is None
    assert (viewer.complaints, viewer.requests) == ([], [])
