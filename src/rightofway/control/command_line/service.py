"""A control at a broker as a process: its signals, its log, its health and its last words."""

from __future__ import annotations

import asyncio
import gc
import signal
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rightofway.cli.terminal import say_written
from rightofway.control.broker import Broker
from rightofway.control.command_line.event_log import EventLog
from rightofway.control.command_line.output import Output
from rightofway.control.commands import Commands
from rightofway.control.driver import Driver
from rightofway.control.identities import Identity
from rightofway.control.journal import SqliteJournal
from rightofway.errors import name_file
from rightofway.facts import Fact

if TYPE_CHECKING:
    from rightofway.control.metrics import FleetMetrics

INTERRUPTED = 130
"""Exit code of robots at a broker after Ctrl-C; after SIGTERM it is 0."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Service:
    """A control at a broker, and all that it has on this machine.

    Attributes
    ----------
    broker
        Where robots are.
    identities
        The robots, in the order of the plan.
    journal
        The file of the journal.
    output
        The plan with its page, and where the report goes.
    log
        Receives events.
    metrics, host
        The port and the address at which metrics and health are served; None for none.
    off
        Robots that are off the floor when a new journal begins.
    holds
        Whether all robots are on hold when a new journal begins.
    look_ahead
        The largest number of edges that are released ahead of a robot.
    """

    broker: Broker
    identities: Sequence[Identity]
    journal: Path
    output: Output
    log: EventLog
    metrics: int | None
    host: str
    off: Sequence[str]
    holds: bool
    look_ahead: int

    def drive(self, *, laps: int | None, switch: bool, stays: bool) -> int:
        """Drive the plan, and report; return the exit code."""
        shown, log, counted = self.output.shown, self.log, self._make_metrics()
        if self.output.page:
            shown.require_packages("--page")
        with ExitStack() as stack:
            with closing(SqliteJournal(self.journal)) as opened:
                began, commands = opened.read_begin(), Commands(self.journal)
                if began is None:
                    self._ask_at_begin(commands)
                with name_file(str(self.journal)):
                    driver = Driver(
                        shown.plan,
                        self.identities,
                        opened,
                        laps=laps,
                        commands=commands,
                        switch=switch,
                        report=log.inform,
                        alarm=log.warn,
                        watch=log.trace if log.has_messages else None,
                        metrics=counted,
                        began=began,
                        look_ahead=self.look_ahead,
                    )
                if counted is not None and self.metrics is not None:
                    counted.serve(self.metrics, self.host, driver.report_health)
                if self.output.is_live:
                    stack.enter_context(shown.serve(self.journal, takes_orders=True))
                gc.freeze()  # what lives as long as the control: a look through it takes 100 ms
                code = _run(driver, self.broker, stays=stays)
            if code:
                log.inform(Fact("run interrupted"))
            elif not driver.is_stopped:
                log.inform(Fact("all at end"))
            self.output.report(driver.result)
            if self.output.page:
                shown.write(self.journal, self.output.page)
                say_written(self.output.page)
            if self.output.is_live and not code and not driver.is_stopped:
                shown.wait_for_interrupt()
        return code

    def _make_metrics(self) -> FleetMetrics | None:
        if self.metrics is None:
            return None
        from rightofway.control.metrics import FleetMetrics

        return FleetMetrics([robot.name for robot in self.output.shown.plan.scenario.robots])

    def _ask_at_begin(self, commands: Commands) -> None:
        """Give the commands with which a new journal begins."""
        if self.holds:
            commands.ask({"kind": "hold"})
        for name in self.off:
            commands.ask({"kind": "remove", "name": name})


def _run(driver: Driver, broker: Broker, *, stays: bool) -> int:
    """Drive until the end, until Ctrl-C or until SIGTERM; return the exit code."""
    try:
        asyncio.run(_drive(driver, broker, stays=stays))
    except KeyboardInterrupt:
        return INTERRUPTED
    return 0


async def _drive(driver: Driver, broker: Broker, *, stays: bool) -> None:
    with _stop_at_signal(driver):
        await driver.run(broker, stays=stays)


@contextmanager
def _stop_at_signal(driver: Driver) -> Iterator[None]:
    """Have SIGTERM end the run in order, as long as the context lasts."""
    loop = asyncio.get_running_loop()

    def stop(_number: int, _frame: object) -> None:
        loop.call_soon_threadsafe(driver.stop)

    before = signal.signal(signal.SIGTERM, stop)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)
