"""The moment as a link, as a picture and on paper."""

from tests.builders.plans import crowd, door
from tests.viewer.conftest import Opener


def test_a_link_to_the_moment_is_copied(show: Opener) -> None:
    viewer = show(door(), "#tick=4&robot=R2", permissions=["clipboard-read", "clipboard-write"])
    viewer.page.click("#copy-link")
    viewer.wait_for("document.getElementById('copy-link').textContent === 'Copied'")
    copied = viewer.ask("navigator.clipboard.readText()")
    assert copied.endswith("plan.html#tick=4&robot=R2")


def test_the_picture_holds_map_and_diagram_and_is_called_after_file_and_moment(
    show: Opener,
) -> None:
    viewer = show(door(), "#tick=4", title="door.yaml")
    with viewer.page.expect_download() as download:
        viewer.page.click("#save-picture")
    assert download.value.suggested_filename == "door at 4.png"
    size = viewer.ask("(({width, height}) => [width, height])(share.picture())")
    heights = viewer.ask("[mapView.canvas.height, diagram.canvas.height]")
    width = viewer.ask("mapView.canvas.width + diagram.canvas.width")
    assert size == [width, 48 + max(heights)]  # side by side, as on the screen
    viewer.page.set_viewport_size({"width": 1600, "height": 1000})
    viewer.wait_for("diagram.canvas.getBoundingClientRect().left === 0 && !frames.asked")
    size = viewer.ask("(({width, height}) => [width, height])(share.picture())")
    heights = viewer.ask("[mapView.canvas.height, diagram.canvas.height]")
    assert size == [viewer.ask("mapView.canvas.width"), 48 + sum(heights)]
    assert (viewer.complaints, viewer.requests) == ([], [])


def test_paper_has_the_moment_and_a_table_in_light_colours(show: Opener) -> None:
    viewer = show(door(), "#tick=4", color_scheme="dark")
    dark = viewer.ask("theme.paper")
    viewer.ask("paper.lay(true)")
    viewer.page.emulate_media(media="print")
    assert viewer.text("#paper-moment") == "The map at time 4 of 10."
    assert viewer.text("#paper-robots").splitlines()[1:] == ["R1\t10\t9\t\t\t1", "R2\t9\t9\t\t\t"]
    assert viewer.ask("theme.paper") != dark
    assert not viewer.page.locator("#play").is_visible()
    viewer.ask("paper.lay(false)")
    assert viewer.ask("theme.paper") == dark


def test_the_table_on_paper_has_the_robots_that_lose_most(show: Opener) -> None:
    viewer = show(crowd(120))
    viewer.ask("paper.lay(true)")
    rows = viewer.page.locator("#paper-robots tr").all_text_contents()
    assert len(rows) == 1 + 50 + 1
    assert rows[-1] == "and 70 more, which lose less"
