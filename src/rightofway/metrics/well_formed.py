"""Well formed fleets: which jobs no robot can do alone, from home and back, past the other homes.

A fleet is well formed if all robots start at homes that are not closed, no job has begun, and each
job can be done by one allowed robot alone, with a full battery, from home and back, on a way that
avoids the other homes; and if the home of a robot with a battery charges it. Then all jobs without
`latest` can be served: one robot after another does one job, charges and stays at home.

References
----------
Ma, Li, Kumar & Koenig, *Lifelong Multi-Agent Path Finding for Online Pickup and Delivery Tasks*,
AAMAS 2017: well formed MAPD instances, here with batteries.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise

from rightofway.facts import Fact
from rightofway.metrics.site import Finding, Site
from rightofway.model import Scenario
from rightofway.model.work import BoundJob, BoundRobot, Work
from rightofway.search.lone_ways import LoneWays
from rightofway.site import VertexId


def find_ill_formed_jobs(site: Site) -> Iterator[Finding]:
    """Yield the jobs that keep a fleet from being well formed, and the robots that do."""
    scenario = site.scenario
    if scenario is None or scenario.problem.work is None:
        return
    yield from _find_odd_starts(site, scenario)
    search = _JobSearch(site, scenario, scenario.problem.work)
    for index, job in enumerate(scenario.problem.work.jobs):
        finding = search.find_obstacle(index, job)
        if finding is not None:
            yield finding


def _find_odd_starts(site: Site, scenario: Scenario) -> Iterator[Finding]:
    """Yield the robots that do not begin at an open home without work."""
    closures = scenario.problem.closures
    states = [robot.start for robot in scenario.robots]
    away, closed, busy = list[int](), list[int](), list[int]()
    for index, (robot, state) in enumerate(zip(scenario.robots, states, strict=True)):
        if state is not None and state.at != robot.home:
            away.append(index)
        if closures is not None and closures.list_at_vertex(index, robot.home):
            closed.append(index)
        if state is not None and state.begun:
            busy.append(index)
    for kind, remedy, robots in (
        ("starts away from home", "start at home", away),
        ("home closed", "keep the home open", closed),
        ("jobs begun", "finish begun jobs", busy),
    ):
        if robots:
            yield Finding(
                kind="job",
                severity="note",
                fact=Fact(kind, site, robots=tuple(robots)),
                remedy=Fact(remedy),
                vertices=site.list_names(scenario.robots[robot].home for robot in robots),
                robots=tuple(scenario.robots[robot].name for robot in robots),
            )


class _JobSearch:
    """The search for a robot that can do a job alone, and for the reason where there is none."""

    def __init__(self, site: Site, scenario: Scenario, work: Work) -> None:
        self.site, self.scenario, self.work = site, scenario, work
        self.ways = LoneWays(scenario)

    def find_obstacle(self, index: int, job: BoundJob) -> Finding | None:
        """Return why no robot can do a job alone, or None if one can, or has begun it.

        Of several robots the one counts that is nearest to doing it: whose battery is too small, or
        is not charged at home, before those without a way.
        """
        if job.begun_by is not None:
            return None
        obstacles = list[tuple[int, Fact, Fact, int]]()
        for robot in job.robots:
            obstacle = self._find_obstacle_of(robot, index, job)
            if obstacle is None:
                return None
            obstacles.append((*obstacle, robot))
        if not obstacles:
            name = self._name(index)
            obstacles = [(0, self._state("job without robot", job=name), Fact("allow a robot"), -1)]
        _, fact, remedy, robot = max(obstacles, key=lambda obstacle: obstacle[0])
        return Finding(
            kind="job",
            severity="error",
            fact=fact,
            remedy=remedy,
            vertices=self.site.list_names(dict.fromkeys(stop.vertex for stop in job.stops)),
            robots=() if robot < 0 else (self.scenario.robots[robot].name,),
        )

    def _name(self, job: int) -> str:
        assert self.scenario.jobs is not None, "the scenario has jobs"
        return self.scenario.jobs[job].name

    def _state(self, kind: str, **values: object) -> Fact:
        return Fact(kind, self.site, **values)

    def _find_obstacle_of(
        self, robot: int, index: int, job: BoundJob
    ) -> tuple[int, Fact, Fact] | None:
        """Return a rank, a fact and a remedy if a robot cannot do a job, or None."""
        home, name = self.scenario.robots[robot].home, self._name(index)
        battery, bound = self.ways.get_battery(robot), self.work.robots[robot]
        legs = list(pairwise([home, *(stop.vertex for stop in job.stops), home]))
        stops, reach = [stop for _, stop in legs[:-1]], self.ways.find_reach(robot)
        # Ways between stops need no search: one may lead by the robot's own home.
        missing = next((stop for stop in stops if not reach[stop]), None)
        if missing is not None:
            has_way = bool(self.ways.find_reach(robot, avoids_homes=False)[stops].all())
            kind = "job through homes" if has_way else "job without way"
            fact = self._state(kind, job=name, robot=robot, place=missing)
            return int(has_way), fact, Fact("move the homes" if has_way else "add a way for it")
        if battery is None:
            return None
        need, most = self._add_energies(robot, legs, job, bound), battery.full - battery.reserve
        if need > most:
            shares = {"need": Fraction(need, battery.full), "most": Fraction(most, battery.full)}
            kind = "job beyond battery" if need <= battery.full else "job beyond full battery"
            fact = self._state(kind, job=name, robot=robot, **shares)
            return 3, fact, Fact("give a larger battery")
        if home not in bound.charging or (need and not battery.charge):
            fact = self._state("home does not charge", job=name, robot=robot, place=home)
            return 2, fact, Fact("charge at home")
        return None

    def _add_energies(
        self,
        robot: int,
        legs: Sequence[tuple[VertexId, VertexId]],
        job: BoundJob,
        bound: BoundRobot,
    ) -> int:
        """Return the energy of a job from home and back; without turns between edges."""
        battery = bound.battery
        assert battery is not None, "the robot has one"
        drives = sum(self.ways.compute_energy(robot, *leg) for leg in legs)
        works = sum(stop.work for stop in job.stops)
        turns = bound.turn * len(job.stops)
        return drives + works * (battery.work + battery.on) + turns * battery.on
