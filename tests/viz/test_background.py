"""The picture under the map of the page: what is written of it, and where it lies."""

from fractions import Fraction
from pathlib import Path

import pytest
from PIL import Image

from rightofway.errors import InputError
from rightofway.site import Edge, make_grid_roadmap, make_roadmap
from rightofway.viz import Background, make_payload
from rightofway.viz.page.background import make_background_data
from rightofway.viz.page.schema import PlaceData
from tests.builders.plans import DOOR, door


def box_of(place: PlaceData) -> list[float]:
    """Return the upper left corner of a picture, and its size."""
    return [place["x"], place["y"], place["width"], place["height"]]


@pytest.fixture
def picture(tmp_path: Path) -> Path:
    """Return the path of a picture of 60 by 30 pixels."""
    path = tmp_path / "hall.png"
    Image.new("L", (60, 30), 200).save(path)
    return path


def test_a_picture_is_as_wide_as_the_map_and_lies_on_its_lower_border(picture: Path) -> None:
    # three cells from -0.5 to 2.5; 60 by 30 pixels are 3 by 1.5 cells
    found = make_background_data(make_grid_roadmap(DOOR), Background(picture=picture))
    assert box_of(found) == [-0.5, 1.0, 3.0, 1.5]
    assert found["href"].startswith("data:image/png;base64,")


def test_a_scale_is_the_length_of_a_pixel(picture: Path) -> None:
    roadmap = make_grid_roadmap(DOOR, cell_size=Fraction(1, 2))
    found = make_background_data(roadmap, Background(picture=picture, scale=0.05))
    assert box_of(found) == pytest.approx([-0.5, -0.5, 6.0, 3.0])


def test_an_origin_is_a_point_of_the_site(picture: Path) -> None:
    """As in a map of ROS: y grows upwards, the origin is the lower left pixel's corner."""
    edge = Edge(tail="a", head="b", length=Fraction(2))
    roadmap = make_roadmap({"a": (1, 5), "b": (3, 5)}, [edge], y_up=True)
    found = make_background_data(roadmap, Background(picture=picture, scale=0.1, origin=(0, 4)))
    # a unit of the drawing is the edge of 2; a is drawn at (0, 0); the origin is 1 left of a and
    # 1 below it; the picture is 6 by 3 length units
    assert box_of(found) == pytest.approx([-0.5, 0.5 - 1.5, 3.0, 1.5])


def test_a_portable_greymap_becomes_a_picture_that_browsers_show(tmp_path: Path) -> None:
    Image.new("L", (4, 2), 200).save(tmp_path / "map.pgm")
    found = make_background_data(make_grid_roadmap(DOOR), Background(picture=tmp_path / "map.pgm"))
    assert found["href"].startswith("data:image/png;base64,")


def test_what_is_no_picture_is_refused(tmp_path: Path) -> None:
    (tmp_path / "text.png").write_text("no picture")
    for name in ("text.png", "missing.png"):
        with pytest.raises(InputError, match=f"{name}: is no picture that can be read"):
            make_payload(door(), background=Background(picture=tmp_path / name))


def test_a_scale_and_an_opacity_without_sense_are_refused() -> None:
    with pytest.raises(InputError, match=r"background.scale: 0 is not positive"):
        Background(picture="a.png", scale=0)
    with pytest.raises(InputError, match=r"background.opacity: 2 is above 1"):
        Background(picture="a.png", opacity=2)
