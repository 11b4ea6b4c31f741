"""The course of a drive, as pages show it: a fold over the rows of a journal.

The journal may be that of a control that runs, in this process or another one, or of one that has
ended: a page that is live and a replay are given the same rows (decision 15).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

from rightofway.control.driven_ends import list_driven_jobs, list_driven_ways, make_ends_data
from rightofway.control.joins import grow_plan
from rightofway.control.journal import Entry, JournalRow
from rightofway.control.ledger import Ledger, refuse_entry
from rightofway.control.notices import EVERY_KIND, PAUSE
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import RouteToDrive
from rightofway.control.story import Story
from rightofway.control.work_items import find_charge_step, find_stop
from rightofway.errors import InputError, quote
from rightofway.execution.drive_result import DrivenEnd, DriveResult
from rightofway.facts import Fact, read_fact
from rightofway.model import Plan, Tick
from rightofway.report.facts import FactWriter
from rightofway.report.phrases import to_parts
from rightofway.viz.page.schema import DrivenFrame, DrivenRow, EndsData, SaysRow

__all__ = ["Recording", "RowSource"]

MAX_ROWS = 200_000
"""Rows that are kept; beyond that a recording begins again with what is known."""

DECIMALS = 2
"""Decimals of a moment [ticks]."""

ENDS_EVERY = 1.0
"""Seconds between two measurements of the ends of jobs."""

OF_LEDGER = frozenset({"fault", "failed"})
"""Kinds of alarms that begin and end with entries on robots, not with notices."""

EVERYBODY = ("plan", "splice", "snapshot", "fleet grown")
"""Kinds of entries that may change what is known of all robots."""


class RowSource(Protocol):
    """A source of rows of a journal, see `JournalReader`."""

    @property
    def is_written(self) -> bool:
        """Whether a control runs."""

    def read_rows(self, after: int = 0) -> Sequence[JournalRow]:
        """Return the rows behind one."""


@dataclass(slots=True)
class _Shown:
    """The values of a robot that pages show."""

    route: RouteToDrive | None = None
    arrived: int = -1
    since: float = 0.0  # when it arrived there
    released: int = -1
    done: int = -1  # the last visit whose work is done
    is_on_hold: bool = False
    is_off: bool = False
    percent: int | None = None
    task: Fact | None = None
    alarms: dict[str, Any] = field(default_factory=dict)  # the sentence of each kind
    seen: dict[str, str] = field(default_factory=dict)  # by whom, of each kind
    wait: SaysRow | None = None  # the last sentence on whom it waits for


class Recording:
    """The course of a run by its journal, in ticks of its plan.

    Parameters
    ----------
    plan
        The plan with which the journal begins.
    source
        Its rows.
    clock
        Returns the time of this machine [s].

    Attributes
    ----------
    now
        The latest moment that is known [ticks].
    is_running
        Whether a control writes the journal.
    """

    def __init__(
        self, plan: Plan, source: RowSource, clock: Callable[[], float] = time.time
    ) -> None:
        self._given, self._plan, self._source, self._clock = plan, plan, source, clock
        self._roadmap, self._writer = plan.scenario.roadmap, FactWriter(plan.scenario)
        seconds = plan.scenario.units.seconds or 1
        self._per_second = 1 / float(plan.scenario.problem.clock.tick * seconds)
        self.now, self.is_running = 0.0, False
        self._last = 0  # the number of the last row that was read
        self._began: float | None = None
        self._moment, self._seen = 0.0, 0.0  # of the last row; when it was read
        self._pace: float | None = 1.0  # seconds of the journal in one; None for unknown
        self._is_simulated = False
        self._ledger = Ledger(self._roadmap)
        self._story: Story | None = None
        self._shown: list[_Shown] = []
        self._general = _Shown()  # what is about no robot
        self._ends: dict[int, Tick] = {}  # when robots came to the end of their routes
        self._ends_data: EndsData | None = None
        self._measured = float("-inf")  # when [s of this machine]
        self._told: dict[int, Any] = {}  # the last sentence on each robot
        self._rows: list[DrivenRow] = []
        self._first = 0  # the number of the first row that is kept

    @property
    def count(self) -> int:
        """Number of rows until now."""
        return self._first + len(self._rows)

    def read_on(self) -> None:
        """Read new rows of the journal.

        Raises
        ------
        InputError
            If the journal is of another plan.
        """
        self.is_running = self._source.is_written
        group: list[JournalRow] = []
        for row in self._source.read_rows(self._last):
            if group and row.moment != group[0].moment:
                self._take(group)
                group = []
            group.append(row)
        if group:
            self._take(group)
        self.now = max(self.now, self._convert_to_tick(self._get_present()))
        if len(self._rows) > MAX_ROWS:
            self._begin_again()

    @property
    def result(self) -> DriveResult:
        """The result until now; the journal has no messages."""
        if not self._ledger.robots:
            raise InputError.at("journal", "has no robots yet (drive the plan with it)")
        robots, now = self._ledger.robots, Tick(int(self.now))
        ends = tuple(map(self._ends.get, range(len(robots))))
        scenario = self._plan.scenario
        has_laps = any(  # more than those of the plan
            own.count_laps() > (robot.laps or scenario.rules.laps)
            for own, robot in zip(robots, scenario.robots, strict=True)
        )
        return DriveResult(
            plan=self._plan,
            trace=None,
            completion=None if has_laps else ends,
            jobs=self._ledger.count_jobs(),
            ends=list_driven_jobs(self._ledger, self._plan.scenario, now),
            laps=tuple(own.laps_done for own in robots),
            now=now,
            waits=tuple(own.waits for own in robots),
            messages={},
        )

    def measure_ends(self) -> EndsData | None:
        """Return planned and actual ends of jobs, or of ways of robots; None of laps.

        It is the same object until an end has changed, at least for `ENDS_EVERY`.
        """
        robots, now = self._ledger.robots, Tick(int(self.now))
        if robots and self._clock() >= self._measured + ENDS_EVERY:
            self._measured, plan = self._clock(), self._plan
            ways = tuple[DrivenEnd, ...]()
            if plan.scenario.jobs is None:
                since = [known.since for known in self._shown]
                ways = list_driven_ways(plan, self._ledger, since, self._ends, now)
            data = make_ends_data(self.result, ways)
            self._ends_data = self._ends_data if data == self._ends_data else data
        return self._ends_data

    def take_frame(self, after: int = 0) -> DrivenFrame:
        """Return the rows after a number of rows.

        Parameters
        ----------
        after
            How many rows are known already.
        """
        begins = not self._first <= after <= self.count or not after
        rows = self._rows if begins else self._rows[after - self._first :]
        return {
            "number": self.count,
            "now": round(self.now, DECIMALS),
            "runs": self.is_running,
            "begins": begins,
            "rows": list(rows),
        }

    # --- moments ---------------------------------------------------------------------------------

    def _get_present(self) -> float:
        """Return the moment of the journal at which it is now [s]."""
        if not self.is_running or self._pace is None or self._began is None:
            return self._moment
        if self._is_simulated:
            return self._moment + (self._clock() - self._seen) * self._pace
        return self._clock()

    def _convert_to_tick(self, moment: float) -> float:
        return 0.0 if self._began is None else (moment - self._began) * self._per_second

    # --- from entries to rows --------------------------------------------------------------------

    def _take(self, group: Sequence[JournalRow]) -> None:
        """Take in the entries of one moment."""
        moment = group[0].moment
        if self._began is None:
            self._began = group[0].entry.get("began", moment)  # a snapshot knows it
        self._moment, self._seen = max(self._moment, moment), self._clock()
        tick = round(
            max(self._convert_to_tick(self._moment), self._rows[-1][0] if self._rows else 0),
            DECIMALS,
        )
        self.now = max(self.now, tick)
        changed = set[int]()
        for row in group:
            changed.update(self._apply(row, tick))
            self._last = row.number
        for robot in sorted(changed):
            self._compare(robot, tick)
        if self._story is not None:
            for happening in self._story.go_on():
                robot, kind, fact, others = happening
                says: SaysRow = (tick, robot, "says", kind, self._write(fact), list(others))
                self._rows.append(says)
                self._shown[robot].wait = says if kind == "wait" else None
                self._ends.pop(robot, None)
                self._ends |= {robot: Tick(int(tick))} if kind == "end" else {}

    def _apply(self, row: JournalRow, tick: float) -> Iterable[int]:
        """Take in an entry; return the robots of which it may say something."""
        entry = row.entry
        kind = entry["kind"]
        self._ledger.read(row.number, entry)
        if kind == "notice":
            try:
                self._show_notice(entry, tick)
            except Exception as error:
                raise refuse_entry(row.number, entry, error) from error
            return ()
        if kind == "charge":
            self._show_charge(int(entry["robot"]), int(entry["percent"]), tick)
            return ()
        if kind == "pace":
            self._pace, self._is_simulated = entry["seconds"], True
            return ()
        if kind == "started":
            self._rows.append((tick, -1, "says", "news", self._write(Fact("control started")), []))
        if kind in EVERYBODY:
            if not self._shown or kind == "fleet grown":
                self._take_fleet()
            return range(len(self._shown))
        robot = int(entry.get("robot", -1))
        if kind == "fault":
            self._update_alarm(
                robot, "fault", self._told.get(robot) or self._write(entry["fault"]), tick
            )
        elif kind == "failed":
            self._update_alarm(robot, "failed", self._told.get(robot, entry["job"]), tick)
        return () if robot < 0 else (robot,)

    @property
    def plan(self) -> Plan:
        """The plan with the robots that have joined."""
        return self._plan

    @property
    def has_grown(self) -> bool:
        """Whether robots have joined that are not in the plan with which the journal begins."""
        return self._plan is not self._given

    def _take_fleet(self) -> None:
        """Take in the robots of the plan, and those that have joined."""
        ledger = self._ledger
        joined = (own for name, own in ledger.joined.items() if name in ledger.names)
        self._plan = grow_plan(self._given, joined)
        self._refuse_another_plan()
        self._shown += (_Shown() for _ in ledger.robots[len(self._shown) :])
        self._story = Story(ledger, ledger.names)

    def _refuse_another_plan(self) -> None:
        names = tuple(robot.name for robot in self._plan.scenario.robots)
        if self._ledger.names != names:
            theirs = ", ".join(self._ledger.names[:3])
            message = f"is of other robots, {theirs} (give the plan that they drive)"
            raise InputError.at("journal", message)
        for own in self._ledger.robots:
            for place in own.route.places:
                try:
                    self._roadmap.get_vertex(place)
                except InputError:
                    message = f"is of another map, with {quote(place)} (give the plan of it)"
                    raise InputError.at("journal", message) from None

    def _write(self, fact: Fact | Entry) -> Any:
        """Return the sentence of a fact, or of one as a journal has it, for pages."""
        fact = fact if isinstance(fact, Fact) else read_fact(fact)
        return to_parts(self._writer.write(fact))

    def _show_notice(self, entry: Entry, tick: float) -> None:
        """Show a notice."""
        robot, about, fact = entry["robot"], entry["about"], entry["fact"]
        text = None if fact is None else self._write(fact)
        is_alarm = about and not entry["over"] and not self._is_wanted(robot, about)
        if text is not None:
            self._rows.append((tick, robot, "says", "alarm" if is_alarm else "news", text, []))
            self._told[robot] = text
        if fact is not None and fact["kind"] == "alarms seen":
            self._mark_seen(fact["values"]["person"], tick)
        if about == EVERY_KIND:
            for number, known in self._list_shown():
                for kind in known.alarms.keys() - OF_LEDGER:
                    self._update_alarm(number, kind, None, tick)
        elif about:
            self._update_alarm(robot, about, text if is_alarm else None, tick)

    def _is_wanted(self, robot: int, about: str) -> bool:
        """Return whether trouble of a robot is the pause that a person has asked for."""
        if about != PAUSE or not 0 <= robot < len(self._ledger.robots):
            return False
        pause = self._ledger.robots[robot].pause
        return pause is not None and pause.is_on

    def _list_shown(self) -> Iterable[tuple[int, _Shown]]:
        """Return the values that pages show: those about no robot, and those of each robot."""
        return ((-1, self._general), *enumerate(self._shown))

    def _mark_seen(self, person: str, tick: float) -> None:
        """Show that a person has seen all alarms that last, and that nobody had seen before."""
        for robot, known in self._list_shown():
            for kind in known.alarms.keys() - known.seen.keys():
                known.seen[kind] = person
                self._rows.append((tick, robot, "seen", kind, person))

    def _show_charge(self, robot: int, percent: int, tick: float) -> None:
        """Show the state of charge of a robot."""
        if 0 <= robot < len(self._shown):
            self._shown[robot].percent = percent
            self._rows.append((tick, robot, "charge", percent))

    def _update_alarm(self, robot: int, kind: str, text: Any, tick: float) -> None:
        """Show that trouble of a kind begins, or with None that it ends."""
        known = self._shown[robot] if 0 <= robot < len(self._shown) else self._general
        alarms = known.alarms
        if text is None and kind not in alarms:
            return
        self._rows.append((tick, robot, "alarm", kind, text))
        if text is None:
            del alarms[kind]
            known.seen.pop(kind, None)
        else:
            alarms[kind] = text

    def _compare(self, robot: int, tick: float) -> None:
        """Show the values of a robot that have changed since pages got them."""
        own, known = self._ledger.robots[robot], self._shown[robot]
        if own.route is not known.route:
            self._show_route(robot, own.route, known, tick)
        if own.arrived > known.arrived:
            known.arrived, known.since = own.arrived, tick
            self._rows.append((tick, robot, "arrived", own.arrived))
        if own.released != known.released:
            known.released = own.released
            self._rows.append((tick, robot, "released", own.released))
        jobs = own.route.get_jobs(own.arrived)
        if jobs and known.done < own.arrived and own.finished.issuperset(jobs):
            known.done = own.arrived
            self._rows.append((tick, robot, "done", own.arrived))
        if own.is_on_hold != known.is_on_hold:
            known.is_on_hold = own.is_on_hold
            self._rows.append((tick, robot, "hold", own.is_on_hold))
        if own.is_off != known.is_off:
            known.is_off = own.is_off
            self._rows.append((tick, robot, "off", own.is_off))
        if (task := _find_task(own)) != known.task:
            known.task = task
            self._rows.append((tick, robot, "task", "" if task is None else self._write(task)))
        if own.fault is None or own.is_off:  # a person has looked after it
            self._update_alarm(robot, "fault", None, tick)
        if not own.failed:
            self._update_alarm(robot, "failed", None, tick)

    def _show_route(self, robot: int, route: RouteToDrive, known: _Shown, tick: float) -> None:
        """Show a route from the first visit on that differs from the one known."""
        old, visit = known.route, route.first
        if old is not None:
            visit = max(old.first, route.first)
            end = min(old.end, route.end)
            while visit < end and old.get_place(visit) == route.get_place(visit):
                visit += 1
        known.route = route
        if old is None or visit < max(route.end, old.end):
            vertices = [
                int(self._roadmap.get_vertex(place)) for place in route.stretch(visit, route.end)
            ]
            self._rows.append((tick, robot, "route", visit, vertices))

    def _begin_again(self) -> None:
        """Keep only rows that describe the present."""
        self._first = self.count
        tick = self._rows[-1][0]
        self._rows = []
        for robot, known in enumerate(self._shown):
            own: RobotLedger = self._ledger.robots[robot]
            wait = known.wait
            self._shown[robot] = fresh = _Shown(alarms=known.alarms, seen=known.seen, wait=wait)
            self._compare(robot, tick)
            if known.percent is not None:
                self._show_charge(robot, known.percent, tick)
            self._show_alarms_again(robot, fresh, tick)
            if wait is not None and own.arrived == own.released:
                self._rows.append((tick, *wait[1:]))
            fresh.done = own.arrived
        self._show_alarms_again(-1, self._general, tick)

    def _show_alarms_again(self, robot: int, known: _Shown, tick: float) -> None:
        """Show the alarms that last, and who has seen them."""
        for kind, text in known.alarms.items():
            self._rows.append((tick, robot, "alarm", kind, text))
        for kind, person in known.seen.items():
            self._rows.append((tick, robot, "seen", kind, person))


def _find_task(own: RobotLedger) -> Fact | None:
    """Return what a robot does for a job of a pool, or that it charges; None for neither."""
    if own.is_off:
        return None
    items = own.route.get_jobs(own.arrived)
    charges = [item for item in items if find_charge_step(item) == "begin"]
    if any(item in own.finished and f"{item} end" not in own.finished for item in charges):
        return Fact("task charges")
    for visit in range(own.arrived, own.route.end):
        for item in own.route.get_jobs(visit):
            if item not in own.finished and (stop := find_stop(item)):
                is_at_work = visit == own.arrived and own.is_asked_for(item)
                kind = "task at work" if is_at_work else "task ahead"
                return Fact(kind, job=stop[0], number=stop[1] + 1)
    return None
