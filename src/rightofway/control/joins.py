"""Robots that no plan has join a fleet that drives.

A robot joins in two steps. A command appends it to the fleet, off the floor, with its identity. The
control that has carried the command out begins again on its journal, as after a kill, with the plan
and the robots that have joined: so all its parts have the same fleet. From then on it receives the
states of the robot. When one shows it at its vertex, it is placed there as robots are that were off
the floor, so that mutual exclusion follows from the release graph; the next round gives it jobs.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from rightofway.control.dispatcher import Dispatcher
from rightofway.control.identities import IDENTITY_KEYS, Identity, make_identity_like
from rightofway.control.journal import Entry
from rightofway.control.messages import Message
from rightofway.control.names import find_robot
from rightofway.control.notices import Notices
from rightofway.control.round_place import refuse_place
from rightofway.errors import GaveUp, InputError, Steps, Where, quote
from rightofway.facts import Fact
from rightofway.io.scenario.fleet import read_robot_of_jobs
from rightofway.io.scenario.loaded_map import LoadedMap
from rightofway.io.scenario.writer import dump_robot
from rightofway.model import Plan, Robot, RobotState, Scenario, Track

__all__ = ["Joins", "grow_identities", "grow_plan", "make_join_entry"]

JOIN = "join"
"""The kind of trouble of a robot that has joined and cannot be placed."""

PATIENCE = 10
"""Calls of `Joins.look` until it is reported that a robot cannot be placed yet."""


def grow_plan(plan: Plan, joined: Iterable[Entry]) -> Plan:
    """Return a plan with the robots that have joined, which stay where they are.

    Parameters
    ----------
    plan
        A plan with jobs.
    joined
        The entries of the robots.

    Raises
    ------
    InputError
        With every fault of a robot: its name is taken, its home is not free, a key is unknown.
    """
    for entry in joined:
        scenario = plan.scenario
        robot = _make_robot(scenario, entry)
        fleet = (*map(_leave_begin, scenario.robots), robot)
        try:  # ticks of routes in the journal are those of the first clock
            grown = replace(scenario, robots=fleet, tours=None, clock=scenario.problem.clock)
        except InputError as error:
            own: dict[Steps, Where] = {("robots", len(fleet) - 1): ()}
            raise InputError(fault.relocate(own) for fault in error.faults) from error
        if grown.roadmap.n_edges != scenario.roadmap.n_edges:
            remedy = "plan again with it"
            raise InputError.at("radius", f"is larger than the lanes of the plan allow ({remedy})")
        vertex = scenario.roadmap.get_vertex(entry["at"])
        plan = replace(
            plan,
            scenario=grown,
            tracks=(*plan.tracks, Track.of([int(vertex)], [0])),
            tours=(*(plan.tours or ()), ()),
            run=replace(plan.run, alone=None, outcome=None),  # they are of the smaller fleet
        )
    return plan


def make_join_entry(plan: Plan, given: Mapping[str, Any]) -> Entry:
    """Return the entry of a robot that joins.

    Parameters
    ----------
    plan
        The plan with which the journal begins.
    given
        Its ``name``, ``serial`` number and place ``at``; the name of the robot that it is ``like``;
        more keys of robots, of scenario files and of files of identities, in ``set``.

    Raises
    ------
    InputError
        If its serial number or place is missing, the place is unknown, or one of these keys may not
        be set; or if robots of the plan differ, and none is named that it is like.
    """
    serial, place = (str(given.get(key) or "") for key in ("serial", "at"))
    if not serial or not place:
        key, example = ("at", "--at") if serial else ("serial", "--serial")
        raise InputError.at(key, f"is missing (give {example})")
    keys = given.get("set") or {}
    if not isinstance(keys, dict) or {"name", "serial", "start"} & keys.keys():
        message = f"{quote(keys)} cannot be set (give keys of robots apart from its start)"
        raise InputError.at("set", message)
    roadmap = plan.scenario.roadmap
    return {
        "kind": "joined",
        "name": str(given.get("name") or ""),
        "serial": serial,
        "at": roadmap.name(roadmap.get_place(place)),
        "like": str(given.get("like") or _find_usual(plan)),
        "given": keys,
    }


def _make_robot(scenario: Scenario, entry: Entry) -> Robot:
    """Return the robot of an entry: like another one, but for the given keys."""
    names = [robot.name for robot in scenario.robots]
    like = dump_robot(scenario.robots[find_robot(names, entry["like"])], scenario)
    given = {key: value for key, value in entry["given"].items() if key not in IDENTITY_KEYS}
    replaced = {"start", "radius"} if "size" in given else {"start"}
    usual = {key: value for key, value in like.items() if key not in replaced}
    document = {**usual, "home": entry["at"], **given, "name": entry["name"]}
    return read_robot_of_jobs(document, LoadedMap(roadmap=scenario.roadmap, units=scenario.units))


def _leave_begin(robot: Robot) -> Robot:
    """Return a robot of a fleet that drives, which is no longer where the run began."""
    if robot.start is None:
        return robot
    start = RobotState(at=robot.home, ready=robot.start.ready, soc=robot.start.soc)
    return replace(robot, start=start)


def grow_identities(
    names: Sequence[str], identities: Sequence[Identity], joined: Iterable[Entry]
) -> list[Identity]:
    """Return the identities of a fleet with those of the robots that have joined.

    Parameters
    ----------
    names, identities
        The robots of the plan.
    joined
        The entries of the others.

    Raises
    ------
    InputError
        If another robot has the same topics, or with every fault of an identity.
    """
    names, identities = [*names], [*identities]
    for entry in joined:
        given = {key: value for key, value in entry["given"].items() if key in IDENTITY_KEYS}
        like = identities[find_robot(names, entry["like"])]
        own = make_identity_like(like, {**given, "serial": entry["serial"]})
        topics = [identity.get_topic("") for identity in identities]
        if own.get_topic("") in topics:
            owner = names[topics.index(own.get_topic(""))]
            message = f"{quote(own.serial_number)} is the serial number of {owner} already"
            raise InputError.at("serial", f"{message} (correct one)")
        names.append(entry["name"])
        identities.append(own)
    return identities


class Joins:
    """The robots of a control that join, see the module.

    Parameters
    ----------
    plan, identities
        Those with which the journal begins.
    dispatcher
        The work of robots, with rounds.
    """

    def __init__(self, plan: Plan, identities: Sequence[Identity], dispatcher: Dispatcher) -> None:
        self._plan, self._identities, self._dispatcher = plan, identities, dispatcher
        self._looks = Counter[str]()

    def judge(self, given: Mapping[str, Any]) -> tuple[Entry, Fact]:
        """Return the entry of a robot that may join, and the fact that answers the command.

        Parameters
        ----------
        given
            As for `make_join_entry`.

        Raises
        ------
        InputError
            With every fault of the robot.
        GaveUp
            If another robot holds its place, or no way leads home from there.
        """
        ledger, entry = self._dispatcher.ledger, make_join_entry(self._plan, given)
        name, vertex, like = entry["name"], entry["at"], entry["like"]
        if name in ledger.names and name not in ledger.joining:
            raise InputError.at("robot", f"{quote(name)} is a robot already (give another name)")
        if like in ledger.joining:  # another command may still replace it
            raise InputError.at("like", f"{quote(like)} joins itself (name a robot that drives)")
        joined = {**ledger.joined, name: entry}
        grown = grow_plan(self._plan, joined.values())
        names = [robot.name for robot in self._plan.scenario.robots]
        grow_identities(names, self._identities, joined.values())
        committed = self._dispatcher.control.list_committed()
        number = [robot.name for robot in grown.scenario.robots].index(name)
        refuse_place(grown.scenario, ledger, committed, number, vertex)
        return entry, Fact("robot joins", robot=name, place=vertex)

    def look(self, notices: Notices) -> list[Message]:
        """Place the robots that are where they join; call it every second.

        Parameters
        ----------
        notices
            Receives the reason for which a robot cannot be placed yet.
        """
        messages = list[Message]()
        for name in sorted(self._dispatcher.ledger.joining):
            messages += self._place(name, notices)
        return messages

    def _place(self, name: str, notices: Notices) -> list[Message]:
        """Place a robot if that is possible; else report the reason, once."""
        control, rounds = self._dispatcher.control, self._dispatcher.rounds
        robot, place = control.ledger.names.index(name), control.ledger.joined[name]["at"]
        assert rounds is not None, "only plans with jobs have robots that join"
        self._looks[name] += 1
        reason = Fact("no state")
        if robot not in control.lost and robot in control.places:
            reason = Fact("state of other place", place=control.places[robot])
            if control.places[robot] == place:
                try:
                    messages = rounds.place(robot, place, [])
                except GaveUp as error:
                    reason = error.explain().detach()
                else:
                    notices.end(robot, JOIN)
                    notices.report_on(robot, Fact("has joined", place=place))
                    return messages
        if self._looks[name] >= PATIENCE:
            end = Fact("joins no longer")
            notices.begin(robot, JOIN, Fact("cannot join", place=place, reason=reason), end)
        return []


def _find_usual(plan: Plan) -> str:
    """Return the name of a robot that all others are like, apart from their places."""
    first = plan.scenario.robots[0]
    for robot in plan.scenario.robots:
        if replace(robot, name=first.name, home=first.home, start=first.start) != first:
            message = f"{first.name} and {robot.name} differ (name the one that it is like: --like)"
            raise InputError.at("like", message)
    return first.name
