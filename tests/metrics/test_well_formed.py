"""Which jobs keep a fleet from being well formed, and why; each fleet has one known reason."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from rightofway.facts import Fact
from rightofway.io import parse_scenario
from rightofway.io.sites import make_sites
from rightofway.metrics import Finding, Inspection, inspect

# A row with a bay below its middle; cells are N0 to N4, and N7.
GRID = [".....", "@@.@@"]
TANK = {"drive": "1/10", "on": "1/100", "work": "1/50", "charge": 1, "reserve": "1/10"}


def inspect_fleet(robots: list[dict[str, Any]], **parts: Any) -> Inspection:
    document = {"format": "rightofway-scenario/1", "map": {"grid": GRID}, "robots": robots}
    scenario = parse_scenario(document | {"rules": {"turn": 0}} | parts)
    ((_, site),) = make_sites(scenario, ()).sites
    return inspect(site)


def find(robots: list[dict[str, Any]], **parts: Any) -> list[tuple[str, dict[str, Any]]]:
    """Return the kinds and values of findings on jobs."""
    found = [finding for finding in inspect_fleet(robots, **parts).findings if is_of_job(finding)]
    return [(finding.fact.kind, dict(finding.fact.values)) for finding in found]


def is_of_job(finding: Finding) -> bool:
    return finding.kind == "job"


def test_a_fleet_that_can_do_each_job_alone_is_well_formed() -> None:
    robots = [{"name": "R1", "home": "N0"}, {"name": "R2", "home": "N7"}]
    jobs = [{"name": "J1", "pickup": "N1", "dropoff": "N4"}]
    assert inspect_fleet(robots, jobs=jobs).well_formed is True
    assert inspect_fleet([{"name": "R1", "home": "N0", "target": "N4"}]).well_formed is None


def test_a_job_that_no_robot_may_do_or_carries_is_named() -> None:
    robots = [{"name": "R1", "home": "N0", "type": "fork"}]
    jobs = [
        {"name": "J1", "at": "N4", "types": ["lift"]},
        {"name": "J2", "pickup": "N1", "dropoff": "N4", "load": 2},
    ]
    assert find(robots, jobs=jobs) == [
        ("job without robot", {"job": "J1"}),
        ("job without robot", {"job": "J2"}),
    ]


def test_a_job_beyond_the_home_of_another_robot_is_named() -> None:
    """R2 stays in the middle of the row: R1 does not pass it."""
    robots = [{"name": "R1", "home": "N0"}, {"name": "R2", "home": "N2"}]
    jobs = [{"name": "J1", "at": "N4", "robot": "R1"}, {"name": "J2", "at": "N4"}]
    assert find(robots, jobs=jobs) == [("job through homes", {"job": "J1", "robot": 0, "place": 4})]


def test_a_large_robot_does_not_pass_beside_a_home() -> None:
    """In the bay, R2 is a cell away from the row: discs of radius 0.6 need 1.2 cells."""
    robots = [
        {"name": "R1", "home": "N0", "radius": "0.6"},
        {"name": "R2", "home": "N7", "radius": "0.6"},
    ]
    jobs = [{"name": "J1", "at": "N4", "robot": "R1"}]
    assert [kind for kind, _ in find(robots, jobs=jobs)] == ["job through homes"]
    small = [robot | {"radius": "0.5"} for robot in robots]
    assert find(small, jobs=jobs) == []


def test_a_job_without_a_way_is_named_also_behind_a_closure_without_end() -> None:
    robots = [{"name": "R1", "home": "N0"}]
    jobs = [{"name": "J1", "at": "N4"}]
    closed = find(robots, jobs=jobs, closures=[{"at": "N2"}])
    assert closed == [("job without way", {"job": "J1", "robot": 0, "place": 4})]
    assert find(robots, jobs=jobs, closures=[{"at": "N2", "until": 9}]) == []


def test_a_job_that_takes_more_than_a_battery_is_named_with_both_shares() -> None:
    """Four edges, out and back: 8/10 of drives, 8/100 of `on`; a unit of work takes 3/100 more."""
    robots = [{"name": "R1", "home": "N0", "battery": "tank"}]
    parts = {"batteries": {"tank": TANK}, "charging": ["N0"]}
    assert find(robots, jobs=[{"name": "J1", "at": "N4"}], **parts) == []  # 88 % of 90 %
    shares = {"need": Fraction(91, 100), "most": Fraction(9, 10)}
    assert find(robots, jobs=[{"name": "J1", "at": "N4", "work": 1}], **parts) == [
        ("job beyond battery", {"job": "J1", "robot": 0, **shares})
    ]
    twice = {"name": "J1", "stops": [{"at": "N4"}, {"at": "N0"}, {"at": "N4"}]}
    assert [kind for kind, _ in find(robots, jobs=[twice], **parts)] == ["job beyond full battery"]


@pytest.mark.parametrize(("charging", "rate"), [(["N1"], 1), (["N0"], 0)])
def test_a_home_that_does_not_charge_is_named(charging: list[str], rate: int) -> None:
    robots = [{"name": "R1", "home": "N0", "battery": "tank"}]
    parts = {"batteries": {"tank": TANK | {"charge": rate}}, "charging": charging}
    assert find(robots, jobs=[{"name": "J1", "at": "N1"}], **parts) == [
        ("home does not charge", {"job": "J1", "robot": 0, "place": 0})
    ]


def test_of_several_robots_the_one_nearest_to_doing_a_job_is_named() -> None:
    """R1 has no way past R2, whose battery is too small for the work."""
    robots = [{"name": "R1", "home": "N0"}, {"name": "R2", "home": "N2", "battery": "tank"}]
    jobs = [{"name": "J1", "at": "N4", "work": 16}]
    found = find(robots, jobs=jobs, batteries={"tank": TANK}, charging=["N2"])
    assert [(kind, values["robot"]) for kind, values in found] == [("job beyond battery", 1)]


def test_robots_that_do_not_begin_at_open_homes_without_work_are_noted() -> None:
    robots = [
        {"name": "R1", "home": "N0", "start": {"at": "N1"}},
        {"name": "R2", "home": "N4", "start": {"at": "N4", "begun": {"J1": 1}}},
    ]
    jobs = [{"name": "J1", "pickup": "N3", "dropoff": "N2"}]
    closures = [{"at": "N4", "from": 5, "until": 9}]
    inspection = inspect_fleet(robots, jobs=jobs, closures=closures)
    assert inspection.well_formed is False
    notes = [finding for finding in inspection.findings if is_of_job(finding)]
    assert {finding.severity for finding in notes} == {"note"}
    assert [(finding.fact.kind, finding.fact.values) for finding in notes] == [
        ("starts away from home", {"robots": (0,)}),
        ("home closed", {"robots": (1,)}),
        ("jobs begun", {"robots": (1,)}),
    ]


def test_places_of_jobs_are_places_of_the_site() -> None:
    robots = [{"name": "R1", "home": "N0"}]
    jobs = [{"name": "J1", "pickup": "N1", "dropoff": "N4"}]
    document = {"format": "rightofway-scenario/1", "map": {"grid": GRID}, "robots": robots}
    ((_, site),) = make_sites(parse_scenario(document | {"jobs": jobs}), ()).sites
    assert site.places == {
        0: Fact("home of", robot=0),
        1: Fact("place of job", job="J1"),
        4: Fact("place of job", job="J1"),
    }
    assert site.trips == {}
