"""Sentences on a plan: where robots lose time and why, decisions of the planner, faults.

All are phrases: reports, pages, notebooks and the studio show them, each in its language.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from math import ceil, floor

from rightofway.kinds.numbers import format_number
from rightofway.metrics import derive_outcome, measure
from rightofway.model import (
    Closure,
    Decision,
    ForcedLoss,
    Improvement,
    Loss,
    Objective,
    OutcomeKind,
    Plan,
    Scenario,
)
from rightofway.report.phrases import Phrase, chain_items, join_items, mark_figure
from rightofway.report.place_names import PlaceNames
from rightofway.report.quantities import Quantities


@dataclass(frozen=True, kw_only=True)
class Words:
    """How sentences on one plan write times, robots and places."""

    plan: Plan
    quantities: Quantities

    def name_robot(self, robot: int | None) -> str:
        """Return the name of a robot."""
        return "" if robot is None else self.plan.scenario.robots[robot].name

    def name_place(self, vertex: int | None) -> str:
        """Return the name of a vertex in a sentence."""
        return "" if vertex is None else self.places(vertex)

    def name_way(self, vertices: Sequence[int]) -> str:
        """Return a place, or the first and the last of several."""
        first, last = self.name_place(vertices[0]), self.name_place(vertices[-1])
        return first if first == last else Phrase("first to last", first=first, last=last)

    def say_time(self, ticks: int) -> str:
        """Return how long a number of ticks lasts."""
        return self._time(ticks)

    def say_moment(self, tick: int) -> str:
        """Return a point in time."""
        return self._moment(tick)

    @cached_property
    def places(self) -> PlaceNames:
        """The names of the vertices for people."""
        return PlaceNames(self.plan.scenario, numbered=True)

    @cached_property
    def closed(self) -> Sequence[tuple[tuple[int, ...], int]]:
        """A place closed for a while: its vertices, and until when."""
        scenario = self.plan.scenario
        times = ((closure, read_closed_ticks(closure, scenario)) for closure in scenario.closures)
        return [
            (list_closed_vertices(closure, scenario), end)
            for closure, (_, end) in times
            if end is not None
        ]

    # Large plans have far more losses than different times and places.

    @cached_property
    def _time(self) -> Callable[[int], str]:
        return cache(self.quantities.format_duration)

    @cached_property
    def _moment(self) -> Callable[[int], str]:
        return cache(self.quantities.format_moment)


def describe_proof(plan: Plan) -> str:
    """Return the proof of a plan, apart from its lower bound; empty if there is none."""
    outcome, metrics = derive_outcome(plan), measure(plan)
    if outcome.kind is OutcomeKind.OPTIMAL:
        if metrics.flowtime == metrics.flowtime_alone and plan.tours is None:
            return Phrase("proof: as fast as alone")
        objective = Phrase(outcome.objective.value)
        return Phrase("proof: optimal", objective=objective)
    if outcome.kind is OutcomeKind.BOUNDED and outcome.factor is not None:
        factor, objective = str(format_number(outcome.factor)), Phrase(outcome.objective.value)
        return Phrase("proof: factor", factor=factor, objective=objective)
    # The flowtime is shown with its own bound; surcharges count where they raise it.
    is_shown = outcome.objective is Objective.FLOWTIME or (
        outcome.objective is Objective.COST and (outcome.bound or 0) <= metrics.flowtime_alone
    )
    if outcome.kind is OutcomeKind.BEST_FOUND and outcome.bound and not is_shown:
        cost = plan.compute_value(outcome.objective)
        return Phrase(
            "proof: gap",
            gap=mark_figure(f"{cost / outcome.bound - 1:.1%}"),
            objective=Phrase(outcome.objective.value),
        )
    return ""


def list_forced_losses(plan: Plan) -> Sequence[ForcedLoss]:
    """Return why no plan is better, where this is proven of a plan; nothing of other plans."""
    is_optimal = derive_outcome(plan).kind is OutcomeKind.OPTIMAL
    return plan.run.forced_losses if is_optimal else ()


def summarize_forced_loss(scenario: Scenario, loss: ForcedLoss, quantities: Quantities) -> Phrase:
    """Return the losses of robots in every plan, or how long they need, in a few words."""
    names = join_items([scenario.robots[robot].name for robot in loss.robots])
    values = {"robots": names, "time": _write_lost_time(loss, quantities)}
    if loss.objective is not Objective.MAKESPAN:
        return Phrase("robots lose", **values)
    if len(loss.robots) == 1:
        return Phrase("robot needs", **values)
    return Phrase("robots need", **values)


def describe_forced_loss(
    scenario: Scenario, loss: ForcedLoss, quantities: Quantities, place: str
) -> Phrase:
    """Return which robots force that no plan is better, and where they would meet."""
    names = [scenario.robots[robot].name for robot in loss.robots]
    values = {"time": _write_lost_time(loss, quantities), "place": place}
    match loss.objective, names:
        case Objective.MAKESPAN, [one]:
            return Phrase("forced makespan of one", one=one, **values)
        case Objective.MAKESPAN, [one, other]:
            return Phrase(
                "forced makespan of two",
                one=one,
                other=other,
                **values,
            )
        case Objective.MAKESPAN, _:
            return Phrase(
                "forced makespan of robots",
                robots=join_items(names),
                **values,
            )
        case _, [one, other]:
            return Phrase(
                "forced loss of two",
                one=one,
                other=other,
                **values,
            )
    return Phrase(
        "forced loss of robots",
        robots=join_items(names),
        **values,
    )


def _write_lost_time(loss: ForcedLoss, quantities: Quantities) -> str:
    time = quantities.format_duration(loss.ticks)
    match loss.objective:
        case Objective.WEIGHTED:
            return Phrase("time by weight", time=time)
        case Objective.COST:
            return Phrase("time with surcharges", time=time)
    return time


def describe_improvement(improvement: Improvement, quantities: Quantities) -> Phrase:
    """Return the gain of a search over its first plan, and the number of attempts."""
    gain = Phrase("gain: none")
    if improvement.saved > 0:
        gain = Phrase("gain: time saved", time=quantities.format_duration(improvement.saved))
    attempts: Phrase = Phrase("attempts")
    if improvement.tries is not None:
        attempts = Phrase("n_attempts", number=str(improvement.tries))
    if improvement.interrupted:
        attempts = Phrase("interrupted attempts", attempts=attempts)
    return Phrase("improvement", attempts=attempts, gain=gain)


def describe_loss(words: Words, loss: Loss) -> Phrase:
    """Return how a robot loses time; the sentence goes on from its name."""
    names = {
        "other": words.name_robot(loss.for_robot),
        "here": words.name_place(loss.vertex),
        "time": words.say_time(loss.ticks),
    }
    match loss.kind:
        case "waits":
            return _wait_in_words(words, loss, names)
        case "follows":
            if loss.until_vertex == loss.vertex:
                return Phrase("follows at place", **names)
            end_place = words.name_place(loss.until_vertex)
            return Phrase("follows along way", **names, there=end_place)
        case "waits for job":
            return Phrase("waits for job", **names)
        case "makes room":
            if loss.for_robot is None:
                return Phrase("makes room", **names)
            return Phrase("makes room for", **names)


def describe_executed_loss(words: Words, loss: Loss, unplanned: int) -> Phrase:
    """Return how a robot loses time on the floor, and how much longer that was than planned."""
    text = describe_loss(words, loss)
    if unplanned <= 0:
        return text
    return Phrase("loss beyond plan", loss=text, time=words.say_time(unplanned))


def _wait_in_words(words: Words, loss: Loss, names: Mapping[str, str]) -> Phrase:
    """Return for whom a robot waits; for no robot: the places that may be closed then."""
    if loss.for_robot is not None:
        freed = words.name_place(loss.freed)
        if loss.freed == loss.towards:
            return Phrase("waits for place", **names, freed=freed)
        return Phrase(
            "waits for place further on",
            **names,
            freed=freed,
        )
    for vertices, end in words.closed:
        is_ahead = loss.towards in vertices and (len(vertices) == 1 or loss.vertex in vertices)
        if end > loss.tick and is_ahead:
            names = {**names, "way": words.name_way(vertices), "end": words.say_moment(end)}
            return Phrase("waits for closure", **names)
    if words.plan.scenario.closures:
        return Phrase(
            "waits for closure or robot",
            **names,
        )
    return Phrase("waits for nothing free", **names)


def describe_losses(words: Words, group: Sequence[Loss]) -> Phrase:
    """Return where and why a robot loses time to another one; all losses are of that pair."""
    first, number = group[0], len(group)
    names = {
        "robot": words.name_robot(first.robot),
        "other": words.name_robot(first.for_robot),
        "moment": words.say_moment(first.tick),
        "loss": describe_loss(words, first),
        "time": words.say_time(sum(loss.ticks for loss in group)),
        "number": str(number),
    }
    if number == 1:
        return Phrase("loss at moment", **names)
    if first.for_robot is None:
        return Phrase("losses", **names)
    return Phrase("losses to robot", **names)


def summarize_decision(words: Words, decision: Decision) -> tuple[Phrase, Phrase]:
    """Return who waits for whom, and when, at what loss and why, each in a line."""
    names = {
        "waits": words.name_robot(decision.waits),
        "first": words.name_robot(goes_first(decision)),
    }
    names["place"] = words.name_way(decision.vertices)
    match decision.kind:
        case "head-on":
            head = Phrase("decision: head-on", **names)
        case "following":
            head = Phrase("decision: following", **names)
        case _:
            head = Phrase("decision: waits", **names)
    cost: Phrase = Phrase("no time lost")
    if decision.ticks:
        cost = Phrase("loses time", time=words.say_time(decision.ticks))
    moment, why = words.say_moment(decision.tick), _write_why(words, decision)
    return head, Phrase("decision at moment", moment=moment, cost=cost, why=why)


REASONS: Mapping[str, Phrase] = {
    "node": Phrase("why: fewer conflicts"),
    "settled": Phrase("why: settled"),
    "priority": Phrase("why: priority"),
    "only": Phrase("why: only way"),
}
"""Why a robot goes first, by the level of a decision that looks at no times."""


def _write_why(words: Words, decision: Decision) -> Phrase:
    """Return why a robot goes first, in few words."""
    reason = REASONS.get(decision.level)
    if reason is not None:
        return reason
    if not _is_by_sum(words):
        return Phrase("why: better for both")
    if _is_tie(decision):
        return Phrase("why: tie")
    return Phrase("why: sooner in all")


def describe_decision(words: Words, decision: Decision) -> Phrase:
    """Return how two robots would have met, and which of them waits where."""
    first_name, other = map(words.name_robot, decision.robots)
    names = {
        "one": first_name,
        "other": other,
        "place": words.name_way(decision.vertices),
        "waits": words.name_robot(decision.waits),
        "first": words.name_robot(goes_first(decision)),
        "here": words.name_place(decision.waits_at),
        "time": words.say_time(decision.ticks),
    }
    match decision.kind:
        case "head-on":
            met = Phrase("met head-on", **names)
        case "following":
            met = Phrase("met following", **names)
        case "crossing":
            met = Phrase(
                "met too near",
                **names,
            )
        case _:
            met = Phrase("met at place", **names)
    how = Phrase("gives way at loss" if decision.ticks else "gives way", **names)
    return Phrase("two sentences", first=met, second=how)


def goes_first(decision: Decision) -> int:
    """Return the robot that goes first."""
    first_robot, other = decision.robots
    return first_robot if decision.waits == other else other


def _is_by_sum(words: Words) -> bool:
    """Return whether the planner chose by the sum of two completion times."""
    plan = words.plan
    has_weights = any(robot.weight != 1 for robot in plan.scenario.robots)
    return plan.run.options.get("objective", "flowtime") == "flowtime" and not has_weights


def _is_tie(decision: Decision) -> bool:
    sums = decision.completion_sums
    return decision.level == "robot" and sums is not None and sums[0] == sums[1]


def describe_reason(words: Words, decision: Decision) -> Phrase:
    """Return why the planner decided so."""
    names = {
        "waits": words.name_robot(decision.waits),
        "first": words.name_robot(goes_first(decision)),
    }
    match decision.level:
        case "node":
            return Phrase(
                "reason: node level",
                **names,
            )
        case "settled":
            return Phrase(
                "reason: settled",
                **names,
            )
        case "priority":
            return Phrase("reason: priority", **names)
        case "only":
            return Phrase(
                "reason: only way",
                **names,
            )
        case "robot":
            sums = _write_sums(words, decision, names["waits"])
            return Phrase(
                "reason: robot level",
                sums=sums,
            )


def _write_sums(words: Words, decision: Decision, waits: str) -> Phrase:
    """Return how the completion times decide, where the conflicts left are equal."""
    has_both = None not in (decision.completion_sums or ())
    if has_both and not _is_by_sum(words):
        return Phrase("sums: objective decides")
    if _is_tie(decision):
        return Phrase(
            "sums: tie",
            waits=waits,
        )
    if None in (decision.completion_sums or ()):
        return Phrase("sums: one choice", waits=waits)
    return Phrase("sums: smaller decides")


def list_figures(words: Words, decision: Decision) -> list[tuple[Phrase, str, str]]:
    """Return the compared figures: the name of each, then its value if each robot waits."""
    rows = list[tuple[Phrase, str, str]]()
    if any(count is not None for count in decision.conflicts_left):
        impossible = Phrase("impossible")
        first, other = (impossible if n is None else str(n) for n in decision.conflicts_left)
        rows.append((Phrase("figure: conflicts left"), first, other))
    if decision.completion_sums:
        no_way = Phrase("no way at all")
        first, other = (
            no_way if n is None else words.say_time(n) for n in decision.completion_sums
        )
        rows.append((Phrase("figure: sum of completion times"), first, other))
    return rows


def describe_figures(words: Words, decision: Decision) -> list[Phrase]:
    """Return the results of both choices, a sentence for each compared figure."""
    first_name, other = map(words.name_robot, decision.robots)
    return [
        Phrase(
            "figure of both choices",
            figure=figure,
            if_one=if_one,
            if_other=if_other,
            one=first_name,
            other=other,
        )
        for figure, if_one, if_other in list_figures(words, decision)
    ]


def explain_decision(words: Words, decision: Decision) -> str:
    """Return why the planner decided so, with the figures that it compared."""
    sentences = [describe_reason(words, decision), *describe_figures(words, decision)]
    return chain_items(sentences, "two sentences")


def describe_closure(closure: Closure, scenario: Scenario) -> Phrase:
    """Return the closed places, and when they are closed."""
    moment, place = Quantities.of(scenario).format_moment, PlaceNames(scenario, numbered=True)
    vertices, (begin, end) = (
        list_closed_vertices(closure, scenario),
        read_closed_ticks(closure, scenario),
    )
    values = {"begin": moment(begin)}
    if len(vertices) > 1:
        first, last = place(vertices[0]), place(vertices[-1])
        values["way"] = Phrase("first to last", first=first, last=last)
        if end is None:
            return Phrase("way closed from moment", **values)
        return Phrase("way closed until moment", **values, end=moment(end))
    if end is None:
        return Phrase("closed from moment", **values)
    return Phrase("closed until moment", **values, end=moment(end))


def list_closed_vertices(closure: Closure, scenario: Scenario) -> tuple[int, ...]:
    """Return the vertices of a closure, along a lane in order."""
    if closure.edge is None:
        return () if closure.at is None else (int(closure.at),)
    return tuple(map(int, scenario.roadmap.find_ways_along(closure.edge)[0]))


def read_closed_ticks(closure: Closure, scenario: Scenario) -> tuple[int, int | None]:
    """Return the ticks from which and until which a place is closed; None for ever."""
    tick, until = scenario.problem.clock.tick, closure.until
    return floor(closure.from_ / tick), None if until is None else ceil(until / tick)
