"""The messages between control and robots, in any version of the norm.

Nodes of an order are the vertices of a route, with even sequence ids from 0 in each order; the edge
into a node has the odd id before. All that is sent is released: an order has no horizon.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

LOOK_AHEAD = 4
"""Released edges that a robot has not reached yet, at most: re-planning keeps the rest free."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OrderNode:
    """A vertex of an order.

    Attributes
    ----------
    place
        The name of the vertex.
    sequence_id
        An even number.
    actions
        Ids of the actions there, each done once, before the robot drives on.
    """

    place: str
    sequence_id: int
    actions: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """A new order (update 0), or an update that begins with the last node of the base."""

    robot: int
    order_id: str
    update_id: int
    nodes: tuple[OrderNode, ...]

    def to_document(self) -> dict[str, Any]:
        """Return the order for a journal; `asdict` takes thirty times as long."""
        nodes = [
            {"place": node.place, "sequence_id": node.sequence_id, "actions": node.actions}
            for node in self.nodes
        ]
        return {
            "robot": self.robot,
            "order_id": self.order_id,
            "update_id": self.update_id,
            "nodes": nodes,
        }

    @classmethod
    def of_document(cls, document: Mapping[str, Any]) -> Order:
        """Return an order of a journal.

        Parameters
        ----------
        document
            The result of `to_document`.
        """
        nodes = tuple(
            OrderNode(
                place=node["place"],
                sequence_id=node["sequence_id"],
                actions=tuple(node["actions"]),
            )
            for node in document["nodes"]
        )
        return cls(**{**document, "nodes": nodes})


@dataclass(frozen=True, slots=True, kw_only=True)
class InstantAction:
    """An immediate command: send the state, cancel the order, pause, or end the pause."""

    robot: int
    action_id: str
    kind: Literal["stateRequest", "cancelOrder", "factsheetRequest", "startPause", "stopPause"]


Message = Order | InstantAction


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotError:
    """An error that a robot reports.

    Attributes
    ----------
    kind
        As the robot names it.
    level
        ``WARNING``, ``URGENT``, ``CRITICAL`` or ``FATAL``.
    description
        In words; may be empty.
    """

    kind: str
    level: str
    description: str = ""


AUTOMATIC = frozenset({"AUTOMATIC", "SEMIAUTOMATIC"})
"""Operating modes in which a robot drives what it is sent."""

HARMLESS = frozenset({"WARNING", "URGENT"})
"""Levels of errors with which a robot goes on driving."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """The reported condition of a robot. It can delay releases but never causes one.

    Attributes
    ----------
    mode
        Its operating mode.
    is_paused
        Whether it is paused.
    emergency_stop
        Which emergency stop is pressed; ``NONE`` for none.
    errors
        Its faults.
    wants_more
        Whether it will soon have driven all that it may, and asks for more.
    """

    mode: str = "AUTOMATIC"
    is_paused: bool = False
    emergency_stop: str = "NONE"
    errors: tuple[RobotError, ...] = ()
    wants_more: bool = False

    @property
    def is_fit(self) -> bool:
        """Whether more may be released."""
        return (
            self.mode in AUTOMATIC
            and not self.is_paused
            and self.emergency_stop in {"NONE", ""}
            and all(error.level in HARMLESS for error in self.errors)
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Load:
    """A load on a robot; both names may be unknown."""

    load_id: str | None = None
    load_type: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class StateReport:
    """The state message of a robot; messages may be lost, doubled, late, and partly wrong.

    Attributes
    ----------
    order_id, update_id
        Of the order that it has; an empty id without one.
    last_place, last_sequence_id
        The node that it has reached last.
    nodes, edges
        Sequence ids of nodes and edges that are still to be driven.
    actions
        The status of actions by their ids, instant ones too.
    is_driving
        Whether it drives.
    condition
        Whether it is fit to drive on.
    position
        Where it is: x and y [m], and the map; None if the message has none. For people only.
    theta
        Where it heads, from x to y in its own frame [rad]; None if the message has none. For
        forecasts only.
    charge
        The state of charge of its battery, from 0 to 1; None if the message has none.
    loads
        What it carries; None if the message has none.
    """

    order_id: str
    update_id: int
    last_place: str
    last_sequence_id: int
    nodes: tuple[int, ...] = ()
    edges: tuple[int, ...] = ()
    actions: Mapping[str, str] = field(default_factory=dict)
    is_driving: bool = False
    condition: Condition = Condition()
    position: tuple[float, float, str] | None = None
    theta: float | None = None
    charge: float | None = None
    loads: tuple[Load, ...] | None = None

    @property
    def is_idle(self) -> bool:
        """Whether the order has no remaining nodes."""
        return not self.nodes and not self.edges and not self.is_driving
