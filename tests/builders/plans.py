"""Plans written by hand, to be looked at; no planner made them."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np

from rightofway.model import (
    Decision,
    ExecutionTrace,
    Plan,
    PlannerRun,
    Reroute,
    Robot,
    Rules,
    Scenario,
    Status,
    SteadyState,
    Stop,
    Tick,
    Track,
    find_stays,
)
from rightofway.model.kept_facts import RerouteReason
from rightofway.site import Edge, VertexId, make_grid_roadmap, make_roadmap
from rightofway.units import Units

__all__ = [
    "DOOR",
    "counter",
    "counter_late",
    "counter_steady",
    "crowd",
    "delayed",
    "door",
    "door_shifted",
    "hostile",
    "loop",
    "yard",
]

DOOR = ("...", "@.@", "...")
"""Vertices 0 to 6 are named N0, N1, N2, N4, N6, N7, N8."""


def door() -> Plan:
    """Return the paper's Table 4: R1 waits one tick in N0, until R2 has left N1."""
    roadmap = make_grid_roadmap(DOOR)
    robots = tuple(
        Robot(
            name=name, home=roadmap.get_vertex(home), stops=(Stop(at=roadmap.get_vertex(target)),)
        )
        for name, home, target in (("R1", "N0", "N6"), ("R2", "N2", "N8"))
    )
    decision = Decision(
        tick=Tick(1),
        kind="vertex",
        vertices=(roadmap.get_vertex("N1"),),
        robots=(0, 1),
        waits=0,
        waits_at=roadmap.get_vertex("N0"),
        ticks=Tick(1),
        level="robot",
        conflicts_left=(0, 0),
        completion_sums=(19, 19),
    )
    return Plan(
        scenario=Scenario(roadmap=roadmap, robots=robots),
        tracks=(
            Track.of([0, 1, 3, 5, 4, 5, 3, 1, 0], [0, 2, 3, 4, 5, 7, 8, 9, 10]),
            Track.of([2, 1, 3, 5, 6, 5, 3, 1, 2], [0, 1, 2, 3, 4, 6, 7, 8, 9]),
        ),
        run=PlannerRun(name="two-level", status=Status("waits only"), decisions=(decision,)),
    )


def door_shifted(ticks: int) -> Plan:
    """Return the door with all of R1 but its start so many ticks later; -1 makes it collide."""
    plan = door()
    first, *others = plan.tracks
    enter = [int(tick) + ticks * (visit > 0) for visit, tick in enumerate(first.enter)]
    return replace(plan, tracks=(Track.of(first.vertices.tolist(), enter), *others))


def loop(*, occupancy: str = "one", names: tuple[str, ...] = ("a", "b", "c", "d")) -> Plan:
    """Return one robot on a roadmap of four vertices, with work of 2 and turning of 1 at ``c``.

    The tick is half a unit: the short edges take 1 unit, the long one from ``c`` to ``d`` 3/2. The
    edge from ``d`` to ``a`` leads one way only.
    """
    a, b, c, d = names
    lengths = {(a, b): 2, (b, a): 2, (b, c): 2, (c, b): 2, (c, d): 3, (d, c): 3, (d, a): 2}
    roadmap = make_roadmap(
        {a: (0, 0), b: (2, 0), c: (2, 2), d: (-1, 2)},
        [Edge(tail=u, head=w, length=Fraction(length)) for (u, w), length in lengths.items()],
    )
    robot = Robot(
        name="Cart", home=VertexId(0), stops=(Stop(at=VertexId(2), work=Fraction(2)),),
        speed=Fraction(2), turn=Fraction(1),
    )  # fmt: skip
    rules = Rules(occupancy="both") if occupancy == "both" else Rules()
    # ticks: 2 to b, 2 to c; there 4 of work, 2 of turning, 1 of waiting, 3 of driving; 2 to a
    return Plan(
        scenario=Scenario(roadmap=roadmap, robots=(robot,), rules=rules),
        tracks=(Track.of([0, 1, 2, 3, 0], [0, 2, 4, 14, 16]),),
        run=PlannerRun(
            name="by hand",
            reroutes=(Reroute(robot=0, because=RerouteReason("other", text="just so")),),
        ),
    )


