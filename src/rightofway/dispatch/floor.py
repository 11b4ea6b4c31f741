"""The simulated floor: robots that drive by right of way, with delays and batteries.

A visit begins when the stay before it has ended, the drive is over, and all arrivals that it waits
for have happened. So the times of a floor follow from the routes, the release graph and the delays:
they are evaluated visit by visit, each when all that it depends on is known, and only for actions
that begin before some tick. Where robots do not book ahead (``occupancy: one``), the visits of a
rotation wait for each other and begin at one instant.

Work begins at `earliest` or later, and after the jobs that its job comes after. A robot with
nothing to do charges where it may.
"""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

from rightofway.dispatch.delays import DelayDraws
from rightofway.dispatch.record import DoneStep, RobotRecord
from rightofway.model import NEVER, BookingRules, BoundBattery, Scenario
from rightofway.model.turning import find_heading_on_map, list_headings
from rightofway.precedence import DelayModel
from rightofway.site import Roadmap

__all__ = ["FloorEvent", "FloorRobot", "SimulatedFloor", "StepToDo", "VisitToCome"]

Pair = tuple[int, int]


class FloorEvent(NamedTuple):
    """Work at a stop of a job that has begun, or has ended (``is_end``), at a tick."""

    tick: int
    is_end: bool
    robot: int
    job: str
    stop: int


@dataclass(frozen=True, slots=True, kw_only=True)
class StepToDo:
    """Work at a stop, or a charge (``job`` is empty) of at least `ticks`.

    ``earliest`` counts from the start of the shift [ticks]; the jobs ``after`` end before it. The
    last work of a job ``ends_job``.
    """

    job: str
    stop: int
    ticks: int
    earliest: int = 0
    after: tuple[str, ...] = ()
    ends_job: bool = False


class VisitToCome(NamedTuple):
    """A visit of a route: the edge into it with the turn before, and the work in it [ticks].

    ``planned`` is when the plan has it begin. ``waits`` are the arrivals before it, each with the
    robot and the number of its visit: pairs, as there are very many of them.
    """

    vertex: int
    planned: int = 0
    edge: int = -1
    turn: int = 0
    drive: int = 0
    steps: tuple[StepToDo, ...] = ()
    waits: tuple[Pair, ...] = ()


@dataclass(slots=True, kw_only=True)
class FloorRobot:
    """The state of one robot.

    Attributes
    ----------
    visits
        The last visit that has begun, or to which the robot drives, and those to come.
    first
        The number of the first of these since the start of the shift.
    n_begun
        The number of steps that have begun in the first of these.
    free, expected
        When all that has begun there ends, and when it would without delays [ticks].
    since
        Nothing else begins before that tick.
    recent
        Vertex and begin of visits, from the last one on whose booking has not ended.
    enters
        When visits began, by number, as far as others may wait for them [ticks].
    heading
        In the plane of the map [degrees]; None where it is unknown.
    soc, counted, charging
        The state of charge at a tick, in parts of the battery, and since when it charges.
    has_worked
        Whether it has worked or charged in the first of its visits.
    cap
        The number of the last visit that it may begin, and of the steps in it; None for no cap.
    lost
        Since when it does not go on any more; None if it does.
    """

    visits: deque[VisitToCome]
    first: int = 0
    n_begun: int = 0
    free: int = 0
    expected: int = 0
    since: int = 0
    recent: deque[tuple[int, int]] = field(default_factory=deque)
    enters: dict[int, int] = field(default_factory=dict)
    heading: Fraction | None = None
    soc: int = 0
    counted: int = 0
    charging: int | None = None
    has_worked: bool = False
    cap: tuple[int, int] | None = None
    lost: int | None = None

    @property
    def is_idle(self) -> bool:
        """Whether it has nothing to do and nowhere to go."""
        return len(self.visits) == 1 and self.n_begun == len(self.visits[0].steps)

    @property
    def waits_until(self) -> int:
        """When the work for which it stands at its place may begin by the clock [ticks]; or 0."""
        steps = self.visits[0].steps[self.n_begun : self.n_begun + 1]
        return max((step.earliest for step in steps), default=0)

    @property
    def n_steps_left(self) -> int:
        """Number of works and charges of its route that have not begun."""
        return sum(len(visit.steps) for visit in self.visits) - self.n_begun

    def estimate(self, now: int) -> int:
        """Return when all that has begun is expected to end: what is overdue lasts as long again.

        Parameters
        ----------
        now
            The tick.
        """
        if self.free <= now:
            return self.free
        return self.expected if self.expected > now else 2 * now - self.expected + 1

    def forget_before(self, now: int, rules: BookingRules) -> None:
        """Forget visits that have ended, once their headway is over."""
        while len(self.recent) > 1 and rules.end(self.recent[1][1]) <= now:
            self.recent.popleft()
        least = self.first - len(self.recent) + 1
        for number in [number for number in self.enters if number < least]:
            del self.enters[number]

    def fork(self, now: int) -> FloorRobot:
        """Return the robot as a forecast sees it: it is free when it is expected to be."""
        twin = copy(self)
        twin.visits = deque(self.visits)
        twin.recent, twin.enters = deque(self.recent), dict(self.enters)
        if self.lost is not None and self.lost <= now:
            return twin
        twin.lost = None
        twin.free = twin.expected = self.estimate(now)
        if self.recent[-1][1] > now:  # it drives
            twin.recent[-1] = self.recent[-1][0], twin.free
            twin.enters[self.first] = twin.free
        return twin


