"""The page plays a plan: clock, slider, keys, motion."""

import pytest

from tests.builders.plans import door, hostile, loop
from tests.viewer.conftest import Opener


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_page_loads_without_complaint_and_without_the_network(show: Opener, scheme: str) -> None:
    viewer = show(door(), color_scheme=scheme)
    assert viewer.text("#headline") == "2 robots"
    assert (viewer.complaints, viewer.requests) == ([], [])


def test_play_lets_time_run_and_pause_stops_it(show: Opener) -> None:
    viewer = show(door())
    viewer.page.click("#play")
    viewer.poll(lambda: viewer.tick > 0.2, "a later moment")
    viewer.page.get_by_role("button", name="Pause").click()
    stopped = viewer.tick
    for _ in range(5):
        viewer.painted()
    assert viewer.tick == stopped
    assert viewer.page.get_by_role("button", name="Play", exact=True).is_visible()


def test_it_plays_by_itself_unless_the_user_wants_less_motion(show: Opener) -> None:
    for wish, button in (("no-preference", "Pause"), ("reduce", "Play")):
        viewer = show(door(), reduced_motion=wish)
        assert viewer.page.get_by_role("button", name=button, exact=True).is_visible()


def test_a_plan_stops_at_its_end_and_starts_again_from_there(show: Opener) -> None:
    viewer = show(door(), "#tick=9.9")
    viewer.page.keyboard.press("Space")
    viewer.page.get_by_role("button", name="Play", exact=True).wait_for()
    assert viewer.tick == 10
    viewer.page.keyboard.press("Space")
    viewer.poll(lambda: viewer.tick < 5, "the beginning")


def test_the_slider_seeks(show: Opener) -> None:
    viewer = show(door())
    viewer.page.fill("#slider", "4")
    assert viewer.tick == 4
    assert viewer.text("#readout") == "4 of 10"


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
    assert viewer.tick == tick


def test_events_are_those_of_the_chosen_robot(show: Opener) -> None:
    """The cart drives at 0 and 2, works from 4, turns from 8, waits from 10, drives from 11."""
    viewer = show(loop(), "#tick=4&robot=Cart")
    seen = []
    for _ in range(4):
        viewer.page.keyboard.press("Shift+ArrowRight")
        seen.append(viewer.tick)
    viewer.page.keyboard.press("Shift+ArrowLeft")
    assert [*seen, viewer.tick] == [8, 10, 11, 14, 11]


@pytest.mark.parametrize(("tick", "shown"), [(7, "3.5 of 8"), (0.5, "0.25 of 8"), (4, "2 of 8")])
def test_the_clock_shows_the_very_moment_in_units(show: Opener, tick: float, shown: str) -> None:
    """A tick is half a unit; a moment within a tick is shown, too."""
    assert show(loop(), f"#tick={tick}").text("#readout") == shown


def test_names_are_text_and_nothing_else(show: Opener) -> None:
    evil = "</script><script>alert(1)</script><img src=x onerror=alert(1)>"
    viewer = show(hostile(evil), "#robot=" + evil.replace("<", "%3C"))
    assert viewer.text("#card h2") == evil
    assert evil in viewer.text("#card dl")
    viewer.page.click("#tab-decisions")
    assert evil in viewer.text("#decision-list")
    assert viewer.page.locator("img").count() == 0
    # a script that came through would be refused by the policy of the page, and that complained of
    assert (viewer.complaints, viewer.requests) == ([], [])