def hostile(name: str) -> Plan:
    """Return a plan in which everything that may have a name has this one."""
    roadmap = make_roadmap(
        {name: (0, 0), "b": (1, 0)},
        [
            Edge(tail=name, head="b", length=Fraction(1)),
            Edge(tail="b", head=name, length=Fraction(1)),
        ],
    )
    robot = Robot(name=name, home=VertexId(0), stops=(Stop(at=VertexId(1)),))
    run = PlannerRun(
        name=name,
        status=Status("other", text=name),
        reroutes=(Reroute(robot=0, because=RerouteReason("other", text=name)),),
    )
    tracks = (Track.of([0, 1, 0], [0, 1, 2]),)
    return Plan(scenario=Scenario(roadmap=roadmap, robots=(robot,)), tracks=tracks, run=run)


def crowd(robots: int, *, decisions: int = 0) -> Plan:
    """Return a warehouse of 161 by 63 cells with many robots that run free: they do collide.

    Every third row is an aisle, and so are the first of every ten columns. A robot drives along its
    row to the next such column, along that to the row of its stop, and there to its stop; after 3
    units of work the same way back.
    """
    columns, rows = 161, 63
    aisle = "." * columns
    shelf = "".join("." if column % 10 == 0 else "@" for column in range(columns))
    roadmap = make_grid_roadmap([shelf if row % 3 else aisle for row in range(rows)])
    cells = [(3 * (index % 21), index // 21 * 3 + 1) for index in range(robots)]
    ways = []
    for index, (row, column) in enumerate(cells):
        goal_row, goal_column = 3 * ((index * 8 + 5) % 21), (column * 7 + 11 * index) % columns
        cross = column - column % 10
        corners = [(row, column), (row, cross), (goal_row, cross), (goal_row, goal_column)]
        ways.append([roadmap.get_vertex(f"N{r * columns + c}") for r, c in _straight(corners)])
    fleet = tuple(
        Robot(name=f"Robot {index + 1}", home=way[0], stops=(Stop(at=way[-1], work=Fraction(3)),))
        for index, way in enumerate(ways)
    )
    tracks = tuple(_there_and_back(way) for way in ways)
    run = PlannerRun(
        name="free",
        decisions=tuple(_decision(index, ways[2 * index][1]) for index in range(decisions)),
    )
    return Plan(scenario=Scenario(roadmap=roadmap, robots=fleet), tracks=tracks, run=run)


def _straight(corners: list[tuple[int, int]]) -> list[tuple[int, int]]:
    cells = [corners[0]]
    for row, column in corners[1:]:
        while cells[-1] != (row, column):
            (r, c) = cells[-1]
            down, right = (row > r) - (row < r), (column > c) - (column < c)
            cells.append((r + down, c + right))
    return cells


def _there_and_back(way: list[VertexId]) -> Track:
    """Drive a way, work 3 ticks and turn 1, and drive back; a tick for an edge."""
    last = len(way) - 1
    back = [last + 4 + step for step in range(1, last + 1)]
    return Track.of([*way, *way[-2::-1]], [*range(last + 1), *back])


def _decision(index: int, vertex: VertexId) -> Decision:
    return Decision(
        tick=Tick(index % 40),
        kind="vertex",
        vertices=(vertex,),
        robots=(2 * index, 2 * index + 1),
        waits=2 * index,
        waits_at=vertex,
        ticks=Tick(1),
        level="node",
        conflicts_left=(3, 5),
    )


def counter(laps: int = 4) -> Plan:
    """Return two robots that take turns at one counter, four laps each, in the grid ``...``.

    R1 has its home in N0, R2 in N2; both work 3 ticks in N1 and turn for 1, and an edge takes 1. So
    N1 is held for 5 ticks by one and then by the other: everything comes again after 10.
    """
    roadmap = make_grid_roadmap(["..."])
    robots = tuple(
        Robot(name=name, home=VertexId(home), stops=(Stop(at=VertexId(1), work=Fraction(3)),))
        for name, home in (("R1", 0), ("R2", 2))
    )
    tracks = tuple(
        Track.of(
            [home, *[1, home] * laps],
            [0, *(tick + 10 * lap for lap in range(laps) for tick in (first, first + 5))],
        )
        for home, first in ((0, 1), (2, 6))
    )
    scenario = Scenario(roadmap=roadmap, robots=robots, rules=Rules(laps=laps))
    return Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))


