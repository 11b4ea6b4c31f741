"""The moment as a link, as a picture and on paper."""

from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image

from tests.builders.plans import crowd, door
from tests.builders.players import Player
from tests.viewer.conftest import Opener


def picture_of(viewer: Player) -> tuple[str, tuple[int, int]]:
    """Save the picture, and return the name of its file and its size [pixels]."""
    with viewer.page.expect_download() as download:
        viewer.page.get_by_role("button", name="Picture").click()
    content = Path(download.value.path()).read_bytes()
    return download.value.suggested_filename, Image.open(BytesIO(content)).size


def test_a_link_to_the_moment_is_copied(show: Opener) -> None:
    viewer = show(door(), "#tick=4&robot=R2", permissions=["clipboard-read", "clipboard-write"])
    viewer.page.click("#copy-link")
    viewer.page.get_by_role("button", name="Copied").wait_for()
    copied = viewer.page.evaluate("navigator.clipboard.readText()")
    assert copied.endswith("plan.html#tick=4&robot=R2")


def test_the_picture_holds_map_and_diagram_and_is_called_after_file_and_moment(
    show: Opener,
) -> None:
    viewer = show(door(), "#tick=4", title="door.yaml")
    name, (width, height) = picture_of(viewer)
    assert name == "door at 4.png"
    map_, diagram = viewer.box(), viewer.box("#diagram")
    assert diagram["x"] >= map_["x"] + map_["width"]  # side by side, as on the screen
    assert width == pytest.approx(map_["width"] + diagram["width"], abs=1)  # in whole pixels
    assert height == pytest.approx(48 + max(map_["height"], diagram["height"]), abs=1)
    viewer.page.set_viewport_size({"width": 1600, "height": 1000})
    viewer.poll(lambda: viewer.box("#diagram")["x"] == 0, "the diagram below the map")
    viewer.painted()
    _, size = picture_of(viewer)
    map_, diagram = viewer.box(), viewer.box("#diagram")
    assert size == pytest.approx((map_["width"], 48 + map_["height"] + diagram["height"]), abs=1)
    assert (viewer.complaints, viewer.requests) == ([], [])


def test_paper_has_the_moment_and_a_table_in_light_colours(show: Opener) -> None:
    viewer = show(door(), "#tick=4", color_scheme="dark")
    dark = viewer.colour(viewer.on_map((1.25, 1.25)))
    viewer.lay_on_paper()
    assert viewer.text("#paper-moment") == "The map at time 4 of 10."
    assert viewer.text("#paper-robots").splitlines()[1:] == ["R1\t10\t9\t\t\t1", "R2\t9\t9\t\t\t"]
    assert viewer.colour(viewer.on_map((1.25, 1.25))) != dark
    assert not viewer.page.locator("#play").is_visible()
    viewer.take_from_paper()
    assert viewer.colour(viewer.on_map((1.25, 1.25))) == dark


def test_the_table_on_paper_has_the_robots_that_lose_most(show: Opener) -> None:
    viewer = show(crowd(120))
    viewer.lay_on_paper()
    rows = viewer.page.locator("#paper-robots tr").all_text_contents()
    assert len(rows) == 1 + 50 + 1
    assert rows[-1] == "and 70 more, which lose less"
