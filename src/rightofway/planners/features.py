"""Abilities of planners, and the refusal of scenarios that need more than a planner can."""

from __future__ import annotations

from collections.abc import Callable, Collection
from enum import StrEnum

from rightofway.errors import InputError
from rightofway.model import Problem
from rightofway.model.problem import refuse_closures, refuse_jobs, refuse_turn_rates
from rightofway.model.resources import refuse_sizes


class Feature(StrEnum):
    """Something that a planner can do; a planner without it refuses scenarios that need it.

    Attributes
    ----------
    IMPROVES
        It can start from a plan and make it better, also from one of another scenario.
    LEAVES_SWAPS
        Its plans may hold swaps; all other plans keep all rules.
    SIZES
        It plans robots that have a size, and keeps zones and passed vertices.
    CLOSURES
        It keeps clear of closures.
    BARRED_EDGES
        It keeps robots off edges that are barred for their type.
    TURN_RATES
        It plans robots that need time to turn on the spot.
    JOBS
        It plans scenarios with jobs.
    """

    IMPROVES = "improves"
    LEAVES_SWAPS = "leaves swaps"
    SIZES = "sizes"
    CLOSURES = "closures"
    BARRED_EDGES = "barred edges"
    TURN_RATES = "turn rates"
    JOBS = "jobs"


ANY_FLEET = frozenset({Feature.SIZES, Feature.CLOSURES, Feature.BARRED_EDGES, Feature.TURN_RATES})
"""What a planner can do that plans every scenario."""


def refuse_unknown(
    problem: Problem,
    features: Collection[Feature],
    method: str,
    remedy: Callable[[Feature], str],
) -> None:
    """Refuse a problem that needs a feature which is not there.

    Raises
    ------
    InputError
        For jobs, robots with a size, zones, passed vertices, turn rates, closures or barred edges,
        with the first that is found.
    """
    if problem.work is not None and Feature.JOBS not in features:
        refuse_jobs(problem, method, remedy(Feature.JOBS))
    if not problem.resources.are_points and Feature.SIZES not in features:
        has_passed = problem.roadmap.passing is not None
        if Feature.LEAVES_SWAPS in features and not has_passed:
            why = "it leaves swaps, and robots with a size collide in them"
            raise InputError.at("", f"{method} is for points: {why} ({remedy(Feature.SIZES)})")
        refuse_sizes(problem.resources, method, remedy(Feature.SIZES))
    if problem.turns and Feature.TURN_RATES not in features:
        refuse_turn_rates(problem, method, remedy(Feature.TURN_RATES))
    if problem.closures is not None and Feature.CLOSURES not in features:
        refuse_closures(problem, method, remedy(Feature.CLOSURES))
    if problem.is_barred and Feature.BARRED_EDGES not in features:
        message = f"{method} does not know edges that are barred for some robots"
        raise InputError.at("", f"{message} ({remedy(Feature.BARRED_EDGES)})")


def refuse_with_swaps_left(problem: Problem) -> None:
    """Refuse ``swaps=leave`` for a problem that the published method does not know.

    Raises
    ------
    InputError
        For robots with a size, turn rates and closures.
    """
    known = {Feature.BARRED_EDGES}
    refuse_unknown(problem, known, "swaps=leave", lambda _: "choose swaps=resolve")