def counter_steady() -> SteadyState:
    """Return the steady period of `counter`.

    From tick 6 on, when R2 comes to the counter and R1 is home, everything comes again. The circle:
    R1 comes to N1 and goes home, so R2 comes to N1 and goes home, so R1 comes to N1, 10 ticks on.
    """
    critical = ((0, 3), (0, 2), (1, 1), (1, 2))  # at ticks 11, 6 (so 16), 6 (so 16) and 11 (so 21)
    return SteadyState(robots=(0, 1), start=Tick(6), period=Tick(10), critical=critical)


def counter_late() -> ExecutionTrace:
    """Return a run of `counter`: R1 is held up for 4 ticks at its first work, R2 breaks down.

    R1 stands still from 3 to 7 and leaves N1 at 10 instead of 6; all that follows is 4 late. R2
    comes to N1 at 20 instead of 16 and breaks down there at 22; R1, home since 20, waits for ever.
    """
    return ExecutionTrace(
        tracks=(
            Track.of([0, 1, 0, 1, 0], [0, 1, 10, 15, 20]),
            Track.of([2, 1, 2, 1], [0, 10, 15, 20]),
        ),
        dwell=(np.array([0, 4, 1, 4, 1]), np.array([0, 4, 1, 4])),
        drive=(np.array([0, 1, 1, 1, 1]), np.array([0, 1, 1, 1])),
        completion=(None, None),
        stoppages=(((Tick(3), Tick(4)),), ((Tick(22), None),)),
    )


def delayed(plan: Plan, every: int = 9) -> ExecutionTrace:
    """Return a run of a plan in which each robot loses ticks by itself, and heeds nobody.

    Each drive into every ninth visit takes a tick longer, and each robot stands still for 12 ticks.
    """
    tracks, dwells, drives, stoppages = [], [], [], []
    for robot, (track, stay) in enumerate(
        zip(plan.tracks, find_stays(plan.scenario, plan.tracks), strict=True)
    ):
        slow = (np.arange(len(track)) + robot) % every == 0
        slow[0] = False
        begin = 20 + 7 * robot % 60
        enter = track.enter + np.cumsum(slow)
        enter[enter > begin] += 12
        tracks.append(Track.of(track.vertices.tolist(), enter.tolist()))
        dwells.append(stay.dwell)
        drives.append(np.append(0, stay.drive[:-1]) + slow)
        stoppages.append(((Tick(begin), Tick(12)),) if begin < enter[-1] else ())
    return ExecutionTrace(
        tracks=tuple(tracks),
        dwell=tuple(dwells),
        drive=tuple(drives),
        completion=tuple(Tick(int(track.enter[-1])) for track in tracks),
        stoppages=tuple(stoppages),
    )


def yard() -> Plan:
    """Return two robots on a roadmap in metres: dock to gate both ways, then round one way."""
    lengths = {
        ("dock", "gate"): 4, ("gate", "dock"): 4, ("gate", "press"): 3, ("press", "paint"): 4,
        ("paint", "dock"): 3,
    }  # fmt: skip
    roadmap = make_roadmap(
        {"dock": (0, 0), "gate": (4, 0), "press": (4, 3), "paint": (0, 3)},
        [Edge(tail=u, head=w, length=Fraction(length)) for (u, w), length in lengths.items()],
    )
    robots = (
        Robot(
            name="porter",
            home=roadmap.get_vertex("dock"),
            stops=(Stop(at=roadmap.get_vertex("press")),),
        ),
        Robot(
            name="runner",
            home=roadmap.get_vertex("gate"),
            stops=(Stop(at=roadmap.get_vertex("dock")),),
        ),
    )
    return Plan(
        scenario=Scenario(roadmap=roadmap, robots=robots, units=Units(length="m", time="s")),
        tracks=(
            Track.of([0, 1, 2, 3, 0], [0, 8, 11, 15, 18]),
            Track.of([1, 0, 1], [0, 4, 8]),
        ),
        run=PlannerRun(name="by hand"),
    )
