"""Plans of other programs: what is written is read back; counted actions are single steps."""

from __future__ import annotations

import json
import tempfile
from fractions import Fraction
from pathlib import Path

from hypothesis import strategies as st

from rightofway.io import FOREIGN_FORMATS, format_foreign, load_plan, write_map
from rightofway.io.foreign import planviz
from rightofway.model import Plan, PlannerRun, Robot, Rules, Scenario, Stop, Track
from rightofway.site import VertexId
from rightofway.site.grid import make_grid_roadmap
from tests.builders.laws import law
from tests.oracles.planviz import visits_step_by_step

HALL = make_grid_roadmap([".....", ".@...", "....."])


@st.composite
def walks(draw: st.DrawFn) -> Track:
    """Return a walk of a few visits along edges, each for a few ticks."""
    vertices, enter = [draw(st.integers(0, HALL.n_vertices - 1))], [0]
    for _ in range(draw(st.integers(0, 8))):
        begin, end = HALL.indptr[vertices[-1]], HALL.indptr[vertices[-1] + 1]
        vertices.append(draw(st.sampled_from(HALL.heads[begin:end].tolist())))
        enter.append(enter[-1] + draw(st.integers(1, 3)))
    return Track.of(vertices, enter)


@st.composite
def plans(draw: st.DrawFn) -> Plan:
    """Return a plan that need not keep the rules: the robots walk as if they were alone."""
    tracks = draw(
        st.lists(walks(), min_size=1, max_size=4, unique_by=lambda track: int(track.vertices[0]))
    )
    robots = tuple(
        Robot(
            name=f"A{index}",
            home=VertexId(int(track.vertices[0])),
            stops=(Stop(at=VertexId(int(track.vertices[-1]))),),
        )
        for index, track in enumerate(tracks)
    )
    scenario = Scenario(roadmap=HALL, robots=robots, rules=Rules(turn=Fraction(0), ends="none"))
    return Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun())


@law(plan=plans(), name=st.sampled_from(sorted(FOREIGN_FORMATS)))
def test_what_is_written_for_another_program_is_read_back(plan: Plan, name: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path, map_file = Path(folder, "plan"), Path(folder, "hall.map")
        write_map(HALL, map_file)
        path.write_text(format_foreign(plan, name), encoding="utf-8")
        assert load_plan(path, map_file) == plan


@st.composite
def runs_of_actions(draw: st.DrawFn) -> tuple[int, list[tuple[str, int]]]:
    """Return the steps of a move, and runs in which waits may interrupt moves and turns."""
    steps_per_move = draw(st.integers(1, 4))
    runs: list[tuple[str, int]] = []
    for action in draw(st.lists(st.sampled_from("FRCW"), max_size=12)):
        first = draw(st.integers(0, steps_per_move))
        wait = draw(st.integers(0, 2))
        runs += [(action, first), ("W", wait), (action, steps_per_move - first)]
    return steps_per_move, [(action, steps) for action, steps in runs if steps]


@law(drawn=runs_of_actions(), heading=st.sampled_from("ENWS"))
def test_counted_actions_lead_where_single_steps_lead(
    drawn: tuple[int, list[tuple[str, int]]], heading: str
) -> None:
    steps_per_move, runs = drawn
    part = ",".join(f"{action} {steps}" for action, steps in runs)
    log = {
        "actionModel": "MAPF_T",
        "agentMaxCounter": steps_per_move,
        "start": [[50, 50, heading]],
        "actualPaths": [f"[(0,50,50,0,0):({part})]"],
    }
    (agent,) = planviz.read(json.dumps(log)).agents
    found = zip(map(tuple, agent.cells.tolist()), agent.steps.tolist(), strict=True)
    single = [action for action, steps in runs for _ in range(steps)]
    expected = visits_step_by_step(single, (50, 50), "ENWS".index(heading), steps_per_move)
    assert list(found) == expected
