"""Robots that stand still: fleets with holds and closed places, driven until nobody moves any more.

An observer then compares each robot with the log and with its own search: a robot that stands has
a line that says why, and its next stop cannot be reached past all others as they stand.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Sequence
from functools import partial
from itertools import pairwise

import rightofway
from rightofway.control import FleetControl, Message
from rightofway.control.commitments import list_stops_to_make
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.story import Happening, Story
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.facts import Fact
from rightofway.io import parse_scenario
from rightofway.model import Plan
from tests.builders.chaos import MemoryJournal
from tests.builders.floors import Floor
from tests.oracles.space import Shape, incompatible, zones_of

__all__ = ["StandingFleet", "crowded_plan"]

PATIENCE = 2
"""Rounds for which a robot does not go on before others are replanned round it."""

MOST_ROUNDS = 1_000
"""Rounds after which a fleet without faults would have ended or stand."""


def crowded_plan(seed: int) -> Plan:
    """Return a plan of robots that all work at the same two or three places of a small grid."""
    draw = random.Random(seed)  # noqa: S311
    while True:
        rows, columns = draw.choice([(3, 4), (4, 4), (2, 6)])
        cells = ["".join(draw.choice("....@") for _ in range(columns)) for _ in range(rows)]
        free = [k for k, cell in enumerate("".join(cells)) if cell == "."]
        count = draw.randint(2, 4)
        if len(free) < 2 * count + 2:
            continue
        draw.shuffle(free)
        places = free[count : count + draw.randint(2, 3)]
        robots = [
            {
                "name": f"R{number + 1}",
                "home": f"N{home}",
                "stops": [{"at": f"N{place}", "work": 1} for place in draw.sample(places, 2)],
            }
            for number, home in enumerate(free[:count])
        ]
        document = {
            "format": "rightofway-scenario/1",
            "map": {"grid": cells},
            "rules": {"rotations": False},
            "robots": robots,
        }
        try:
            return rightofway.solve(parse_scenario(document), "prioritized")
        except (NoPlanExists, GaveUp, InputError):
            continue


class StandingFleet:
    """Robots that drive a plan with holds and closed places, until nobody moves.

    Attributes
    ----------
    trouble
        The sentence on a replanning that has failed; empty where none has.
    reports
        All sentences on replanning.
    counts
        How often robots were held, places closed, and so on.
    """

    def __init__(self, plan: Plan, seed: int) -> None:
        self._draw = random.Random(seed)  # noqa: S311
        self.scenario, self.trouble, self.counts = plan.scenario, "", Counter[str]()
        self.reports = list[str]()
        dispatcher = Dispatcher(
            FleetControl(MemoryJournal(), look_ahead=1),
            plan,
            planner="prioritized",
            time_limit=None,
            patience=PATIENCE,
        )
        dispatcher.report = self._note_trouble
        dispatcher.begin("run")
        self.floor, self.ledger = Floor(dispatcher), dispatcher.ledger
        self._story = Story(self.ledger, self.ledger.names)
        self.last: dict[int, Happening] = {}  # the last line on each robot

    def _note_trouble(self, fact: Fact | None, is_over: bool) -> None:
        sentence = "" if fact is None else str(fact)
        self.trouble = "" if is_over else sentence
        self.reports += [sentence] if sentence else []

    def send(self, messages: list[Message]) -> None:
        """Deliver messages of the control."""
        self.floor.send(messages)

    def drive(self, events: int) -> None:
        """Have things happen in as many of the first rounds, then drive on until nobody moves."""
        still = 0
        for number in range(MOST_ROUNDS):
            if number < events:
                self._interfere()
            before = self._stand()
            self.floor.drive(1)
            self.send(self.floor.dispatcher.pass_stuck())
            self.last |= {told.robot: told for told in self._story.go_on()}
            still = still + 1 if self._stand() == before else 0
            if number >= events and still > 2 * PATIENCE:
                return
        raise AssertionError("robots drive without end")

    def _stand(self) -> list[tuple[object, ...]]:
        return [(own.arrived, own.released, len(own.finished)) for own in self.ledger.robots]

    def _interfere(self) -> None:
        """Hold a robot or let it go, close a place or open it, or do nothing."""
        draw, operator = self._draw, self.floor.operator
        kind = draw.choice(["hold", "hold", "go", "close", "close", "open", *[""] * 20])
        try:
            if kind in {"hold", "go"}:
                self.send(operator.operate(kind, draw.choice(self.ledger.names)))
            elif kind == "close":
                self.send(operator.close(*self._draw_place()))
            elif kind == "open" and self.ledger.closed:
                self.send(operator.open(*draw.choice(sorted(self.ledger.closed))))
            self.counts[kind] += 1
        except (InputError, GaveUp):
            self.counts[f"not {kind}"] += 1

    def _draw_place(self) -> Sequence[str]:
        """Return a vertex, or both ends of a lane."""
        roadmap = self.scenario.roadmap
        vertex = self._draw.randrange(roadmap.n_vertices)
        heads = self._list_heads(0, vertex)
        if heads and self._draw.random() < 0.7:
            return [roadmap.name(vertex), roadmap.name(self._draw.choice(heads))]
        return [roadmap.name(vertex)]

    # --- what an observer asks ------------------------------------------------------------------

    def list_silent(self) -> list[str]:
        """Return robots that stand before the end of their work without a line that says why."""
        return [
            f"{name} stands at {own.route.get_place(own.arrived)} after: {self.last.get(robot)}"
            for robot, (name, own) in enumerate(
                zip(self.ledger.names, self.ledger.robots, strict=True)
            )
            if not own.is_done and not own.is_on_hold and not self._waits(robot)
        ]

    def _waits(self, robot: int) -> bool:
        return robot in self.last and self.last[robot].kind == "wait"

    def list_free(self) -> list[str]:
        """Return robots that stand though a way to their next stop leads past all others.

        A robot without stops may have left its home in advance, so that others can come by.
        """
        free = []
        for robot, own in enumerate(self.ledger.robots):
            stops = list_stops_to_make(own, own.released)
            here = own.route.get_place(own.arrived)
            if not stops or own.is_on_hold or stops[0].place == here:
                continue
            if self._reaches(robot, here, goal := stops[0].place):
                free.append(f"{self.ledger.names[robot]} stands at {here}, and {goal} is free")
        return free

    def _reaches(self, robot: int, start: str, goal: str) -> bool:
        get_vertex, name = self.scenario.roadmap.get_vertex, self.scenario.roadmap.name
        closed, seen = self.ledger.closed_edges, {int(get_vertex(start))}
        front = list(seen)
        for vertex in front:  # grows as it goes
            for head in self._list_heads(robot, vertex):
                if head in seen or (name(vertex), name(head)) in closed:
                    continue
                if not self._is_blocked(robot, vertex, head):
                    seen.add(head)
                    front.append(head)
        return int(get_vertex(goal)) in seen

    def _list_heads(self, robot: int, vertex: int) -> list[int]:
        roadmap, ticks = self.scenario.roadmap, self.scenario.problem.itineraries[robot].edge_ticks
        edges = range(int(roadmap.indptr[vertex]), int(roadmap.indptr[vertex + 1]))
        return [int(roadmap.heads[k]) for k in edges if ticks[int(roadmap.class_of_edge[k])] >= 0]

    def _is_blocked(self, robot: int, tail: int, head: int) -> bool:
        """Return whether another robot holds what excludes the drive into a vertex."""
        excludes = partial(incompatible, self.scenario)
        return any(
            excludes(robot, mine, other, theirs)
            for other in range(len(self.ledger.robots))
            if other != robot
            for mine in self._list_shapes((tail, head))[1:]
            for theirs in self._list_shapes(self._list_held(other))
        )

    def _list_held(self, robot: int) -> tuple[int, ...]:
        held = self.ledger.robots[robot].held
        return tuple(int(self.scenario.roadmap.get_vertex(place)) for place in held)

    def _list_shapes(self, path: Sequence[int]) -> list[Shape]:
        """Return the vertices, edges and zones of a path, its first vertex first."""
        roadmap, edges = self.scenario.roadmap, list(pairwise(path))
        zones = {zone for vertex in path[1:] or path for zone in zones_of(roadmap, (vertex,))}
        zones |= {zone for edge in edges for zone in zones_of(roadmap, edge)}
        return [*((vertex,) for vertex in path), *edges, *((-1 - zone,) for zone in sorted(zones))]
