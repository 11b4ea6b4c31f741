"""One right of way of a plan, flipped: the other robot goes first, and all else follows."""

from __future__ import annotations

from collections.abc import Sequence

from rightofway.errors import GaveUp
from rightofway.model import Plan, Tick, Track
from rightofway.planners.local_search import LocalSearch
from rightofway.planners.task import Deadline, Task, planning_headway
from rightofway.precedence import graph_of


def flipped(
    plan: Plan, waits: int, goes_first: int, tick: Tick, *, time_limit: float | None = None
) -> Sequence[Track]:
    """Return the timetable of a plan in which a robot that waits goes first instead.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    waits
        The robot that waits, by index.
    goes_first
        The robot that it waits for.
    tick
        When the wait ends. Of the rights of way between both robots, the one that ends nearest to
        it is flipped, with all others in the segment that both share.
    time_limit
        When to stop [s]; None for no limit.

    Returns
    -------
    sequence of Track
        The earliest timetable, on the same routes. Conflicts that follow from the flip are resolved
        one after the other by what they cost.

    Raises
    ------
    GaveUp
        If no right of way of the two is there, or no timetable was found on these routes.
    """
    scenario, names = plan.scenario, [robot.name for robot in plan.scenario.robots]
    graph = graph_of(scenario, plan.tracks, headway=planning_headway(scenario))
    rights = [
        (first, second)
        for first, second in graph.rights_of(waits)
        if graph.place(second)[0] == waits and graph.place(first)[0] == goes_first
    ]
    if not rights:
        raise GaveUp(f"{names[waits]} never waits for {names[goes_first]} (choose another wait)")
    first, second = min(rights, key=lambda right: (abs(graph.enter(right[1]) - tick), right))
    search = LocalSearch(Task(scenario=scenario, deadline=Deadline.after(time_limit)), graph)
    if not (search.reverse(first, second) and search.resolve()):
        raise GaveUp(
            f"{names[waits]} cannot go first on these routes (plan again for other routes)"
        )
    return graph.tracks()
