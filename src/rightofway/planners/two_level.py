"""Right of way on two levels: the method of the paper.

Robots run free on their routes. Where two of them conflict, one waits in the vertex before until
the other has left. The *node level* chooses by the number of conflicts that either choice leaves in
the whole system. Where these are equal, the *robot level* follows both choices to their ends, in
two movement groups, and takes the group in which the two robots achieve their work sooner.

The paper leaves swaps unsolved. Planner ``paper`` is the method as published, vertex by vertex, on
shortest routes. Planner ``two-level`` sees swaps: two robots whose routes run together share a
segment, and the right of way is decided for the whole segment at once.

References
----------
Oleiwi, *Optimum path planning for multi mobile robots with speed of work achievement as
constrain*.

Notes
-----
Deterministic. Rights of way once given are kept, so the method ends: it has decided every conflict,
or it has found one that no waiting resolves (`conflict_resolution`). There ``paper`` gives up, but
``two-level`` is complete: given time it finds a plan or proves that none exists. Neither planner is
optimal.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from rightofway.deadline import Deadline
from rightofway.errors import InputError
from rightofway.model import Decision, Plan, Tick, Track
from rightofway.planners.features import refuse_with_swaps_left
from rightofway.planners.rights_of_way import plan_by_rule, plan_on_routes
from rightofway.precedence import Meeting, Segment
from rightofway.repair.conflict_resolution import (
    PartialPlan,
    Resolution,
    Right,
    list_rights_if_waits,
)
from rightofway.repair.plan_request import Draft, PlanRequest
from rightofway.repair.routing import choose_routes
from rightofway.search import Distances


@dataclass(frozen=True, slots=True, kw_only=True)
class _Option:
    """One way to resolve a conflict: robot ``waits`` (0: i, 1: j) lets the other one go first."""

    waits: int
    rights: tuple[Right, ...]
    conflicts_left: int
    meets_settled: bool
    delay: Tick
    level: Literal["node", "robot", "only", "settled"] = "only"


@dataclass(frozen=True, slots=True, kw_only=True)
class _MovementGroup:
    """All conflicts of two robots resolved, and the sum of both completion times [ticks].

    ``value`` is the objective of the planner for the two completion times: for the
    flowtime of robots of one weight their sum, as published.
    """

    resolution: Resolution
    completion_sum: int
    value: tuple[int, int]


def two_level(request: PlanRequest) -> Draft:
    """Plan a fleet by the method of the paper, without swaps; options: `TwoLevelOptions`."""
    if request.options.get("swaps") == "leave":
        refuse_with_swaps_left(request.scenario.problem)
        return paper(request)
    distances, routes = choose_routes(request)
    return plan_by_rule(request, distances, routes, plan_by_two_levels)


def paper(request: PlanRequest) -> Draft:
    """Plan a fleet by the method as published; the plan may hold swaps. It has no options."""
    distances, plan = _make_published(request)
    return plan_on_routes(request, distances, plan, plan_by_two_levels)


def _make_published(request: PlanRequest) -> tuple[Distances, PartialPlan]:
    """Return a fleet on shortest routes, in which swaps are no conflicts."""
    distances, routes = choose_routes(replace(request, options={"routes": "shortest"}))
    return distances, PartialPlan(request, routes, sees_swaps=False)


def plan_by_two_levels(plan: PartialPlan, meeting: Meeting) -> Resolution | None:
    """Follow both movement groups of a pair; the one sooner done wins, group one on a tie."""
    i, j = meeting.robots
    first = _follow(plan, i, j, on_tie=0)
    if first is not None and all(
        decision.level != "robot" for decision in first.resolution.decisions
    ):
        return first.resolution
    two = _follow(plan, i, j, on_tie=1)
    sums = tuple(None if group is None else group.completion_sum for group in (first, two))
    first_wins = two is None or (first is not None and first.value <= two.value)
    winner = first if first_wins else two
    if winner is None:
        return None
    decisions = (
        replace(decision, completion_sums=(sums[0], sums[1]))
        if decision.level == "robot"
        else decision
        for decision in winner.resolution.decisions
    )
    return replace(winner.resolution, decisions=tuple(decisions))


@dataclass(frozen=True, slots=True, kw_only=True)
class MovementGroup:
    """One of the two temporary movement groups of a decision (the paper's List1 and List2).

    Attributes
    ----------
    tracks
        The whole fleet, with all conflicts of the two robots resolved.
    completions
        When each of the two has achieved its work: W(i) and W(j) [ticks].
    """

    tracks: tuple[Track, ...]
    completions: tuple[Tick, Tick]


def replay_movement_groups(
    plan: Plan, decision: Decision, time_limit: float | None = None
) -> tuple[MovementGroup | None, MovementGroup | None]:
    """Return both movement groups of a decision; the planner is run again to find them.

    Returns
    -------
    tuple
        Group one, in which the first robot waits on ties, and group two; None for a group that
        found no way. Without a tie both groups are equal.

    Raises
    ------
    InputError
        If no decision of this planner is like that.
    GaveUp
        When time ran out.
    """
    options = {"routes": "clear", "swaps": "resolve", **plan.run.options}
    request = PlanRequest(
        scenario=plan.scenario, options=options, deadline=Deadline.after(time_limit)
    )
    groups: list[MovementGroup | None] = []

    def by_two_levels_again(partial: PartialPlan, meeting: Meeting) -> Resolution | None:
        resolution = plan_by_two_levels(partial, meeting)
        if resolution is not None and decision in resolution.decisions:
            groups.extend(_make_temporary_group(partial, meeting, on_tie) for on_tie in (0, 1))
        return resolution

    if plan.run.name == "paper" or options["swaps"] == "leave":
        _, replayed = _make_published(request)
    else:
        _, routes = choose_routes(request)
        replayed = PartialPlan(request, routes)
    replayed.resolve_all(by_two_levels_again)
    if not groups:
        message = f"{plan.run.name} has no movement groups (plan with paper, two-level or auto)"
        raise InputError.at("planner", message)
    return groups[0], groups[1]


def _make_temporary_group(plan: PartialPlan, meeting: Meeting, on_tie: int) -> MovementGroup | None:
    i, j = meeting.robots
    followed = _follow(plan, i, j, on_tie=on_tie)
    if followed is None:
        return None
    mark = plan.graph.checkpoint()
    plan.graph.give_all(followed.resolution.rights)
    completions = plan.graph.get_completion(i), plan.graph.get_completion(j)
    group = MovementGroup(tracks=tuple(plan.graph.build_tracks()), completions=completions)
    plan.graph.rollback(mark)
    return group


def _follow(plan: PartialPlan, i: int, j: int, *, on_tie: int) -> _MovementGroup | None:
    """Resolve all conflicts of a pair in order of time, then take everything back.

    Where the node level leaves it open, ``on_tie`` (0: i, 1: j) waits.
    """
    graph = plan.graph
    mark = graph.checkpoint()
    decisions: list[Decision] = []
    rights: list[Right] = []
    # A temporary movement group of the paper: the two robots go on, meeting after meeting, until
    # they do not meet any more. Both groups are tried, and the better one is kept.
    while (meeting := graph.find_next_meeting_of(i, j)) is not None:
        segment = plan.find_segment(meeting)
        # Node level: let either of the two wait, and count the collisions that are left in the
        # system.
        options = [_try_wait(plan, meeting, segment, waits) for waits in (0, 1)]
        chosen = _decide_at_node_level(options, on_tie)
        if chosen is None:
            graph.rollback(mark)
            return None
        left = [None if option is None else option.conflicts_left for option in options]
        decision = plan.decide(meeting, segment, chosen.waits, chosen.delay)
        decisions.append(replace(decision, level=chosen.level, conflicts_left=(left[0], left[1])))
        graph.give_all(chosen.rights)
        rights += chosen.rights
    completions = graph.get_completion(i), graph.get_completion(j)
    graph.rollback(mark)
    weights = [plan.request.scenario.problem.itineraries[robot].weight for robot in (i, j)]
    return _MovementGroup(
        resolution=Resolution(decisions=tuple(decisions), rights=tuple(rights)),
        completion_sum=sum(completions),
        value=plan.request.objective.compute_values(weights, completions),
    )


def _try_wait(plan: PartialPlan, meeting: Meeting, segment: Segment, waits: int) -> _Option | None:
    """Let one of the two wait until the other has left, and count; None if impossible."""
    graph, robot = plan.graph, meeting.robots[waits]
    # A choice that meets robots which are settled already would undo decisions of before.
    others = plan.settled.copy()
    others[list(meeting.robots)] = 0
    rights = list_rights_if_waits(graph, meeting, segment, waits)
    enters = rights[0][1]
    mark, planned, met = (
        graph.checkpoint(),
        graph.enter(enters),
        graph.count_conflicts_of(robot, others),
    )
    if not graph.give_all(rights):
        return None
    option = _Option(
        waits=waits,
        rights=rights,
        conflicts_left=graph.count_conflicts(),
        meets_settled=graph.count_conflicts_of(robot, others) > met,
        delay=Tick(graph.enter(enters) - planned),
    )
    graph.rollback(mark)
    return option


def _decide_at_node_level(options: Sequence[_Option | None], on_tie: int) -> _Option | None:
    """Choose which robot waits by the conflicts left in the whole system."""
    possible = [option for option in options if option is not None]
    # One of the two cannot wait at all: the other one does.
    if len(possible) < len(options):
        return possible[0] if possible else None
    # Both robots could wait: first, no robot that is settled may be met again.
    clear = [option for option in possible if not option.meets_settled]
    if len(clear) == 1:
        return replace(clear[0], level="settled")
    i_waits, j_waits = possible
    # A tie at the node level is decided at the robot level: by which group both achieve sooner.
    if i_waits.conflicts_left == j_waits.conflicts_left:
        return replace(possible[on_tie], level="robot")
    return replace(min(possible, key=lambda option: option.conflicts_left), level="node")
