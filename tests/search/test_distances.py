"""Distance tables: shared while they are kept, and never more of them than memory allows."""

from __future__ import annotations

import pytest

from rightofway.metrics import find_forced_losses
from rightofway.model import Tick
from rightofway.search import Distances
from rightofway.site import VertexId, make_grid_roadmap
from tests.builders.fleets import grid_fleet

ONE = (Tick(1),)


def test_tables_above_the_limit_are_forgotten_the_oldest_first(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Three tables of 9 entries fit into 30; the fourth one takes the place of the first."""
    monkeypatch.setattr("rightofway.search.distances.MOST_ENTRIES", 30)
    computed = list[int]()
    distances = Distances(make_grid_roadmap(["..."] * 3), checkpoint=lambda: computed.append(1))
    for target, n_computed in [(0, 1), (1, 2), (2, 3), (0, 3), (3, 4), (2, 4), (0, 5)]:
        assert distances.to(VertexId(target), ONE)[8] == 4 - target // 3 - target % 3
        assert len(computed) == n_computed


def test_no_robot_is_driven_alone_once_the_time_of_forced_losses_is_over(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    driven = list[int]()
    monkeypatch.setattr(
        "rightofway.metrics.forced_losses.find_earliest_track",
        lambda robot, *_, **__: driven.append(robot),
    )
    fleet = grid_fleet(["...", "@.@", "..."], [("N0", "N6"), ("N2", "N8")])
    assert find_forced_losses(fleet, time_limit=0) == ()
    assert find_forced_losses(fleet) == ()
    assert driven == [0]
