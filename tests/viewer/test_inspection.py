"""The page of an inspection: the site drawn, findings as a list, a click lights the place."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from rightofway.io.sites import Choice, read_sites
from rightofway.metrics import inspect
from rightofway.report.inspection import describe_site
from rightofway.viz import write_inspection
from rightofway.viz.palette import LIGHT
from tests.builders.players import Player

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator

LAYOUTS = Path(__file__).parents[1] / "data" / "layouts"

Open = Callable[..., Player]


@pytest.fixture
def inspected(browser: Browser, tmp_path: Path) -> Iterator[Open]:
    contexts = []

    def open_page(source: Path, **context: Any) -> Player:
        found = read_sites(source, Choice())
        levels = [(name, site, inspect(site)) for name, site in found.sites]
        path = tmp_path / "site.html"
        write_inspection(
            levels, path, title=source.name, description=found.description, notes=found.notes
        )
        contexts.append(browser.new_context(**{"reduced_motion": "reduce", **context}))
        viewer = Player(contexts[-1].new_page())
        viewer.page.goto(path.as_uri())
        viewer.painted()
        return viewer

    yield open_page
    for context in contexts:
        context.close()


@pytest.fixture
def crossing(tmp_path: Path) -> Path:
    """Return a layout of two lanes that cross without a vertex; no lane leads to E."""
    (tmp_path / "nodes.csv").write_text("name,x,y\nA,0,0\nB,8,0\nC,4,-4\nD,4,4\nE,6,4\n")
    (tmp_path / "edges.csv").write_text(
        "from,to,both_ways\nA,B,true\nC,D,true\nB,D,true\nE,D,false\n"
    )
    return tmp_path / "nodes.csv"


def findings(viewer: Player) -> Locator:
    """Return the rows of the list."""
    return viewer.page.get_by_role("listbox", name="Findings").get_by_role("option")


def lit(viewer: Player) -> list[tuple[float, float]]:
    """Return where places are lit by a ring [pixels]."""
    return [
        (ring.x, ring.y)
        for ring in viewer.discs()
        if ring.colour == LIGHT.held and not ring.is_filled
    ]


@pytest.mark.parametrize("name", ["hall.lif.json", "plant.xml", "room.yaml", "hall.building.yaml",
                                  "route.geojson", "two-rooms.map", "hall.graphml"])  # fmt: skip
def test_every_format_has_a_page(inspected: Open, name: str) -> None:
    viewer = inspected(LAYOUTS / name)
    assert viewer.complaints == []
    assert viewer.text("#headline").startswith(name)


def test_the_page_has_the_words_of_the_command(inspected: Open, crossing: Path) -> None:
    (_, site), *_ = read_sites(crossing, Choice()).sites
    result = inspect(site)
    viewer = inspected(crossing)
    assert viewer.text("#size") == " ".join(describe_site(site, result))
    titles = [row.get_attribute("title") for row in findings(viewer).all()]
    assert titles == [str(finding) for finding in result.findings]


def test_a_click_on_a_finding_lights_its_place(inspected: Open, crossing: Path) -> None:
    viewer = inspected(crossing)
    viewer.page.click("#finding-list .row:has-text('cross without a vertex')")
    places = viewer.all_on_map([(0, 0), (8, 0), (4, -4), (4, 4)])  # A to D
    assert lit(viewer) == [pytest.approx(place) for place in places]
    assert "The lanes A to B and C to D cross without a vertex." in viewer.text("#card")
    viewer.press("Escape")
    assert lit(viewer) == []
    assert not viewer.page.is_visible("#card")


def test_a_click_on_a_place_chooses_its_findings_in_turn(inspected: Open, crossing: Path) -> None:
    viewer = inspected(crossing)
    viewer.page.mouse.click(*viewer.at((6, 4)))  # E
    assert viewer.chosen == "Warning: unreachable"


def test_findings_are_found_by_words(inspected: Open, crossing: Path) -> None:
    viewer = inspected(crossing)
    viewer.page.keyboard.press("/")
    viewer.page.keyboard.type("crossing")
    (found,) = findings(viewer).all_inner_texts()
    assert "cross without a vertex" in found
    viewer.press("Enter")
    assert viewer.chosen == "Warning: crossing"


def test_levels_are_chosen_in_the_head(inspected: Open) -> None:
    viewer = inspected(LAYOUTS / "hall.building.yaml")
    levels = {"L1": {"dock", "v1", "shelf"}, "L2": {"stairs", "top"}}
    for level, named in levels.items():
        viewer.page.get_by_label("Level").select_option(label=level)
        assert {name.text for name in viewer.names()} & set().union(*levels.values()) == named
        site = viewer.page.get_by_role("img", name=f"Map with {len(named)} vertices", exact=True)
        assert site.is_visible()
    assert viewer.complaints == []


def test_a_fleet_stands_at_its_homes_in_its_true_size(inspected: Open, tmp_path: Path) -> None:
    (tmp_path / "hall.yaml").write_text(
        "format: rightofway-scenario/1\n"
        "map: {roadmap: {vertices: {A: [0, 0], B: [2, 0]}, edges: [[A, B]]}}\n"
        "robots:\n- {name: R1, home: A, target: B, radius: 0.5}\n"
        "- {name: R2, home: B, target: A, radius: 0.75}\n"
    )
    viewer = inspected(tmp_path / "hall.yaml")
    for place, radius in (((0, 0), 0.5), ((2, 0), 0.75)):
        at = pytest.approx(viewer.on_map(place))
        radii = [disc.radius for disc in viewer.discs() if (disc.x, disc.y) == at]
        assert any(each == pytest.approx(radius * viewer.view[0]) for each in radii), place
    assert viewer.complaints == []


@pytest.mark.parametrize("size", [(390, 844), (844, 390), (1280, 720), (3840, 2160)], ids=str)
def test_the_page_fits_every_screen(inspected: Open, size: tuple[int, int]) -> None:
    viewer = inspected(LAYOUTS / "plant.xml", viewport={"width": size[0], "height": size[1]})
    assert viewer.page.locator("html").evaluate("(it) => it.scrollWidth") == size[0]
    assert viewer.page.is_visible("#map")


def test_the_paper_has_all_findings(inspected: Open, crossing: Path) -> None:
    viewer = inspected(crossing)
    viewer.lay_on_paper()
    assert "cross without a vertex" in viewer.text("#paper-findings")
