"""The rounds of a control: it keeps closures, passes stuck robots, obeys commands.

A control at a broker and one of simulated robots share it; each calls it at its own pace.
"""

from __future__ import annotations

from collections.abc import Callable

from rightofway.control.battery_watch import BatteryWatch
from rightofway.control.commands import Answer, Commands, CommandsFailed
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.joins import Joins
from rightofway.control.messages import Message
from rightofway.control.notices import Notices
from rightofway.control.operator import Operator
from rightofway.control.standstill import Standstill
from rightofway.facts import Fact, read_fact
from rightofway.model import NEVER
from rightofway.precedence import Part

__all__ = ["Supervisor"]

PLAN, COMMANDS = "plan", "commands"
"""The kind of trouble that no plan of the rest is found."""


class Supervisor:
    """The supervision of robots that drive.

    Parameters
    ----------
    dispatcher
        The work of robots.
    notices
        Receives facts for people.
    read_ticks
        Returns the time since the run began [ticks].
    commands
        Where people ask for more: jobs, closures, holds; None where nobody can.
    joins
        The robots that join; None where none can.

    Attributes
    ----------
    operator
        Carries out the commands.
    """

    def __init__(
        self,
        dispatcher: Dispatcher,
        notices: Notices,
        read_ticks: Callable[[], int],
        commands: Commands | None = None,
        joins: Joins | None = None,
    ) -> None:
        self._dispatcher, self._notices, self._commands = dispatcher, notices, commands
        self._joins = joins
        self.operator = Operator(dispatcher, joins)
        self._answers: list[tuple[int, Answer]] = []  # to commands, once all is on the disk
        self._has_lost_commands = False  # their file could not be used
        self._told = dict[int, int]()  # of each robot, the last part that a closure kept it from
        self._standstill = Standstill(dispatcher, notices, read_ticks)
        scenario, control = dispatcher.plan.scenario, dispatcher.control
        self._batteries = BatteryWatch(scenario, control, notices) if scenario.batteries else None
        dispatcher.report = self._report_replanning
        if dispatcher.rounds is not None:
            dispatcher.rounds.tell = notices.report
        dispatcher.keep_time(read_ticks)

    def _report_replanning(self, fact: Fact | None, is_over: bool) -> None:
        self._notices.report(fact, PLAN, is_over=is_over)

    def take_turn(self) -> list[Message]:
        """Return the messages to send because time has passed; call it every second."""
        if self._batteries is not None:
            self._batteries.look()
        messages = [*self._dispatcher.follow_time(), *self._dispatcher.pass_stuck()]
        if self._joins is not None:
            messages += self._joins.look(self._notices)
        self.tell_closures()
        self._standstill.look()
        self._notices.settle()
        return messages

    def tell_closures(self) -> None:
        """Report robots that nothing keeps from going on but closures of the scenario."""
        if self._dispatcher.closures is None:
            return
        ledger = self._dispatcher.ledger
        for robot, own in enumerate(ledger.robots):
            part, route = own.released + 1, own.route
            is_at_end = own.arrived == own.released and own.finished.issuperset(
                route.get_jobs(own.arrived)
            )
            if part == route.end or own.is_off or not is_at_end or self._told.get(robot) == part:
                continue
            if not ledger.graph.may_go(Part(robot, part), ledger.arrived):
                continue
            if (closed := self._dispatcher.find_closed(robot, part)) is None:
                continue
            self._told[robot] = part
            ends = {} if closed.end == NEVER else {"end": closed.end}
            fact = Fact(
                "waits for opening" if ends else "waits for good",
                place=route.get_place(own.arrived),
                head=route.get_place(part),
                begin=closed.begin,
                about=self._dispatcher.plan.scenario,
                **ends,
            )
            self._notices.report_on(robot, fact)

    def obey(self) -> list[Message]:
        """Carry out the commands of people; return the messages to send."""
        if self._commands is None:
            return []
        try:
            messages, answers = self.operator.obey(self._commands)
        except CommandsFailed as error:
            self._report_lost_commands(error)
            return []
        if self._has_lost_commands:
            self._notices.report(Fact("commands read"), COMMANDS, is_over=True)
        self._has_lost_commands = False
        self._answers += answers
        for _, answer in answers:
            if answer["fact"]:
                self._notices.report(read_fact(answer["fact"]))
        return messages

    def answer(self) -> None:
        """Answer the commands that were carried out; call it when all of that is on the disk."""
        answers, self._answers = self._answers, []
        for number, answer in answers:
            assert self._commands is not None
            try:
                self._commands.answer(number, answer)
            except CommandsFailed as error:  # `obey` answers again what it finds unanswered
                self._report_lost_commands(error)
                return

    def _report_lost_commands(self, error: CommandsFailed) -> None:
        """Report once that nobody can command; robots go on."""
        if not self._has_lost_commands:
            self._notices.report(Fact("commands lost", error=str(error)), COMMANDS)
        self._has_lost_commands = True

    @property
    def has_answers(self) -> bool:
        """Whether commands were carried out that are not answered yet."""
        return bool(self._answers)
