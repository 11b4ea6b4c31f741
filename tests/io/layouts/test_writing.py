"""A round trip loses nothing that both formats can say, and names what it loses."""

from dataclasses import replace
from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.io import LAYOUT_WRITERS, format_layout, read_layout
from rightofway.io.layouts.writing import PASSED_VERTICES
from rightofway.site.layout import Layout, Level

HERE = Path(__file__).parents[2] / "data" / "layouts"
LEVELS = [
    ("hall.lif.json", None), ("route.geojson", None), ("hall.graphml", None), ("plant.xml", None),
    ("nodes.csv", None), ("hall.nav.yaml", "L1"), ("hall.building.yaml", "L2"),
]  # fmt: skip


def single(file: str, level: str | None) -> Layout:
    found = read_layout(HERE / file)
    assert isinstance(found, Layout)
    return replace(found, levels=(found.get_level(level),))


def known_to_all(level: Level) -> list[object]:
    """Return what every format says: where vertices lie, and how fast robots drive between them."""
    numbers = {vertex.name: number for number, vertex in enumerate(level.vertices)}
    lanes = {(numbers[edge.tail], numbers[edge.head], edge.max_speed) for edge in level.edges}
    return [[vertex.at for vertex in level.vertices], sorted(lanes, key=str)]


def known_to(level: Level, says: frozenset[str]) -> list[object]:
    """Return what a format says that has a place for some things."""
    own = {
        "names of vertices": [vertex.name for vertex in level.vertices],
        "stations": level.stations,
        "parking places": [vertex.is_parking for vertex in level.vertices],
        "charging places": [vertex.is_charging for vertex in level.vertices],
        "actions of vertices": [
            [(use, action) for use, action in vertex.actions if use != "work"]
            for vertex in level.vertices
        ],
        PASSED_VERTICES: [vertex.is_passed for vertex in level.vertices],
        "lanes longer than the straight line": [edge.length for edge in level.edges],
        "drawn curves": [edge.shape for edge in level.edges],
        "curves that robots drive along": [
            edge.shape for edge in level.edges if edge.chord_error is not None
        ],
        "vehicle types": level.vehicle_types,
        "ids of lanes": level.edge_ids,
        "headings at vertices": [vertex.heading for vertex in level.vertices],
        "orientations along lanes": level.orientations,
        "forbidden turns": [
            ends
            for ends, turns in sorted(level.turns.items())
            if not all(own.at_begin and own.at_end for own in turns.values())
        ],
        "zones": level.zones,
    }
    return [own[what] for what in sorted(says - {"levels"})]


@pytest.mark.parametrize(("file", "level"), LEVELS)
@pytest.mark.parametrize("name", LAYOUT_WRITERS)
def test_what_is_written_is_read_back(
    name: str, file: str, level: str | None, tmp_path: Path
) -> None:
    layout = single(file, level)
    text, _ = format_layout(layout, name)
    path = tmp_path / "layout"
    path.write_text(text, encoding="utf-8")
    again = read_layout(path)
    assert isinstance(again, Layout)
    old, new = layout.levels[0], again.levels[0]
    assert known_to_all(new) == known_to_all(old)
    says = LAYOUT_WRITERS[name].says
    if not old.vehicle_types:  # a LIF lane with a speed limit names a type
        says -= {"vehicle types"}
    if len({*old.edge_ids.values()}) < len(old.edges):  # a LIF lane has an id of its own
        says -= {"ids of lanes"}
    assert known_to(new, says) == known_to(old, says)
    assert format_layout(again, name) == (text, ())


def test_losses_are_named_and_counted() -> None:
    (loss,) = format_layout(single("plant.xml", None), "graphml")[1]
    names = (
        "stations (2: Socket and Saw 1), actions of vertices without loads (1: End), ids of lanes"
        " (4: Dock --- Cross, Dock --- Cross, Cross --- End and End --- Dock) and zones (1:"
        " Crossing)"
    )
    assert str(loss) == f"left out, the format has no place for them: {names}"
    losses = format_layout(single("hall.lif.json", None), "nav2")[1]
    assert str(losses[0]).endswith(
        "names of vertices (4: P1, A, B and C), stations (1: Press), charging places (1: P1)"
        " and vehicle types (2: forklift and tugger)"
    )


def test_a_format_of_one_level_refuses_a_building() -> None:
    found = read_layout(HERE / "hall.nav.yaml")
    assert isinstance(found, Layout)
    with pytest.raises(InputError, match=r"2 levels, and nav2 knows one \(write lif or open-rmf\)"):
        format_layout(found, "nav2")
    assert [level.name for level in found.levels] == ["L1", "L2"]
