"""Names that people use: robots, jobs as ``R1/job2``, and places that they close."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rightofway.control.journal import Entry
from rightofway.control.ledger import Edge, Ledger
from rightofway.control.work_items import find_stop
from rightofway.errors import InputError, find_nearest, quote
from rightofway.facts import Fact
from rightofway.resume.rest_of_fleet import StopToMake
from rightofway.site import Roadmap

__all__ = [
    "describe_place",
    "find_failed_job",
    "find_job",
    "find_open_job",
    "find_robot",
    "list_edges_into",
    "list_jobs",
    "name_place",
]


def list_jobs(ledger: Ledger) -> list[dict[str, Any]]:
    """Return the jobs of all robots that are not done, in their order: name, place, state."""
    rows = []
    for name, own in zip(ledger.names, ledger.robots, strict=True):
        for visit in range(own.arrived, own.route.end):
            for job in own.route.get_jobs(visit):
                if job in own.finished:
                    continue
                state = "released" if visit <= own.released else "planned"
                state = "failed" if job in own.failed else state
                place = own.route.get_place(visit)
                rows.append({"name": f"{name}/{job}", "at": place, "state": state})
    return rows


def find_robot(names: Sequence[str], name: str) -> int:
    """Return the number of a robot.

    Parameters
    ----------
    names
        Of all robots.
    name
        Its name.

    Raises
    ------
    InputError
        If no robot has it.
    """
    if name not in names:
        meant = find_nearest(name, names) or names[0]
        raise InputError.at("robot", f"{quote(name)} is no robot (for example {meant})")
    return names.index(name)


def find_failed_job(ledger: Ledger, name: str) -> Entry:
    """Return robot and job of a failed job."""
    for number, own in enumerate(ledger.robots):
        for item in own.failed:
            if (find_stop(item) or ("", 0))[0] == name:
                return {"robot": number, "job": item}
    if name in ledger.pool.jobs:
        raise InputError.at("job", f"{quote(name)} has not failed (see rightofway jobs list)")
    robot, _, job = name.rpartition("/")
    number = find_robot(ledger.names, robot)
    if job not in ledger.robots[number].failed:
        raise InputError.at("job", f"{quote(name)} has not failed (see rightofway jobs list)")
    return {"robot": number, "job": job}


def find_job(
    ledger: Ledger, stops: Sequence[Sequence[StopToMake]], name: str
) -> tuple[int, int | None]:
    """Return the robot of a job, and which of its stops it is; None if it is released or done.

    Parameters
    ----------
    ledger
        The state that the journal describes.
    stops
        The stops that each robot still has to make after its released parts.
    name
        The job, as ``R1/job2``.

    Raises
    ------
    InputError
        If there is no such job.
    """
    robot, _, job = name.rpartition("/")
    number = find_robot(ledger.names, robot)
    for index, stop in enumerate(stops[number]):
        if stop.job == job:
            return number, index
    if job in ledger.robots[number].route.all_jobs:
        return number, None
    raise InputError.at("job", f"{quote(name)} is no job (see rightofway jobs list)")


def find_open_job(
    ledger: Ledger, stops: Sequence[Sequence[StopToMake]], name: str
) -> tuple[int, int]:
    """Return the robot of a job that is not released, and which of its stops it is."""
    number, index = find_job(ledger, stops, name)
    if index is None:
        is_done = name.rpartition("/")[2] in ledger.robots[number].finished
        state = "done" if is_done else "released"
        raise InputError.at("job", f"{quote(name)} is {state} already (it cannot be changed)")
    return number, index


def list_edges_into(roadmap: Roadmap, names: Sequence[str]) -> list[Edge]:
    """Return the edges that lead into a vertex, or into a lane from both its ends.

    Robots between the ends of a lane that was split drive out of it.
    """
    roadmap = roadmap.fold()
    vertices = [roadmap.get_vertex(name) for name in names]
    if len(vertices) == 1:
        tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
        same = roadmap.list_place(vertices[0])
        into = [(tail, head) for head in same for tail in tails[roadmap.heads == head].tolist()]
    else:
        lanes = roadmap.find_ways_along((vertices[0], vertices[-1]))
        if not lanes:
            message = f"no lane joins {names[0]} and {names[-1]} (name both its ends)"
            raise InputError.at("place", message)
        into = [ends for lane in lanes for ends in ((lane[0], lane[1]), (lane[-1], lane[-2]))]
    return [
        (roadmap.name(tail), roadmap.name(head))
        for tail, head in into
        if roadmap.find_edge(tail, head) is not None
    ]


def describe_place(state: str, names: Sequence[str]) -> Fact:
    """Return the state of a vertex, or of the lane between two: open, closed or opened."""
    if len(names) == 1:
        return Fact(f"place {state}", place=names[0])
    return Fact(f"lane {state}", place=names[0], other=names[-1])


def name_place(names: Sequence[str]) -> str:
    """Return the name of a vertex, or a lane, for people."""
    return names[0] if len(names) == 1 else f"the lane between {names[0]} and {names[-1]}"
