"""Sizes that only another unit explains: named with that unit, and never of a site as sites are."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest

from rightofway.io import load_with_notes
from rightofway.io.sites import Choice, read_sites
from rightofway.metrics import Site, inspect
from rightofway.site import Edge, make_roadmap
from rightofway.site.scale import find_odd_sizes
from rightofway.units import Units
from tests.builders.pages import ROOT

HALL = {"A": (0, 0), "B": (66, 0), "C": (66, 36), "D": (0, 36)}
"""The corners of a hall [m]."""


def find_odd(unit: str, factor: Fraction, radius: Fraction, offset: int = 0) -> list[str]:
    """Return what is odd about the hall where its numbers are multiples of metres."""
    at = {
        name: (float(offset + x * factor), float(offset + y * factor))
        for name, (x, y) in HALL.items()
    }
    long = 1000 * max(factor, Fraction(1))
    edges = [Edge(tail=tail, head=head, length=long) for tail, head in ("AB", "BC", "CD", "DA")]
    roadmap = make_roadmap(at, edges)
    units = Units(length=unit, time="s")  # type: ignore[arg-type]
    return [
        f"{fact} ({remedy})"
        for fact, remedy in find_odd_sizes(Site(roadmap=roadmap, units=units), radius)
    ]


@pytest.mark.parametrize(
    ("unit", "factor", "offset", "words"),
    [
        ("m", 1000, 0, "The site is 66000 x 36000 m large (if its numbers are mm, convert"),
        ("cm", 10_000, 0, "The site is 660000 x 360000 cm large (if its numbers are mm"),
        ("m", "1/1000", 0, "The site is 0.07 x 0.04 m large (if its numbers are km"),
        ("mm", 1, 0, "The site is 66 x 36 mm large (if its numbers are m, convert"),
        ("cm", "1/10", 0, "The site is 6.6 x 3.6 cm large (if its numbers are m, convert"),
        ("m", "1/111000", 53, "(if its numbers are degrees, convert them to m)"),
    ],
)
def test_a_site_in_another_unit_is_named_with_it(
    unit: str, factor: int | str, offset: int, words: str
) -> None:
    [found] = find_odd(unit, Fraction(factor), Fraction(0), offset)
    assert words in found


@pytest.mark.parametrize(("unit", "factor"), [("m", 1), ("cm", 100), ("mm", 1000)])
def test_a_radius_in_another_unit_is_named_with_it(unit: str, factor: int) -> None:
    assert find_odd(unit, Fraction(factor), Fraction(2 * factor, 5)) == []
    [found] = find_odd(unit, Fraction(factor), Fraction(400 * factor))
    assert found.startswith(f"A robot has a radius of {400 * factor} {unit} (if it is")


def test_nothing_is_known_of_lengths_without_a_unit() -> None:
    edge = Edge(tail="A", head="B", length=Fraction(10**9))
    roadmap = make_roadmap({"A": (0.0, 0.0), "B": (1e9, 0.0)}, [edge])
    assert list(find_odd_sizes(Site(roadmap=roadmap), Fraction(10**10))) == []


FILES = sorted(
    path
    for folder in (ROOT / "tests" / "data" / "samples", ROOT / "examples")
    for path in folder.rglob("*")
    if path.suffix in {".xml", ".json", ".yaml", ".geojson", ".map", ".graphml"}
    and "paper" not in path.parts
    and path.name not in {"campus.building.yaml", "warehouse_keepout.yaml"}  # are refused
)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_no_sample_and_no_example_is_odd(path: Path) -> None:
    sites = read_sites(path, Choice())
    assert not any("degrees" in str(note) for note in sites.notes)
    for _, site in sites.sites:
        assert list(find_odd_sizes(site, site.radii[0])) == []


def test_degrees_are_found_by_inspect_and_by_a_plan(tmp_path: Path) -> None:
    """Two points of Hamburg in degrees, 22 m apart, with the crs of GPS."""
    places = {0: [9.99001, 53.55001], 1: [9.99023, 53.55007]}
    points = [
        {"type": "Feature", "properties": {"id": key},
         "geometry": {"type": "Point", "coordinates": place}}
        for key, place in places.items()
    ]  # fmt: skip
    lanes = [
        {"type": "Feature", "properties": {"id": 10 + tail, "startid": tail, "endid": 1 - tail},
         "geometry": {"type": "LineString"}}
        for tail in places
    ]  # fmt: skip
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::4326"}}
    layout = tmp_path / "degrees.geojson"
    collection = {"type": "FeatureCollection", "crs": crs, "features": [*points, *lanes]}
    layout.write_text(json.dumps(collection), encoding="utf-8")
    sites = read_sites(layout, Choice())
    assert any("4326 has degrees" in str(note) for note in sites.notes)
    [(_, site)] = sites.sites
    [found] = [each for each in inspect(site).findings if each.kind == "scale"]
    assert found.severity == "warning"
    assert "degrees" in str(found.remedy)
    scenario = {
        "format": "rightofway-scenario/1",
        "map": {"layout": layout.name},
        "robots": [{"name": "R1", "home": "0", "target": "1"}],
    }
    path = tmp_path / "scenario.json"
    path.write_text(json.dumps(scenario), encoding="utf-8")
    assert any("if its numbers are degrees" in str(note) for note in load_with_notes(path).notes)
