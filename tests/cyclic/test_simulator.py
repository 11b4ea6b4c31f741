"""Simulations of repeated laps: the kernel against slow rules, and what follows a recurrence."""

import random

import pytest
from hypothesis import strategies as st

from rightofway.cyclic.pattern import find_pattern
from rightofway.cyclic.route import ROUTES, GroupContext, make_cyclic_routes, split_groups
from rightofway.cyclic.rules import NATIVE_RULES, RULES
from rightofway.cyclic.run import Simulation, make_simulation
from rightofway.cyclic.simulator import Deadlock
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Rules, Scenario
from rightofway.planners import Deadline
from rightofway.site import make_grid_roadmap
from tests.builders.any_fleet import LAPS_REFUSE, any_fleet
from tests.builders.fleets import fleet_on, largest_part, random_grid
from tests.builders.laws import law, leave
from tests.oracles.lap_rules import rolling

some_rules = st.sampled_from(
    [
        Rules(),
        Rules(headway=1),  # type: ignore[arg-type]
        Rules(occupancy="both"),
        Rules(rotations=False),
        Rules(headway=1, occupancy="both"),  # type: ignore[arg-type]
    ]
)


def groups_of(
    draw: random.Random, *, size: int, robots: int, walls: float, rules: Rules
) -> list[GroupContext]:
    """Return the groups of a random fleet, on any routes; none if a robot has nowhere to go."""
    grid = random_grid(draw, size=size, walls=walls)
    most = len(largest_part(make_grid_roadmap(grid)))
    try:
        scenario: Scenario = fleet_on(
            grid, draw, robots=min(robots, most), rules=rules, apart=most > 1
        )
        groups = split_groups(scenario, make_cyclic_routes(scenario, draw.choice(ROUTES)))
    except (InputError, NoPlanExists, ValueError):
        leave("a robot has nowhere to go")
    return [GroupContext(scenario=scenario, routes=tuple(group)) for group in groups]


def outcome(simulation: Simulation) -> tuple[int, int] | Deadlock | None:
    """Return two ticks with one state, a deadlock, or None if it takes long."""
    try:
        return simulation.advance(Deadline.after(2))
    except Deadlock as deadlock:
        return deadlock
    except GaveUp:
        return None


@pytest.mark.parametrize("rule", NATIVE_RULES)
@law(seed=st.integers(0, 2**32), rules=some_rules)
def test_the_kernel_decides_as_one_window_after_the_other_does(
    rule: str, seed: int, rules: Rules
) -> None:
    """On crowded floors: many simulations take windows back, and many end in a deadlock."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    groups = groups_of(
        draw, size=draw.randint(3, 7), robots=draw.randint(2, 10), walls=0.1, rules=rules
    )
    for context in groups:
        check_decisions(context, rule)


def check_decisions(context: GroupContext, rule: str) -> None:
    """Compare the kernel with windows, tick by tick, and their deadlocks."""
    slow, fast = rolling(context, rule), make_simulation(context, rule)
    expected, found = outcome(slow), outcome(fast)
    if expected is None or found is None:
        return
    if isinstance(expected, Deadlock):
        assert isinstance(found, Deadlock)
        assert vars(found) == vars(expected)
    else:
        assert found == expected
    assert [list(past) for past in fast.history] == [list(past) for past in slow.history]


@law(
    any_fleet(robots=(2, 4), without=LAPS_REFUSE, apart=True),
    st.sampled_from(NATIVE_RULES),
    st.sampled_from(ROUTES),
)
def test_the_kernel_decides_as_windows_do_for_any_fleet(
    scenario: Scenario, rule: str, routed: str
) -> None:
    try:
        routes = make_cyclic_routes(scenario, routed)
    except NoPlanExists:
        leave("no laps exist")
    for group in split_groups(scenario, routes):
        check_decisions(GroupContext(scenario=scenario, routes=tuple(group)), rule)


@pytest.mark.parametrize("rule", RULES)
@law(seed=st.integers(0, 2**32), rules=some_rules)
def test_what_follows_a_recurrence_is_the_pattern(rule: str, seed: int, rules: Rules) -> None:
    """The rule continues to decide, without the states seen so far."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    groups = groups_of(
        draw, size=draw.randint(4, 7), robots=draw.randint(2, 5), walls=0.15, rules=rules
    )
    for context in groups:
        simulation = make_simulation(context, rule)
        try:
            recurrence = simulation.advance(Deadline.after(2))
            pattern = find_pattern(
                simulation.history, [len(lap) for lap in context.laps], recurrence
            )
            simulation.reset_states()
            simulation.advance(Deadline.after(2))
        except (Deadlock, GaveUp):
            continue
        for robot, past in enumerate(simulation.history):
            known = len(pattern.history[robot])
            if pattern.counts[robot]:
                assert list(past[known:]) == [
                    pattern.enter(robot, visit) for visit in range(known, len(past))
                ]
            else:
                assert len(past) == known
