"""The operator: commands of people to a control, each carried out once.

A command is committed to the journal with its changes, in one transaction. So a control that
was killed knows at its next start which commands it has carried out.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from rightofway.control.commands import (
    Answer,
    Commands,
    read_command,
    read_duration,
    refuse_nameless,
)
from rightofway.control.commitments import list_stops_to_make
from rightofway.control.detours import Detours, list_neighbours
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.fleet_control import UNSOUND
from rightofway.control.job_commands import JobCommands, list_pooled_jobs
from rightofway.control.joins import Joins
from rightofway.control.journal import Entry
from rightofway.control.messages import Message
from rightofway.control.names import (
    describe_place,
    find_failed_job,
    find_job,
    find_open_job,
    find_robot,
    list_edges_into,
    list_jobs,
    name_place,
)
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import make_route_from
from rightofway.errors import GaveUp, InputError, describe_defect, escape_text, quote
from rightofway.facts import Fact
from rightofway.resume.rest_of_fleet import StopToMake

__all__ = ["OPERATIONS", "Operator"]

OPERATIONS: Mapping[str, Entry] = {
    "hold": {"kind": "hold", "on": True},  # nothing more is released to it until it is let go
    "go": {"kind": "hold", "on": False},
    "stop": {"kind": "hold", "on": True},  # and it pauses where it is, if it can
    "cancel": {"kind": "cancel wanted"},  # as far as it can stop before
    "clear": {"kind": "cleared"},  # a person confirms that it is where the journal has it
    "remove": {"kind": "taken off"},  # a person confirms that it is off the floor
}
"""Commands of an operator for robots: the entry of each, without its robot."""

JOB_KINDS = frozenset({"list", "add", "change", "withdraw", "skip"})
"""Commands on jobs, which a plan with jobs keeps in a pool."""

LONGEST_NAME = 40
"""Characters of the name of a person."""


class Operator:
    """Carries out commands of people.

    Each command has a method, which returns the messages to send.

    Parameters
    ----------
    dispatcher
        The work of robots.
    joins
        The robots that join; None where none can.
    """

    def __init__(self, dispatcher: Dispatcher, joins: Joins | None = None) -> None:
        self._dispatcher, self._scenario = dispatcher, dispatcher.plan.scenario
        self._joins = joins
        self._ledger = dispatcher.ledger
        self._detours = Detours(self._scenario, self._ledger)
        self._number: int | None = None  # of the command under way, until it is committed
        self._person = ""  # who has given it, if known
        self._jobs = None
        if dispatcher.rounds is not None:
            self._jobs = JobCommands(self._scenario, self._ledger)

    def obey(self, commands: Commands) -> tuple[list[Message], list[tuple[int, Answer]]]:
        """Carry out the commands of people, each once.

        Parameters
        ----------
        commands
            The file beside the journal.

        Returns
        -------
        tuple
            The messages to send, and the answers: give them to `Commands.answer` once all is on the
            disk.
        """
        ledger = self._ledger
        messages: list[Message] = []
        answers: list[tuple[int, Answer]] = []
        for number, text in commands.list_unanswered():
            if ledger.grows:
                break  # later commands may name the robot that has joined
            if number <= ledger.commands:  # it was carried out before a start
                is_last = number == ledger.commands
                fact = ledger.answer if is_last else Fact("carried out before").as_dict()
                answers.append((number, {"done": not (is_last and ledger.failed), "fact": fact}))
                continue
            self._number = number
            try:
                more, reply = self._run_command(read_command(text))
            except (InputError, GaveUp) as error:
                refusal = Fact("refused", reason=error.explain().detach())
                more, reply = [], {"done": False, "fact": refusal.as_dict()}
            except UNSOUND:
                raise
            except Exception as error:  # noqa: BLE001 (the guard: no command ends the control)
                more, reply = self._fail(number, text, error)
            self._number, self._person = None, ""
            answers.append((number, reply))
            messages += more
        return messages, answers

    def _fail(self, number: int, command: Any, error: Exception) -> tuple[list[Message], Answer]:
        """Answer a command that has raised as failed; no start may carry it out again."""
        defect = Fact("command with defect", defect=describe_defect(error), command=quote(command))
        refusal = Fact("refused", reason=defect)
        if number > self._ledger.commands:  # else it was committed before it has raised
            self._number = number
            self._dispatcher.control.commit(*self._record_answer(refusal, failed=True))
        return [], {"done": False, "fact": refusal.as_dict()}

    def _run_command(self, command: Mapping[str, Any]) -> tuple[list[Message], Answer]:
        """Carry out a command; return the messages to send, and the answer."""
        refuse_nameless(command)
        if self._jobs is not None and command["kind"] in JOB_KINDS:
            return self._run_job_command(self._jobs, command)
        ledger = self._ledger
        kind, lasts, clock = command["kind"], command.get("work"), self._scenario.problem.clock
        texts = {key: str(value) for key, value in command.items() if value is not None}
        name, at, robot = texts.get("name", ""), texts.get("at"), texts.get("robot")
        places = [texts[key] for key in ("name", "to") if key in texts]
        seconds, after = self._scenario.units.seconds, command.get("after")
        ticks = None if lasts is None else clock.count_ticks(read_duration(lasts, seconds))
        before = str(after[0] if isinstance(after, list) and after else after or "") or None
        if kind == "list":
            return [], {"done": True, "fact": None, "jobs": list_jobs(ledger)}
        if kind == "seen":
            person = _read_person(name)
            return self._note(fact=Fact("alarms seen", person=person)), {
                "done": True, "fact": ledger.answer,
            }  # fmt: skip
        self._person = _read_person(texts.get("person", ""))
        changes: dict[str, Callable[[], list[Message]]] = {
            "add": lambda: self.add_job(at or "", int(ticks or 0), robot, before)[1],
            "change": lambda: self.change_job(name, at, ticks),
            "withdraw": lambda: self.withdraw_job(name),
            "again": lambda: self.retry_job(name),
            "skip": lambda: self.skip_job(name),
            "close": lambda: self.close(*places),
            "open": lambda: self.open(*places),
            "place": lambda: self.place_robot(name, at),
            "join": lambda: self.join_robot(command),
            "replan": lambda: self._plan_rest(
                self._dispatcher.list_stops(), fact=Fact("replanned")
            ),
        }
        change = changes.get(kind) or partial(self.operate, kind, texts.get("name"))
        messages = change()
        return messages, {"done": True, "fact": ledger.answer}

    def _run_job_command(
        self, jobs: JobCommands, command: Mapping[str, Any]
    ) -> tuple[list[Message], Answer]:
        """Carry out a command on the jobs of a plan with jobs."""
        rounds, kind = self._dispatcher.rounds, command["kind"]
        assert rounds is not None, "a plan with jobs has rounds"
        if kind == "list":
            rows = list_pooled_jobs(self._ledger, rounds.watch.map_robots(), rounds.reasons)
            return [], {"done": True, "fact": None, "jobs": rows}
        given = {key: value for key, value in command.items() if key != "kind"}
        name, now = str(given.get("name", "")), rounds.watch.read_ticks()
        changes: dict[str, Callable[[], tuple[list[Entry], Fact]]] = {
            "add": lambda: jobs.add(given, now),
            "change": lambda: jobs.change(given, now),
            "withdraw": lambda: jobs.withdraw(name, now),
            "skip": lambda: jobs.give_up(self._find_failed(name), now),
        }
        entries, fact = changes[kind]()
        notes = [*entries, *self._record_answer(fact)]
        if entries:
            messages = self._dispatcher.replan(notes=notes)
        else:
            messages = self._dispatcher.control.note(*notes)
        return messages, {"done": True, "fact": fact.as_dict(), "name": fact.values["job"]}

    def _find_failed(self, name: str) -> str:
        """Return the job of a failed stop; refuse one that has not failed."""
        find_failed_job(self._ledger, name)
        return name

    # --- robots ----------------------------------------------------------------------------------

    def operate(self, kind: str, name: str | None = None) -> list[Message]:
        """Hold one robot or all, let them go, cancel, or confirm where a robot is.

        Parameters
        ----------
        kind
            One of `OPERATIONS`.
        name
            Of the robot; None for all, with hold, go and stop.

        Raises
        ------
        InputError
            If there is no such command or robot, or a robot has to be named.
        """
        ledger, entry = self._ledger, OPERATIONS.get(kind)
        if entry is None:
            raise InputError.at("command", f"{quote(kind)} is no command (see rightofway jobs)")
        refuse_nameless({"kind": kind, "name": name})
        robots = range(len(ledger.names)) if name is None else [find_robot(ledger.names, name)]
        operation = Fact(f"operation {kind}")
        fact = Fact("all operated", operation=operation)
        if name is not None:
            fact = Fact("operated", robot=name, operation=operation)
        entries: list[Entry] = [{**entry, "robot": robot} for robot in robots]
        entries += (pause for robot in robots for pause in self._list_pauses(kind, robot))
        messages = self._note(*entries, fact=fact)
        control = self._dispatcher.control
        messages += (pause for robot in robots for pause in control.list_pauses(robot))
        if self._dispatcher.rounds is not None and kind in {"clear", "remove"}:
            messages += self._dispatcher.replan()
        return messages

    def _list_pauses(self, kind: str, robot: int) -> Iterator[Entry]:
        """Yield the entry of a pause that begins or ends; robots that cannot pause are on hold."""
        own = self._ledger.robots[robot]
        was_on = own.pause is not None and own.pause.is_on
        if (kind == "stop" and not was_on) or (kind == "go" and was_on):
            action = f"{self._ledger.run}-{robot}-pause{own.pauses}"
            yield {"kind": "pause wanted", "robot": robot, "on": kind == "stop", "action": action}

    def place_robot(self, name: str, at: str | None = None) -> list[Message]:
        """Take in a robot again that was off the floor, where a person has put it.

        Its jobs that are not done are planned from there. It gets a new order; an order of before
        that it still has makes it faulty.

        Parameters
        ----------
        name
            Of the robot.
        at
            The name of a vertex or a station; None for that where the robot says that it is.

        Raises
        ------
        InputError
            If the robot is not off the floor, or does not say where it is.
        GaveUp
            If no plan from there was found, as where another robot is in the way.
        """
        robot = find_robot(self._ledger.names, name)
        own, said = self._ledger.robots[robot], self._dispatcher.control.places.get(robot, "")
        if not own.is_off:
            remedy = f"confirm first that it is off the floor: rightofway jobs … remove {name}"
            raise InputError.at("robot", f"{name} is on the floor ({remedy})")
        if at is None and not said:
            raise InputError.at("robot", f"{name} does not say where it is (give --at)")
        place = self._name_stop(at or said)
        if self._dispatcher.rounds is not None:
            notes = self._record_answer(Fact("robot placed", robot=name, place=place))
            return self._dispatcher.rounds.place(robot, place, notes)
        first, stops = own.route.end, self._dispatcher.list_stops()
        # A lap that ends where the robot has arrived was counted, its work there may not be done.
        laps_ahead = tuple(end for end in own.route.lap_ends if end > own.arrived)
        ahead = replace(own, route=replace(own.route, lap_ends=laps_ahead))
        stops[robot] = list_stops_to_make(ahead, own.arrived - 1)
        begun = replace(own, route=make_route_from(own.route, place), is_off=False)
        begun.arrived = begun.released = first
        fact = Fact("robot placed", robot=name, place=place)
        return self._plan_rest(stops, placed={robot: begun}, fact=fact)

    def join_robot(self, given: Mapping[str, Any]) -> list[Message]:
        """Take in a robot that no plan has, as soon as its state shows it at its place.

        Parameters
        ----------
        given
            As for `Joins.judge`.

        Raises
        ------
        InputError
            With every fault of the robot, or if robots cannot join here.
        GaveUp
            If another robot is in the way, or no way leads home from there.
        """
        if self._joins is None:
            remedy = "drive a plan with jobs at a broker; else plan again with the robot"
            raise InputError.at("join", f"is not possible with this plan, or in a demo ({remedy})")
        entry, fact = self._joins.judge(given)
        return self._note(entry, fact=fact)

    # --- jobs ------------------------------------------------------------------------------------

    def add_job(
        self, at: str, work: int, robot: str | None = None, after: str | None = None
    ) -> tuple[str, list[Message]]:
        """Give a robot one more job: where it is least out of its way, or directly after another.

        Parameters
        ----------
        at
            The name of a vertex, or of a station.
        work
            Its duration [ticks].
        robot
            Whose job it is; None for the robot that drives least more.
        after
            A job of the robot, as ``R1/job2``, that is done before; None for any place in its work.

        Returns
        -------
        tuple
            The name of the job, and the messages to send.

        Raises
        ------
        InputError
            If there is no such vertex, robot or job, or the job is of another robot.
        GaveUp
            If no plan with it was found: the old one stands.
        """
        at = self._name_stop(at)
        robots, stops = self._ledger.robots, self._dispatcher.list_stops()
        candidates = (
            range(len(robots)) if robot is None else [find_robot(self._ledger.names, robot)]
        )
        if after is not None:
            owner, place_of_job = find_job(self._ledger, stops, after)
            if owner not in candidates:
                remedy = f"leave out --robot, or name a job of {robot}"
                raise InputError.at("job", f"{quote(after)} is no job of {robot} ({remedy})")
            candidates = [owner]
        on_floor = [number for number in candidates if not robots[number].is_off]
        if not on_floor:
            raise InputError.at("robot", "is off the floor (name another one, or none)")
        if after is not None:
            number, index = owner, 0 if place_of_job is None else place_of_job + 1
        else:
            number, index = self._detours.find_least(on_floor, stops, at)
        job = f"job{robots[number].next_job}"
        stops[number].insert(index, StopToMake(at, job, work))
        name = f"{self._ledger.names[number]}/{job}"
        fact = Fact("only job added", job=name, place=at)
        if neighbours := list_neighbours(self._ledger, number, stops[number], index):
            fact = Fact("job added", job=name, place=at, neighbours=neighbours)
        return name, self._plan_rest(stops, fact=fact)

    def change_job(
        self, name: str, at: str | None = None, work: int | None = None
    ) -> list[Message]:
        """Change place or work of a job that is not released.

        Parameters
        ----------
        name
            The job, as ``R1/job2``.
        at, work
            The change: the name of a vertex or a station, and how long it lasts [ticks].

        Raises
        ------
        InputError
            If there is no such job or vertex, or the job is released already.
        GaveUp
            If no plan with it was found: the old one stands.
        """
        at = None if at is None else self._name_stop(at)
        stops = self._dispatcher.list_stops()
        number, index = find_open_job(self._ledger, stops, name)
        old = stops[number][index]
        stops[number][index] = old._replace(
            place=old.place if at is None else at, work=old.work if work is None else work
        )
        return self._plan_rest(stops, fact=Fact("job changed", job=name))

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
        stops = self._dispatcher.list_stops()
        number, index = find_open_job(self._ledger, stops, name)
        job = stops[number].pop(index).job
        fact = Fact("job withdrawn", job=name)
        return self._plan_rest(stops, withdrawn=[(number, job)], fact=fact)

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
        entry = {"kind": "again", **find_failed_job(self._ledger, name)}
        robot = entry["robot"]
        cancel = {"kind": "cancel wanted", "robot": robot}
        return self._note(entry, cancel, fact=Fact("job repeated", job=name))

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
        entry = {"kind": "skipped", **find_failed_job(self._ledger, name)}
        return self._note(entry, fact=Fact("job skipped", job=name))

    def _name_vertex(self, name: str) -> str:
        """Return the name of the vertex that a name means: its own, or that of a station."""
        roadmap = self._scenario.roadmap
        return roadmap.name(roadmap.get_place(name))

    def _name_stop(self, name: str) -> str:
        """Return the name of the vertex that a name means; robots may stop there."""
        vertex = self._name_vertex(name)
        if not self._dispatcher.control.may_stop(vertex):
            message = f"{name} is driven through only (name a vertex without pass)"
            raise InputError.at("place", message)
        return vertex

    # --- places ----------------------------------------------------------------------------------

    def close(self, *names: str) -> list[Message]:
        """Let no robot enter a vertex or a lane; those that hold it drive on.

        The rest is replanned round it as far as a way is left; where no plan is found, the old one
        stands, and robots stop before it.

        Parameters
        ----------
        names
            The name of a vertex or a station, or of both ends of a lane, which is closed in both
            directions.

        Raises
        ------
        InputError
            If there is no such vertex or lane.
        """
        names = tuple(map(self._name_vertex, names))
        edges = list_edges_into(self._scenario.roadmap, names)
        return self._change_floor({"kind": "closed", "names": names, "edges": edges}, "closed")

    def open(self, *names: str) -> list[Message]:
        """Open a vertex or a lane again that was closed; replan the rest.

        Parameters
        ----------
        names
            The name of a closed vertex or its station, or of both ends of a closed lane.

        Raises
        ------
        InputError
            If it is not closed.
        """
        closed = self._ledger.closed
        names = tuple(map(self._name_vertex, names))
        known = names if names in closed else names[::-1]
        if known not in closed:
            remedy = f"closed are: {', '.join(map(name_place, closed)) or 'none'}"
            raise InputError.at("place", f"{name_place(names)} is not closed ({remedy})")
        return self._change_floor({"kind": "opened", "names": known}, "opened")

    def _change_floor(self, entry: Entry, state: str) -> list[Message]:
        """Commit a change of the floor, then replan the rest if that is possible."""
        messages = self._note(entry, fact=describe_place(state, entry["names"]))
        return [*messages, *(self._dispatcher.replan_if_possible() or [])]

    # --- what all of them do ---------------------------------------------------------------------

    def _note(self, *entries: Entry, fact: Fact) -> list[Message]:
        """Commit the changes of a command, with its answer."""
        return self._dispatcher.control.note(*entries, *self._record_answer(fact))

    def _plan_rest(
        self,
        stops: Sequence[Sequence[StopToMake]],
        *,
        fact: Fact,
        withdrawn: Collection[tuple[int, str]] = (),
        placed: Mapping[int, RobotLedger] | None = None,
    ) -> list[Message]:
        """Plan the rest with these stops; commit it with the answer."""
        notes = self._record_answer(fact)
        return self._dispatcher.replan(stops, withdrawn=withdrawn, placed=placed, notes=notes)

    def _record_answer(self, fact: Fact, *, failed: bool = False) -> list[Entry]:
        """Return the entry of the command that is under way, with its answer."""
        if self._number is None:
            return []
        number, self._number = self._number, None
        if self._person:
            fact = Fact("by person", change=fact, person=self._person)
        entry = {"kind": "command", "number": number, "answer": fact.as_dict(), "failed": failed}
        return [entry]


def _read_person(name: str) -> str:
    """Return the name of a person, as the log shows it."""
    return escape_text(name.strip()[:LONGEST_NAME])
