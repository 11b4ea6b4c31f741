"""Benchmarks are run by name (`just bench`), never with the tests."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from rightofway.model import Scenario
from tests.builders.fleets import random_fleet


@pytest.fixture(scope="session")
def fleet() -> Callable[[int], Scenario]:
    """Return a function that makes a random fleet of so many robots on a 64 x 64 grid."""

    def make(robots: int) -> Scenario:
        return random_fleet(1, size=64, robots=robots, walls=0.1)

    return make
