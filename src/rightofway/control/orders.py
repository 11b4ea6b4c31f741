"""Orders over parts of a route, and updates of them, as entries of a journal (rule 6)."""

from __future__ import annotations

from collections.abc import Callable

from rightofway.control.journal import Entry
from rightofway.control.ledger import Ledger
from rightofway.control.messages import Order, OrderNode

__all__ = ["make_order", "make_update"]


MayBegin = Callable[[int, str], bool]
"""Whether an item of work of a robot may begin: others of the node wait behind it."""


def make_order(
    ledger: Ledger, robot: int, begin: int, end: int, may_begin: MayBegin = lambda *_: True
) -> Entry:
    """Return the entry of a new order over some parts."""
    own = ledger.robots[robot]
    order_id = f"{ledger.run}-{robot}-{own.order_count}"
    parts = range(begin, end + 1)
    nodes, actions = _make_nodes(ledger, robot, parts, begin, may_begin)
    order = Order(robot=robot, order_id=order_id, update_id=0, nodes=tuple(nodes))
    return _make_entry(order, begin, actions)


def make_update(
    ledger: Ledger, robot: int, end: int, may_begin: MayBegin = lambda *_: True
) -> Entry:
    """Return the entry of an update to a last part; it begins with the last node of the base.

    That node is sent again word for word; its actions are done once.
    """
    own = ledger.robots[robot]
    assert own.message is not None
    sent = own.orders[own.order_id]
    parts = range(own.released + 1, end + 1)
    nodes, actions = _make_nodes(ledger, robot, parts, sent.offset, may_begin)
    order = Order(
        robot=robot,
        order_id=own.order_id,
        update_id=sent.updates,
        nodes=(own.message.nodes[-1], *nodes),
    )
    return _make_entry(order, sent.offset, actions)


def _make_nodes(
    ledger: Ledger, robot: int, parts: range, offset: int, may_begin: MayBegin
) -> tuple[list[OrderNode], list[tuple[str, str, int]]]:
    """Return the nodes of parts, and the id, job and number of their actions.

    The action of a job keeps its id in all orders, so that it is not done twice: a state that
    says that it is finished may have been lost.
    """
    own, actions, nodes = ledger.robots[robot], [], []
    for part in parts:
        ids = list[str]()
        for job in own.route.get_jobs(part):
            if job in own.finished or job in own.failed:  # a person decides on failed ones
                continue
            if not may_begin(robot, job):
                break  # the robot stands there until it may: then it gets an order of this node
            last = own.attempts.get(job, 0)
            attempt = max(last, 1)
            ids.append(f"{ledger.run}-{robot}-{job}-{attempt}")
            actions.append((ids[-1], job, attempt))
        place, number = own.route.get_place(part), 2 * (part - offset)
        nodes.append(OrderNode(place=place, sequence_id=number, actions=tuple(ids)))
    return nodes, actions


def _make_entry(order: Order, offset: int, actions: list[tuple[str, str, int]]) -> Entry:
    """Return the entry of an order whose sequence id 0 is a part of the route."""
    document = order.to_document()
    return {
        "kind": "order",
        "robot": order.robot,
        "order": document,
        "offset": offset,
        "actions": actions,
    }
