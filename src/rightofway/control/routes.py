"""Routes as orders have them: names of vertices, and the work at stops as jobs."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

from rightofway.control.batteries import FleetBatteries, follow_charge
from rightofway.control.work_items import name_charge, name_stop
from rightofway.model import Battery, Plan, PlannedItem, Scenario, Tick, Track, make_route

__all__ = [
    "RouteToDrive",
    "make_route_from",
    "make_route_to_join",
    "make_route_with_work",
    "make_routes_to_drive",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class RouteToDrive:
    """The route of a robot as orders have it; visits keep their numbers when the first ones go.

    Attributes
    ----------
    places
        The name of the vertex of each visit.
    jobs
        For each visit the items of work there, see `rightofway.control.work_items`; each name is in
        one visit.
    first
        The number of the first visit that is kept.
    work
        The duration of each job of each visit, with its turn [ticks]; empty without a planner.
    enter
        When each visit is planned to begin [ticks]: only the order of these times counts. Empty
        where nobody plans.
    lap_ends
        Numbers of the visits at which a lap ends, one for each lap: of a lap without work nothing
        may be left to drive.
    in_step
        Whether the end is that of a lap of the plan, so that its next lap may follow.
    targets
        Ends of charges, each with the state of charge at which the robot may go on, from 0 to 1.
    """

    places: tuple[str, ...]
    jobs: tuple[tuple[str, ...], ...]
    first: int = 0
    work: tuple[tuple[int, ...], ...] = ()
    enter: tuple[int, ...] = ()
    lap_ends: tuple[int, ...] = ()
    in_step: bool = True
    targets: tuple[tuple[str, float], ...] = ()

    @property
    def end(self) -> int:
        """The number after that of the last visit."""
        return self.first + len(self.places)

    def get_place(self, visit: int) -> str:
        """Return the name of the vertex of a visit.

        Parameters
        ----------
        visit
            The number of a visit that is kept.
        """
        return self.places[self._index(visit)]

    def get_jobs(self, visit: int) -> tuple[str, ...]:
        """Return the actions of a visit.

        Parameters
        ----------
        visit
            The number of a visit that is kept.
        """
        return self.jobs[self._index(visit)]

    def get_work(self, visit: int) -> tuple[int, ...]:
        """Return the duration of each job of a visit [ticks].

        Parameters
        ----------
        visit
            The number of a visit that is kept.
        """
        return self.work[self._index(visit)]

    def get_enter(self, visit: int) -> int:
        """Return when a visit is planned to begin [ticks].

        Parameters
        ----------
        visit
            The number of a visit that is kept.
        """
        return self.enter[self._index(visit)]

    def stretch(self, begin: int, end: int) -> tuple[str, ...]:
        """Return the places of visits, those before ``end``.

        Parameters
        ----------
        begin, end
            Numbers of visits; those not kept are left out.
        """
        return self.places[max(begin - self.first, 0) : max(end - self.first, 0)]

    def leads_over(self, edges: Collection[tuple[str, str]], begin: int, end: int) -> bool:
        """Return whether the way from a visit to before another one leads over one of some edges.

        Parameters
        ----------
        edges
            The names of both ends of each.
        begin, end
            The numbers of the visits, as in `stretch`.
        """
        return bool(edges) and not set(edges).isdisjoint(pairwise(self.stretch(begin, end)))

    def cut_before(self, visit: int) -> RouteToDrive:
        """Return the route without the visits before one.

        Parameters
        ----------
        visit
            The number of a visit that is kept.
        """
        index = self._index(visit)
        return replace(
            self,
            first=visit,
            places=self.places[index:],
            jobs=self.jobs[index:],
            work=self.work[index:],
            enter=self.enter[index:],
            lap_ends=tuple(end for end in self.lap_ends if end >= visit),
            targets=tuple(
                (item, soc)
                for item, soc in self.targets
                if any(item in names for names in self.jobs[index:])
            ),
        )

    def cut_after(self, visit: int) -> RouteToDrive:
        """Return the route without the visits after one.

        Parameters
        ----------
        visit
            The number of a visit that is kept.
        """
        length = self._index(visit) + 1
        return replace(
            self,
            places=self.places[:length],
            jobs=self.jobs[:length],
            work=self.work[:length],
            enter=self.enter[:length],
            lap_ends=tuple(end for end in self.lap_ends if end <= visit),
        )

    def join(self, after: RouteToDrive, later: int) -> RouteToDrive:
        """Return the route until another one begins, and that one from its first visit on.

        Parameters
        ----------
        after
            The other route; its first visit is one of this route, which begins when it did.
        later
            How much later its other visits begin [ticks].
        """
        index = self._index(after.first)
        return replace(
            self,
            places=(*self.places[:index], *after.places),
            jobs=(*self.jobs[:index], *after.jobs),
            work=(*self.work[:index], *after.work),
            enter=(*self.enter[: index + 1], *(tick + later for tick in after.enter[1:])),
            lap_ends=(*(end for end in self.lap_ends if end < after.first), *after.lap_ends),
            in_step=after.in_step,
            targets=(*self.targets, *after.targets),
        )

    @property
    def all_jobs(self) -> set[str]:
        """Return the names of all that is to be done."""
        return {job for jobs in self.jobs for job in jobs}

    def _index(self, visit: int) -> int:
        index = visit - self.first
        if index < 0:
            raise IndexError(f"visit {visit} is not kept, the first is {self.first}")
        return index

    @classmethod
    def of_document(cls, document: Mapping[str, Any]) -> RouteToDrive:
        """Return a route of a journal.

        Parameters
        ----------
        document
            The route as `asdict` has it.
        """
        return cls(
            **{
                **document,
                "places": tuple(document["places"]),
                "jobs": tuple(map(tuple, document["jobs"])),
                "work": tuple(map(tuple, document["work"])),
                "enter": tuple(document["enter"]),
                "lap_ends": tuple(document["lap_ends"]),
                "targets": tuple((item, soc) for item, soc in document.get("targets", ())),
            }
        )


def make_routes_to_drive(plan: Plan) -> list[RouteToDrive]:
    """Return the route of each robot, with a job for each stop of each lap, or with its tour.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    """
    scenario = plan.scenario
    if plan.tours is not None:
        return [
            make_route_with_work(scenario, robot, track, tour)
            for robot, (track, tour) in enumerate(zip(plan.tracks, plan.tours, strict=True))
        ]
    routes = []
    for robot, itinerary, track in zip(
        scenario.robots, scenario.problem.itineraries, plan.tracks, strict=True
    ):
        route = make_route(scenario.roadmap, itinerary, track)
        jobs: list[list[str]] = [[] for _ in route.vertices]
        work: list[list[int]] = [[] for _ in route.vertices]
        stages_of_lap = len(itinerary.stages) // (robot.laps or scenario.rules.laps)
        for stage, visit in enumerate(route.serves):
            if stage % stages_of_lap < len(robot.stops):  # the rest of a lap is the way home
                jobs[visit].append(f"job{stage}")
                work[visit].append(itinerary.stages[stage].work + itinerary.stages[stage].turn)
        routes.append(
            RouteToDrive(
                places=tuple(map(scenario.roadmap.name, route.vertices)),
                jobs=tuple(map(tuple, jobs)),
                work=tuple(map(tuple, work)),
                enter=tuple(track.enter.tolist()),
                lap_ends=tuple(route.serves[stages_of_lap - 1 :: stages_of_lap]),
            )
        )
    return routes


def make_route_with_work(
    scenario: Scenario, robot: int, track: Track, tour: Sequence[PlannedItem]
) -> RouteToDrive:
    """Return the route of a robot with the stops and charges of its tour.

    A robot that ends where it may charge does so until it has more to do.

    Parameters
    ----------
    scenario
        A scenario with jobs.
    robot, track
        The number of the robot, and where it is, when.
    tour
        Its items, in order.
    """
    jobs: list[list[str]] = [[] for _ in track.vertices]
    work: list[list[int]] = [[] for _ in track.vertices]
    targets, last = list[tuple[str, float]](), len(track) - 1
    number = 0
    for number, (item, soc) in enumerate(_follow_tour(scenario, robot, track, tour), 1):
        if item.job is not None and item.stop is not None:
            assert scenario.jobs is not None, "a plan with tours has jobs"
            jobs[item.visit].append(name_stop(scenario.jobs[item.job].name, item.stop))
            work[item.visit].append(item.end - item.begin)
            continue
        jobs[item.visit].append(name_charge(number, "begin"))
        work[item.visit].append(0)
        if item.visit < last or item != tour[-1]:
            jobs[item.visit].append(name_charge(number, "end"))
            work[item.visit].append(item.end - item.begin)
            targets.append((name_charge(number, "end"), float(soc)))
    rests_at = scenario.roadmap.name(int(track.vertices[-1]))
    is_charging = bool(tour) and tour[-1].job is None and tour[-1].visit == last
    if not is_charging and FleetBatteries(scenario).may_charge(robot, rests_at):
        jobs[last].append(name_charge(number + 1, "begin"))
        work[last].append(0)
    return RouteToDrive(
        places=tuple(map(scenario.roadmap.name, track.vertices.tolist())),
        jobs=tuple(map(tuple, jobs)),
        work=tuple(map(tuple, work)),
        enter=tuple(track.enter.tolist()),
        in_step=False,
        targets=tuple(targets),
    )


def _follow_tour(
    scenario: Scenario, robot: int, track: Track, tour: Sequence[PlannedItem]
) -> Iterator[tuple[PlannedItem, Fraction]]:
    """Yield the items of a tour with the planned states of charge at their ends."""
    own = scenario.robots[robot]
    battery = Battery() if own.battery is None else dict(scenario.batteries)[own.battery]
    soc = Fraction(1) if own.start is None else own.start.soc
    ready = 0 if own.start is None else scenario.problem.clock.count_ticks(own.start.ready)
    path = track.vertices.tolist()
    charges = follow_charge(scenario, battery, path, tour, soc=soc, begin=Tick(ready))
    yield from zip(tour, charges, strict=True)


def make_route_to_join(place: str) -> RouteToDrive:
    """Return the route of a robot that has joined and is at a place."""
    return RouteToDrive(places=(place,), jobs=((),), work=((),), enter=(0,), in_step=False)


def make_route_from(route: RouteToDrive, place: str) -> RouteToDrive:
    """Return where a robot begins that was put at a place, and where its route ends.

    Its visits have numbers that no order of before has.
    """
    places = (place, route.places[-1])
    return RouteToDrive(
        places=places, jobs=((), ()), work=((), ()), enter=(0, 1), first=route.end, in_step=False
    )
