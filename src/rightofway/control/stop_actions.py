"""The actions of an item of work: those of its stop, of its place, or the usual one of the robot.

An item is done by one action or by several, which are named by numbers from 0. The entry of an
order in a journal has what each action is to do, so that it stays the same after a restart.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from rightofway.control.work_items import find_charge_step, find_stop
from rightofway.dispatch.pool import Pool
from rightofway.model import ActionUse, Job, Scenario, StopAction
from rightofway.model.actions import find_use

__all__ = [
    "USUAL",
    "ActionToDo",
    "ListActions",
    "StopActions",
    "is_further_action",
    "name_action",
    "split_action",
]

ATTEMPT_AND_STEP = re.compile(r"-([0-9]+)(?:\+([0-9]+))?$")


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionToDo:
    """An action of an item of work.

    Attributes
    ----------
    use
        The kind of the stop.
    action
        The action; None for the usual one of the robot.
    load
        The load that is picked or dropped, as parameters ``loadId`` and ``loadType``.
    """

    use: ActionUse = "work"
    action: StopAction | None = None
    load: Mapping[str, str] = field(default_factory=dict)

    def to_document(self) -> dict[str, Any]:
        """Return the action for a journal."""
        action = None if self.action is None else self.action.to_document()
        return {"use": self.use, "action": action, "load": dict(self.load)}

    @classmethod
    def of_document(cls, document: Mapping[str, Any] | None) -> ActionToDo:
        """Return an action of a journal; None is `USUAL`.

        Parameters
        ----------
        document
            The result of `to_document`.
        """
        if document is None:
            return USUAL
        action = None if document["action"] is None else StopAction(**document["action"])
        return cls(use=document["use"], action=action, load=document["load"])


USUAL = ActionToDo()
"""The usual action of the robot at a stop where the load stays as it is."""

ListActions = Callable[[int, str, str], tuple[ActionToDo, ...]]
"""Returns the actions of a robot, at a place, for an item of work; at least one."""


class StopActions:
    """Finds the actions of items by a scenario and a pool of jobs.

    Parameters
    ----------
    scenario
        The scenario of the plan.
    pool
        Jobs that became known later, and those that changed.
    """

    def __init__(self, scenario: Scenario, pool: Callable[[], Pool]) -> None:
        self._scenario, self._get_pool = scenario, pool
        self._of_place = {own.at: own for own in scenario.actions}
        self._jobs = {job.name: job for job in scenario.jobs or ()}

    def find(self, robot: int, place: str, item: str) -> tuple[ActionToDo, ...]:
        """Return the actions of an item; at least one.

        Parameters
        ----------
        robot
            The number of the robot.
        place
            The name of the vertex.
        item
            The item of work there.
        """
        if find_charge_step(item) is not None:
            return (USUAL,)
        use: ActionUse = "work"
        roadmap, load = self._scenario.roadmap, dict[str, str]()
        at = roadmap.get_original(roadmap.get_vertex(place))
        own: tuple[StopAction, ...] = ()
        job, stop = self._find_job(item)
        if job is not None:
            use, own = find_use(job.stops[stop].load), job.stops[stop].actions
            known = {"loadId": job.load_id, "loadType": job.load_type}
            load = {key: value for key, value in known.items() if value and use != "work"}
        elif find_stop(item) is None:
            stops = self._scenario.robots[robot].stops
            own = next((trip_stop.actions for trip_stop in stops if trip_stop.at == at), ())
        if not own and at in self._of_place:
            own = getattr(self._of_place[at], use)
        return tuple(ActionToDo(use=use, action=action, load=load) for action in own or (None,))

    def _find_job(self, item: str) -> tuple[Job | None, int]:
        """Return the job of an item and the number of its stop."""
        name, stop = find_stop(item) or ("", 0)
        pooled = self._get_pool().jobs.get(name)
        return (self._jobs.get(name) if pooled is None else pooled.job), stop


def name_action(item: str, attempt: int, step: int) -> str:
    """Return the end of the id of an action: of an item, an attempt and its number among several.

    A single action, and the first of several, have the number 0, which is left out.
    """
    return f"{item}-{attempt}+{step}" if step else f"{item}-{attempt}"


def is_further_action(action_id: str) -> bool:
    """Return whether an action is not the first one of its item; one of others is a first one."""
    match = ATTEMPT_AND_STEP.search(action_id)
    return match is not None and match[2] is not None


def split_action(action_id: str) -> tuple[int, int]:
    """Return the attempt and the number of an action by its id."""
    match = ATTEMPT_AND_STEP.search(action_id)
    assert match is not None, "the id of an action of ours ends with its attempt"
    return int(match[1]), int(match[2] or 0)
