"""Facts that a state proves: arrivals, finished jobs, acknowledgements, faults (rules 7 and 11).

States may come late, twice and in any order, with a wrong field. A proven fact stays true.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from rightofway.control.journal import Entry
from rightofway.control.ledger import Ledger
from rightofway.control.messages import StateReport
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.stop_actions import split_action
from rightofway.control.work_items import describe_item
from rightofway.errors import escape_text
from rightofway.facts import Fact

__all__ = [
    "find_proven_visit",
    "has_stopped",
    "is_acknowledged_by",
    "is_taken_back",
    "list_facts",
    "make_stray",
    "take_fault",
]

FAILED = frozenset({"FAILED", "RETRIABLE"})
"""The status of an action that has failed; a person decides whether a retriable one is retried."""

Report = Callable[[int, Fact], None]
"""Receives a robot and a fact about it."""


def list_facts(
    ledger: Ledger, robot: int, state: StateReport, visit: int | None, report: Report
) -> Iterator[Entry]:
    """Yield the facts that a state proves: finished jobs, an arrival, faults; report faults."""
    own = ledger.robots[robot]
    ended = {*own.finished}
    for job, steps in _list_finished(own, state).items():
        done = {*own.steps_done.get(job, ())}
        if own.count_steps(job) == len(done | steps):
            ended.add(job)
            yield {"kind": "finished", "robot": robot, "job": job}
            continue
        for step in sorted(steps - done):
            yield {"kind": "action finished", "robot": robot, "job": job, "step": step}
    for action_id, status in state.actions.items():
        failed = own.jobs_of.get(action_id)
        if failed is None or failed in ended:
            continue
        # FAILED counts for the current order and the latest attempt only: an older state may be
        # late.
        if (
            status in FAILED
            and state.order_id == own.order_id
            and _is_failure(own, action_id, failed)
        ):
            report(robot, Fact("job failed", job=describe_item(failed)))
            yield {"kind": "failed", "robot": robot, "job": failed}
    if visit is not None and visit > own.arrived:
        yield {"kind": "arrived", "robot": robot, "visit": visit}
    fault = None if own.fault else _find_fault(ledger, robot, state)
    if fault is not None:
        yield take_fault(robot, fault, state, report)


def _list_finished(own: RobotLedger, state: StateReport) -> dict[str, set[int]]:
    """Return the numbers of the actions that a state calls finished, by jobs that are not.

    They count whenever they come, under any order: the id of an action is used once.
    """
    finished = dict[str, set[int]]()
    for action_id, status in state.actions.items():
        job = own.jobs_of.get(action_id)
        if job is not None and job not in own.finished and status == "FINISHED":
            finished.setdefault(job, set()).add(split_action(action_id)[1])
    return finished


def make_stray(state: StateReport) -> Fact:
    """Return the fault of a robot that has lost its order elsewhere than where it was held."""
    return Fact("astray", place=escape_text(state.last_place[:80]))


def take_fault(robot: int, fault: Fact, state: StateReport, report: Report) -> Entry:
    """Report a fault; return its entry."""
    report(robot, Fact("faulty", fault=fault))
    place = state.last_place or None
    return {"kind": "fault", "robot": robot, "fault": fault.as_dict(), "place": place}


def _is_failure(own: RobotLedger, action_id: str, job: str) -> bool:
    """Return whether the last action for a job failed by itself, not by our withdrawal."""
    is_last = split_action(action_id)[0] == own.attempts[job]
    return is_last and job not in own.failed and own.cancel is None


def find_proven_visit(own: RobotLedger, state: StateReport) -> int | None:
    """Return the visit at whose vertex a state proves that the robot has arrived."""
    sent = own.orders.get(state.order_id)
    # Rule 7: the order is one of ours, and odd sequence numbers are edges.
    if sent is None or state.last_sequence_id % 2:
        return None
    end = sent.ends.get(state.update_id)
    if end is None:  # never sent, or so old that it proves nothing new
        return None
    # The visit lies in the base of the update that the state names, so a wrong number proves
    # nothing.
    begin = max(sent.offset, own.route.first)
    visit = sent.offset + state.last_sequence_id // 2
    if not begin <= visit <= min(end, own.released):
        return None
    # The name has to agree, too: two fields that are wrong alike are less likely than one.
    if own.route.get_place(visit) != state.last_place:
        return None
    if not state.nodes:
        # A state from before the update, after a withdrawal or a reset has no nodes either.
        return visit if visit == end else None
    # Nodes and edges that are still ahead contradict an arrival behind them: the first one counts.
    ahead = [sent.offset + (number + 1) // 2 for number in (*state.nodes, *state.edges)]
    visit = min(visit, min(ahead) - 1)
    return visit if visit >= begin else None


def _find_fault(ledger: Ledger, robot: int, state: StateReport) -> Fact | None:
    """Return how a state contradicts all that was sent (rule 11)."""
    own = ledger.robots[robot]
    sent = own.orders.get(state.order_id)
    if sent is None:
        return _find_fault_of_order(ledger, robot, state)
    # A higher update than any sent: somebody else controls this robot.
    if state.update_id >= sent.updates:
        return Fact("unknown update", update=state.update_id, updates=sent.updates)
    visit = sent.offset + state.last_sequence_id // 2
    if state.update_id not in sent.ends or visit < own.route.first:
        return None  # of long ago: where it was is not kept
    end = max(sent.ends.values())
    base = range(sent.offset, end + 1)
    beyond = [number for number in state.nodes if sent.offset + number // 2 not in base]
    if beyond:
        return Fact("unreleased node", node=beyond[0])
    places = own.route.stretch(sent.offset, end + 1)
    if state.order_id == own.order_id and state.last_place not in {*places, ""}:
        return Fact("off way", place=escape_text(state.last_place[:80]))
    return None


def _find_fault_of_order(ledger: Ledger, robot: int, state: StateReport) -> Fact | None:
    """Return the fault of an order that is not kept."""
    if not state.order_id:
        return None
    if not ledger.owns(robot, state.order_id):
        return Fact("foreign order", order=escape_text(state.order_id[:80]))
    number = ledger.find_number(robot, state.order_id)
    # An order from before a person placed the robot, with nodes left: it may still drive them.
    if number is not None and number < ledger.robots[robot].first_order and state.nodes:
        return Fact("old order")
    return None


def is_taken_back(ledger: Ledger, robot: int, state: StateReport) -> bool:
    """Return whether an old withdrawal, which has come late, took the current order back.

    The robot takes no update of it any more. Its answer to a token says where it stands.
    """
    own, start = ledger.robots[robot], f"{ledger.run}-{robot}-cancel"
    current = own.cancel.action_id if own.cancel else None
    return any(
        status == "FINISHED" and action.startswith(start) and action != current
        for action, status in state.actions.items()
    )


def is_acknowledged_by(own: RobotLedger, state: StateReport) -> bool:
    """Return whether a state shows the last order or update, to its last node."""
    assert own.message is not None
    last = own.message.nodes[-1].sequence_id
    is_known = last in state.nodes or last == state.last_sequence_id
    return state.update_id == own.message.update_id and is_known


def has_stopped(own: RobotLedger, state: StateReport) -> bool:
    """Return whether a robot has carried out our withdrawal, or had nothing to withdraw."""
    if own.cancel is None or own.cancel.action_id is None or own.token is not None:
        return False
    status = state.actions.get(own.cancel.action_id)
    return status in {"FINISHED", "FAILED"} and state.is_idle and own.is_acknowledged
