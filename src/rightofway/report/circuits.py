"""The bottleneck of laps in words: the actions on a critical circuit, step by step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Literal

from rightofway.cyclic import Piece
from rightofway.model import Scenario, Tick
from rightofway.report.phrases import Phrase, chain_items, join_items
from rightofway.report.place_names import PlaceNames
from rightofway.report.quantities import Quantities
from rightofway.site import VertexId

MAX_STEPS = 12
"""Steps of a circuit that a sentence names; further ones are counted."""

MAX_ROBOTS = 4
"""Robots of a circuit that are named in short."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CircuitStep:
    """Actions of one robot on a critical circuit until the next step can begin.

    Attributes
    ----------
    kind
        That of a `Piece`, or ``laps`` for whole laps that a robot makes without waiting.
    robot
        The robot, by index.
    places
        The vertices where that is, each once for laps.
    ticks
        How long it takes [ticks].
    after
        The robot that a right of way waits for, by index; None for other steps.
    text
        The actions; the sentence continues after the robot's name.
    """

    kind: Literal["work", "way", "right of way", "laps"]
    robot: int
    places: tuple[VertexId, ...]
    ticks: Tick
    text: Phrase
    after: int | None = None


def list_circuit_steps(pieces: Sequence[Piece], scenario: Scenario) -> list[CircuitStep]:
    """Return a critical circuit in steps, the first of a robot at the start; laps are one step."""
    # The right of way by which the first robot comes to its first piece may stand at the end.
    turn = next((k for k, piece in enumerate(reversed(pieces)) if piece.kind != "right of way"), 0)
    rotated = [*pieces[len(pieces) - turn :], *pieces[: len(pieces) - turn]]
    place, steps = PlaceNames(scenario, numbered=True), list[CircuitStep]()
    for _, run in groupby(rotated, lambda piece: piece.robot):
        awaited = steps[-1].robot if steps else rotated[-1].robot
        steps.extend(_list_steps_of_robot(list(run), awaited, scenario, place))
    return steps


def _list_steps_of_robot(
    run: Sequence[Piece], awaited: int, scenario: Scenario, place: PlaceNames
) -> Iterator[CircuitStep]:
    """Yield the actions of one robot without waiting for others."""
    home = scenario.robots[run[0].robot].home
    arrivals = [
        k for k, piece in enumerate(run) if piece.kind == "way" and piece.places[-1] == home
    ]
    first, last = (arrivals[0] + 1, arrivals[-1] + 1) if arrivals else (0, 0)
    for piece in run[:first]:
        yield _step(piece, awaited, scenario, place)
    if first < last:
        laps = Phrase("n_laps", number=str(len(arrivals) - 1))
        between = run[first:last]
        yield CircuitStep(
            kind="laps",
            robot=run[0].robot,
            places=tuple(dict.fromkeys(vertex for piece in between for vertex in piece.places)),
            ticks=Tick(sum(piece.ticks for piece in between)),
            text=Phrase("step: own laps", laps=laps),
        )
    for piece in run[last:]:
        yield _step(piece, awaited, scenario, place)


def _step(piece: Piece, awaited: int, scenario: Scenario, place: PlaceNames) -> CircuitStep:
    robot, names = scenario.robots[piece.robot], [place(vertex) for vertex in piece.places]
    at = scenario.roadmap.get_original(piece.places[0])
    match piece.kind:
        case "way" if piece.places[-1] == robot.home:
            text = Phrase("step: drives home")
        case "way":
            text = Phrase("step: drives", place=names[-1])
        case "work" if at in {stop.at for stop in robot.stops} - {robot.home}:
            text = Phrase("step: works", place=names[0])
        case "work":
            text = Phrase("step: turns", place=names[0])
        case _ if awaited == piece.robot:
            text = Phrase("step: enters", place=names[0])
        case _:
            other = scenario.robots[awaited].name
            text = Phrase(
                "step: enters after",
                place=names[0],
                other=other,
                left=names[-1],
            )
    is_after = piece.kind == "right of way" and awaited != piece.robot
    return CircuitStep(
        kind=piece.kind,
        robot=piece.robot,
        places=piece.places,
        ticks=piece.ticks,
        text=text,
        after=awaited if is_after else None,
    )


def describe_circuit(pieces: Sequence[Piece], scenario: Scenario, *, most: int = MAX_STEPS) -> str:
    """Return the actions of the robots of a critical circuit, in one sentence.

    That is ``R2 enters N4 once R1 has left N4, drives to N8, works at N8, drives home; …``.
    """
    names = [robot.name for robot in scenario.robots]
    steps = list_circuit_steps(pieces, scenario)
    if len({step.robot for step in steps}) == 1:
        return Phrase("circuit of one robot", robot=names[steps[0].robot])
    parts = []
    for robot, run in groupby(steps[:most], lambda step: step.robot):
        texts = chain_items([step.text for step in run])
        parts.append(Phrase("steps of robot", robot=names[robot], steps=texts))
    if len(steps) > most:
        further = Phrase("n_more_steps", number=str(len(steps) - most))
        parts.append(Phrase("further steps", steps=further))
    return chain_items(parts, "two clauses")


def summarize_circuit(pieces: Sequence[Piece], scenario: Scenario, period: Tick) -> Phrase:
    """Return which robots set the pace, and the period."""
    robots = list(dict.fromkeys(piece.robot for piece in pieces))
    names = [scenario.robots[robot].name for robot in robots]
    time = Quantities.of(scenario).format_duration(period)
    if len(names) == 1:
        return Phrase(
            "bottleneck of one robot",
            robot=names[0],
            time=time,
        )
    if len(names) > MAX_ROBOTS:
        more = Phrase("number more", number=str(len(names) - MAX_ROBOTS + 1))
        names = [*names[: MAX_ROBOTS - 1], more]
    return Phrase("bottleneck of robots", robots=join_items(names), time=time)
