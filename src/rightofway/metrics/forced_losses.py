"""What pairs of robots lose to each other in every plan: why a bound is above the robots alone."""

from __future__ import annotations

from dataclasses import dataclass

from rightofway.arguments import checks_arguments
from rightofway.deadline import Deadline
from rightofway.metrics.collisions import find_collisions, find_near_misses, find_swaps
from rightofway.model import Objective, Scenario, Tick, Track, checked_time_limit
from rightofway.model.outcome import minimized
from rightofway.search import Bookings, ConflictBasedSearch, Distances, find_earliest_track
from rightofway.site import VertexId

MOST_PAIRS = 200
"""Pairs that are solved, those first that meet first."""

STATES = 10_000
"""Joint states of each pair."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ForcedLoss:
    """Two robots that cannot both be as early as alone.

    Attributes
    ----------
    robots
        The two, by index, the smaller first.
    ticks
        What they lose together in every plan, at least [ticks].
    vertex
        Where they would meet first, each on its best track alone.
    """

    robots: tuple[int, int]
    ticks: Tick
    vertex: VertexId


@checks_arguments
def find_forced_losses(
    scenario: Scenario, *, time_limit: float | None = None
) -> tuple[ForcedLoss, ...]:
    """Return which pairs of robots lose time to each other in every plan, the most first.

    Parameters
    ----------
    scenario
        The problem; every robot can reach its places.
    time_limit
        When to stop [s]; None for no limit.

    Returns
    -------
    tuple of ForcedLoss
        None of pairs that lose nothing, nor where costs have weights or surcharges.

    Notes
    -----
    Each pair is solved for itself. A robot may be in several pairs, so that the losses do not add
    up. Deterministic without a time limit.
    """
    deadline = Deadline.after(checked_time_limit(time_limit))
    if minimized(scenario) is not Objective.FLOWTIME:
        return ()
    tracks = _alone(scenario)
    if tracks is None:
        return ()
    search, losses = ConflictBasedSearch(scenario.problem), []
    alone = [search.search_together([robot], states=STATES)[1] for robot in range(len(tracks))]
    for robots, vertex in list(_meetings(scenario, tracks).items())[:MOST_PAIRS]:
        if deadline.measure_seconds_left() == 0:
            break
        least = [alone[robot] for robot in robots]
        _, together = search.search_together(
            robots, states=STATES, time_limit=deadline.measure_seconds_left()
        )
        if together is None or None in least:
            continue  # such robots have no plan at all
        loss = together - sum(ticks for ticks in least if ticks is not None)
        if loss > 0:
            losses.append(ForcedLoss(robots=robots, ticks=Tick(loss), vertex=vertex))
    return tuple(sorted(losses, key=lambda loss: (-loss.ticks, loss.robots)))


def _alone(scenario: Scenario) -> list[Track] | None:
    """Return the best track of each robot alone; None if one has none."""
    distances, tracks = Distances(scenario.roadmap), []
    for robot in range(len(scenario.robots)):
        track = find_earliest_track(robot, Bookings(scenario.problem), distances)
        if track is None:
            return None
        tracks.append(track)
    return tracks


def _meetings(scenario: Scenario, tracks: list[Track]) -> dict[tuple[int, int], VertexId]:
    """Return the pairs that meet on their tracks, and where they do first, in order of time."""
    of_points = [(hit.start, hit.robots, hit.vertex) for hit in find_collisions(scenario, tracks)]
    head_on = [(swap.tick, swap.robots, swap.vertices[0]) for swap in find_swaps(tracks)]
    of_sizes = [
        (miss.start, miss.robots, miss.places[0][0]) for miss in find_near_misses(scenario, tracks)
    ]
    first: dict[tuple[int, int], VertexId] = {}
    for _, robots, vertex in sorted([*of_points, *head_on, *of_sizes]):
        first.setdefault(robots, vertex)
    return first
