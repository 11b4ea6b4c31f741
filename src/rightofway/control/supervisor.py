"""What a control does on its own and for people: passes stuck robots, carries out commands.

A control at a broker and one of simulated robots share it; each calls it at its own pace.
"""

from __future__ import annotations

from rightofway.control.commands import Answer, Commands, say_answer
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.messages import Message
from rightofway.control.notices import Notices
from rightofway.control.operator import Operator

__all__ = ["Supervisor"]

PLAN = "plan"
"""The kind of trouble that no plan of the rest is found."""


class Supervisor:
    """The supervision of robots that drive.

    Parameters
    ----------
    dispatcher
        The work of robots.
    notices
        What people are told.
    commands
        Where people ask for more: jobs, closures, holds; None where nobody can.

    Attributes
    ----------
    operator
        Carries out the commands.
    """

    def __init__(
        self, dispatcher: Dispatcher, notices: Notices, commands: Commands | None = None
    ) -> None:
        self._dispatcher, self._notices, self._commands = dispatcher, notices, commands
        self.operator = Operator(dispatcher)
        self._answers: list[tuple[int, Answer]] = []  # to commands, once all is on the disk
        dispatcher.report = self._report_replanning

    def _report_replanning(self, sentence: str, is_over: bool) -> None:
        self._notices.report(sentence, PLAN, is_over=is_over)

    def pass_stuck_robots(self) -> list[Message]:
        """Return what is to be sent because robots do not go on; call it every second."""
        return self._dispatcher.pass_stuck()

    def obey(self) -> list[Message]:
        """Carry out what people have asked for; return what is to be sent."""
        if self._commands is None:
            return []
        messages, answers = self.operator.obey(self._commands)
        self._answers += answers
        for _, answer in answers:
            if text := say_answer(answer):
                self._notices.report(text)
        return messages

    def answer(self) -> None:
        """Answer the commands that were carried out; call it when all of that is on the disk."""
        for number, answer in self._answers:
            assert self._commands is not None
            self._commands.answer(number, answer)
        self._answers = []

    @property
    def has_answers(self) -> bool:
        """Whether commands were carried out that are not answered yet."""
        return bool(self._answers)
