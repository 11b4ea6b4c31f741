"""The dispatcher: what there is to do, for robots that drive.

A control asks its dispatcher after whatever comes in, and gets more to release where something is
due. A dispatcher keeps nothing that is not in the journal.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise

from rightofway.control.commitments import StopToMake, list_stops_to_make
from rightofway.control.fleet_control import FleetControl
from rightofway.control.journal import Entry
from rightofway.control.laps import LapsToDrive, build_graph_behind_released
from rightofway.control.ledger import Ledger
from rightofway.control.messages import Message
from rightofway.control.names import (
    find_failed_job,
    find_open_job,
    find_robot,
    list_edges_into,
    name_place,
)
from rightofway.control.rest import RestPlanner
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import make_route_from, make_routes_to_drive
from rightofway.errors import GaveUp, InputError
from rightofway.model import Plan
from rightofway.precedence import Part, ReleaseGraph
from rightofway.search import Distances
from rightofway.site import VertexId

__all__ = ["Dispatcher"]

PATIENCE = 10
"""Seconds for which a robot does not go on before others are replanned round it."""

UNREACHABLE = 10**12
"""More than any way [ticks]."""


class Dispatcher:
    """The work of robots that a control releases.

    Parameters
    ----------
    control
        The control, with an empty journal or that of an earlier start.
    plan
        The plan with which the journal begins.
    laps
        What robots repeat for ever; None where they drive the plan once.
    planner, time_limit
        The planner of the rest where jobs change, and its time for one plan [s].
    patience
        Calls of `pass_stuck` for which a robot does not go on before others are replanned round it.

    Attributes
    ----------
    command
        The number of the command that is carried out, until it is committed with its answer.
    """

    def __init__(
        self,
        control: FleetControl,
        plan: Plan,
        laps: LapsToDrive | None = None,
        *,
        planner: str = "auto",
        time_limit: float | None = 2,
        patience: int = PATIENCE,
    ) -> None:
        self._patience = patience
        self.control, self.plan, self._laps = control, plan, laps
        self.command: int | None = None
        self._distances = Distances(plan.scenario.roadmap)
        self._rest = RestPlanner(plan.scenario, planner, time_limit)
        self._stuck_for: dict[int, int] = {}  # calls of `pass_stuck` in a row, by robot
        self._passed = frozenset[int]()  # robots that the rest is planned round
        control.dispatch = self._dispatch

    @property
    def ledger(self) -> Ledger:
        """What the journal says."""
        return self.control.ledger

    @property
    def is_endless(self) -> bool:
        """Whether robots repeat laps for ever."""
        return self._laps is not None

    def begin(self, run: str) -> None:
        """Give an empty journal the plan.

        Parameters
        ----------
        run
            A name that no other journal has.

        Raises
        ------
        InputError
            If robots of the plan move round a circle at one instant.
        """
        graph = ReleaseGraph.of(self.plan.scenario, self.plan.tracks)
        names = [robot.name for robot in self.plan.scenario.robots]
        self.control.begin(run, make_routes_to_drive(self.plan), graph, names)

    def _dispatch(self) -> list[Message]:
        """Add laps where robots come to the end of theirs."""
        routes = self._laps.extend(self.ledger.robots) if self._laps else None
        if routes is None:
            return []
        absent = [robot for robot, own in enumerate(self.ledger.robots) if own.is_off]
        committed = self.control.list_committed()
        graph = build_graph_behind_released(self.plan.scenario, routes, committed, absent)
        messages = self.control.splice(routes, graph)
        closed = self.ledger.closed_edges
        if closed and any(not closed.isdisjoint(pairwise(route.places)) for route in routes):
            with suppress(GaveUp):  # robots stop before what is closed
                messages += self._plan_rest(self._stops())
        return messages

    # --- jobs (splices, rule 10) -----------------------------------------------------------------

    def add_job(self, at: str, work: int, robot: str | None = None) -> tuple[str, list[Message]]:
        """Give a robot one more job, where it is least out of its way.

        Parameters
        ----------
        at
            The name of a vertex.
        work
            How long it lasts [ticks].
        robot
            Whose job it is; None for the robot that drives least more.

        Returns
        -------
        tuple
            The name of the job, and what is to be sent.

        Raises
        ------
        InputError
            If there is no such vertex or robot.
        GaveUp
            If no plan with it was found: the old one stands.
        """
        self.plan.scenario.roadmap.get_vertex(at)  # refuses what is none
        robots = self.ledger.robots
        candidates = [find_robot(self.ledger, robot)] if robot is not None else range(len(robots))
        on_floor = [number for number in candidates if not robots[number].is_off]
        if not on_floor:
            raise InputError.at("robot", "is off the floor (name another one, or none)")
        stops = self._stops()
        _, place, number = min(
            (*self._detour(number, stops[number], at), number) for number in on_floor
        )
        own = robots[number]
        job = f"job{own.next_job}"
        stops[number].insert(place, StopToMake(at, job, work))
        name = f"{self.ledger.names[number]}/{job}"
        return name, self._replanned(stops, text=f"{name} at {at} is added")

    def change_job(
        self, name: str, at: str | None = None, work: int | None = None
    ) -> list[Message]:
        """Change place or work of a job that is not released.

        Parameters
        ----------
        name
            The job, as ``R1/job2``.
        at, work
            What is changed: the name of a vertex, and how long it lasts [ticks].

        Raises
        ------
        InputError
            If there is no such job or vertex, or the job is released already.
        GaveUp
            If no plan with it was found: the old one stands.
        """
        if at is not None:
            self.plan.scenario.roadmap.get_vertex(at)  # refuses what is none
        stops = self._stops()
        number, place = find_open_job(self.ledger, stops, name)
        old = stops[number][place]
        stops[number][place] = old._replace(
            place=old.place if at is None else at, work=old.work if work is None else work
        )
        return self._replanned(stops, text=f"{name} is changed")

    def withdraw_job(self, name: str) -> list[Message]:
        """Take a job back that is not released.

        Parameters
        ----------
        name
            The job, as ``R1/job2``.

        Raises
        ------
        InputError
            If there is no such job, or it is released already.
        GaveUp
            If no plan without it was found: the old one stands.
        """
        stops = self._stops()
        number, place = find_open_job(self.ledger, stops, name)
        job = stops[number].pop(place).job
        text = f"{name} is withdrawn"
        return self._replanned(stops, withdrawn=[(number, job)], text=text)

    def retry_job(self, name: str) -> list[Message]:
        """Have a robot do a job again that has failed: by a new order from where it stands.

        Parameters
        ----------
        name
            The job, as ``R1/job2``.

        Raises
        ------
        InputError
            If it has not failed.
        """
        entry = {"kind": "again", **find_failed_job(self.ledger, name)}
        robot = entry["robot"]
        return self.note(
            entry, {"kind": "cancel wanted", "robot": robot}, text=f"{name} is done again"
        )

    def skip_job(self, name: str) -> list[Message]:
        """Give up a job that has failed: its robot goes on without it.

        Parameters
        ----------
        name
            The job, as ``R1/job2``.

        Raises
        ------
        InputError
            If it has not failed.
        """
        return self.note(
            {"kind": "skipped", **find_failed_job(self.ledger, name)}, text=f"{name} is skipped"
        )

    def replan(self) -> list[Message]:
        """Plan the rest as things are now.

        Raises
        ------
        GaveUp
            If no plan was found: the old one stands.
        """
        return self._replanned(self._stops())

    def switch(self) -> list[Message]:
        """Switch rights of way where robots have come so far that another order is better.

        A robot that is lost, faulty, on hold or not fit lets others go first, where they can.
        """
        control, ledger = self.control, self.ledger
        better = self._rest.find_better_order(
            ledger.robots, control.list_committed(), control.list_stuck()
        )
        return control.splice(*better) if better else []

    def place_robot(self, name: str, at: str | None = None) -> list[Message]:
        """Take in a robot again that was off the floor, where a person has put it.

        Its jobs that are not done are planned from there. It gets a new order; an order of before
        that it still has makes it faulty.

        Parameters
        ----------
        name
            Of the robot.
        at
            The name of a vertex; None for that where the robot says that it is.

        Raises
        ------
        InputError
            If the robot is not off the floor, or does not say where it is.
        GaveUp
            If no plan from there was found, as where another robot is in the way.
        """
        robot = find_robot(self.ledger, name)
        own, said = self.ledger.robots[robot], self.control.places.get(robot, "")
        if not own.is_off:
            remedy = f"confirm first that it is off the floor: rightofway jobs … remove {name}"
            raise InputError.at("robot", f"{name} is on the floor ({remedy})")
        if at is None and not said:
            raise InputError.at("robot", f"{name} does not say where it is (give --at)")
        place = at or said
        self.plan.scenario.roadmap.get_vertex(place)  # refuses what is none
        first, stops = own.route.end, self._stops()
        stops[robot] = list_stops_to_make(own, own.arrived - 1)
        if stops[robot] and stops[robot][0].ends_lap:
            del stops[robot][0]  # it was counted when the robot arrived
        begun = replace(own, route=make_route_from(own.route, place), is_off=False)
        begun.arrived = begun.released = first
        notes = self._carried_out(f"{name} goes on from {place}")
        return [
            *self._plan_rest(stops, notes=notes, placed={robot: begun}),
            *self._dispatch(),
        ]

    def close(self, *names: str) -> list[Message]:
        """Let no robot enter a vertex or a lane; those that hold it drive on.

        The rest is replanned round it as far as a way is left; where no plan is found, the old one
        stands, and robots stop before it.

        Parameters
        ----------
        names
            The name of a vertex, or of both ends of a lane, which is closed in both directions.

        Raises
        ------
        InputError
            If there is no such vertex or lane.
        """
        edges = list_edges_into(self.plan.scenario.roadmap, names)
        return self._noted({"kind": "closed", "names": names, "edges": edges}, "closed")

    def open(self, *names: str) -> list[Message]:
        """Open a vertex or a lane again that was closed; replan the rest.

        Parameters
        ----------
        names
            The name of a closed vertex, or of both ends of a closed lane.

        Raises
        ------
        InputError
            If it is not closed.
        """
        closed = self.ledger.closed
        known = names if names in closed else names[::-1]
        if known not in closed:
            remedy = f"closed are: {', '.join(map(name_place, closed)) or 'none'}"
            raise InputError.at("place", f"{name_place(names)} is not closed ({remedy})")
        return self._noted({"kind": "opened", "names": known}, "open")

    def _noted(self, entry: Entry, state: str) -> list[Message]:
        """Commit a change of the floor, then replan the rest if that is possible."""
        text = f"{name_place(entry['names'])} is {state}"
        messages = self.note(entry, text=text)
        try:
            return [*messages, *self.replan()]
        except GaveUp:
            return messages

    def note(self, *entries: Entry, text: str) -> list[Message]:
        """Commit what a command changes, with its answer.

        Parameters
        ----------
        entries
            What it changes.
        text
            The answer.
        """
        return self.control.note(*entries, *self._carried_out(text))

    def _carried_out(self, text: str) -> list[Entry]:
        """Return the entry of the command that is under way, with its answer."""
        if self.command is None:
            return []
        number, self.command = self.command, None
        return [{"kind": "command", "number": number, "answer": text}]

    def _stops(self) -> list[list[StopToMake]]:
        rows = zip(self.ledger.robots, self.control.list_committed(), strict=True)
        return [list_stops_to_make(own, released) for own, released in rows]

    def _replanned(
        self,
        stops: Sequence[Sequence[StopToMake]],
        *,
        withdrawn: Collection[tuple[int, str]] = (),
        text: str = "replanned",
    ) -> list[Message]:
        """Plan the rest with these stops; then it counts, with the command that it follows."""
        notes = self._carried_out(text)
        messages = self._plan_rest(stops, withdrawn=withdrawn, notes=notes)
        return [*messages, *self._dispatch()]

    def _plan_rest(
        self,
        stops: Sequence[Sequence[StopToMake]],
        *,
        withdrawn: Collection[tuple[int, str]] = (),
        notes: Sequence[Entry] = (),
        placed: Mapping[int, RobotLedger] | None = None,
    ) -> list[Message]:
        """Plan the rest with these stops; robots that are placed begin where they are put."""
        ledger, placed = self.ledger, placed or {}
        robots = [placed.get(robot, own) for robot, own in enumerate(ledger.robots)]
        released = self.control.list_committed()
        for robot, own in placed.items():
            released[robot] = own.released
        stuck = [robot for robot in self._passed if robot not in placed]
        routes, graph = self._rest.plan(robots, released, stops, ledger.closed_edges, stuck)
        return self.control.splice(
            routes, graph, withdrawn=withdrawn, notes=notes, placed=[*placed]
        )

    # --- robots that do not go on ----------------------------------------------------------------

    def pass_stuck(self) -> list[Message]:
        """Replan round robots that do not go on, if others wait for them; call it every second.

        A robot is passed when it has not been fit, or on hold, for a while. Once it is fit again,
        the rest is replanned with it. Where no plan is found the old one stands, and it is tried
        again later.
        """
        ledger, control = self.ledger, self.control
        self._stuck_for = {k: self._stuck_for.get(k, 0) + 1 for k in control.list_stuck()}
        long = frozenset(k for k, times in self._stuck_for.items() if times >= self._patience)
        awaited = {
            arrival.robot
            for robot, own in enumerate(ledger.robots)
            if robot not in self._stuck_for
            for arrival in ledger.graph.list_missing(Part(robot, own.released + 1), ledger.arrived)
        }
        if long == self._passed or (long > self._passed and not long & awaited):
            return []
        before, self._passed = self._passed, long
        try:
            return self.replan()
        except GaveUp:
            self._passed = before & long
            self._stuck_for = dict.fromkeys(self._stuck_for, 0)
            return []

    def _detour(self, robot: int, stops: Sequence[StopToMake], at: str) -> tuple[int, int]:
        """Return how much longer a robot drives for a job at best, and before which stop."""
        own, roadmap = self.ledger.robots[robot], self.plan.scenario.roadmap
        itinerary = self.plan.scenario.problem.itineraries[robot]
        stations = [
            own.route.get_place(own.released),
            *(stop.place for stop in stops),
            own.route.places[-1],
        ]
        vertices = [roadmap.get_vertex(place) for place in stations]

        def ticks(start: int, end: int) -> int:
            to_end = self._distances.to(VertexId(end), itinerary.edge_ticks)[start]
            return int(to_end) if to_end >= 0 else UNREACHABLE

        vertex = roadmap.get_vertex(at)
        return min(
            (ticks(before, vertex) + ticks(vertex, after) - ticks(before, after), place)
            for place, (before, after) in enumerate(pairwise(vertices))
        )
