"""Sentences on robots that drive a plan by right of way: the story of a run, and what is wrong.

All are phrases: the log, the live page and the replay of a journal show them.
"""

from __future__ import annotations

from collections.abc import Sequence

from rightofway.phrases import Phrase, join_items

__all__ = [
    "describe_end_of_way",
    "describe_robot",
    "finishes_work",
    "goes_on",
    "say_start",
    "sets_out",
    "waits_until",
]


def describe_robot(robot: str, predicate: str) -> Phrase:
    """Return a sentence on a robot.

    Parameters
    ----------
    robot
        Its name.
    predicate
        What it does or is, without its name.
    """
    return Phrase("{robot} {predicate}", robot=robot, predicate=predicate)


def say_start() -> Phrase:
    """Return that a control has begun to drive a plan, or goes on with it."""
    return Phrase("the control has started")


def sets_out(robot: str, place: str, target: str) -> Phrase:
    """Return that a robot begins to drive, and how far its way is released."""
    return Phrase(
        "{robot} sets out from {place} to {target}", robot=robot, place=place, target=target
    )


def goes_on(robot: str, place: str, target: str) -> Phrase:
    """Return that a robot drives again after a wait, and how far its way is released."""
    return Phrase(
        "{robot} goes on from {place} to {target}", robot=robot, place=place, target=target
    )


def waits_until(robot: str, place: str, others: Sequence[tuple[str, str]]) -> Phrase:
    """Return where a robot waits, and where each of the others has to arrive before it goes on."""
    arrivals = [Phrase("{robot} is at {place}", robot=name, place=at) for name, at in others]
    return Phrase(
        "{robot} waits at {place} until {arrivals}",
        robot=robot,
        place=place,
        arrivals=join_items(arrivals),
    )


def finishes_work(robot: str, place: str, done: int, jobs: int) -> Phrase:
    """Return that a robot has done a job, and how many of its jobs are done."""
    return Phrase(
        "{robot} has done its work at {place} ({done} of {jobs})",
        robot=robot,
        place=place,
        done=str(done),
        jobs=str(jobs),
    )


def describe_end_of_way(robot: str, place: str) -> Phrase:
    """Return that a robot has come to the end of its route."""
    return Phrase("{robot} is at the end of its way, {place}", robot=robot, place=place)
