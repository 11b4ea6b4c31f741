"""What keeps a thousand robots smooth: no frame does more than it must. No stopwatch is used."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import pytest

from tests.builders.plans import crowd
from tests.builders.players import overlap
from tests.viewer.conftest import Opener, pages

if TYPE_CHECKING:
    from playwright.sync_api import Browser

FRAMES = 20


@dataclass(frozen=True)
class Played:
    """What the page did in some frames: what it drew on the map, and on all canvases."""

    is_chosen: bool
    frames: int
    map: Counter[str]
    all: Counter[str]
    elements: int
    names: int  # on the map once time stands still


@pytest.fixture(scope="module", params=["#tick=20", "#tick=20&robot=Robot 7"])
def played(
    request: pytest.FixtureRequest, browser: Browser, tmp_path_factory: pytest.TempPathFactory
) -> Played:
    """Some frames of a thousand robots, with none chosen and with one."""
    with pages(browser, tmp_path_factory.mktemp("large")) as show:
        viewer = show(crowd(1000, decisions=300), request.param)
        viewer.page.get_by_role("combobox", name="Speed").select_option("8")
        viewer.painted()
        elements = viewer.page.locator("*").count()
        on_map, everywhere = viewer.calls("map"), viewer.calls()
        viewer.page.get_by_role("button", name="Play", exact=True).click()

        def frames() -> int:
            return viewer.calls("map")["clearRect"] - on_map["clearRect"]

        viewer.poll(lambda: frames() >= FRAMES, f"{FRAMES} frames")
        viewer.page.get_by_role("button", name="Pause").click()
        viewer.painted()
        found = Played(
            is_chosen=viewer.chosen is not None,
            frames=frames(),
            map=viewer.calls("map") - on_map,
            all=viewer.calls() - everywhere,
            elements=viewer.page.locator("*").count() - elements,
            names=len(viewer.names()),
        )
        assert viewer.complaints == []
    return found


def test_what_does_not_move_is_painted_once(played: Played) -> None:
    """Each frame clears the map and copies what does not move on it: no other canvas is cleared."""
    assert played.all["clearRect"] == played.frames
    assert played.all["drawImage"] == played.map["drawImage"] == played.frames
    assert played.all["fillRect"] == 0


def test_a_frame_draws_each_robot_once(played: Played) -> None:
    """At most a disc and two arcs (ring or dial) for each; names of nobody but the robot chosen."""
    assert 500 * played.frames < played.all["arc"] <= 3 * 1000 * played.frames
    assert played.all["fill"] <= 1000 * played.frames
    # a chosen robot has its name, and its home and stop have theirs
    names = 3 * played.frames * played.is_chosen
    assert played.all["fillText"] <= names + played.names  # the last frame stands still


@pytest.mark.parametrize("tick", [0, 20])
def test_four_hundred_robots_have_the_names_that_there_is_room_for(show: Opener, tick: int) -> None:
    """While time stands still; none of them is over another one."""
    viewer = show(crowd(400), f"#tick={tick}")
    names = [name for name in viewer.names() if name.text.startswith("Robot ")]
    assert len(names) >= 8
    assert len({name.text for name in names}) == len(names)
    for one, other in combinations(names, 2):
        assert not overlap(one.box, other.box), (one, other)


def test_the_page_does_not_grow_while_it_plays(played: Played) -> None:
    assert played.elements == 0


def test_lists_hold_the_rows_in_sight_only(show: Opener) -> None:
    viewer = show(crowd(1000, decisions=300))
    viewer.page.get_by_role("tab", name="Robots").click()
    robots = viewer.page.get_by_role("listbox", name="Robots")
    rows = robots.get_by_role("option", include_hidden=True)
    assert rows.first.get_attribute("aria-setsize") == "1000"
    assert rows.count() < 60
    robots.hover()
    viewer.page.mouse.wheel(0, 1e6)
    viewer.robot("Robot 1000").wait_for()
    assert rows.count() < 60


def test_nothing_is_painted_while_nothing_changes(show: Opener) -> None:
    viewer = show(crowd(1000))
    pictures = []
    for _ in range(2):
        for _ in range(10):
            viewer.painted()
        pictures.append(viewer.calls())
    assert pictures[0] == pictures[1]
    viewer.press("ArrowRight")
    assert viewer.calls() != pictures[1]
