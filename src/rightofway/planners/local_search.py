"""Two-level, improved by flips of rights of way on its routes (`repair.local_search`)."""

from __future__ import annotations

from rightofway.model import Improvement, Status, Tick
from rightofway.planners.two_level import two_level
from rightofway.precedence import build_graph_of_plan
from rightofway.repair.local_search import LocalSearch
from rightofway.repair.task import Draft, Task


def local_search(task: Task) -> Draft:
    """Improve a plan without changing its routes; options: `LocalSearchOptions`.

    `two_level` makes the plan to start from where none is given.
    """
    first = Draft(tracks=task.start) if task.start else two_level(task)
    task.has_plan()
    task.better(lambda: first.tracks)
    graph = build_graph_of_plan(task.scenario.problem, first.tracks)
    search = LocalSearch(task, graph)
    old = search.measure()
    search.run(rounds=int(task.options["rounds"]))
    new = search.measure()
    status = Status(
        "reversals",
        objective=task.objective.value,
        before=int(old[0]),
        after=int(new[0]),
    )
    if first.status is not None:
        status = Status("then", first=first.status, second=status)
    return Draft(
        tracks=tuple(graph.build_tracks()),
        status=status,
        reroutes=first.reroutes,
        improvement=Improvement(saved=Tick(old[0] - new[0])),
    )
