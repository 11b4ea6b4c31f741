"""Charges of robots that have nothing to do, and whose battery does not last for their rest.

The search for tours charges for stops. A robot whose last stop went to another robot while it
charged would go home with what it has, and might be too low there to reach a charging place again.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rightofway.assign import Travel
from rightofway.model import Assignment, Tick, TourItem, Work

__all__ = ["charge_for_rest"]

MARGIN = 10
"""A robot rests with one part in so many of a battery more than it needs to reach a charge."""

Ends = Sequence[tuple[Tick, ...]]
"""When the items of each tour end [ticks]."""


def charge_for_rest(
    assignment: Assignment, ends: Ends, work: Work, travel: Travel
) -> tuple[Assignment, list[tuple[Tick, ...]]]:
    """Return tours in which robots without stops charge before they go home, where they must.

    A robot may rest at home if its battery lasts from there to a charging place, and a tenth of a
    battery longer. Where it would not, the robot charges first as much as is missing, at the place
    that it leaves soonest.

    Parameters
    ----------
    assignment, ends
        Tours, and when their items end.
    work, travel
        The jobs and robots, and travel between their places.
    """
    tours, later = list(assignment.tours), list(ends)
    for robot, tour in enumerate(tours):
        choices = [] if tour else list(_list_charges(robot, work, travel))
        if choices:
            end, item = min(choices, key=lambda choice: (choice[0], choice[1].vertex))
            tours[robot], later[robot] = (item,), (end,)
    return replace(assignment, tours=tuple(tours)), later


def _list_charges(robot: int, work: Work, travel: Travel) -> list[tuple[Tick, TourItem]]:
    """Return the charges with which a robot may rest at home, with their ends; none if it may."""
    bound, kind = work.robots[robot], travel.battery_of[robot]
    if bound.home is None or bound.battery is None or not bound.battery.charge:
        return []
    own = travel.batteries[kind]
    battery, start, home = own.battery, travel.get_start(robot), travel.place_of[bound.home]
    ticks = travel.ticks[travel.kind_of[robot]]
    level = bound.battery.soc * (battery.full // bound.battery.full)

    def drain(origin: int, target: int) -> int:
        return int(own.drives[origin, target]) + battery.on * int(ticks[origin, target])

    # At home the battery should last for the way to a charge, and for making room before that; at
    # least as far as a full battery does, or the robot would go to and fro.
    ways = {place: drain(place, home) for place in own.charging if ticks[place, home] >= 0}
    needed = battery.reserve + int(own.to_charging[home])
    most = battery.full - min(ways.values(), default=battery.full)
    wanted = min(needed + battery.full // MARGIN, most)
    if wanted < needed or level - drain(start, home) >= wanted:
        return []
    # Only a robot that begins below its reserve may use it on the way to a charge.
    least = 0 if level < battery.reserve else battery.reserve
    charges = []
    for place, homeward in ways.items():
        arrived = level - drain(start, place)
        if arrived >= least and wanted + homeward <= battery.full and ticks[start, place] >= 0:
            duration = Tick(max(1, -(-(wanted + homeward - arrived) // battery.charge)))
            item = TourItem(job=None, stop=None, vertex=travel.vertices[place], duration=duration)
            charges.append((Tick(bound.ready + int(ticks[start, place]) + duration), item))
    return charges
