"""The dispatcher: what there is to do, for robots that drive.

A control asks its dispatcher after whatever comes in, and gets more to release where something is
due. A dispatcher keeps nothing that is not in the journal.
"""

from __future__ import annotations

from rightofway.control.fleet_control import FleetControl
from rightofway.control.laps import LapsToDrive, graph_behind_released
from rightofway.control.ledger import Ledger
from rightofway.control.messages import Message
from rightofway.control.routes import routes_to_drive
from rightofway.model import Plan
from rightofway.precedence import ReleaseGraph

__all__ = ["Dispatcher"]


class Dispatcher:
    """The work of robots that a control releases.

    Parameters
    ----------
    control
        The control, with an empty journal or that of an earlier start.
    plan
        The plan with which the journal begins.
    laps
        What robots repeat for ever; None where they drive the plan once.
    """

    def __init__(self, control: FleetControl, plan: Plan, laps: LapsToDrive | None = None) -> None:
        self.control, self.plan, self._laps = control, plan, laps
        control.dispatch = self._dispatch

    @property
    def ledger(self) -> Ledger:
        """What the journal says."""
        return self.control.ledger

    @property
    def is_endless(self) -> bool:
        """Whether robots repeat laps for ever."""
        return self._laps is not None

    def begin(self, run: str) -> None:
        """Give an empty journal the plan.

        Parameters
        ----------
        run
            A name that no other journal has.

        Raises
        ------
        InputError
            If robots of the plan move round a circle at one instant.
        """
        graph = ReleaseGraph.of(self.plan.scenario, self.plan.tracks)
        names = [robot.name for robot in self.plan.scenario.robots]
        self.control.begin(run, routes_to_drive(self.plan), graph, names)

    def _dispatch(self) -> list[Message]:
        """Add laps where robots come to the end of theirs."""
        routes = self._laps.extended(self.ledger.robots) if self._laps else None
        if routes is None:
            return []
        graph = graph_behind_released(self.plan.scenario, routes, self.control.committed())
        return self.control.splice(routes, graph)
