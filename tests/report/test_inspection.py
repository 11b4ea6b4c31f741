"""Sentences and plain data on findings of an inspection."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

from rightofway.facts import Fact
from rightofway.metrics import Finding, Site, inspect
from rightofway.model import Robot, Stop
from rightofway.report.facts import FactWriter
from rightofway.report.inspection import describe_finding, describe_site, export_finding
from rightofway.site import VertexId, make_grid_roadmap
from rightofway.units import Units
from tests.builders.languages import translate

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


def test_findings_on_jobs_and_a_well_formed_fleet_have_sentences_in_both_languages() -> None:
    site = Site(roadmap=CELLS, robots=(ROBOT, replace(ROBOT, name="R2", home=VertexId(2))))
    writer = FactWriter(site)
    own: dict[str, Any] = {"job": "J1", "robot": 0, "place": 4}
    shares = {"need": Fraction(91, 100), "most": Fraction(9, 10)}
    facts = [
        (Fact("job without robot", site, job="J1"), "no robot may do J1 and can carry it"),
        (Fact("job without way", site, **own), "R1 has no way to N4 (stop of R1 and R2) for J1"),
        (Fact("job through homes", site, **own), "only through homes of other robots"),
        (
            Fact("job beyond battery", site, **own, **shares),
            "J1 takes 91 % of a full battery of R1, and 90 % may be used",
        ),
        (Fact("home does not charge", site, **own | {"place": 0}), "is not charged at N0 (home of"),
        (Fact("starts away from home", site, robots=(0,)), "R1 does not start at home"),
        (Fact("home closed", site, robots=(0, 1)), "the homes of R1 and R2 are closed for some"),
        (Fact("jobs begun", site, robots=(1,)), "R2 has begun a job"),
        (Fact("well formed"), "The fleet is well formed"),
    ]
    for fact, sentence in facts:
        assert sentence in writer.write(fact)
        translated = translate(writer.write(fact))
        assert translated != writer.write(fact)
        assert "{" not in translated
