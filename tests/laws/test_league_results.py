"""Results for the League of Robot Runners, replayed by its rules."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import pairwise

from hypothesis import strategies as st

from rightofway.io import format_foreign
from rightofway.model import (
    Job,
    JobStop,
    Plan,
    PlannedItem,
    PlannerRun,
    Robot,
    RobotState,
    Rules,
    Scenario,
    Tick,
    Track,
)
from rightofway.site import VertexId
from rightofway.site.grid import make_grid_roadmap
from tests.builders.laws import law
from tests.oracles.league import finish_tasks, run_actions

HALL = make_grid_roadmap([".....", ".@...", "....."])
RULES = Rules(turn=Fraction(0), ends="none", turn_rate=Fraction(90))
QUARTERS = {1: 0, 5: 90, -1: 180, -5: 270}
"""The heading of a move by its change of the cell's number [degrees], as y points down."""


@st.composite
def plans(draw: st.DrawFn) -> Plan:
    """Return a plan of robots that turn and drive as if they were alone, and of their jobs."""
    robots, tracks, tours, jobs = [], [], [], list[Job]()
    for index, home in enumerate(draw(st.lists(st.integers(0, 13), min_size=1, max_size=3,
                                               unique=True))):  # fmt: skip
        heading = draw(st.sampled_from([0, 90, 180, 270]))
        state = RobotState(at=VertexId(home), heading=Fraction(heading))
        robots.append(Robot(name=f"A{index}", home=VertexId(home), start=state))
        track = draw(turning_walks(home, heading))
        tracks.append(track)
        visits = draw(st.lists(st.integers(0, len(track) - 1), max_size=6))
        items, left = list[PlannedItem](), sorted(visits)
        while left:
            own, left = left[: (n := draw(st.integers(1, 3)))], left[n:]
            items += [
                PlannedItem(visit=v, begin=at, end=at, job=len(jobs), stop=stop)
                for stop, v in enumerate(own)
                for at in [Tick(int(track.enter[v]))]
            ]
            stops = [JobStop(at=VertexId(int(track.vertices[visit]))) for visit in own]
            jobs.append(Job(name=f"T{len(jobs)}", stops=tuple(stops)))
        tours.append(tuple(items))
    scenario = Scenario(roadmap=HALL, robots=tuple(robots), rules=RULES, jobs=tuple(jobs))
    return Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun(), tours=tuple(tours))


@st.composite
def turning_walks(draw: st.DrawFn, home: int, heading: int) -> Track:
    """Return a walk along edges that leaves the time for turns, and sometimes waits."""
    vertices, enter, grid = [home], [0], HALL.grid
    assert grid is not None
    for _ in range(draw(st.integers(0, 8))):
        begin, end = HALL.indptr[vertices[-1]], HALL.indptr[vertices[-1] + 1]
        vertices.append(draw(st.sampled_from(HALL.heads[begin:end].tolist())))
        before, after = grid.cells[vertices[-2:]].tolist()
        angle = (QUARTERS[after - before] - heading) % 360
        heading = QUARTERS[after - before]
        turns = min(angle, 360 - angle) // 90
        enter.append(enter[-1] + turns + 1 + draw(st.sampled_from([0, 0, 1, 3])))
    return Track.of(vertices, enter)


@law(plan=plans())
def test_actions_lead_along_the_plan_and_events_keep_the_rule_of_the_league(plan: Plan) -> None:
    document = json.loads(format_foreign(plan, "planviz"))
    assert document["actionModel"] == "MAPF_T"
    cells, grid = run_actions(document), plan.scenario.roadmap.grid
    assert grid is not None
    for own, track in zip(cells, plan.tracks, strict=True):
        entered = [step for step, (a, b) in enumerate(pairwise(own), 1) if a != b]
        assert entered == track.enter.tolist()[1:]
        visited = [own[0], *(own[step] for step in entered)]
        assert visited == list(map(grid.get_cell, track.vertices.tolist()))
    assert finish_tasks(document, cells) == [tuple(event) for event in document["events"]]
    assert len({len(path) for path in cells}) == 1
