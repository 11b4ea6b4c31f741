"""Well formed fleets: found like a search over places and stops finds them, and able to do all."""

from __future__ import annotations

from hypothesis import strategies as st

from rightofway.io import parse_scenario
from rightofway.io.sites import make_sites
from rightofway.metrics import Inspection, inspect
from rightofway.model import Scenario
from tests.builders.laws import law, leave
from tests.builders.work_scenarios import draw_work_document
from tests.oracles.well_formed import list_ill_formed
from tests.oracles.work_search import TooLarge, find_best

seeds = st.integers(0, 10**6)


def inspect_scenario(scenario: Scenario) -> Inspection:
    """Return the findings on the one site of a scenario."""
    ((_, site),) = make_sites(scenario, ()).sites
    return inspect(site)


@law(seed=seeds, n_robots=st.integers(1, 4), edges=st.integers(4, 30))
def test_the_jobs_that_break_well_formed_are_those_that_a_search_finds(
    seed: int, n_robots: int, edges: int
) -> None:
    document = draw_work_document(seed, n_robots=n_robots)
    for battery in document.get("batteries", {}).values():
        battery["drive"] = f"1/{edges}"
    scenario = parse_scenario(document)
    named = [
        str(finding.fact.values["job"])
        for finding in inspect_scenario(scenario).findings
        if finding.kind == "job"
    ]
    assert named == list_ill_formed(scenario)


@law(seed=seeds)
def test_all_jobs_of_a_well_formed_fleet_without_latest_can_be_served(seed: int) -> None:
    scenario = parse_scenario(draw_work_document(seed, n_jobs=2, windows=False))
    if not inspect_scenario(scenario).well_formed:
        leave("not well formed")
    try:
        best = find_best(scenario)
    except TooLarge:
        leave("too large to search")
    assert best is not None
    assert best.weight == 0
