"""What keeps a thousand robots smooth: no frame does more than it must. No stopwatch is used."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from tests.builders.plans import crowd
from tests.viewer.conftest import Opener, pages

if TYPE_CHECKING:
    from playwright.sync_api import Browser

COUNT_CALLS = """
window.calls = {};
for (const name of ["arc", "fill", "stroke", "drawImage", "fillRect", "fillText"]) {
  const draw = CanvasRenderingContext2D.prototype[name];
  CanvasRenderingContext2D.prototype[name] = function (...args) {
    window.calls[name] = (window.calls[name] ?? 0) + 1;
    return draw.apply(this, args);
  };
}
window.searches = 0;
const search = lastAtMost;
lastAtMost = function (...args) { window.searches++; return search(...args); };
"""

PLAY_FRAMES = """
async (count) => {
  clock.setRate(8);
  clock.play();
  const first = frames.count;
  const before = { base: mapView.base.paintings, diagram: diagram.layer.paintings,
                   elements: document.querySelectorAll("*").length };
  while (frames.count < first + count) await new Promise((done) => setTimeout(done, 20));
  clock.pause();
  const searches = window.searches;
  motion.moveTo(0);
  return { frames: frames.count - first, calls: window.calls, searches,
           searchesBack: window.searches - searches,
           base: mapView.base.paintings - before.base,
           diagram: diagram.layer.paintings - before.diagram,
           elements: document.querySelectorAll("*").length - before.elements };
}
"""


@pytest.fixture(scope="module", params=["#tick=20", "#tick=20&robot=Robot 7"])
def played(
    request: pytest.FixtureRequest, browser: Browser, tmp_path_factory: pytest.TempPathFactory
) -> dict[str, Any]:
    """Twenty frames of a thousand robots, with none chosen and with one."""
    with pages(browser, tmp_path_factory.mktemp("large")) as show:
        viewer = show(crowd(1000, decisions=300), request.param)
        viewer.ask(f"() => {{ {COUNT_CALLS} }}")
        found: dict[str, Any] = viewer.page.evaluate(PLAY_FRAMES, 20)
        found["chosen"] = viewer.ask("choice.robotIndex >= 0")
        assert viewer.complaints == []
    return found


def test_what_does_not_move_is_painted_once(played: dict[str, Any]) -> None:
    assert (played["base"], played["diagram"]) == (0, 0)
    assert played["calls"]["drawImage"] == played["frames"]
    assert "fillRect" not in played["calls"]


def test_a_frame_draws_each_robot_once(played: dict[str, Any]) -> None:
    """At most a disc and two arcs (ring or dial) for each; names of nobody but the robot chosen."""
    assert 500 * played["frames"] < played["calls"]["arc"] <= 3 * 1000 * played["frames"]
    assert played["calls"]["fill"] <= 1000 * played["frames"]
    # a chosen robot has its name, and its home and stop have theirs
    assert played["calls"].get("fillText", 0) <= 3 * played["frames"] * played["chosen"]


def test_robots_go_on_from_where_they_were(played: dict[str, Any]) -> None:
    """While time runs on nobody is searched for in a plan; a jump back searches for them."""
    assert played["searches"] == 0
    assert played["searchesBack"] > 500


def test_the_page_does_not_grow_while_it_plays(played: dict[str, Any]) -> None:
    assert played["elements"] == 0


def test_lists_hold_the_rows_in_sight_only(show: Opener) -> None:
    viewer = show(crowd(1000, decisions=300))
    viewer.page.click("#tab-robots")
    assert viewer.ask("robotList.list.items.length") == 1000
    assert viewer.ask("document.querySelectorAll('#robot-list .row').length") < 60
    viewer.page.evaluate("robotList.list.box.scrollTop = 1e6")
    viewer.page.wait_for_selector("#robot-list .row:has-text('Robot 1000')")


def test_nothing_is_painted_while_nothing_changes(show: Opener) -> None:
    viewer = show(crowd(1000))
    viewer.ask("new Promise((done) => setTimeout(done, 200))")
    count = viewer.ask("frames.count")
    viewer.ask("new Promise((done) => setTimeout(done, 200))")
    assert viewer.ask("frames.count") == count
