"""Questions about a plan: why a robot waits, and how the plan would be if it went first."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from rightofway.check import check
from rightofway.errors import InputError, InvalidPlan, find_nearest
from rightofway.io import format_plan
from rightofway.metrics import compute_lost_time
from rightofway.model import Loss, Plan, Status, Tick
from rightofway.repair.flip import flip_right_of_way
from rightofway.report.facts import pack_note
from rightofway.report.phrases import Phrase, to_parts
from rightofway.report.quantities import Quantities
from rightofway.report.sentences import Words, describe_decision, describe_losses, explain_decision
from rightofway.studio.messages import Blobs, Emit, zip_text
from rightofway.studio.tasks.documents import compute_figures
from rightofway.studio.tasks.views import read
from rightofway.viz.page.document import as_compact_json
from rightofway.viz.table.groups import make_decision_table

Result = tuple[Any, ...]


def explain_losses(_emit: Emit, blobs: Blobs, *, robot: str | None = None) -> Result:
    """Return each cause of lost time in a sentence, with the decisions that it follows from."""
    plan = read(blobs[0])
    words = Words(plan=plan, quantities=Quantities.of(plan.scenario))
    wanted = None if robot is None else _index(plan, "robot", robot)
    answers = [
        _make_loss(words, loss)
        for lost in compute_lost_time(plan)
        if wanted in {None, lost.robot}
        for loss in lost.losses
    ]
    return (None, zip_text(as_compact_json({"losses": answers})))


MOST_COLUMNS = 500
"""Columns of a table of movement groups; a longer one has longer steps, or changes only."""


def show_groups(_emit: Emit, blobs: Blobs, *, decision: int) -> Result:
    """Return both movement groups of a decision as a table, with their sums in sentences."""
    groups = make_decision_table(read(blobs[0]), decision)
    table = groups.table
    if len(table.ticks) > MOST_COLUMNS:
        shorter = table.keep_changes(), table.limit_columns(MOST_COLUMNS)
        table = min(shorter, key=lambda choice: len(choice.ticks))
    rows = [
        {
            "robot": row.robot,
            "kind": row.kind,
            "places": [str(cell.place) for cell in cells],
            "marks": [cell.mark for cell in cells],
        }
        for row in table.rows
        for cells in [row.list_cells_at(table.ticks, table.step)]
    ]
    data = {
        "heading": table.heading,
        "times": list(map(table.describe_time, table.ticks)),
        "rows": rows,
        "sums": list(map(to_parts, groups.sums)),
    }
    return (None, zip_text(as_compact_json(data)))


def _make_loss(words: Words, loss: Loss) -> dict[str, Any]:
    name = words.plan.scenario.roadmap.name
    because = [
        {
            "index": index,
            "decision": (story := describe_decision(words, words.plan.run.decisions[index])),
            "reason": (reason := explain_decision(words, words.plan.run.decisions[index])),
            "phrase": to_parts(Phrase("two sentences", first=story, second=reason)),
        }
        for index in _list_decisions_behind(words.plan, loss)
    ]
    return {
        "kind": loss.kind,
        "robot": words.name_robot(loss.robot),
        "for": words.name_robot(loss.for_robot) or None,
        "vertex": name(loss.vertex),
        "towards": name(loss.towards),
        "freed": None if loss.freed is None else name(loss.freed),
        "tick": loss.tick,
        "end": loss.end,
        "ticks": loss.ticks,
        "sentence": (sentence := describe_losses(words, [loss])),
        "phrase": to_parts(sentence),
        "because": because,
    }


def _list_decisions_behind(plan: Plan, loss: Loss) -> list[int]:
    """Return by index the decisions that a loss follows from, in order; none where none is kept.

    That is the last decision on both robots at a place of the loss, and decisions of the same wait
    (also for other robots) whose ticks are the rest of the loss.
    """
    places = {loss.vertex, loss.towards, loss.freed}
    pair = {loss.robot, loss.for_robot}
    own = [
        (index, decision)
        for index, decision in reversed([*enumerate(plan.run.decisions)])
        if decision.waits == loss.robot
    ]
    last = next(
        (
            (index, decision)
            for index, decision in own
            if set(decision.robots) == pair and places.intersection(decision.vertices)
        ),
        None,
    )
    if last is None:
        return []
    behind, rest = [last[0]], loss.ticks - last[1].ticks
    for index, decision in own:
        of_same_wait = index != last[0] and decision.waits_at == last[1].waits_at
        if of_same_wait and 0 < decision.ticks <= rest:
            behind.append(index)
            rest -= decision.ticks
    return sorted(behind)


def flip(
    _emit: Emit, blobs: Blobs, *, waits: str, goes_first: str, tick: int, time_limit: float
) -> Result:
    """Return the plan in which a robot that waits goes first, judged, and its costs."""
    plan = read(blobs[0])
    pair = _index(plan, "waits", waits), _index(plan, "goes_first", goes_first)
    answer = flip_right_of_way(plan, *pair, Tick(tick), time_limit=time_limit)
    kind = "reversed" if answer.keeps_routes else "reversed and replanned"
    status = Status(kind, waits=waits, goes_first=goes_first)
    run = replace(plan.run, status=status, seconds=None, decisions=())
    flipped_plan = Plan(scenario=plan.scenario, tracks=answer.tracks, run=run)
    report = check(flipped_plan)
    if not report.ok:
        raise InvalidPlan(f"a flipped right of way made a plan with {report}")
    result = {
        "figures": compute_figures(flipped_plan),
        "before": compute_figures(plan),
        "status": pack_note(status),
    }
    return (result, format_plan(flipped_plan).encode())


def _index(plan: Plan, place: str, name: str) -> int:
    names = [robot.name for robot in plan.scenario.robots]
    if name not in names:
        near = find_nearest(name, names)
        hint = f"did you mean {near!r}?" if near else "name one of the scenario's robots"
        raise InputError.at(place, f"no robot is named {name!r} ({hint})")
    return names.index(name)
