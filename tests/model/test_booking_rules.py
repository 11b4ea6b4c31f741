"""When visits book is computed in one place; nobody else reads the headway or who books ahead."""

from __future__ import annotations

import ast
from collections import Counter

import numpy as np

from rightofway.model import BookingRules, Tick
from tests.builders.sources import SOURCES, parse_modules

READERS = {
    "model/booking_rules.py": "when a visit books",
    "native/problem.py": "the same rules for kernels",
    "model/problem.py": "the headway of a scenario in ticks",
    "model/scenario.py": "a negative headway is a fault",
    "check/__init__.py": "the judge makes bookings of its own",
    "check/closures.py": "the judge",
    "check/conflicts.py": "the judge",
    "check/space.py": "the judge",
    "check/visits.py": "the judge",
    "check/zones.py": "the judge",
    "dispatch/floor.py": "a robot on the floor may drive to what it has not booked",
    "execution/forecast.py": "a robot may drive to what it has not booked",
    "execution/progress.py": "a robot may drive to what it has not booked",
    "cyclic/parameter_curves.py": "the period as a function of the headway",
    "io/scenario/reader.py": "ticks that are too many are refused",
    "viz/page/payload.py": "the page shows bookings",
}
"""Modules that read the headway or who books ahead, and what for."""

READ = {"headway", "books_ahead"}


def readers() -> Counter[str]:
    """Return how often each module reads an attribute of that name of rules."""
    count = Counter[str]()
    for path, module in parse_modules().items():
        for node in ast.walk(module):
            if isinstance(node, ast.Attribute) and node.attr in READ:
                count[path.relative_to(SOURCES).as_posix()] += 1
    return count


def test_bookings_alone_read_the_rules_of_booking() -> None:
    count = readers()
    del count["execution/statistics.py"]  # its numbers of collisions by kind
    assert set(count) - set(READERS) == set()
    assert count.total() <= 29


def test_a_visit_books_from_its_drive_on_and_for_the_headway() -> None:
    ahead = BookingRules(headway=Tick(2), books_ahead=True)
    at_once = BookingRules(headway=Tick(2))
    assert (ahead.start(10, 3), ahead.end(20), ahead.follow(22, 3)) == (7, 22, 25)
    assert (at_once.start(10, 3), at_once.end(20), at_once.follow(22, 3)) == (10, 22, 22)
    assert ahead.start(np.array([10, 20]), np.array([3, 4])).tolist() == [7, 16]


def test_a_tick_keeps_robots_apart_where_only_a_rule_forbids_rotations() -> None:
    assert BookingRules(rotations=False).keep_apart().headway == 1
    assert BookingRules(rotations=False, headway=Tick(3)).keep_apart().headway == 3
    assert BookingRules(rotations=False, books_ahead=True).keep_apart().headway == 0
    assert BookingRules().keep_apart() == BookingRules()
    rotating = [
        BookingRules().may_rotate,
        BookingRules(books_ahead=True).may_rotate,
        BookingRules(headway=Tick(1)).may_rotate,
        BookingRules(rotations=False).may_rotate,
    ]
    assert rotating == [True, False, False, False]
