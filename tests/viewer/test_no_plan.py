"""The page of a fleet that has no plan: who blocks whom, and where."""

import pytest

import rightofway
from rightofway.errors import NoPlanExists
from rightofway.repair.impossible import put_fleet_at_home
from rightofway.viz.palette import LIGHT
from tests.builders.fleets import grid_fleet
from tests.viewer.conftest import Opener


def test_the_page_of_a_blocked_fleet_marks_robots_and_places_and_says_why(show: Opener) -> None:
    """R1 and R2 change places in the upper corridor; R3 is alone in the lower one."""
    scenario = grid_fleet(["...", "@@@", "..."], [("N0", "N2"), ("N2", "N0"), ("N6", "N8")])
    with pytest.raises(NoPlanExists) as caught:
        rightofway.solve(scenario)
    viewer = show(put_fleet_at_home(scenario), no_plan=caught.value)
    assert "no plan exists" in viewer.text("#headline")
    ringed = [disc for disc in viewer.discs() if disc.colour == LIGHT.held and not disc.is_filled]
    homes = viewer.all_on_map([(0.5, 0.5), (2.5, 0.5)])  # N0 and N2; R3 stands in N6
    assert [(disc.x, disc.y) for disc in ringed] == [pytest.approx(home) for home in homes]
    card = viewer.text("#card")
    assert "both have to pass N0, N1 and N2." in card
    assert "Give more room there." in card
    assert viewer.complaints == []
