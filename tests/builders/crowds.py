"""A fleet that `lns` improves for seconds."""

from rightofway.io import dump_scenario
from tests.builders.fleets import random_fleet

CROWD = dump_scenario(random_fleet(seed=3, size=24, robots=60, walls=0))
