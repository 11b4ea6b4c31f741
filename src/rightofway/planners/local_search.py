"""Two-level, improved by flips of rights of way on its routes (`repair.local_search`)."""

from __future__ import annotations

from rightofway.model import Improvement, Status, Tick
from rightofway.planners.two_level import two_level
from rightofway.precedence import build_graph_of_plan
from rightofway.repair.local_search import LocalSearch
from rightofway.repair.plan_request import Draft, PlanRequest


def local_search(request: PlanRequest) -> Draft:
    """Improve a plan without changing its routes; options: `LocalSearchOptions`.

    `two_level` makes the plan to start from where none is given.
    """
    first = Draft(tracks=request.start) if request.start else two_level(request)
    request.has_plan()
    request.better(lambda: first.tracks)
    graph = build_graph_of_plan(request.scenario.problem, first.tracks)
    search = LocalSearch(request, graph)
    old = search.measure()
    search.run(rounds=int(request.options["rounds"]))
    new = search.measure()
    status = Status(
        "reversals",
        objective=request.objective.value,
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
