"""Orders over parts of a route, and updates of them, as entries of a journal (rule 6)."""

from __future__ import annotations

from collections.abc import Callable

from rightofway.control.journal import Entry
from rightofway.control.ledger import Ledger
from rightofway.control.messages import Order, OrderNode
from rightofway.control.stop_actions import USUAL, ActionToDo, ListActions, name_action

__all__ = ["make_order", "make_update"]


MayBegin = Callable[[int, str], bool]
"""Whether an item of work of a robot may begin: others of the node wait behind it."""

Actions = list[tuple[str, str, int]]
"""The id, item and attempt of actions."""

Tasks = dict[str, ActionToDo]
"""Actions, by id."""


def make_order(
    ledger: Ledger,
    robot: int,
    begin: int,
    end: int,
    may_begin: MayBegin = lambda *_: True,
    *,
    list_actions: ListActions = lambda *_: (USUAL,),
) -> Entry:
    """Return the entry of a new order over some parts."""
    own = ledger.robots[robot]
    order_id = f"{ledger.run}-{robot}-{own.order_count}"
    parts = range(begin, end + 1)
    nodes, actions, tasks = _make_nodes(
        ledger, robot, parts, begin, may_begin=may_begin, list_actions=list_actions
    )
    order = Order(robot=robot, order_id=order_id, update_id=0, nodes=tuple(nodes))
    return _make_entry(order, begin, actions, tasks)


def make_update(
    ledger: Ledger,
    robot: int,
    end: int,
    may_begin: MayBegin = lambda *_: True,
    *,
    list_actions: ListActions = lambda *_: (USUAL,),
) -> Entry:
    """Return the entry of an update to a last part; it begins with the last node of the base.

    That node is sent again word for word; its actions are done once.
    """
    own = ledger.robots[robot]
    assert own.message is not None
    sent = own.orders[own.order_id]
    parts = range(own.released + 1, end + 1)
    nodes, actions, tasks = _make_nodes(
        ledger, robot, parts, sent.offset, may_begin=may_begin, list_actions=list_actions
    )
    order = Order(
        robot=robot,
        order_id=own.order_id,
        update_id=sent.updates,
        nodes=(own.message.nodes[-1], *nodes),
    )
    return _make_entry(order, sent.offset, actions, tasks)


def _make_nodes(
    ledger: Ledger,
    robot: int,
    parts: range,
    offset: int,
    *,
    may_begin: MayBegin,
    list_actions: ListActions,
) -> tuple[list[OrderNode], Actions, Tasks]:
    """Return the nodes of parts, their actions, and what these are to do.

    The action of a job keeps its id in all orders, so that it is not done twice: a state that
    says that it is finished may have been lost.
    """
    own, actions, nodes, tasks = ledger.robots[robot], Actions(), [], Tasks()
    for part in parts:
        ids, place = list[str](), own.route.get_place(part)
        for job in own.route.get_jobs(part):
            if job in own.finished or job in own.failed:  # a person decides on failed ones
                continue
            if not may_begin(robot, job):
                break  # the robot stands there until it may: then it gets an order of this node
            attempt = max(own.attempts.get(job, 0), 1)
            for step, task in enumerate(list_actions(robot, place, job)):
                if step in own.steps_done.get(job, ()):
                    continue
                ids.append(f"{ledger.run}-{robot}-{name_action(job, attempt, step)}")
                actions.append((ids[-1], job, attempt))
                tasks[ids[-1]] = task
        number = 2 * (part - offset)
        nodes.append(OrderNode(place=place, sequence_id=number, actions=tuple(ids)))
    return nodes, actions, tasks


def _make_entry(order: Order, offset: int, actions: Actions, tasks: Tasks) -> Entry:
    """Return the entry of an order whose sequence id 0 is a part of the route."""
    unusual = {name: task.to_document() for name, task in tasks.items() if task != USUAL}
    document = order.to_document()
    return {
        "kind": "order",
        "robot": order.robot,
        "order": document,
        "offset": offset,
        "actions": actions,
        **({"tasks": unusual} if unusual else {}),
    }
