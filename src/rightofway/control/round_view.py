"""The fleet of a control as a round sees it, and the plan of a round as routes to drive.

Each robot keeps a part of its route, at least all that is released to it. What is kept goes first
in the new order, so commitments wait for no robot.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace

from rightofway.control.batteries import FleetBatteries, follow_charge
from rightofway.control.commitments import (
    RobotCommitment,
    leave_out_unsent,
    make_robot_commitment,
)
from rightofway.control.ledger import Edge, Ledger
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.round_floor import (
    ItemToDo,
    forecast_kept_parts,
    list_items_to_do,
    list_vertices,
    put_at_stop,
)
from rightofway.control.routes import RouteToDrive
from rightofway.control.work_items import find_charge_step, find_stop, name_charge, name_stop
from rightofway.dispatch import FleetView, PlannedStep, PooledJob, RobotView, Round, StopsLater
from rightofway.dispatch.floor import SimulatedFloor
from rightofway.model import Scenario, Tick, Track
from rightofway.precedence import Part
from rightofway.site import Roadmap

__all__ = ["ViewOfRound", "find_kept_parts", "make_routes_of_round", "map_later", "view_fleet"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ViewOfRound:
    """The input of a round.

    Attributes
    ----------
    view
        The robots that are on the floor.
    present
        Their numbers in the fleet.
    kept_parts
        The last part of each robot of the fleet that is kept.
    commitments
        What each robot that is on the floor keeps.
    known
        The jobs of the round, as they were known.
    jobs
        The same as they are planned: one whose first work was asked for, and is neither done nor
        kept, is left to its robot, which may have done it.
    """

    view: FleetView
    present: tuple[int, ...]
    kept_parts: tuple[int, ...]
    commitments: tuple[RobotCommitment, ...]
    known: Mapping[str, PooledJob]
    jobs: Mapping[str, PooledJob]


def find_kept_parts(
    ledger: Ledger,
    released: Sequence[int],
    ahead: int,
    may_stop: Callable[[str], bool],
    *,
    closed: Collection[Edge] = (),
) -> list[int]:
    """Return the last part of each robot that is kept, at most ``ahead`` beyond the released ones.

    A part is kept only together with all that go before it by right of way, and as far as to where
    the robot may stop. A robot keeps none behind a stop that is not asked for yet, and none that it
    may not enter: a round could not lead it around a closure there.

    Parameters
    ----------
    ledger
        The state that the journal describes.
    released
        The last released part of each robot.
    ahead
        How many more parts a robot may keep.
    may_stop
        Tells whether robots may stop at a vertex, by its name.
    closed
        The edges that are closed now.
    """
    kept_parts, grows = list(released), True
    while grows:
        grows = False
        for robot, own in enumerate(ledger.robots):
            part = kept_parts[robot] + 1
            if own.is_off or part >= min(own.route.end, released[robot] + ahead + 1):
                continue
            items = own.route.get_jobs(part - 1)
            is_free = all(item in own.finished or own.is_sent(item) for item in items)
            rest = range(part, own.route.end)
            last = next(visit for visit in rest if may_stop(own.route.get_place(visit)))
            parts = (Part(robot, number) for number in range(part, last + 1))
            before = itertools.chain.from_iterable(map(ledger.graph.waits, parts))
            is_free = is_free and not own.route.leads_over(closed, part - 1, last + 1)
            if is_free and all(_is_kept(ledger, kept_parts, *arrival) for arrival in before):
                kept_parts[robot], grows = last, True
    return kept_parts


def _is_kept(ledger: Ledger, kept_parts: Sequence[int], robot: int, visit: int) -> bool:
    return ledger.robots[robot].is_off or visit <= kept_parts[robot]


def view_fleet(
    floor: SimulatedFloor,
    ledger: Ledger,
    kept_parts: Sequence[int],
    *,
    unable: Collection[int],
    closed: Collection[Edge],
    later: Mapping[int, StopsLater],
    now: int,
    takeover: int,
) -> ViewOfRound:
    """Return the fleet as a round sees it.

    Parameters
    ----------
    floor
        The floor as it is expected to be now, by `mirror_floor`.
    ledger
        The state that the journal describes.
    kept_parts
        The last part of each robot that is kept.
    unable
        Robots that do not go on: what they hold is a closure.
    closed
        Edges that robots shall not enter, as names of their vertices.
    later
        What robots do behind the ends of their routes, as the last round had it.
    now, takeover
        When the round begins, and when its plan takes over [ticks].
    """
    scenario, roadmap = floor.scenario, floor.roadmap
    present = tuple(robot for robot, own in enumerate(ledger.robots) if not own.is_off)
    known = {
        name: own
        for name, own in ledger.pool.jobs.items()
        if own.robot is None or not ledger.robots[own.robot].is_off
    }
    jobs = dict(known)
    views, commitments, ends = list[RobotView](), list[RobotCommitment](), list[tuple[str, Tick]]()
    latest = max(ledger.robots[k].route.get_enter(kept_parts[k]) for k in present)
    items = {k: list(list_items_to_do(scenario, ledger.robots[k], kept_parts[k])) for k in present}
    caps = {k: (kept_parts[k], sum(map(_is_kept_item, items[k]))) for k in present}
    expected, expected_ends = forecast_kept_parts(floor, caps, now, takeover)
    for robot in present:
        own = leave_out_unsent(put_at_stop(roadmap, ledger.robots[robot]), kept_parts[robot])
        commitment = make_robot_commitment(scenario, robot, own, kept_parts[robot])
        begun = {
            name: _count_begun(job, own, commitment.route)
            for name, job in known.items()
            if job.robot == robot
        }
        for name in [name for name, count in begun.items() if not count]:
            del begun[name]
            bound = replace(known[name].job, robot=ledger.names[robot])
            jobs[name] = replace(known[name], job=bound, robot=None, begun=0)
        ahead, busy = expected[robot], now + commitment.part.busy
        free = max(0, (busy if ahead.free is None else ahead.free) - takeover)
        lengths = {name: len(known[name].job.stops) for name in begun}
        ends += [
            (name, Tick(max(0, expected_ends.get(name, takeover + free) - takeover)))
            for name, count in begun.items()
            if count == lengths[name]
        ]
        commitments.append(commitment)
        views.append(
            RobotView(
                kept_track=Track.of(
                    commitment.part.vertices, [tick - latest for tick in commitment.route.enter]
                ),
                last=kept_parts[robot],
                free=Tick(free),
                heading=ahead.heading,
                soc=ahead.soc,
                begun=tuple(
                    (name, count) for name, count in begun.items() if count < lengths[name]
                ),
                is_able=robot not in unable,
                track=_make_old_track(roadmap, own, kept_parts[robot], ahead.times, takeover),
                steps=tuple(
                    item.step
                    for item in items[robot]
                    if not _is_kept_item(item)
                    and (item.step.job is None or item.step.job in jobs)
                    and item.step.job not in ledger.outdated
                ),
                later=tuple(
                    stop for stop in later.get(robot, ()) if stop[0] not in ledger.outdated
                ),
            )
        )
    shut = frozenset((roadmap.get_vertex(tail), roadmap.get_vertex(head)) for tail, head in closed)
    view = FleetView(
        now=Tick(now),
        takeover=Tick(takeover),
        robots=tuple(views),
        ends=tuple(ends),
        closed=frozenset((int(tail), int(head)) for tail, head in shut),
    )
    return ViewOfRound(
        view=view,
        present=present,
        kept_parts=tuple(kept_parts),
        commitments=tuple(commitments),
        known=known,
        jobs=jobs,
    )


def _is_kept_item(item: ItemToDo) -> bool:
    """Return whether an order has an item, which is then at the end of the kept part."""
    return item.step.visit == 0 and item.is_sent


def _make_old_track(
    roadmap: Roadmap,
    own: RobotLedger,
    last: int,
    times: tuple[int, ...] | None,
    takeover: int,
) -> Track | None:
    """Return the rest of the old plan at the times that are expected; None where there is none."""
    if times is None:
        return None
    return Track.of(list_vertices(roadmap, own, last), [0, *(tick - takeover for tick in times)])


def _count_begun(job: PooledJob, own: RobotLedger, kept_parts: RouteToDrive) -> int:
    """Return how many first stops of a job are done, or asked for in what its robot keeps."""
    items = (item for names in kept_parts.jobs for item in names if own.is_sent(item))
    stops = [stop[1] + 1 for item in items if (stop := find_stop(item)) and stop[0] == job.job.name]
    return max(job.done, *stops, 0)


def make_routes_of_round(
    scenario: Scenario, ledger: Ledger, seen: ViewOfRound, planned: Round
) -> list[RouteToDrive]:
    """Return the routes of a fleet that has planned a round.

    Jobs that have changed or left meanwhile are left out: the next round has them.

    Parameters
    ----------
    scenario, ledger
        As for `view_fleet`.
    seen
        What the round was planned from.
    planned
        The plan.
    """
    robots = [put_at_stop(scenario.roadmap, own) for own in ledger.robots]
    routes = [own.route.cut_before(own.arrived) for own in robots]
    later = 1 + max(commitment.route.enter[-1] for commitment in seen.commitments)
    batteries = FleetBatteries(scenario)
    for index, robot in enumerate(seen.present):
        steps = [step for step in planned.steps[index] if _is_as_known(ledger, seen, step.job)]
        track, view = planned.tracks[index], seen.view.robots[index]
        battery = batteries.of_robot[robot]
        items = _Items(ledger.robots[robot], seen.commitments[index].route, len(track))
        targets = [1.0] * len(steps)
        if battery is not None:
            path = track.vertices.tolist()
            reached = follow_charge(scenario, battery, path, steps, soc=view.soc, begin=view.free)
            targets = list(map(float, reached))
        for number, (step, target) in enumerate(zip(steps, targets, strict=True)):
            is_last = number == len(steps) - 1 and step.visit == len(track) - 1
            items.add(step, target, is_last=is_last)
        rests_at = scenario.roadmap.name(int(track.vertices[-1]))
        items.finish(charges=batteries.may_charge(robot, rests_at))
        routes[robot] = items.make_route(
            list(map(scenario.roadmap.name, track.vertices.tolist())),
            [later + tick for tick in track.enter.tolist()],
            robots[robot].arrived,
        )
    return routes


def map_later(ledger: Ledger, seen: ViewOfRound, planned: Round) -> Mapping[int, StopsLater]:
    """Return what each robot does behind the end of its route, by its number in the fleet.

    Parameters
    ----------
    ledger, seen, planned
        As for `make_routes_of_round`.
    """
    return {
        robot: tuple(stop for stop in stops if _is_as_known(ledger, seen, stop[0]))
        for robot, stops in zip(seen.present, planned.later, strict=False)
    }


def _is_as_known(ledger: Ledger, seen: ViewOfRound, job: str | None) -> bool:
    """Return whether a job is still the one that was planned; True for a charge."""
    own = ledger.pool.jobs.get(job or "")
    return job is None or (own is not None and own.job == seen.known[job].job)


class _Items:
    """The items of work along the new route of a robot.

    Parameters
    ----------
    own
        The robot.
    kept_parts
        The part of its route that it keeps.
    length
        How many visits the new part has; the first one is the last that is kept.
    """

    def __init__(self, own: RobotLedger, kept_parts: RouteToDrive, length: int) -> None:
        self._kept, self._numbers = kept_parts, itertools.count(own.next_job)
        self._jobs = [list(kept_parts.jobs[-1]), *([] for _ in range(length - 1))]
        self._work = [list(kept_parts.work[-1]), *([] for _ in range(length - 1))]
        self._targets = list(kept_parts.targets)
        begun = [item for item in kept_parts.jobs[-1] if find_charge_step(item) is not None]
        is_open = bool(begun) and find_charge_step(begun[-1]) == "begin"
        self._open = begun[-1] if is_open else None  # a charge that is under way

    def add(self, step: PlannedStep, target: float, *, is_last: bool) -> None:
        """Add the work of a stop, or a charge, which ends unless it is the last thing to do."""
        if step.job is not None and step.stop is not None:
            self._end_charge(0, 0.0)
            self._jobs[step.visit].append(name_stop(step.job, step.stop))
            self._work[step.visit].append(int(step.end - step.begin))
            return
        if self._open is None or step.visit > 0:
            self._end_charge(0, 0.0)
            self._begin_charge(step.visit)
        if not is_last:
            self._end_charge(int(step.end - step.begin), target, step.visit)

    def finish(self, *, charges: bool) -> None:
        """End the last charge if the robot drives on; a robot that rests at a charger charges."""
        if self._open is not None and self._open not in self._jobs[-1]:
            self._end_charge(0, 0.0)
        if charges and self._open is None:
            self._begin_charge(len(self._jobs) - 1)

    def _begin_charge(self, visit: int) -> None:
        self._open = name_charge(next(self._numbers), "begin")
        self._jobs[visit].append(self._open)
        self._work[visit].append(0)

    def _end_charge(self, ticks: int, target: float, visit: int = 0) -> None:
        if self._open is None:
            return
        item, self._open = f"{self._open} end", None
        self._jobs[visit].append(item)
        self._work[visit].append(ticks)
        self._targets.append((item, target))

    def make_route(self, places: Sequence[str], enter: Sequence[int], arrived: int) -> RouteToDrive:
        """Return the route from where the robot has arrived."""
        route = replace(
            self._kept,
            places=(*self._kept.places, *places[1:]),
            jobs=(*self._kept.jobs[:-1], *map(tuple, self._jobs)),
            work=(*self._kept.work[:-1], *map(tuple, self._work)),
            enter=(*self._kept.enter, *enter[1:]),
            lap_ends=(),
            in_step=False,
            targets=tuple(self._targets),
        )
        return route.cut_before(max(arrived, route.first))
