"""Fleets whose stages have times, drawn from fleets without jobs."""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from fractions import Fraction
from itertools import combinations

from hypothesis import strategies as st

from rightofway.model import Arc, Itinerary, Problem, Scenario, Stage, Tick, Work
from rightofway.model.turning import compute_first_turns
from rightofway.model.work import WorkObjective

__all__ = ["LATE", "draw_arcs", "draw_times", "with_problem"]

LATE = Fraction(5, 2)


@st.composite
def draw_times(
    draw: st.DrawFn, scenario: Scenario, *, latest: bool = True, costs: bool = False
) -> Scenario:
    """Draw times of the stages of a fleet, states of its robots, and whether they end anywhere."""
    ends_anywhere = draw(st.booleans())
    itineraries = []
    for itinerary in scenario.problem.itineraries:
        turn = max(stage.turn for stage in itinerary.stages)
        n_served = len(itinerary.stages) - (itinerary.last == itinerary.home)
        stages = [
            draw(_timed_stages(stage, turn, latest=latest, costs=costs))
            for stage in itinerary.stages[:n_served]
        ]
        if not ends_anywhere:
            stages.append(Stage(vertex=itinerary.stages[-1].vertex, work=Tick(0), turn=Tick(0)))
        elif draw(st.booleans()):
            stages = stages or []
        if not stages:
            stages = [Stage(vertex=itinerary.home, work=Tick(0), turn=Tick(0))]
        heading = None
        if itinerary.turning is not None:
            heading = draw(st.none() | st.integers(-90, 400).map(Fraction))
        itineraries.append(
            replace(
                itinerary,
                stages=tuple(stages),
                ready=Tick(draw(st.sampled_from([0, 0, 1, 5]))),
                heading=heading,
                first_turns=compute_first_turns(
                    scenario.roadmap, itinerary.turning, itinerary.home, heading
                ),
                ends_anywhere=ends_anywhere,
            )
        )
    return with_problem(scenario, itineraries, costs=costs)


@st.composite
def draw_arcs(draw: st.DrawFn, scenario: Scenario) -> Scenario:
    """Draw stages that wait for stages of other robots, without a circle."""
    places = [
        (robot, stage)
        for robot, itinerary in enumerate(scenario.problem.itineraries)
        for stage in range(len(itinerary.stages_to_serve) - (not itinerary.ends_anywhere))
    ]
    # An order of all stages in which those of a robot keep theirs: arcs lead on in it.
    mixed = draw(st.permutations([robot for robot, _ in places]))
    left = {robot: iter(range(len(places))) for robot in mixed}
    order = [(robot, next(left[robot])) for robot in mixed]
    arcs = [
        Arc(before=before, after=after)
        for before, after in combinations(order, 2)
        if before[0] != after[0] and draw(st.integers(0, 2)) == 0
    ]
    return with_problem(
        scenario, list(scenario.problem.itineraries), tuple(arcs), costs=draw(st.booleans())
    )


@st.composite
def _timed_stages(draw: st.DrawFn, stage: Stage, turn: Tick, *, latest: bool, costs: bool) -> Stage:
    earliest = draw(st.sampled_from([0, 0, 3, 8, 15]))
    limit = draw(st.none() | st.integers(0, 40)) if latest else None
    return replace(
        stage,
        turn=turn,
        earliest=Tick(earliest),
        latest=None if limit is None else Tick(earliest + stage.work + limit),
        weight=draw(st.integers(0, 3)) if costs else 0,
        due=draw(st.none() | st.integers(0, 20).map(Tick)) if costs else None,
    )


def with_problem(
    scenario: Scenario,
    itineraries: list[Itinerary],
    after: tuple[Arc, ...] = (),
    *,
    costs: bool = False,
) -> Scenario:
    """Return a fleet with other itineraries, of a problem with times."""
    objective: WorkObjective = "service" if costs else "flowtime"
    work = Work(jobs=(), robots=(), objective=objective, late=LATE)
    problem: Problem = replace(
        scenario.problem, itineraries=tuple(itineraries), work=work, after=after
    )
    timed = copy(scenario)
    object.__setattr__(timed, "problem", problem)
    return timed
