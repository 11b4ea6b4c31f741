"""Sentences and plain data on findings of an inspection."""

from __future__ import annotations

from fractions import Fraction

from rightofway.facts import Fact
from rightofway.metrics import Finding, Site, inspect
from rightofway.model import Robot, Stop
from rightofway.report.facts import FactWriter
from rightofway.report.inspection import describe_finding, describe_site, export_finding
from rightofway.site import VertexId, make_grid_roadmap
from rightofway.units import Units

CELLS = make_grid_roadmap(["...", "..."])
METRES = Units(length="m", time="s")
ROBOT = Robot(name="R1", home=VertexId(0), stops=(Stop(at=VertexId(4)),))


def test_a_cell_goes_by_its_middle_where_lengths_have_a_unit() -> None:
    """Cells of a grid without a unit go by the number that people write in its file."""
    robots = (ROBOT,)
    measured = FactWriter(Site(roadmap=CELLS, units=METRES, robots=robots))
    assert measured.name_place(4) == "(1.5, 1.5, stop of R1)"
    assert measured.name_place(0) == "(0.5, 0.5, home of R1)"
    assert FactWriter(Site(roadmap=CELLS, units=METRES)).name_place(5) == "(2.5, 1.5)"
    assert FactWriter(Site(roadmap=CELLS, robots=robots)).name_place(4) == "N4 (stop of R1)"


def test_a_place_without_robots_goes_by_its_station() -> None:
    site = Site(roadmap=CELLS, stations={"Press": 1, "N2": 2}, parking={"P": 3})
    named = list(map(FactWriter(site).name_place, range(4)))
    assert named == ["N0", "N1 (station Press)", "N2 (station)", "N3 (parking)"]


def test_a_finding_is_plain_data_and_a_sentence() -> None:
    """Distances are numbers, robots and vertices have their names, parts are facts."""
    site = Site(roadmap=CELLS, units=METRES, robots=(ROBOT,))
    need = Fact("room for robots", sizes=(Fraction(1, 2),), room=Fraction(1))
    finding = Finding(
        kind="too near",
        severity="note",
        fact=Fact("lanes near each other", site, one=(0, 1), other=(1, 2), need=need),
        remedy=Fact("park aside", site, place=5, distance=Fraction(3)),
        vertices=("N0", "N1", "N2"),
        robots=("R1",),
    )
    fact, remedy = describe_finding(site, finding)
    assert fact == (
        "The lane N0 to N1 is too near to the lane N1 to N2; robots of radius 0.5 m need 1 m"
    )
    assert str(finding) == f"{fact} ({remedy})"
    assert export_finding(site, finding) == {
        "kind": "too near",
        "severity": "note",
        "fact": {
            "kind": "lanes near each other",
            "values": {
                "one": ["N0", "N1"],
                "other": ["N1", "N2"],
                "need": {"kind": "room for robots", "values": {"sizes": [0.5], "room": 1}},
            },
        },
        "remedy": {"kind": "park aside", "values": {"place": "N5", "distance": 3}},
        "vertices": ["N0", "N1", "N2"],
        "robots": ["R1"],
        "sentence": str(finding),
    }


def test_the_sizes_of_many_parts_are_cut_and_counted() -> None:
    """Ten cells apart from each other: seven sizes, and three more."""
    site = Site(roadmap=make_grid_roadmap([".@" * 10]))
    _, parts = describe_site(site, inspect(site))
    assert parts == "10 strongly connected parts, of 1, 1, 1, 1, 1, 1, 1 and 3 more vertices."