class SimulatedFloor:
    """Robots that drive by right of way.

    Parameters
    ----------
    scenario
        The fleet, where each robot begins, and the rules.
    delays
        How much longer actions take.

    Attributes
    ----------
    delays
        How much longer actions take.
    robots
        The state of each robot.
    records
        What each robot has done.
    states
        Where robots begin, and their batteries.
    ends
        When jobs have ended, by name [ticks].
    events
        Works that have begun or ended since somebody has cleared the list.
    """

    def __init__(self, scenario: Scenario, delays: DelayDraws) -> None:
        work = scenario.problem.work
        assert work is not None, "the scenario has jobs"
        self.scenario, self.delays, self.states = scenario, delays, work.robots
        self.rules = scenario.problem.booking_rules
        self._books_ahead = self.rules.books_ahead
        self.ends: dict[str, int] = {}
        self.events: list[FloorEvent] = []
        self.records = [RobotRecord() for _ in scenario.robots]
        self.robots = [
            FloorRobot(
                visits=deque([VisitToCome(vertex=state.start)]),
                free=state.ready,
                expected=state.ready,
                recent=deque([(state.start, 0)]),
                enters={0: 0},
                heading=state.heading,
                soc=0 if state.battery is None else state.battery.soc,
                counted=state.ready,
            )
            for state in work.robots
        ]
        for robot, (state, record) in enumerate(zip(work.robots, self.records, strict=True)):
            record.vertices.append(state.start)
            record.enter.append(0)
            self._note_soc(robot, state.ready)
        problem = scenario.problem
        self._headings = list_headings(problem.roadmap) if problem.turns else []
        self._until = 0
        self._front: deque[int] = deque()
        self._waiting: dict[Pair | str, list[int]] = {}

    def fork(self, now: int) -> SimulatedFloor:
        """Return a floor to forecast with: without delays, as far as they are not known.

        Parameters
        ----------
        now
            The tick. An action that is overdue by n ticks is expected to last n more.
        """
        twin = copy(self)
        twin.delays = DelayDraws(DelayModel.none(len(self.robots)), 0, 0)
        twin.events, twin.records = [], [RobotRecord() for _ in self.robots]
        twin.robots = [own.fork(now) for own in self.robots]
        twin.ends = dict(self.ends)
        for own in twin.robots:
            step = own.visits[0].steps[own.n_begun - 1] if own.n_begun else None
            if step is not None and step.ends_job and own.free > now:
                twin.ends[step.job] = own.free
        return twin

    @property
    def roadmap(self) -> Roadmap:
        """The graph that robots drive on."""
        return self.scenario.roadmap

    def find_heading(self, edge: int) -> Fraction | None:
        """Return the heading of an edge in the plane of the map [degrees]; None without one."""
        return self._headings[edge] if self._headings else None

    def convert_heading(self, heading: Fraction | None) -> Fraction | None:
        """Return a heading on the site in the plane of the map [degrees]."""
        return find_heading_on_map(heading, self.roadmap)

    def advance(self, until: int) -> None:
        """Carry out all drives that begin before a tick, and all work that begins until then.

        Parameters
        ----------
        until
            The tick.
        """
        self._until, self._waiting = until, defaultdict(list)
        self._front.extend(range(len(self.robots)))
        while self._front:
            while self._front:
                robot = self._front.popleft()
                while self._do_next(robot, self.robots[robot]):
                    pass
            if not self._books_ahead:
                self._rotate()

    def _do_next(self, robot: int, own: FloorRobot) -> bool:
        """Begin the next action of a robot; return whether it began."""
        if own.lost is not None:
            return False
        if own.n_begun < len(own.visits[0].steps):
            return self._try_step(robot, own, own.visits[0].steps[own.n_begun])
        if len(own.visits) > 1:
            return self._try_visit(robot, own)
        self._charge_while_idle(robot, own)
        return False

    # --- work and charges ------------------------------------------------------------------------

    def _try_step(self, robot: int, own: FloorRobot, step: StepToDo) -> bool:
        if own.cap is not None and (own.first, own.n_begun) >= own.cap:
            return False
        begin = max(own.free, own.since, step.earliest)
        for name in step.after:
            if name not in self.ends:
                self._waiting[name].append(robot)
                return False
            begin = max(begin, self.ends[name])
        if begin > self._until:
            return False
        if step.job:
            self._work(robot, own, step, begin)
        else:
            self._charge(robot, own, step, begin)
        own.n_begun += 1
        return True

    def _work(self, robot: int, own: FloorRobot, step: StepToDo, begin: int) -> None:
        self._end_charge(robot, own, begin)
        own.free = self.delays.stay(robot, own.first, begin, step.ticks)
        own.expected, own.has_worked = begin + step.ticks, True
        self.events.append(FloorEvent(begin, False, robot, step.job, step.stop))
        if own.free >= NEVER:
            self._lose(robot, own, self.delays.find_breakdown(robot))
            return
        battery = self.states[robot].battery
        if battery is not None:
            self._count_charge(robot, own, own.free)
            own.soc -= battery.work * (own.free - begin)
        done = DoneStep(own.first, begin, own.free, step.job, step.stop)
        self.records[robot].steps.append(done)
        self.events.append(FloorEvent(own.free, True, robot, step.job, step.stop))
        self._lose_if_empty(robot, own, own.free)
        if step.ends_job:
            self.ends[step.job] = own.free
            self._front.extend(self._waiting.pop(step.job, ()))

    def _charge(self, robot: int, own: FloorRobot, step: StepToDo, begin: int) -> None:
        """Begin a charge, or go on with the one that the robot has begun while it was idle."""
        if own.charging is None:
            self._count_charge(robot, own, begin)
            own.charging = begin
            self._note_soc(robot, begin)
        own.free = self.delays.stay(robot, own.first, begin, step.ticks)
        own.expected, own.has_worked = begin + step.ticks, True

    def is_charging(self, robot: int) -> bool:
        """Return whether a robot charges and is not full yet.

        Parameters
        ----------
        robot
            Its number.
        """
        own, battery = self.robots[robot], self.states[robot].battery
        if battery is None or own.charging is None or not battery.charge:
            return False
        ticks = max(0, self._until - own.counted)
        return count_soc(battery, own.soc, ticks, is_charging=True) < battery.full

    def _charge_while_idle(self, robot: int, own: FloorRobot) -> None:
        """Charge a robot with nothing to do, where it may; it can be called away at any time."""
        bound, begin = self.states[robot], max(own.free, own.since)
        at = own.visits[0].vertex
        if bound.battery is None or own.charging is not None or at not in bound.charging:
            return
        if begin <= self._until:
            self._charge(robot, own, StepToDo(job="", stop=0, ticks=0), begin)

    def _end_charge(self, robot: int, own: FloorRobot, tick: int) -> None:
        self._count_charge(robot, own, tick)
        if own.charging is None:
            return
        if tick > own.charging:
            self.records[robot].steps.append(DoneStep(own.first, own.charging, tick))
        own.charging = None
        self._note_soc(robot, tick)

    def end_charges(self, tick: int) -> None:
        """End all charges at the end of a shift, so that the records have them.

        Parameters
        ----------
        tick
            The tick.
        """
        for robot, own in enumerate(self.robots):
            self._end_charge(robot, own, tick)

    def _count_charge(self, robot: int, own: FloorRobot, until: int) -> None:
        """Count the state of charge until a tick: a charge only rises, all else takes `on`."""
        battery, ticks = self.states[robot].battery, until - own.counted
        if battery is None or ticks <= 0:
            return
        own.soc = count_soc(battery, own.soc, ticks, is_charging=own.charging is not None)
        own.counted = until

    def _note_soc(self, robot: int, tick: int) -> None:
        battery = self.states[robot].battery
        if battery is not None:
            soc = Fraction(self.robots[robot].soc, battery.full)
            self.records[robot].soc.append((tick, soc))

    def _lose_if_empty(self, robot: int, own: FloorRobot, tick: int) -> None:
        """Lose a robot whose battery is empty."""
        if self.states[robot].battery is not None and own.soc < 0:
            own.soc = 0
            self._lose(robot, own, tick)

    def _lose(self, robot: int, own: FloorRobot, tick: int) -> None:
        own.lost = self.records[robot].lost = tick

    # --- drives ----------------------------------------------------------------------------------

    def _try_visit(self, robot: int, own: FloorRobot) -> bool:
        if own.cap is not None and own.first >= own.cap[0]:
            return False
        ready, (at, by) = self._find_ready(robot, own), self._find_right(robot)
        if ready >= NEVER:
            self._lose(robot, own, self.delays.find_breakdown(robot))
            return False
        if at is None:
            return False
        depart, enter = self._time_drive(robot, own, ready, at)
        while (opens := self._find_open(robot, own, depart, enter)) > depart:
            if opens >= NEVER:  # only another route leads on
                return False
            after = opens if self._books_ahead else opens + enter - depart
            depart, enter = self._time_drive(robot, own, ready, after)
        if depart >= self._until and not self.roadmap.is_passed(own.visits[0].vertex):
            return False
        self._begin_visit(robot, own, depart, enter)
        if by is not None and depart > ready:
            record = self.records[robot]
            record.waits[by] += depart - ready
            record.waits_at[own.recent[-2][0]] += depart - ready
        return True

    def _find_ready(self, robot: int, own: FloorRobot) -> int:
        """Return when a robot could drive into its next visit, if it had the right of way."""
        turn = self.states[robot].turn if own.has_worked else 0
        return max(own.free, own.since) + turn + own.visits[1].turn

    def _find_right(self, robot: int) -> tuple[int | None, int | None]:
        """Return when the last arrival before the next visit of a robot is, and whose it is.

        The tick is None where it is not known yet; then the robot is looked at again.
        """
        at, by = 0, None
        for arrival in self.robots[robot].visits[1].waits:
            enter = self._get_enter(arrival)
            if enter is None:
                self._waiting[arrival].append(robot)
                return None, None
            if (left := int(self.rules.end(enter))) > at:
                at, by = left, arrival[0]
        return at, by

    def _get_enter(self, arrival: Pair) -> int | None:
        robot, visit = arrival
        other = self.robots[robot]
        return None if visit > other.first else other.enters.get(visit, 0)

    def _time_drive(self, robot: int, own: FloorRobot, ready: int, at: int) -> tuple[int, int]:
        """Return when a robot drives and when it arrives, with its right of way from a tick on."""
        number, drive = own.first + 1, own.visits[1].drive
        if self._books_ahead:
            depart = max(ready, at)
            return depart, self.delays.drive(robot, number, depart, drive)
        end = self.delays.drive(robot, number, ready, drive)
        enter = max(end, at)
        return enter - (end - ready), enter

    def _find_open(self, robot: int, own: FloorRobot, depart: int, enter: int) -> int:
        """Return when the edge and the vertex of a drive are open again; 0 where they are.

        The robot stays in the vertex for as long as it is planned to.
        """
        closures, visit = self.scenario.problem.closures, own.visits[1]
        if closures is None:
            return 0
        stay = own.visits[2].planned - visit.planned if len(own.visits) > 2 else 1  # noqa: PLR2004
        closed = [
            *((depart, enter, *times) for times in closures.list_along_edge(robot, visit.edge)),
            *(
                (depart if self._books_ahead else enter, enter + max(stay, 1), *times)
                for times in closures.list_at_vertex(robot, visit.vertex)
            ),
        ]
        return max((end for a, b, start, end in closed if a < end and start < b), default=0)

    def _begin_visit(self, robot: int, own: FloorRobot, depart: int, enter: int) -> None:
        record, visit = self.records[robot], own.visits[1]
        turn = self.states[robot].turn if own.has_worked else 0
        self._end_charge(robot, own, depart - visit.turn - turn)
        own.visits.popleft()
        own.first, own.n_begun, own.has_worked = own.first + 1, 0, False
        own.free, own.expected = enter, depart + visit.drive
        own.recent.append((visit.vertex, enter))
        own.enters[own.first] = enter
        heading = self.find_heading(visit.edge)
        own.heading = own.heading if heading is None else heading
        if enter >= NEVER:
            self._lose(robot, own, self.delays.find_breakdown(robot))
            return
        record.vertices.append(visit.vertex)
        record.enter.append(enter)
        record.drives += enter - depart
        record.turns += visit.turn
        battery = self.states[robot].battery
        if battery is not None and visit.edge >= 0:
            self._count_charge(robot, own, enter)
            own.soc -= battery.drive[int(self.roadmap.class_of_edge[visit.edge])]
            self._lose_if_empty(robot, own, enter)
        self._front.extend(self._waiting.pop((robot, own.first), ()))

    # --- rotations -------------------------------------------------------------------------------

    def _rotate(self) -> None:
        """Move the robots of rotations: each waits only for the next arrivals of others of them."""
        missing = dict(self._list_blocked())
        while missing:
            stray = [robot for robot, others in missing.items() if not missing.keys() >= others]
            if not stray:
                break
            for robot in stray:
                del missing[robot]
        while missing:
            ring = min((_reach(robot, missing) for robot in missing), key=len)
            self._move_ring(sorted(ring))
            # Who waits for a ring comes to it by itself, once it has moved.
            free = {k: others for k, others in missing.items() if others.isdisjoint(ring)}
            missing = {k: others for k, others in free.items() if free.keys() >= others}

    def _list_blocked(self) -> Iterator[tuple[int, set[int]]]:
        """Yield the robots that only miss the next arrivals of others, and these."""
        blocked = {robot for own in self._waiting.values() for robot in own}
        for robot in sorted(blocked):
            own = self.robots[robot]
            if own.n_begun < len(own.visits[0].steps):
                continue
            missing = [at for at in own.visits[1].waits if self._get_enter(at) is None]
            if missing and all(visit == self.robots[k].first + 1 for k, visit in missing):
                yield robot, {k for k, _ in missing}

    def _move_ring(self, ring: Sequence[int]) -> None:
        """Let robots move round at one instant, if one of them sets off before the tick."""
        times = []
        for robot in ring:
            own = self.robots[robot]
            ready = self._find_ready(robot, own)
            end = self.delays.drive(robot, own.first + 1, ready, own.visits[1].drive)
            known = [self._get_enter(at) or 0 for at in own.visits[1].waits]
            times.append((robot, end - ready, max(end, *known)))
        enter = max(at for _, _, at in times)
        if min(enter - lasts for _, lasts, _ in times) >= self._until or enter >= NEVER:
            return
        for robot, lasts, _ in times:
            self._begin_visit(robot, self.robots[robot], enter - lasts, enter)
            self._front.append(robot)


def _reach(robot: int, others: dict[int, set[int]]) -> set[int]:
    """Return the robots that a robot waits for, directly or not; of a ring, all of it."""
    reached, front = set[int](), [robot]
    while front:
        for other in others[front.pop()]:
            if other not in reached:
                reached.add(other)
                front.append(other)
    return reached


def count_soc(battery: BoundBattery, soc: int, ticks: int, *, is_charging: bool) -> int:
    """Return a state of charge after some ticks of a charge, or of being on."""
    if is_charging:
        return min(battery.full, soc + battery.charge * ticks)
    return soc - battery.on * ticks
