"""A round: one planning while robots drive, from the jobs that are known to a judged plan.

    jobs + fleet at the takeover → tours → routes → judged behind the kept parts → plan

The jobs of a round are those that are begun, and for each robot about three that are overdue and
three others, so its time does not grow with the pool. Tours start from the old ones. Robots whose
tours stay the same keep their old tracks at first, and the others are planned around them; then
large neighbourhood search improves all of them until time is up.

References
----------
Li, Tinka, Kiesel, Durham, Kumar & Koenig, *Lifelong multi-agent path finding in large-scale
warehouses*, AAAI 2021: a rolling horizon of plans.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from rightofway.assign import AssignmentSearch, measure_travel
from rightofway.check import check
from rightofway.deadline import Deadline
from rightofway.dispatch.charging import charge_for_rest
from rightofway.dispatch.horizon import STOPS_AHEAD, cut_tours
from rightofway.dispatch.overdue import assign_overdue, has_choice
from rightofway.dispatch.pool import PooledJob
from rightofway.dispatch.view import (
    FleetView,
    PlannedStep,
    RobotView,
    Round,
    StopsLater,
    make_whole_tracks,
)
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.facts import Fact
from rightofway.model import (
    Assignment,
    BoundBattery,
    Job,
    Plan,
    PlannedItem,
    PlannerRun,
    Robot,
    RobotState,
    Scenario,
    Stop,
    Tick,
    Tour,
    TourItem,
    Track,
    UnservedReason,
    Work,
)
from rightofway.model.passing import wait_before_chains
from rightofway.model.work import PATIENCE
from rightofway.precedence import build_timetable
from rightofway.repair.fleet_search import make_fleet_search
from rightofway.repair.plan_request import PlanRequest
from rightofway.resume.commitment import list_closures_after
from rightofway.resume.held import list_held
from rightofway.search import Distances
from rightofway.solve import solve

__all__ = ["RoundPlanner", "choose_jobs"]

JOBS_PER_ROBOT = 3
"""Jobs of a round for each robot that are overdue, and as many others, beside the begun ones."""

STEPS_PER_JOB = 60
"""Steps of the search for tours, for each job of the round."""

SHARE_OF_TOURS = 0.2
"""The part of the time that a round takes for tours."""

SPARE = 10
"""Charges are longer than tours need them by the ticks for one part in so many of a battery."""

SEARCHES = 20
"""Searches for each robot without a track, and for each ten robots, before all are planned anew."""

MOST_IN_VAIN = 200
"""Steps in a row without a better plan, for each robot, after which routes are good enough."""

SHARE_TO_JUDGE = 0.1
"""The part of the time that is left to judge a plan."""

HORIZON_IN_LEADS = 4
"""Routes end so many times later than the next takeover at least."""

BEHIND_CUT = frozenset({"stop not done"})
"""Faults of plans whose tours are cut."""

UNLIMITED = 2**31 - 1


@dataclass(frozen=True, slots=True, kw_only=True)
class _Given:
    """The input of a round: its scenario, and how its indices belong to the fleet.

    ``able`` are the robots of the fleet that are in it, ``overdue`` its overdue jobs that no robot
    has begun, the oldest first.
    """

    scenario: Scenario
    able: tuple[int, ...]
    overdue: tuple[int, ...]
    postponed: tuple[str, ...]
    unserved: tuple[tuple[str, UnservedReason], ...]


class RoundPlanner:
    """Planner of rounds of one fleet; it keeps travel times and distances between rounds.

    Parameters
    ----------
    scenario
        The fleet, its roads and rules; its jobs are not looked at.
    planner
        The name of the planner where planning around old tracks fails.
    stops_ahead
        How many stops and charges of each tour a round makes routes for; None for all.
        `Round.later` has what is left.
    """

    def __init__(
        self, scenario: Scenario, planner: str = "auto", stops_ahead: int | None = STOPS_AHEAD
    ) -> None:
        clock = scenario.problem.clock
        self._scenario = replace(scenario, jobs=(), clock=clock, tours=None)
        self._planner = planner
        self._stops_ahead = stops_ahead
        self._distances: Distances | None = None

    def plan(
        self,
        view: FleetView,
        jobs: Mapping[str, PooledJob],
        *,
        over: Mapping[str, str],
        time_limit: float | None,
        seed: int = 0,
    ) -> Round:
        """Return the plan of a round; the old plan if no other one was found.

        Parameters
        ----------
        view
            The fleet at the takeover.
        jobs
            The jobs of the pool, by name.
        over
            How jobs have left the pool, by name.
        time_limit
            When to stop [s]; None for no limit but that of steps.
        seed
            For all that is drawn.
        """
        began, deadline = time.perf_counter(), Deadline.after(time_limit)
        try:
            planned = self._plan(view, jobs, over, deadline, seed)
        except (GaveUp, NoPlanExists, InputError) as error:
            planned = _keep_old(view, error)
        return replace(planned, seconds=time.perf_counter() - began)

    def _plan(
        self,
        view: FleetView,
        jobs: Mapping[str, PooledJob],
        over: Mapping[str, str],
        deadline: Deadline,
        seed: int,
    ) -> Round:
        given = self._make_scenario(view, jobs, over)
        plan, later = self._find_plan(given, view, deadline, seed)
        return replace(self._judge(view, given, plan), later=later)

    # --- the scenario of the round ---------------------------------------------------------------

    def _make_scenario(
        self, view: FleetView, jobs: Mapping[str, PooledJob], over: Mapping[str, str]
    ) -> _Given:
        scenario, clock = self._scenario, self._scenario.problem.clock
        able = tuple(robot for robot, own in enumerate(view.robots) if own.is_able)
        if not able:
            raise GaveUp(Fact("no robot that drives"))
        chosen = choose_jobs(scenario, view, jobs, over)
        roadmap = scenario.roadmap
        lost = {
            k: own.kept_track.vertices.tolist()
            for k, own in enumerate(view.robots)
            if k not in able
        }
        held = list_held(scenario, lost)
        if held.vertices or view.closed:
            roadmap = roadmap.exclude(held.vertices, {*held.edges, *view.closed})
        closures = list_closures_after(scenario, roadmap, view.takeover)
        if closures is None:
            raise GaveUp(Fact("closed lane taken"))
        passed = clock.convert_to_time(view.takeover)
        ends = {name: clock.convert_to_time(end) for name, end in view.ends}
        known = {own.job.name for own in chosen.jobs}
        begun = {name for robot in able for name, _ in view.robots[robot].begun}
        return _Given(
            scenario=replace(
                scenario,
                roadmap=roadmap,
                closures=closures,
                robots=tuple(self._make_robot(robot, view.robots[robot], known) for robot in able),
                jobs=tuple(
                    _shift_job(own.job, passed, ends, known, is_begun=own.job.name in begun)
                    for own in chosen.jobs
                ),
            ),
            able=able,
            overdue=chosen.overdue,
            postponed=chosen.postponed,
            unserved=chosen.unserved,
        )

    def _make_robot(self, robot: int, seen: RobotView, known: set[str]) -> Robot:
        time_of = self._scenario.problem.clock.convert_to_time
        state = RobotState(
            at=seen.at,
            ready=time_of(seen.free),
            heading=seen.heading,
            soc=seen.soc,
            begun=tuple(pair for pair in seen.begun if pair[0] in known),
        )
        return replace(self._scenario.robots[robot], start=state)

    # --- tours and routes ------------------------------------------------------------------------

    def _find_plan(
        self, given: _Given, view: FleetView, deadline: Deadline, seed: int
    ) -> tuple[Plan, tuple[StopsLater, ...]]:
        """Return a judged plan of the round, at first with the old tracks, and what is later."""
        old = [view.robots[robot] for robot in given.able]
        assignment, ends = self._assign(given, old, deadline, seed)
        lead = Tick(HORIZON_IN_LEADS * (view.takeover - view.now))
        for n_stops in dict.fromkeys((self._stops_ahead, None)):
            cut = cut_tours(given.scenario, assignment, ends, n_stops, lead)
            tracks = self._improve_old(cut.toured, old, deadline, seed)
            if tracks is None:
                break
            driven = wait_before_chains(cut.toured.problem, tracks)
            plan = Plan(
                scenario=cut.toured, tracks=driven, run=PlannerRun(), unserved=assignment.unserved
            )
            if (frozenset() if cut.is_whole else BEHIND_CUT).issuperset(check(plan).counts):
                return plan, _list_later(given, cut.later, len(view.robots))
        left = deadline.measure_seconds_left()
        if left == 0:
            raise GaveUp(Fact("time over without a plan"))
        return solve(given.scenario, self._planner, time_limit=left, seed=seed), ()

    def _assign(
        self,
        given: _Given,
        old: Sequence[RobotView],
        deadline: Deadline,
        seed: int,
    ) -> tuple[Assignment, list[tuple[Tick, ...]]]:
        """Return tours that go on from the old ones, and when their items end."""
        scenario, work = given.scenario, given.scenario.problem.work
        assert work is not None, "the scenario has jobs"
        if self._distances is None or self._distances.roadmap is not scenario.roadmap:
            self._distances = Distances(scenario.roadmap)
        travel = measure_travel(scenario.problem, self._distances)
        weights = scenario.problem.weights
        old_tours = _make_old_assignment(scenario, old)
        hurried = deadline.shorten(SHARE_OF_TOURS)
        if given.overdue:
            first = deadline.shorten(SHARE_OF_TOURS / 2)
            work, old_tours = assign_overdue(
                work, travel, old_tours, given.overdue, weights=weights, deadline=first
            )
        search = AssignmentSearch(work, travel, weights=weights, seed=seed)
        search.start(old_tours)
        search.construct(hurried.measure_seconds_left())
        if has_choice(work):
            search.improve(STEPS_PER_JOB * len(work.jobs), hurried.measure_seconds_left())
        if search.cost.missing:
            raise GaveUp(Fact("begun jobs without a tour"))
        assignment, ends = charge_for_rest(search.assignment, search.list_ends(), work, travel)
        return _spare_charges(assignment, work), ends

    def _improve_old(
        self, toured: Scenario, old: Sequence[RobotView], deadline: Deadline, seed: int
    ) -> tuple[Track, ...] | None:
        """Return tracks that start from the old ones of robots with the same tours, improved."""
        judging = deadline.shorten(1 - SHARE_TO_JUDGE)
        search = make_fleet_search(PlanRequest(scenario=toured, seed=seed, deadline=judging))
        tracks = _list_old_tracks(toured, old)
        try:
            search.start(tracks)
        except ValueError:  # a kept part is in the way of an old track
            tracks = [None] * len(tracks)
        left = [robot for robot, track in enumerate(tracks) if track is None]
        alone = search.compute_alone()
        order = sorted(left, key=lambda robot: (int(alone[robot]), robot))
        searches = SEARCHES * (len(left) + len(tracks) // 10)
        if left and not search.repair(
            order, searches=searches, time_limit=judging.measure_seconds_left()
        ):
            return None
        patience = MOST_IN_VAIN * len(tracks)
        search.improve(UNLIMITED, patience=patience, time_limit=judging.measure_seconds_left())
        if toured.problem.closures is None:
            search.retime()
        return search.list_tracks()

    # --- judgement -------------------------------------------------------------------------------

    def _judge(self, view: FleetView, given: _Given, plan: Plan) -> Round:
        """Return the plan as a round, if it keeps the rules behind the kept parts."""
        fleet = dict(zip(given.able, plan.tracks, strict=True))
        tracks = [
            fleet.get(robot, Track.of([own.at], [0])) for robot, own in enumerate(view.robots)
        ]
        self._judge_whole(given, make_whole_tracks(view, tracks))
        steps: dict[int, tuple[PlannedStep, ...]] = {}
        for robot, tour, planned in zip(
            given.able, plan.scenario.tours or (), plan.tours or (), strict=True
        ):
            steps[robot] = tuple(_list_steps(given.scenario, tour, planned))
        names = [job.name for job in given.scenario.jobs or ()]
        return Round(
            tracks=tuple(tracks),
            steps=tuple(steps.get(robot, ()) for robot in range(len(view.robots))),
            unserved=(*((names[job], reason) for job, reason in plan.unserved), *given.unserved),
            postponed=given.postponed,
        )

    def _judge_whole(self, given: _Given, whole: Sequence[Track]) -> None:
        """Raise `GaveUp` if robots cannot drive what they keep and then their new tracks."""
        scenario, robots = self._scenario, []
        for robot in given.able:
            begin, end = whole[robot].vertices[[0, -1]].tolist()
            own = replace(
                scenario.robots[robot], home=begin, stops=(Stop(at=end),), start=None,
                capacity=None, battery=None, charging=None, turn=Fraction(0), ends="none",
            )  # fmt: skip
            robots.append(own)
        rules = replace(scenario.rules, objective=None, late=None, patience=None, laps=1)
        trips = replace(  # kept parts may lead out of what is closed
            scenario, robots=tuple(robots), jobs=None,
            batteries=(), charging=(), closures=(), rules=rules,
        )  # fmt: skip
        tracks = build_timetable(trips.problem, [whole[robot] for robot in given.able])
        if tracks is None:
            raise GaveUp(Fact("order not kept behind released"))
        judged = check(Plan(scenario=trips, tracks=tuple(tracks), run=PlannerRun()))
        if not judged.ok:
            raise GaveUp(Fact("rest with faults", faults=judged.total))


@dataclass(frozen=True, slots=True, kw_only=True)
class ChosenJobs:
    """The jobs of a round, those that are left to later ones, and those that nobody can do now.

    ``overdue`` are the indices of overdue jobs that nobody has begun, the oldest first.
    """

    jobs: tuple[PooledJob, ...]
    overdue: tuple[int, ...] = ()
    postponed: tuple[str, ...] = ()
    unserved: tuple[tuple[str, UnservedReason], ...] = ()


def choose_jobs(
    scenario: Scenario,
    view: FleetView,
    jobs: Mapping[str, PooledJob],
    over: Mapping[str, str],
) -> ChosenJobs:
    """Return the jobs of a round, the most urgent ones first.

    Begun jobs first, then overdue ones, the oldest first, then by `earliest`. A job comes with
    those that it follows, or later. Jobs begun by robots that do not go on leave the round.

    Parameters
    ----------
    scenario
        The fleet and its rules.
    view
        The fleet at the takeover.
    jobs
        The jobs of the pool, by name.
    over
        How jobs have left the pool, by name.
    """
    clock, takeover = scenario.problem.clock, view.takeover
    patience = PATIENCE if scenario.rules.patience is None else scenario.rules.patience
    now = clock.convert_to_time(takeover)
    ended = {name for name, _ in view.ends}
    begun = {name for own in view.robots if own.is_able for name, _ in own.begun}
    stuck = {name for own in view.robots if not own.is_able for name, _ in own.begun}
    begun_anywhere = {name for own in view.robots for name, _ in own.begun}

    def rank(own: PooledJob) -> tuple[object, ...]:
        job = own.job
        overdue_at = job.earliest + patience if job.due is None else job.due
        is_overdue = overdue_at < now
        urgency = overdue_at if is_overdue else job.earliest
        return job.name not in begun, not is_overdue, urgency, own.known, -job.weight, job.name

    room = dict.fromkeys((True, False), JOBS_PER_ROBOT * len(view.robots))
    chosen, postponed = dict[str, PooledJob](), list[str]()
    unserved: dict[str, UnservedReason] = {}
    able = {scenario.robots[k].name for k, own in enumerate(view.robots) if own.is_able}
    for own in sorted(jobs.values(), key=rank):
        name, job = own.job.name, own.job
        if name in ended or name in stuck:
            continue
        open_before = [
            before for before in job.after
            if over.get(before) != "done" and before not in ended and before not in chosen
        ] if name not in begun else []  # fmt: skip
        if any(over.get(before, "done") != "done" for before in open_before):
            unserved[name] = "after"
        elif job.robot is not None and job.robot not in able:
            unserved[name] = "robot"
        elif name not in begun and not _is_in_time(job, now):
            unserved[name] = "latest"
        elif name in begun:
            chosen[name] = own
        elif open_before or not room[is_overdue := not rank(own)[1]]:
            postponed.append(name)
        else:
            chosen[name] = own
            room[is_overdue] -= 1
    assert begun_anywhere <= jobs.keys() | over.keys(), "begun jobs are known"
    return ChosenJobs(
        jobs=tuple(chosen.values()),
        overdue=tuple(
            index
            for index, own in enumerate(chosen.values())
            if own.job.name not in begun and not rank(own)[1]
        ),
        postponed=tuple(postponed),
        unserved=tuple(unserved.items()),
    )


def _is_in_time(job: Job, now: Fraction) -> bool:
    """Return whether the stops of a job could end in time if robots drove in no time."""
    for stop in job.stops:
        now = max(now, stop.earliest) + stop.work
        if stop.latest is not None and now > stop.latest:
            return False
    return True


def _shift_job(
    job: Job, passed: Fraction, ends: Mapping[str, Fraction], known: set[str], *, is_begun: bool
) -> Job:
    """Return a job whose times count from the takeover.

    A `due` that has passed becomes 0: costs of plans then differ by a constant.
    """
    stops = [
        replace(
            stop,
            earliest=max(stop.earliest - passed, Fraction(0)),
            latest=None if stop.latest is None or is_begun else stop.latest - passed,
        )
        for stop in job.stops
    ]
    latest = job.stops[-1].latest
    if is_begun and latest is not None:
        # Scenarios do not check `latest` of begun jobs: so at least it costs to be late.
        job = replace(job, due=latest if job.due is None else min(job.due, latest))
    waits = [ends[name] for name in job.after if name in ends]
    stops[0] = replace(stops[0], earliest=max([stops[0].earliest, *waits]))
    return replace(
        job,
        stops=tuple(stops),
        due=None if job.due is None else max(job.due - passed, Fraction(0)),
        after=tuple(name for name in job.after if name in known),
    )


def _spare_charges(assignment: Assignment, work: Work) -> Assignment:
    """Return the same tours with charges that last longer than they must.

    Else a wait on the way would send a robot back to charge as little again, and so on for ever.
    """
    tours = [
        tour
        if robot.battery is None
        else tuple(_spare_charge(item, robot.battery) for item in tour)
        for tour, robot in zip(assignment.tours, work.robots, strict=True)
    ]
    return replace(assignment, tours=tuple(tours))


def _spare_charge(item: TourItem, battery: BoundBattery) -> TourItem:
    if item.job is not None or not item.duration or not battery.charge:
        return item
    return replace(item, duration=Tick(item.duration - -battery.full // (SPARE * battery.charge)))


def _keep_old(view: FleetView, error: Exception) -> Round:
    """Return the old plan as a round, and why it stands."""
    reason = getattr(error, "reason", None)
    fact = reason if isinstance(reason, Fact) else Fact("other", text=str(error))
    return Round(
        tracks=tuple(own.track or Track.of([own.at], [0]) for own in view.robots),
        steps=tuple(own.steps for own in view.robots),
        stands=True,
        facts=(Fact("old plan stands", reason=fact),),
    )


def _list_later(given: _Given, later: Sequence[Tour], n_robots: int) -> tuple[StopsLater, ...]:
    """Return the stops behind the horizon of each robot of the fleet."""
    names = [job.name for job in given.scenario.jobs or ()]
    tours = dict(zip(given.able, later, strict=True))
    return tuple(
        tuple(
            (names[item.job], item.stop)
            for item in tours.get(robot, ())
            if item.job is not None and item.stop is not None
        )
        for robot in range(n_robots)
    )


def _make_old_assignment(scenario: Scenario, old: Sequence[RobotView]) -> Assignment:
    """Return the old tours, as far as their jobs are in the round."""
    jobs = scenario.jobs or ()
    index = {job.name: number for number, job in enumerate(jobs)}
    tours = []
    for own in old:
        ahead = [(step.job, step.stop) for step in own.steps if step.job is not None]
        tours.append(
            tuple(
                TourItem(
                    job=index[job], stop=stop, vertex=jobs[index[job]].stops[stop].at,
                    duration=Tick(0),
                )
                for job, stop in (*ahead, *own.later)
                if job in index and stop is not None
            )
        )  # fmt: skip
    return Assignment(tours=tuple(tours))


def _list_old_tracks(toured: Scenario, old: Sequence[RobotView]) -> list[Track | None]:
    """Return the old tracks of the robots that do what they would have done."""
    names = [job.name for job in toured.jobs or ()]
    tracks = list[Track | None]()
    for tour, own, itinerary in zip(
        toured.tours or (), old, toured.problem.itineraries, strict=True
    ):
        new = [
            (None if item.job is None else names[item.job], item.stop, item.vertex)
            for item in tour
            if item.job is not None or item.duration
        ]
        before = [(step.job, step.stop, step.vertex) for step in own.steps]
        is_same = own.track is not None and new == before
        if is_same and own.track is not None and not itinerary.ends_anywhere:
            is_same = int(own.track.vertices[-1]) == itinerary.last
        tracks.append(own.track if is_same else None)
    return tracks


def _list_steps(
    scenario: Scenario, tour: Sequence[TourItem], planned: Sequence[PlannedItem]
) -> Iterator[PlannedStep]:
    """Yield the steps of a planned tour, with the names of jobs."""
    jobs = scenario.jobs or ()
    items = [item for item in tour if item.job is not None or item.duration]
    for item, step in zip(items, planned, strict=True):
        yield PlannedStep(
            visit=step.visit,
            vertex=item.vertex,
            begin=step.begin,
            end=step.end,
            job=None if step.job is None else jobs[step.job].name,
            stop=step.stop,
            least=Tick(0) if step.job is not None else item.duration,
        )
