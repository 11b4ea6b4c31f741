"""The judge of jobs and its slow twin agree on random scenarios with random plans."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import ceil
from typing import Any

from hypothesis import strategies as st

from rightofway.assign import WorkBound, measure_travel
from rightofway.check import check
from rightofway.model import (
    Battery,
    Job,
    JobStop,
    Plan,
    PlannedItem,
    PlannerRun,
    Robot,
    RobotState,
    Rules,
    Scenario,
    Tick,
    Track,
)
from rightofway.plan_work.rounds import OBJECTIVES
from rightofway.search import Distances
from rightofway.site import VertexId, make_grid_roadmap
from tests.builders.laws import law, leave
from tests.oracles.judge import Site
from tests.oracles.work import Broken, Fleet, Own, judge, list_robots, measure
from tests.oracles.work_search import TooLarge, find_best

F = Fraction

RULES = {
    "item": {"before ready", "outside visit", "wrong duration", "items overlap", "wrong stop"},
    "load": {"wrong load"},
    "charge": {"wrong charger", "low battery", "stranded"},
    "end": {"wrong start", "wrong end"},
    "time": {"too early", "too late"},
    "job": {
        "stop not done",
        "stop done again",
        "job divided",
        "stop order",
        "wrong robot",
        "also unserved",
        "begun unserved",
        "after unserved",
        "wrong order",
    },
}
"""The kinds of faults of each rule of the slow judge."""


TIMES = st.sampled_from([F(0), F(0), F(1), F(3, 2), F(4), F(7)])


def draw_job(draw: st.DrawFn, name: str, cells: st.SearchStrategy[VertexId]) -> Job:
    """Draw a job that is for all robots: one stop, a pickup and a dropoff, or three stops."""
    loads = draw(st.sampled_from([(0,), (1, -1), (0, 0), (2, -1, -1)]))
    stops = []
    for load in loads:
        work, earliest = draw(TIMES) / 2, draw(TIMES)
        slack = draw(st.sampled_from([None, None, F(3), F(10), F(25)]))
        latest = None if slack is None else earliest + work + slack
        at = draw(cells)
        stops.append(JobStop(at=at, work=work, load=load, earliest=earliest, latest=latest))
    due = draw(st.sampled_from([None, F(3), F(9)]))
    return Job(name=name, stops=tuple(stops), weight=draw(TIMES) + 1, due=due)


def draw_robot(
    draw: st.DrawFn,
    name: str,
    ends: tuple[int, int],
    begun: list[str],
    *,
    has_state: bool,
    is_plain: bool,
) -> Robot:
    """Draw a robot by its home and start."""
    state = RobotState(
        at=VertexId(ends[1]),
        ready=draw(TIMES),
        heading=draw(st.sampled_from([None, F(0), F(90), F(200)])),
        soc=draw(st.sampled_from([F(1), F(1), F(3, 10), F(1, 10)])),
        begun=tuple((job, 1) for job in begun),
    )
    charging = draw(st.sampled_from([None, None, (), (ends[0],), ends]))
    return Robot(
        name=name,
        home=VertexId(ends[0]),
        type=draw(st.sampled_from([None, "fork"])),
        turn=F(0) if is_plain else None,
        turn_rate=None if is_plain else draw(st.sampled_from([None, F(45)])),
        speed=F(1) if is_plain else draw(st.sampled_from([F(1), F(1, 2)])),
        start=state if has_state else None,
        capacity=draw(st.sampled_from([None, 0, 2, 3])),
        battery=draw(st.sampled_from([None, "large", *([None] * 4 if is_plain else [])])),
        charging=None if charging is None else tuple(map(VertexId, charging)),
    )


SMALL = [["...", "..."], ["....", ".@.."]]
TINY = [["..", ".."], ["...", "@.@"]]


@st.composite
def works(draw: st.DrawFn, grids: list[list[str]], most_jobs: int, is_plain: bool) -> Scenario:
    """Draw two robots and some jobs on a grid; plain robots turn in no time."""
    roadmap = make_grid_roadmap(draw(st.sampled_from(grids)))
    vertices = range(roadmap.n_vertices)
    cells = st.sampled_from(vertices).map(VertexId)
    names = ["J1", "J2", "J3"][: draw(st.integers(0, most_jobs))]
    jobs = [draw_job(draw, name, cells) for name in names]
    has_state = draw(st.booleans())
    by = {job.name: draw(st.integers(0, 4)) for job in jobs if has_state and len(job.stops) > 1}
    limits: list[dict[str, Any]] = [
        {"robot": draw(st.sampled_from([None, "R1", "R2"]))},
        {"types": draw(st.sampled_from([(), ("fork",)]))},
        {"after": tuple(draw(st.sets(st.sampled_from(names))) if names else ())},
    ]
    for number, job in enumerate(jobs):
        if by.get(job.name, 2) > 1:
            limit = draw(st.sampled_from(limits))
            if all(name < job.name for name in limit.get("after") or ()):
                jobs[number] = replace(job, **limit)
    homes, starts = (draw(st.permutations(vertices))[:2] for _ in range(2))
    shares = st.sampled_from([F(0), F(0), F(1, 40), F(1, 17)])
    battery = Battery(
        drive=draw(shares),
        on=draw(shares) / 3,
        work=draw(shares),
        charge=draw(st.sampled_from([F(1, 3), F(1, 10)])),
        reserve=draw(st.sampled_from([F(0), F(1, 10), F(1, 5), F(1, 2)])),
    )
    return Scenario(
        roadmap=roadmap,
        robots=tuple(
            draw_robot(
                draw,
                f"R{number + 1}",
                (homes[number], starts[number]),
                [name for name, robot in by.items() if robot == number],
                has_state=has_state,
                is_plain=is_plain,
            )
            for number in range(2)
        ),
        jobs=tuple(jobs),
        batteries=(("large", battery),),
        charging=tuple(draw(st.lists(cells, max_size=2))),
        rules=Rules(ends=draw(st.sampled_from(["home", "none"]))),
    )


def find_path(site: Site, robot: Robot, start: int, goal: int) -> list[int]:
    """Return a shortest path of a robot."""
    before = {start: start}
    for at in (queue := [start]):
        for tail, head in site.edges:
            if tail == at and head not in before and site.drive(robot, (tail, head)) is not None:
                before[head] = at
                queue.append(head)
    path = [goal]
    while path[-1] != start:
        path.append(before[path[-1]])
    return path[::-1]


class Trip:
    """A track with its tour, as early as it can be."""

    def __init__(self, fleet: Fleet, robot: Robot) -> None:
        self.fleet, self.robot = fleet, robot
        self.vertices, self.enter = [int(fleet.state(robot).at)], [0]
        self.items = list[PlannedItem]()

    def go(self, goal: int) -> None:
        """Drive to a vertex."""
        for vertex in find_path(self.fleet.site, self.robot, self.vertices[-1], goal)[1:]:
            free = max(self.enter[-1], self.fleet.ready(self.robot))
            if self.items and self.items[-1].visit == len(self.enter) - 1:
                free = self.items[-1].end + self.fleet.stop_turn(self.robot)
            drive = self.fleet.site.drive(self.robot, (self.vertices[-1], vertex))
            assert drive is not None, "the path has edges"
            self.vertices.append(vertex)
            self.enter.append(0)
            own = Own(self.vertices, self.enter, ())
            corner = self.fleet.corner(self.robot, own, len(self.vertices) - 2)
            self.enter[-1] = free + corner + drive

    def do(self, earliest: int, ticks: int, job: int | None, stop: int | None) -> None:
        """Do something where the robot is."""
        free = max([self.enter[-1], self.fleet.ready(self.robot), earliest])
        begin = max([free, *(item.end for item in self.items[-1:])])
        self.items.append(
            PlannedItem(
                visit=len(self.enter) - 1,
                begin=Tick(begin),
                end=Tick(begin + ticks),
                job=job,
                stop=stop,
            )
        )


@st.composite
def plans(
    draw: st.DrawFn,
    grids: list[list[str]] = SMALL,
    most_jobs: int = 3,
    is_plain: bool = False,
) -> Plan:
    """Draw a plan that keeps most rules, and change it."""
    scenario = draw(works(grids, most_jobs, is_plain))
    fleet, trips = Fleet(scenario), list[Trip]()
    owners = [draw(st.integers(0, 2)) for _ in fleet.jobs]
    for number, robot in enumerate(scenario.robots):
        trip = Trip(fleet, robot)
        trips.append(trip)
        if draw(st.booleans()) and (chargers := sorted(fleet.chargers(robot))):
            trip.go(draw(st.sampled_from(chargers)))
            trip.do(0, draw(st.integers(0, 6)), None, None)
        for index, job in enumerate(fleet.jobs):
            by, first = fleet.begun.get(job.name, (owners[index], 0))
            if by != number:
                continue
            for k, stop in enumerate(job.stops[first:], start=first):
                trip.go(int(stop.at))
                earliest, work = (ceil(time / fleet.tick) for time in (stop.earliest, stop.work))
                trip.do(earliest, work, index, k)
        if fleet.returns(robot):
            trip.go(int(robot.home))
    unserved = {
        index
        for index, job in enumerate(fleet.jobs)
        if owners[index] == 2 and job.name not in fleet.begun
    }
    for _ in range(draw(st.integers(0, 2))):
        change(draw, trips, unserved, len(fleet.jobs))
    return Plan(
        scenario=scenario,
        tracks=tuple(Track.of(trip.vertices, trip.enter) for trip in trips),
        run=PlannerRun(name="at random"),
        tours=tuple(tuple(trip.items) for trip in trips),
        unserved=tuple((job, "not found") for job in sorted(unserved)),
    )


def change(draw: st.DrawFn, trips: list[Trip], unserved: set[int], n_jobs: int) -> None:
    """Break a plan at one place, perhaps."""
    trip = draw(st.sampled_from(trips))
    kind = draw(st.sampled_from(["time", "enter", "drop", "swap", "move", "unserved", "visit"]))
    if kind == "unserved" and n_jobs:
        unserved ^= {draw(st.integers(0, n_jobs - 1))}
    if kind == "enter":
        begin = draw(st.integers(0, len(trip.enter) - 1))
        shift = draw(st.sampled_from([-2, -1, 1, 3]))
        trip.enter[begin:] = [tick + shift for tick in trip.enter[begin:]]
    if not trip.items:
        return
    place = draw(st.integers(0, len(trip.items) - 1))
    item = trip.items[place]
    if kind == "time":
        shifts = [draw(st.integers(-1, 1)) for _ in range(2)]
        begin, end = Tick(item.begin + shifts[0]), Tick(item.end + shifts[1])
        trip.items[place] = replace(item, begin=begin, end=end)
    elif kind == "visit":
        trip.items[place] = replace(item, visit=draw(st.integers(0, len(trip.enter) - 1)))
    elif kind == "drop":
        trip.items.pop(place)
    elif kind == "swap":
        trip.items.append(trip.items.pop(place))
    elif kind == "move":
        other = draw(st.sampled_from(trips))
        visit = draw(st.integers(0, len(other.enter) - 1))
        other.items.append(replace(trip.items.pop(place), visit=visit))


@law(plans())
def test_the_judge_of_jobs_agrees_with_its_slow_twin(plan: Plan) -> None:
    found = set[Broken]()
    jobs = {job.name: index for index, job in enumerate(plan.scenario.jobs or ())}
    for fault in check(plan).faults:
        for rule, kinds in RULES.items():
            if fault.kind in kinds:
                number = fault.robots[0] if fault.robots else 0
                if rule in {"job", "time"}:
                    item = fault.numbers.get("item")
                    name = fault.numbers.get("job", item and item.values["job"])
                    number = jobs[name]
                found.add((rule, number))
    assert found == judge(plan)


@law(plans())
def test_robots_complete_when_they_rest_or_with_their_last_work(plan: Plan) -> None:
    fleet, robots = Fleet(plan.scenario), list_robots(plan)
    completions = [
        fleet.completion(robot, own)
        for robot, own in zip(plan.scenario.robots, robots, strict=True)
    ]
    assert list(plan.completions) == completions


def keeps_bounds(plan: Plan) -> bool:
    """Return whether no bound is above a plan that keeps the rules, for any objective."""
    problem = plan.scenario.problem
    assert problem.work is not None, "the plan has jobs"
    travel, weights = measure_travel(problem, Distances(plan.scenario.roadmap)), problem.weights
    unserved = {job for job, _ in plan.unserved}
    served = [job for job in range(len(problem.work.jobs)) if job not in unserved]
    for name, objective in OBJECTIVES.items():
        bound = WorkBound(replace(problem.work, objective=name), travel, weights)
        if any(map(bound.is_impossible, served)):
            return False
        if bound.compute(served) > plan.compute_value(objective):
            return False
    return True


@law(plans())
def test_no_bound_of_jobs_is_above_a_plan(plan: Plan) -> None:
    assert not check(plan).ok or keeps_bounds(plan)


@law(plans(TINY, 2, is_plain=True))
def test_no_plan_is_better_than_the_exhaustive_search(plan: Plan) -> None:
    try:
        best = find_best(plan.scenario)
    except TooLarge as error:
        leave(str(error))
    is_right = check(plan).ok
    if best is None:
        assert not is_right
        return
    report = check(best.plan)
    assert report.ok, str(report)
    assert measure(best.plan) == (best.weight, best.cost)
    assert keeps_bounds(best.plan)
    if is_right:
        assert measure(plan) >= (best.weight, best.cost)
