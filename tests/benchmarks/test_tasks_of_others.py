"""Tasks of other programs: logs of pibt2 as jobs, and goals that agents choose from."""

from __future__ import annotations

from benchmarks.tasks_of_others import (
    find_least_flowtime,
    list_assignments,
    plan_log,
    read_log,
)

ROWS = ["....", ".TT."]

LOG = """instance=hall.txt
agents=2
map_file=hall.map
solver=TP
solved=1
service_time=7.5
makespan=11
starts=(0,1),(3,1),
task=
1:3->0,appear=2,finished=11
0:1->2,appear=0,finished=4
solution=
0:(0,1)->(1,0):0,(3,1)->(3,1):-1,
"""
"""Two agents in the lower corners; a place is row * 4 + column."""


def test_a_log_of_pibt2_is_a_scenario_with_its_tasks() -> None:
    log = read_log(LOG, ROWS)
    assert (log.solver, log.makespan, log.service_time) == ("TP", 11, 7.5)
    name = log.scenario.roadmap.name
    assert [name(robot.home) for robot in log.scenario.robots] == ["N4", "N7"]
    assert [
        (job.name, int(job.earliest), [(name(stop.at), stop.load) for stop in job.stops])
        for job in log.scenario.jobs or ()
    ] == [("T0", 0, [("N1", 1), ("N2", -1)]), ("T1", 2, [("N3", 1), ("N0", -1)])]
    # A0 is at its dropoff N2 at 3 and goes back. A1 waits for step 2 at N3, then for A0: it follows
    # to N2 at 4, and is at N0 at 6, 4 after T1 appeared.
    assert plan_log(log, 1) == (6, 3.5)


def test_each_agent_gets_one_goal_and_the_least_flowtime_is_found() -> None:
    """On a row with a bay, an agent without a goal makes room for the other one."""
    agents = [
        {"name": "A", "start": [0, 0], "potentialGoals": [[4, 0], [3, 0]]},
        {"name": "B", "start": [1, 0], "potentialGoals": [[4, 0], [3, 0]]},
    ]
    hall = {"dimensions": [5, 2], "obstacles": [[0, 1], [1, 1], [3, 1], [4, 1]]}
    document = {"map": hall, "agents": agents}
    assert len(list(list_assignments(document))) == 2  # of four, two give both one goal
    assert find_least_flowtime(document, 1) == 6  # A to column 3, B to column 4: three moves each
    agents[1]["potentialGoals"] = []
    assert find_least_flowtime(document, 1) == 5  # A three moves, B two into the bay
