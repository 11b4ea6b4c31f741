"""Sentences on a plan: where robots lose time and why, what the planner decided."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from rightofway.metrics import measure, outcome_of
from rightofway.model import Decision, Loss, OutcomeKind, Plan
from rightofway.model.place_names import PlaceNames
from rightofway.quantities import Quantities
from rightofway.values import written

UNEXPLAINED = ", though no place on its way becomes free just then"
"""What a report says about a wait that no other robot is the cause of."""

MAY_BE_CLOSED = ", because something on its way is closed, or to let a robot pass later"
"""What a report says about a wait without a cause, where a place is closed for a while."""


@dataclass(frozen=True, kw_only=True)
class Words:
    """How a report on one plan writes times, robots and places."""

    plan: Plan
    quantities: Quantities

    def robot(self, robot: int | None) -> str:
        """Return the name of a robot."""
        return "" if robot is None else self.plan.scenario.robots[robot].name

    def place(self, vertex: int | None) -> str:
        """Return what a sentence calls a vertex."""
        return "" if vertex is None else self.places(vertex)

    @cached_property
    def places(self) -> PlaceNames:
        """What people call the vertices."""
        return PlaceNames(self.plan.scenario, numbered=True)

    def time(self, ticks: int) -> str:
        """Return how long a number of ticks lasts."""
        return self.quantities.duration(ticks)

    def at(self, tick: int) -> str:
        """Return when something happens."""
        return f"at {self.quantities.moment(tick)}"


def proof_in_words(plan: Plan) -> str:
    """Return what is proven of a plan, beside its lower bound; empty if that is nothing."""
    outcome, metrics = outcome_of(plan), measure(plan)
    if outcome.kind is OutcomeKind.OPTIMAL:
        if metrics.flowtime == metrics.lower_bound:
            return "optimal, no robot loses time"
        return f"optimal, no plan has a smaller {outcome.objective}"
    if outcome.kind is OutcomeKind.BOUNDED and outcome.factor is not None:
        return f"at most {written(outcome.factor)} times the least {outcome.objective}"
    return ""


def sentence_on(words: Words, group: Sequence[Loss]) -> str:
    """Return where and why a robot loses time to another one; all losses are of that pair."""
    first, times = group[0], len(group)
    robot, other = words.robot(first.robot), words.robot(first.for_robot)
    place, freed = words.place(first.vertex), words.place(first.freed)
    total, begin = words.time(sum(loss.ticks for loss in group)), words.at(first.tick)
    if first.kind == "follows":
        way = _where(words, first, "from")
        if times > 1:
            return f"{robot} follows {other} {times} times and loses {total}, first {way} {begin}."
        return f"{robot} follows {other} {way} and loses {total}, beginning {begin}."
    if first.kind == "makes room":
        reason = "" if first.for_robot is None else f" for {other}"
        moment = words.quantities.moment
        away = f"away from {place} from {moment(first.tick)} to {moment(first.end)}"
        if times > 1:
            return f"{robot} makes room{reason} {times} times and loses {total}, first {away}."
        return f"{robot} makes room{reason} and loses {total}, {away}."
    where = _where(words, first)
    unexplained = MAY_BE_CLOSED if words.plan.scenario.closures else UNEXPLAINED
    if times > 1:
        reason = unexplained if first.for_robot is None else ""
        awaited = "" if first.for_robot is None else f" for {other}"
        how = f"waits {times} times{awaited}, {total} in all, first {where} {begin}"
        return f"{robot} {how}{reason}."
    if first.for_robot is None:
        reason = unexplained
    elif first.freed == first.towards:
        reason = f", for {other} to leave {freed}"
    else:
        reason = f", so that {other} can leave {freed} first"
    return f"{robot} waits {total} {where} {begin}{reason}."


def _where(words: Words, loss: Loss, preposition: str = "in") -> str:
    """Return the place of a loss, or its first and its last place after a preposition."""
    first, last = words.place(loss.vertex), words.place(loss.until_vertex)
    return f"in {first}" if loss.until_vertex == loss.vertex else f"{preposition} {first} to {last}"


def decision_in_words(words: Words, decision: Decision) -> str:
    """Return which robot waits where, by a decision of the planner."""
    vertices = decision.vertices
    where = words.place(vertices[0])
    if decision.kind != "vertex":
        first, last = (words.places.where(vertices[end]) for end in (0, -1))
        where = f"segment {first} to {last} ({len(vertices)} vertices)"
    waits, first = words.robot(decision.waits), words.robot(_goes_first(decision))
    how = f"{waits} waits {words.time(decision.ticks)} in {words.place(decision.waits_at)}"
    if decision.kind == "following":
        how = f"{how} and follows {first}" if decision.ticks else f"{waits} follows {first}"
    else:
        how = f"{how}, {first} goes first"
    return f"At {words.quantities.moment(decision.tick)}, {where}: {how}."


def _goes_first(decision: Decision) -> int:
    one, other = decision.robots
    return one if decision.waits == other else other


def reason_in_words(words: Words, decision: Decision) -> str:
    """Return why the planner decided so."""
    i, j = map(words.robot, decision.robots)
    if_i, if_j = decision.conflicts_left
    left = f"conflicts left {if_i} if {i} waits, {if_j} if {j} does"
    match decision.level:
        case "only":
            return f"only choice: {words.robot(_goes_first(decision))} cannot wait here."
        case "priority":
            return f"priority: {words.robot(_goes_first(decision))} has the higher one."
        case "settled":
            return f"node level: the other choice meets robots that are settled already ({left})."
        case "node":
            return f"node level: {left}."
    sum_i, sum_j = decision.completion_sums or (None, None)
    if sum_i is None or sum_j is None:
        sums = f"Only with {j if sum_i is None else i} waiting do both get through."
    elif sum_i == sum_j:
        sums = (
            f"A tie: either way they complete after {words.time(sum_i)} in sum, and"
            f" {words.robot(decision.waits)} waits by rule."
        )
    else:
        sums = (
            f"They complete after {words.time(sum_i)} in sum if {i} waits, after"
            f" {words.time(sum_j)} if {j} does."
        )
    return f"robot level: {left}. {sums}"
