"""What control and robots say to each other, whatever the version of the norm.

Nodes of an order are the vertices of a route, with even sequence ids from 0 in each order; the edge
into a node has the odd id before. All that is sent is released: an order has no horizon.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Literal


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
        Ids of what is to be done there, each once, before the robot goes on.
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
        """Return the order for a journal."""
        return asdict(self)

    @classmethod
    def of_document(cls, document: Mapping[str, Any]) -> Order:
        """Return an order of a journal.

        Parameters
        ----------
        document
            What `to_document` has returned.
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
    """Something to be done at once: tell the state, or stop and forget the order."""

    robot: int
    action_id: str
    kind: Literal["stateRequest", "cancelOrder"]


Message = Order | InstantAction


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotState:
    """What a robot says of itself; messages may be lost, doubled, late, and partly wrong.

    Attributes
    ----------
    order_id, update_id
        Of the order that it has; an empty id where it has none.
    last_place, last_sequence_id
        The node that it has reached last.
    nodes, edges
        Sequence ids of nodes and edges that are still to be driven.
    actions
        The status of actions by their ids, instant ones too.
    is_driving
        Whether it drives.
    """

    order_id: str
    update_id: int
    last_place: str
    last_sequence_id: int
    nodes: tuple[int, ...] = ()
    edges: tuple[int, ...] = ()
    actions: Mapping[str, str] = field(default_factory=dict)
    is_driving: bool = False

    @property
    def is_idle(self) -> bool:
        """Whether nothing is left to be driven."""
        return not self.nodes and not self.edges and not self.is_driving
