"""A round: one planning while robots drive, from the jobs that are known to a judged plan.

    jobs + fleet at the takeover → tours → routes → judged behind the kept parts → plan

The jobs of a round are those that are begun, and for each robot about three that are overdue and
three others, so its time does not grow with the pool. Tours start from the old ones, and so do
routes (`rightofway.dispatch.routes`).

References
----------
Li, Tinka, Kiesel, Durham, Kumar & Koenig, *Lifelong multi-agent path finding in large-scale
warehouses*, AAAI 2021: a rolling horizon of plans.
"""

from __future__ import annotations

import time
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial

from rightofway.assign import AssignmentSearch, measure_travel
from rightofway.check import check
from rightofway.deadline import Deadline
from rightofway.dispatch.charging import charge_for_rest
from rightofway.dispatch.horizon import (
    STOPS_AHEAD,
    Crowding,
    CutTours,
    cut_tours,
    cut_tracks,
    find_horizon,
    may_stay_anywhere,
)
from rightofway.dispatch.overdue import assign_overdue, has_choice
from rightofway.dispatch.pool import PooledJob
from rightofway.dispatch.routes import (
    HURRIED,
    FoundRoutes,
    find_routes,
    keep_old_tours,
    list_old_items,
    list_same_tracks,
)
from rightofway.dispatch.view import (
    FleetView,
    PlannedStep,
    RobotView,
    Round,
    StopsLater,
    make_whole_tracks,
)
from rightofway.errors import GaveUp, InputError, NoPlanExists, RightOfWayError
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
from rightofway.resume.commitment import list_closures_after
from rightofway.resume.held import list_held
from rightofway.search import Distances
from rightofway.solve import OF_BATTERIES, solve

__all__ = ["RoundPlanner", "choose_jobs"]

JOBS_PER_ROBOT = 3
"""Jobs of a round for each robot that are overdue, and as many others, beside the begun ones."""

STEPS_PER_JOB = 60
"""Steps of the search for tours, for each job of the round."""

SHARE_OF_TOURS = 0.2
"""The part of the time that a round takes for tours."""

SPARE = 10
"""Charges are longer than tours need them by the ticks for one part in so many of a battery."""

HORIZON_IN_LEADS = 4
"""Routes end so many times later than the next takeover at least."""

BEHIND_CUT = frozenset({"stop not done"})
"""Faults of plans whose tours are cut."""


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


