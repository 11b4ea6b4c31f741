"""The ledger: the state of each robot by a journal, a fold over its entries."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from typing import Any, ClassVar, get_args

from rightofway.control.journal import UNFOLDED, Entry
from rightofway.control.robot_ledger import APPLY_TO_ROBOT, RobotLedger
from rightofway.control.routes import RouteToDrive, make_route_to_join
from rightofway.control.work_items import find_stop
from rightofway.dispatch.pool import EventKind, Pool, PoolEvent
from rightofway.errors import InputError, describe_error, quote
from rightofway.model import Tick
from rightofway.precedence import Arrival, Part, ReleaseGraph
from rightofway.site import Roadmap

Names = tuple[str, ...]
"""An object that a person closes: a vertex, or the two ends of a lane."""

JOB_EVENTS = frozenset(get_args(EventKind))
"""Kinds of entries on jobs; stops that robots begin and end follow from orders and actions."""

Edge = tuple[str, str]
"""The names of the vertices that an edge leaves and enters."""


class Ledger:
    """All robots, the release graph of their routes, and the jobs that are not finished.

    ``changed`` has the robots with entries that a story has not been told of yet.

    Parameters
    ----------
    roadmap
        The map of the jobs; None where there are none.
    """

    def __init__(self, roadmap: Roadmap | None = None) -> None:
        self._roadmap, self.pool = roadmap, Pool()
        self.outdated = set[str]()  # jobs that have changed since they were planned
        self.run = ""
        self.starts = 0
        self.names: tuple[str, ...] = ()
        self.robots: list[RobotLedger] = []
        self.graph = ReleaseGraph((), {})
        self.closed: dict[Names, tuple[Edge, ...]] = {}  # what nobody may enter
        self.commands = 0  # the number of the last command that was carried out
        self.answer: Entry | None = None  # to it, as a fact has it
        self.failed = False  # whether it has raised
        self.changed = set[int]()
        self.joined: dict[str, Entry] = {}  # robots that no plan has, by name
        self.joining = set[str]()  # those of them that have not been placed yet
        self.grows = False  # whether some of them are not among the robots yet

    @property
    def arrived(self) -> list[int]:
        """The visit at whose vertex each robot has arrived.

        A robot that is off the floor goes on in thought, wherever it would have right of way:
        a part that waits for it does not list who goes before both of them. In the end it is past
        its last visit.
        """
        arrived = [own.arrived for own in self.robots]
        absent = [robot for robot, own in enumerate(self.robots) if own.is_off]
        for robot in absent:
            arrived[robot] = self.robots[robot].released
        goes_on = bool(absent)
        while goes_on:
            goes_on = False
            for robot in absent:
                end = self.robots[robot].route.end
                while arrived[robot] < end and (
                    arrived[robot] + 1 == end
                    or self.graph.may_go(Part(robot, arrived[robot] + 1), arrived)
                ):
                    arrived[robot], goes_on = arrived[robot] + 1, True
        return arrived

    @property
    def closed_edges(self) -> set[Edge]:
        """The closed edges, by the names of their vertices."""
        return {edge for edges in self.closed.values() for edge in edges}

    def owns(self, robot: int, order_id: str) -> bool:
        """Return whether an order is one of ours for a robot, however old.

        Parameters
        ----------
        robot
            Its number.
        order_id
            As a state names it.
        """
        return (
            order_id in self.robots[robot].orders or self.find_number(robot, order_id) is not None
        )

    def find_number(self, robot: int, order_id: str) -> int | None:
        """Return the number of an order of ours for a robot; None for an order of others.

        Parameters
        ----------
        robot
            Its number.
        order_id
            As a state names it, of any length.
        """
        start, _, digits = order_id.rpartition("-")
        count = self.robots[robot].order_count
        is_short = len(digits) <= len(str(count)) and digits.isdecimal()
        if start != f"{self.run}-{robot}" or not is_short or digits != str(int(digits)):
            return None
        return int(digits) if int(digits) < count else None

    def read(self, number: int, entry: Entry) -> None:
        """Take in an entry that a file has.

        Parameters
        ----------
        number
            Of the entry.
        entry
            The next entry of the journal.

        Raises
        ------
        InputError
            If it is of an unknown kind, or contradicts the entries before it.
        """
        try:
            if entry["kind"] in APPLY_TO_ROBOT and entry["robot"] not in range(len(self.robots)):
                raise IndexError(entry["robot"])  # noqa: TRY301 (negative ones, too)
            self.apply(entry)
            self._refuse_contradictions(entry)
        except Exception as error:
            raise refuse_entry(number, entry, error) from error

    def _refuse_contradictions(self, entry: Entry) -> None:
        """Refuse robots that an entry has put off their routes; a control makes no such entry."""
        if entry["kind"] == "placed":
            return  # the splice with its route follows
        is_of_robot = entry["kind"] in APPLY_TO_ROBOT
        for own in [self.robots[entry["robot"]]] if is_of_robot else self.robots:
            visits = (own.route.first, own.arrived, own.released, own.route.end)
            if {*map(type, visits)} != {int} or not (
                own.route.first <= own.arrived <= own.released < own.route.end
            ):
                raise ValueError(f"visits are not in their order: {visits}")

    def apply(self, entry: Entry) -> None:
        """Take in an entry.

        Parameters
        ----------
        entry
            The next entry of the journal.
        """
        kind = entry["kind"]
        if kind in self._apply_to_fleet:
            self._apply_to_fleet[kind](self, entry)
        elif kind in JOB_EVENTS:
            self._apply_job_event(PoolEvent.of_document(entry, self.roadmap))
        elif kind in UNFOLDED:
            pass
        else:
            APPLY_TO_ROBOT[kind](self.robots[entry["robot"]], entry)
            self._follow_jobs(entry)
            if kind in {"placed", "taken off"}:
                self.joining.discard(self.names[entry["robot"]])
            others = range(len(self.robots)) if kind == "fault" else ()  # it may be in their way
            self.changed.update((entry["robot"], *others))

    def _apply_start(self, _: Entry) -> None:
        self.starts += 1

    def _close(self, entry: Entry) -> None:
        self.closed[tuple(entry["names"])] = tuple(map(tuple, entry["edges"]))
        self.changed.update(range(len(self.robots)))  # robots may wait for it to be open

    def _open(self, entry: Entry) -> None:
        self.closed.pop(tuple(entry["names"]), None)

    def _apply_command(self, entry: Entry) -> None:
        self.commands, self.answer = entry["number"], entry["answer"]
        self.failed = entry["failed"]

    def _join(self, entry: Entry) -> None:
        self.joined[entry["name"]] = entry
        self.joining.add(entry["name"])
        self.grows = True

    def _grow_fleet(self, _: Entry) -> None:
        """Take in the robots that have joined, off the floor until they are placed."""
        self.grows = False
        for name in sorted(self.joining, key=[*self.joined].index):
            route = make_route_to_join(self.joined[name]["at"])
            number = self.names.index(name) if name in self.names else len(self.names)
            self.robots[number : number + 1] = [RobotLedger(route, is_off=True)]
            self.names = (*self.names[:number], name, *self.names[number + 1 :])
            self.changed.add(number)
        old, ends = self.graph, [own.route.end for own in self.robots]
        waits = {part: old.waits(part) for part in old.list_waiting_parts()}
        self.graph = ReleaseGraph(ends, waits, [own.route.first for own in self.robots])

    @property
    def roadmap(self) -> Roadmap:
        """The map of the jobs."""
        assert self._roadmap is not None, "a journal with jobs is read with its map"
        return self._roadmap

    def _apply_job_event(self, event: PoolEvent) -> None:
        """Take in what has happened to a job; its work does not begin where it has changed.

        Robots pass the places of a job that has left; they stand at those of a changed one until it
        is planned again.
        """
        self.pool.apply(event)
        if event.kind in {"job ended", "job planned"}:
            return
        if event.kind == "job changed":
            self.outdated.add(event.name)
        if not self.pool.is_over(event.name):
            return
        for own in self.robots:
            items = own.route.all_jobs
            own.finished |= {
                item for item in items if (find_stop(item) or ("", 0))[0] == event.name
            }
        self.changed.update(range(len(self.robots)))

    def count_jobs(self) -> tuple[int, ...]:
        """Return the number of finished jobs of each robot; of plans without jobs, its stops."""
        has_jobs = self.pool.jobs or self.pool.left
        return tuple(own.whole_jobs if has_jobs else own.jobs_done for own in self.robots)

    def _follow_jobs(self, entry: Entry) -> None:
        """Count stops of jobs: work is begun when it is released, and done when it is finished."""
        kind: EventKind = "stop begun" if entry["kind"] == "order" else "stop done"
        items = {
            "order": lambda: [item for _, item, _ in entry["actions"]],
            "finished": lambda: [entry["job"]],
        }.get(entry["kind"], list)()
        for name, stop in filter(None, map(find_stop, items)):
            robot: int = entry["robot"]
            event = PoolEvent(kind=kind, at=Tick(0), name=name, robot=robot, stop=stop)
            if self.pool.apply(event) and self.pool.is_over(name):
                self.robots[robot].whole_jobs += 1

    def make_snapshot(self) -> Entry:
        """Return an entry that is equivalent to all entries before it."""
        robots = [own.to_document() for own in self.robots]
        waits = _write_waits(self.graph, [own.released for own in self.robots])
        return {
            "kind": "snapshot",
            "run": self.run,
            "starts": self.starts,
            "names": self.names,
            "closed": list(self.closed.items()),
            "commands": self.commands,
            "answer": self.answer,
            "failed": self.failed,
            "robots": robots,
            "waits": waits,
            "joined": [*self.joined.values()],
            "joining": sorted(self.joining),
            "grows": self.grows,
            "outdated": sorted(self.outdated),
            "pool": self.pool.to_document(self.roadmap) if self._roadmap else None,
        }

    def _apply_plan(self, entry: Entry) -> None:
        routes = [RouteToDrive.of_document(route) for route in entry["routes"]]
        self.graph = _make_graph(routes, entry["waits"])
        self.outdated.clear()
        if entry["kind"] == "plan":
            self.run, self.names = entry["run"], tuple(entry["names"])
            self.robots = [RobotLedger(route) for route in routes]
        for own, route in zip(self.robots, routes, strict=True):
            own.take_route(route)
        self.changed.update(range(len(self.robots)))

    def _apply_snapshot(self, entry: Entry) -> None:
        self.run, self.starts = entry["run"], entry["starts"]
        self.names, self.closed = (
            tuple(entry["names"]),
            {tuple(names): tuple(map(tuple, edges)) for names, edges in entry["closed"]},
        )
        self.commands, self.answer = entry["commands"], entry["answer"]
        self.failed = entry["failed"]
        self.robots = [RobotLedger.of_document(robot) for robot in entry["robots"]]
        self.graph = _make_graph([own.route for own in self.robots], entry["waits"])
        self.joined = {own["name"]: own for own in entry.get("joined", ())}
        self.joining, self.grows = set(entry.get("joining", ())), entry.get("grows", False)
        self.outdated = set(entry.get("outdated", ()))  # journals of version 2 have no jobs
        if entry.get("pool") is not None:
            self.pool = Pool.of_document(entry["pool"], self.roadmap)
        self.changed.update(range(len(self.robots)))

    _apply_to_fleet: ClassVar[Mapping[str, Callable[[Ledger, Entry], None]]] = {
        "started": _apply_start,
        "plan": _apply_plan,
        "splice": _apply_plan,
        "snapshot": _apply_snapshot,
        "closed": _close,
        "opened": _open,
        "command": _apply_command,
        "joined": _join,
        "fleet grown": _grow_fleet,
    }
    """How each kind of entry is taken in that is about no robot and no job."""


Waits = list[list[list[Any]]]
"""A release graph in a journal: for each part that waits, the part and its arrivals."""


def make_plan_entry(
    kind: str,
    run: str,
    routes: Sequence[RouteToDrive],
    graph: ReleaseGraph,
    *,
    committed: Sequence[int],
    names: Sequence[str] = (),
) -> Entry:
    """Return the entry of routes and their release graph."""
    documents = [asdict(route) for route in routes]
    waits = _write_waits(graph, committed)
    return {"kind": kind, "run": run, "names": names, "routes": documents, "waits": waits}


def refuse_entry(number: int, entry: Entry, error: Exception) -> InputError:
    """Return the fault of an entry that cannot be read."""
    message = (
        f"{quote(str(entry))} cannot be read: {describe_error(error)[:200]}"
        " (the file is damaged, or of another version: name another one)"
    )
    return InputError.at(("entry", number), message)


def _write_waits(graph: ReleaseGraph, committed: Sequence[int]) -> Waits:
    """Return who waits for whom after the released parts."""
    return [
        [list(part), [list(arrival) for arrival in graph.waits(part)]]
        for part in graph.list_waiting_parts()
        if part.number > committed[part.robot]
    ]


def _make_graph(routes: Sequence[RouteToDrive], waits: Waits) -> ReleaseGraph:
    return ReleaseGraph(
        [route.end for route in routes],
        {Part(*part): [Arrival(*arrival) for arrival in arrivals] for part, arrivals in waits},
        [route.first for route in routes],
    )
