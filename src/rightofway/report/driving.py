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
    "has_arrived",
    "has_left",
    "is_open",
    "say_start",
    "sets_out",
    "waits_for_closure",
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


def waits_until(robot: str, place: str, conditions: Sequence[str]) -> Phrase:
    """Return where a robot waits, and what has to be the case before it goes on."""
    return Phrase(
        "{robot} waits at {place} until {arrivals}",
        robot=robot,
        place=place,
        arrivals=join_items(conditions),
    )


def has_arrived(robot: str, place: str) -> Phrase:
    """Return the condition that a robot is at a place."""
    return Phrase("{robot} is at {place}", robot=robot, place=place)


def has_left(robot: str, place: str) -> Phrase:
    """Return the condition that a robot which is off its way has left a place."""
    return Phrase("{robot} has left {place}", robot=robot, place=place)


def is_open(names: Sequence[str]) -> Phrase:
    """Return the condition that a place is open, or the lane between two places."""
    if len(names) == 1:
        return Phrase("{place} is open", place=names[0])
    return Phrase("the lane between {place} and {other} is open", place=names[0], other=names[-1])


def waits_for_closure(place: str, head: str, begin: str, end: str | None) -> Phrase:
    """Return the predicate that a robot waits, because the way before it is closed by the clock."""
    if end is None:
        return Phrase(
            "waits at {place}: the way to {head} is closed from {begin} on",
            place=place,
            head=head,
            begin=begin,
        )
    return Phrase(
        "waits at {place}: the way to {head} is closed from {begin} to {end}",
        place=place,
        head=head,
        begin=begin,
        end=end,
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
