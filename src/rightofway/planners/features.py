"""Abilities of planners, and the refusal of scenarios that need more than a planner can."""

from __future__ import annotations

from collections.abc import Callable, Collection
from enum import StrEnum

from rightofway.errors import InputError
from rightofway.model import Problem


class Feature(StrEnum):
    """A feature of planners; a planner without it refuses scenarios that need it.

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
"""The features of a planner that plans every scenario."""


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
    needs = (
        (Feature.JOBS, problem.work is not None, "jobs"),
        (Feature.SIZES, problem.roadmap.passing is not None, "vertices with pass"),
        (Feature.SIZES, not problem.resources.are_points, "robots with a size or zones"),
        (Feature.TURN_RATES, problem.turns, "robots with a turn_rate"),
        (Feature.CLOSURES, problem.closures is not None, "closures"),
        (Feature.BARRED_EDGES, problem.is_barred, "edges that are barred for some robots"),
    )
    for feature, is_needed, needed in needs:
        if is_needed and feature not in features:
            fault, hint = f"{method} does not know {needed}", remedy(feature)
            if needed == "robots with a size or zones" and Feature.LEAVES_SWAPS in features:
                fault = f"{method} is for points: it leaves swaps, and robots with a size collide"
                fault += " in them"
            elif feature is Feature.TURN_RATES:
                hint += ", or leave it out"
            raise InputError.at("", f"{fault} ({hint})")


def refuse_with_swaps_left(problem: Problem) -> None:
    """Refuse ``swaps=leave`` for a problem that the published method does not know.

    Raises
    ------
    InputError
        For robots with a size, turn rates and closures.
    """
    known = {Feature.BARRED_EDGES}
    refuse_unknown(problem, known, "swaps=leave", lambda _: "choose swaps=resolve")
