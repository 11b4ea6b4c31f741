"""The page of an inspection as a document: what it is given, and that it brings nothing along."""

from __future__ import annotations

from fractions import Fraction

from rightofway.metrics import Site, inspect
from rightofway.model import Robot, Stop
from rightofway.site import Edge, VertexId, make_roadmap
from rightofway.units import Units
from rightofway.viz import make_inspection_page, make_site_data
from tests.builders.payloads import payload_in

EVIL = '</script><img src="x" onerror="alert(1)">'


def yard() -> Site:
    """Return two places on one lane, and a robot with a size."""
    edges = [Edge(tail=a, head=b, length=Fraction(2)) for a, b in ("AB", "BA")]
    roadmap = make_roadmap({"A": (0, 0), "B": (2, 0)}, edges)
    robot = Robot(name="R1", home=VertexId(0), stops=(Stop(at=VertexId(1)),), radius=Fraction(1, 2))
    return Site(roadmap=roadmap, units=Units(length="m", time="s"), robots=(robot,))


def test_a_level_has_its_map_its_robots_and_its_findings() -> None:
    site = yard()
    (level,) = payload_in(make_inspection_page([("", site, inspect(site))], title="yard"))["levels"]
    (robot,) = level["robots"]
    assert (robot["name"], robot["radius"], robot["vertices"]) == ("R1", 0.5, [0])
    assert robot["stages"] == [[1, 0, 0, -1]]
    assert level["map"]["names"] == ["A", "B"]
    assert len(level["findings"]) == len(inspect(site).findings)


def test_a_map_needs_no_plan() -> None:
    data = make_site_data(Site(roadmap=yard().roadmap))
    assert (data["robots"], data["map"]["width"], data["units"]) == (
        [], 2.0, {"length": None, "time": None},
    )  # fmt: skip


def test_names_bring_no_element_with_them() -> None:
    site = yard()
    page = make_inspection_page(
        [(EVIL, site, inspect(site))], title=EVIL, description=EVIL, notes=[EVIL]
    )
    assert "<img" not in page
    assert payload_in(page)["notes"] == [EVIL]