@dataclass(frozen=True, slots=True, kw_only=True)
class _RoundPlan:
    """A judged plan of a round, and what is left of its tours behind the horizon.

    The robots in ``keeping`` keep their old tours, for ``reasons``.
    """

    plan: Plan
    later: tuple[Tour, ...]
    keeping: tuple[int, ...] = ()
    reasons: tuple[Fact, ...] = ()

    @property
    def is_still(self) -> bool:
        """Whether no robot has anything to do: then waiting helps nobody."""
        return not any(self.plan.scenario.tours or ())


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
        self._crowding = Crowding()

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
        drafted = self._find_plan(given, view, deadline, seed)
        return replace(
            self._judge(view, given, drafted.plan),
            later=_list_later(given, drafted.later, len(view.robots)),
            is_hurried=len(drafted.keeping) > HURRIED * len(given.able),
            facts=_describe_kept(self._scenario, drafted),
        )

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
    ) -> _RoundPlan:
        """Return a judged plan of the round, at first with the old tracks."""
        old = [view.robots[robot] for robot in given.able]
        items = [list_old_items(given.scenario, own) for own in old]
        assignment, ends = self._assign(given, items, deadline, seed)
        lead = Tick(HORIZON_IN_LEADS * (view.takeover - view.now))
        tracks = [own.track for own in old]
        horizon = find_horizon(ends, lead) if may_stay_anywhere(given.scenario) else None
        ahead = self._stops_ahead
        for n_stops, until in self._crowding.list_attempts(ahead, horizon):
            cut = cut_tours(given.scenario, assignment, ends, n_stops, lead)
            start = list_same_tracks(cut.toured, old)
            routing = partial(find_routes, old=tracks, horizon=until, deadline=deadline, seed=seed)
            may_cut, is_cut = horizon is not None and n_stops == ahead, until is not None
            most = int(HURRIED * len(old)) if may_cut and not is_cut else len(old)
            planned = _find_routes(cut, assignment, start, items, routing, most_keeping=most)
            is_still = planned is None or (planned.is_still and any(assignment.tours))
            if may_cut:
                crowded = planned is None
                self._crowding.note(is_crowded=crowded, is_cut=is_cut, is_still=is_still)
            if planned is None or (is_still and (planned.keeping or self._crowding.is_stuck)):
                continue
            return planned
        left = deadline.measure_seconds_left()
        if left == 0:
            raise GaveUp(Fact("time over without a plan"))
        plan = solve(given.scenario, self._planner, time_limit=left, seed=seed)
        return _RoundPlan(plan=plan, later=((),) * len(old))

    def _assign(
        self,
        given: _Given,
        old: Sequence[tuple[Tour, Tour]],
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
        old_tours = Assignment(tours=tuple((*ahead, *behind) for ahead, behind in old))
        if given.overdue:
            first = deadline.shorten(SHARE_OF_TOURS / 2)
            work, old_tours = assign_overdue(
                work, travel, old_tours, given.overdue, weights=weights, deadline=first
            )
        stable = _keep_next_jobs(work, old, given.overdue)
        for worked in (stable, work):
            hurried = deadline.shorten(SHARE_OF_TOURS)
            search = AssignmentSearch(worked, travel, weights=weights, seed=seed)
            search.start(old_tours)
            search.construct(hurried.measure_seconds_left())
            if has_choice(worked):
                search.improve(STEPS_PER_JOB * len(work.jobs), hurried.measure_seconds_left())
            unserved = (job for job, _ in search.assignment.unserved)
            if all(stable.jobs[job] is work.jobs[job] for job in unserved):
                break
        if search.cost.missing:
            raise GaveUp(Fact("begun jobs without a tour"))
        assignment, ends = charge_for_rest(search.assignment, search.list_ends(), work, travel)
        return _spare_charges(assignment, work), ends

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


def _keep_old(view: FleetView, error: RightOfWayError) -> Round:
    """Return the old plan as a round, and why it stands; its times begin with the takeover."""
    reason = error.explain().detach(view.takeover)
    return Round(
        tracks=tuple(own.track or Track.of([own.at], [0]) for own in view.robots),
        steps=tuple(own.steps for own in view.robots),
        stands=True,
        facts=(Fact("old plan stands", reason=reason),),
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


def _keep_next_jobs(work: Work, old: Sequence[tuple[Tour, Tour]], overdue: Collection[int]) -> Work:
    """Return work in which only its robot may do the job that a robot is on its way to.

    Else such jobs would change robots in most rounds, for little gain: each change needs a new
    route, and in a dense fleet there may be none. Overdue jobs may always change robots, and so may
    all jobs while a robot has nothing to do.
    """
    jobs = list(work.jobs)
    if not all(ahead or behind for ahead, behind in old):
        return work
    for robot, (ahead, behind) in enumerate(old):
        job = (*ahead, *behind)[0].job
        if job is None or job in overdue or len(jobs[job].robots) == 1:
            continue
        if robot in jobs[job].robots:
            jobs[job] = replace(jobs[job], robots=(robot,))
    return replace(work, jobs=tuple(jobs))


def _find_routes(
    cut: CutTours,
    assignment: Assignment,
    start: Sequence[Track | None],
    items: Sequence[tuple[Tour, Tour]],
    routing: partial[FoundRoutes],
    *,
    most_keeping: int,
) -> _RoundPlan | None:
    """Return a plan that keeps the rules, if old tours of so many robots make one possible."""
    work, horizon = cut.toured.problem.work, routing.keywords["horizon"]
    has_batteries = work is not None and any(robot.battery for robot in work.robots)
    keeping, reasons = frozenset[int](), list[Fact]()
    while True:
        routes, planned = routing(cut.toured, start), None
        wrong, reason = routes.left, Fact("no route in time")
        if routes.improve is not None:
            # The search knows no batteries: its first tracks are judged while there is time for
            # others, and stay the plan where a battery does not last for the improved ones.
            for improves in (False, True) if has_batteries else (True,):
                tracks = routes.improve() if improves else routes.tracks
                ended = cut, [track for track in tracks if track is not None]
                if horizon is not None:
                    ended = cut_tracks(*ended, horizon)
                plan = _join_plan(*ended, assignment)
                judged = check(plan)
                if not (frozenset() if ended[0].is_whole else BEHIND_CUT).issuperset(judged.counts):
                    break
                planned = _RoundPlan(
                    plan=plan,
                    later=ended[0].later,
                    keeping=tuple(sorted(keeping)),
                    reasons=tuple(dict.fromkeys(reasons)),
                )
            if planned is not None:
                return planned
            reason = Fact("batteries do not last")
            wrong = tuple(
                robot for fault in judged.faults if fault.kind in OF_BATTERIES
                for robot in fault.robots
            )  # fmt: skip
        if keeping.issuperset(wrong) or len(keeping.union(wrong)) > most_keeping:
            return None
        keeping = keeping.union(wrong)
        reasons.append(reason)
        olds = routing.keywords["old"]
        start = [olds[k] if k in wrong else track for k, track in enumerate(routes.tracks)]
        cut = keep_old_tours(cut, items, keeping)


def _join_plan(cut: CutTours, tracks: Sequence[Track], assignment: Assignment) -> Plan:
    """Return the plan of tours that are cut."""
    tours = (*(cut.toured.tours or ()), *cut.later)
    assigned = {item.job for tour in tours for item in tour}
    return Plan(
        scenario=cut.toured,
        tracks=wait_before_chains(cut.toured.problem, tracks),
        run=PlannerRun(),
        unserved=tuple(pair for pair in assignment.unserved if pair[0] not in assigned),
    )


def _describe_kept(scenario: Scenario, planned: _RoundPlan) -> tuple[Fact, ...]:
    """Return why robots keep their old tours, if some do."""
    if not planned.keeping:
        return ()
    return (Fact("old tours kept", scenario, robots=len(planned.keeping), reasons=planned.reasons),)


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
