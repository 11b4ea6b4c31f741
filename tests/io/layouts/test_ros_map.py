"""Pixels of ROS maps become free, occupied or unknown as the map server has it."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from rightofway.errors import InputError
from rightofway.io import read_layout
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.io.scenario.reader import read_scenario
from rightofway.io.sites import Choice, read_sites
from rightofway.site.occupancy import FREE, OCCUPIED, UNKNOWN, Occupancy

YAML = "image: a.png\nresolution: 1\norigin: [0, 0, 0]\nfree_thresh: 0.196\noccupied_thresh: 0.65\n"


def pixels(folder: Path, picture: Image.Image, more: str = "negate: 0", name: str = "a.png") -> str:
    """Return what a row of pixels is: a dot for free, ``?`` for unknown, ``@`` for occupied."""
    picture.save(folder / name)
    (folder / "a.yaml").write_text(YAML.replace("a.png", name) + more, "utf-8")
    found = read_layout(folder / "a.yaml")
    assert isinstance(found, Occupancy)
    shown = {FREE: ".", UNKNOWN: "?", OCCUPIED: "@"}
    return "".join(shown[pixel] for pixel in found.pixels[0].tolist())


def grey(*values: int) -> Image.Image:
    return Image.fromarray(np.array([values], np.uint8))


def test_dark_is_occupied_between_the_thresholds_unknown(tmp_path: Path) -> None:
    """Darkness of 205 is 50/255 = 0.19608, just above 0.196; of 89 and 90 0.651 and 0.647."""
    assert pixels(tmp_path, grey(0, 89, 90, 205, 206, 254, 255)) == "@@??..."


def test_light_is_occupied_where_the_map_is_negated(tmp_path: Path) -> None:
    assert pixels(tmp_path, grey(0, 49, 50, 165, 166, 255), "negate: 1") == "..??@@"
    assert pixels(tmp_path, grey(0, 255), "negate: true") == ".@"


def test_what_costs_in_a_scaled_map_is_not_free(tmp_path: Path) -> None:
    assert pixels(tmp_path, grey(0, 150, 254), "negate: 0\nmode: scale") == "@?."


def test_raw_pixels_are_occupancies(tmp_path: Path) -> None:
    more = "negate: 0\nmode: raw"
    assert pixels(tmp_path, grey(0, 1, 99, 100, 101, 255), more) == ".??@??"


def test_clear_pixels_are_unknown(tmp_path: Path) -> None:
    colours = np.array([[[255, 255, 255, 255], [255, 255, 255, 254], [0, 0, 0, 255]]], np.uint8)
    assert pixels(tmp_path, Image.fromarray(colours)) == ".?@"


def test_the_darkness_of_a_colour_is_the_mean_of_its_channels(tmp_path: Path) -> None:
    """(255, 255, 0) has 1/3 of darkness, (255, 0, 0) 2/3."""
    colours = np.array([[[255, 255, 0], [255, 0, 0], [255, 255, 255]]], np.uint8)
    assert pixels(tmp_path, Image.fromarray(colours)) == "?@."


def test_pictures_of_16_bits_are_read_exactly(tmp_path: Path) -> None:
    """52690 is 0.19600 dark, 52691 less than that: 65535 * 0.804 = 52690.14."""
    wide = Image.fromarray(np.array([[0, 52690, 52691, 65535]], np.uint16))
    assert pixels(tmp_path, wide) == "@?.."
    assert pixels(tmp_path, wide, name="a.pgm") == "@?.."


@pytest.mark.parametrize("name", ["a.pgm", "a.bmp", "a.png"])
def test_formats_of_pictures(tmp_path: Path, name: str) -> None:
    assert pixels(tmp_path, grey(0, 254), name=name) == "@."


def test_a_map_is_cut_into_cells_of_half_a_metre_unless_it_is_said(tmp_path: Path) -> None:
    """In every command, whether a scenario names the map or `inspect` reads it alone."""
    pixels(tmp_path, Image.new("L", (40, 40), 255))
    (tmp_path / "a.yaml").write_text(YAML.replace("resolution: 1", "resolution: 0.1") + "negate: 0")
    robots = [{"name": "R1", "home": "N0", "target": "N63"}]
    drawn = {"layout": str(tmp_path / "a.yaml")}
    scenario = read_scenario(
        {"format": SCENARIO_FORMAT, "map": drawn, "robots": robots}, tmp_path
    ).scenario
    ((_, site),) = read_sites(tmp_path / "a.yaml", Choice()).sites
    for roadmap in (scenario.roadmap, site.roadmap):
        assert roadmap.grid is not None
        assert (roadmap.grid.columns, roadmap.grid.cell_size) == (8, Fraction(1, 2))


def test_pictures_that_would_fill_the_memory_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.pgm").write_bytes(b"P5 60000 60000 255\n" + bytes(100))
    (tmp_path / "a.yaml").write_text(YAML.replace("a.png", "a.pgm"), "utf-8")
    with pytest.raises(InputError, match="more than 64000000"):
        read_layout(tmp_path / "a.yaml")


def test_half_a_picture_is_refused(tmp_path: Path) -> None:
    grey(*range(256)).save(tmp_path / "a.png")
    data = (tmp_path / "a.png").read_bytes()
    (tmp_path / "a.png").write_bytes(data[: len(data) // 2])
    (tmp_path / "a.yaml").write_text(YAML, "utf-8")
    with pytest.raises(InputError, match="the picture cannot be read"):
        read_layout(tmp_path / "a.yaml")
