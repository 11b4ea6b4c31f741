"""Plans as JSON for PlanViz and the League of Robot Runners: actions, tasks and events.

Robots that drive along an edge in one tick and turn by 90 degrees in one tick have the actions of
the model ``MAPF_T``, one for each tick: waits, then turns, then a drive. A half turn is two turns
clockwise. Other robots have those of the model ``MAPF``, without headings.

The jobs of a scenario are tasks of several errands, as of the round of 2024. Without jobs each stop
is a task of its own, as of the round of 2023. In the model ``MAPF_T`` the errands of jobs are
finished by the rule of the League: at each step from 1 on, an agent finishes the next errand of its
tour if it is at that place, one errand in a step. So an errand may be finished at another step than
in the plan, or never, where a robot does two at one place and instant.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from rightofway.errors import InputError
from rightofway.io.foreign.planviz import HEADINGS, MOVES
from rightofway.io.foreign.trajectories import Cell, CellsOfPlan, make_cells, require_grid
from rightofway.model import Plan, Scenario, Track
from rightofway.model.planned_tour import PlannedTour

RIGHT_ANGLE = 90
"""A turn of the League [degrees]."""

ROUND = "2024 LoRR"
"""The round of the League whose tasks have several errands."""

TURNS = ((), ("C",), ("R", "R"), ("R",))
"""The turns to a heading, by how far it is from the last one in the order of `HEADINGS`."""


class Errand(NamedTuple):
    """Work at a stop of a job: indices of both, the visit of the robot, and when it ends."""

    job: int
    stop: int
    visit: int
    end: int


def write(plan: Plan) -> str:
    """Return the text of a plan.

    Raises
    ------
    InputError
        If the roadmap is no grid, or a robot moves without the time for its turn.
    """
    turns = has_turns(plan.scenario)
    starts, paths = _turn_and_drive(plan) if turns else _drive_only(make_cells(plan))
    finished = _finish_errands(plan, by_rule=turns)
    steps = max([*map(len, paths), *(step for own in finished for step in own)])
    lines = [",".join([*path, *["W"] * (steps - len(path))]) for path in paths]
    document = {
        "actionModel": "MAPF_T" if turns else "MAPF",
        "AllValid": "Yes",
        "teamSize": len(lines),
        "start": starts,
        "sumOfCost": sum(int(track.enter[-1]) for track in plan.tracks),
        "makespan": steps,
        "actualPaths": lines,
        "plannerPaths": lines,
        "plannerTimes": [],
        "errors": [],
        **(_log_stops if plan.tours is None else _log_jobs)(plan, finished),
    }
    return json.dumps(document) + "\n"


def has_turns(scenario: Scenario) -> bool:
    """Return whether all robots drive, and turn by a right angle, in a tick each."""
    roadmap, problem = scenario.roadmap, scenario.problem
    return all(
        itinerary.turning is not None
        and itinerary.turning.rate == RIGHT_ANGLE
        and (itinerary.heading or 0) % RIGHT_ANGLE == 0
        and {itinerary.edge_ticks[edge] for edge in np.unique(roadmap.class_of_edge)} <= {-1, 1}
        for itinerary in problem.itineraries
    )


def count_missed_errands(plan: Plan) -> int:
    """Return how many errands of tours an agent of the League does not finish along the plan."""
    finished = _finish_errands(plan, by_rule=True)
    errands = [len(list(list_errands(tour))) for tour in plan.tours or ()]
    return sum(errands) - sum(map(len, finished)) if plan.tours else 0


def _drive_only(cells: CellsOfPlan) -> tuple[list[list[Any]], list[list[str]]]:
    """Return the starts and the actions of robots without headings."""
    names = {move: action for action, move in MOVES.items()} | {(0, 0): "W"}
    steps = zip(np.diff(cells.rows).tolist(), np.diff(cells.columns).tolist(), strict=True)
    paths = [[names.get(move, "W") for move in zip(*moves, strict=True)] for moves in steps]
    return [[*next(cells.list_cells(robot)), "N/A"] for robot in range(len(paths))], paths


def _turn_and_drive(plan: Plan) -> tuple[list[list[Any]], list[list[str]]]:
    """Return the starts and the actions of robots with headings."""
    grid, starts, paths = require_grid(plan), list[list[Any]](), list[list[str]]()
    for robot, track in enumerate(plan.tracks):
        cells = [grid.get_cell(vertex) for vertex in track.vertices.tolist()]
        headings = [_find_heading_of_move(*move) for move in pairwise(cells)]
        known = plan.scenario.problem.itineraries[robot].heading
        now = next(iter(headings), 0) if known is None else -int(known) // RIGHT_ANGLE % len(TURNS)
        starts.append([*cells[0], list(HEADINGS)[now]])
        path = list[str]()
        for heading, ticks in zip(headings, np.diff(track.enter).tolist(), strict=True):
            actions = [*TURNS[(heading - now) % len(TURNS)], "F"]
            if ticks < len(actions):
                message = f"drives {ticks} ticks after it came, and turns first"
                raise InputError.at(("robots", robot), f"{message} (check the plan)")
            path += ["W"] * (ticks - len(actions)) + actions
            now = heading
        paths.append(path)
    return starts, paths


def _find_heading_of_move(before: Cell, after: Cell) -> int:
    """Return the number of the heading of a move to the next cell."""
    move = after[0] - before[0], after[1] - before[1]
    if move not in HEADINGS.values():
        message = f"a robot jumps from {list(before)} to {list(after)} (check the plan)"
        raise InputError.at("robots", message)
    return list(HEADINGS.values()).index(move)


def _finish_errands(plan: Plan, *, by_rule: bool) -> list[list[int]]:
    """Return the steps at which each robot finishes its stops, or the errands of its tour."""
    if plan.tours is None:
        itineraries = plan.scenario.problem.itineraries
        return [
            [
                int(track.enter[visit]) + stage.work
                for visit, stage in zip(stays.serves, itinerary.stages, strict=False)
            ]
            for stays, track, itinerary in zip(plan.stays, plan.tracks, itineraries, strict=True)
        ]
    if by_rule:
        return [
            list(_finish_by_rule(track, [errand.visit for errand in list_errands(tour)]))
            for track, tour in zip(plan.tracks, plan.tours, strict=True)
        ]
    return [[errand.end for errand in list_errands(tour)] for tour in plan.tours]


def list_errands(tour: PlannedTour) -> Iterator[Errand]:
    """Yield the work of a tour at stops of jobs, without charges."""
    for item in tour:
        if item.job is not None and item.stop is not None:
            yield Errand(item.job, item.stop, item.visit, item.end)


def _finish_by_rule(track: Track, visits: Iterable[int]) -> Iterator[int]:
    """Yield the steps at which an agent of the League finishes the errands of these visits."""
    at, step, last = 0, 0, len(track) - 1
    for errand in visits:
        step, vertex = step + 1, track.vertices[errand]
        while at < last and (track.enter[at + 1] <= step or track.vertices[at] != vertex):
            at += 1
        if track.vertices[at] != vertex:
            return
        step = max(step, int(track.enter[at]))
        yield step


def _log_stops(plan: Plan, finished: Sequence[Sequence[int]]) -> dict[str, Any]:
    """Return a task for each stop of a robot, and when it is assigned and finished."""
    tasks, events, grid = list[list[int]](), list[list[list[int | str]]](), require_grid(plan)
    for itinerary, steps in zip(plan.scenario.problem.itineraries, finished, strict=True):
        own: list[list[int | str]] = []
        for stage, begin, end in zip(itinerary.stages, [0, *steps], steps, strict=False):
            own += [[len(tasks), begin, "assigned"], [len(tasks), end, "finished"]]
            tasks.append([len(tasks), *grid.get_cell(stage.vertex)])
        events.append(own)
    return {"numTaskFinished": len(tasks), "events": events, "tasks": tasks}


def _log_jobs(plan: Plan, finished: Sequence[Sequence[int]]) -> dict[str, Any]:
    """Return the tasks that robots do, when each is assigned, and when its errands are finished."""
    assert plan.tours is not None, "the plan has jobs"
    jobs, grid = plan.scenario.jobs or (), require_grid(plan)
    work = plan.scenario.problem.work
    assert work is not None, "the plan has jobs"
    events, schedules, used = list[tuple[int, int, int, int]](), list[str](), set[int]()
    for robot, (tour, steps) in enumerate(zip(plan.tours, finished, strict=True)):
        errands, begin, current, schedule = list(list_errands(tour)), 1, -1, list[str]()
        for errand, step in zip(errands, [*steps, None], strict=False):
            if errand.job != current:
                schedule.append(f"{begin}:{errand.job}")
                current = errand.job
            if step is not None:
                events.append((step, robot, errand.job, errand.stop + 1))
                begin = step + 1
        schedules.append(",".join(schedule))
        used |= {errand.job for errand in errands}
    return {
        "version": ROUND,
        "numTaskFinished": sum(stop == len(jobs[job].stops) for _, _, job, stop in events),
        "actualSchedule": schedules,
        "plannerSchedule": schedules,
        "scheduleErrors": [],
        "events": sorted(events),
        "tasks": [
            [
                job,
                work.jobs[job].earliest,
                [part for stop in jobs[job].stops for part in grid.get_cell(stop.at)],
            ]
            for job in sorted(used)
        ],
    }
