"""Outputs of a drive: its report and its page."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from rightofway.cli.terminal import put_json, put_report

if TYPE_CHECKING:
    from rightofway.control.command_line.watch import WatchPage
    from rightofway.execution.drive_result import DriveResult
    from rightofway.report.quantities import Quantities


@dataclass(frozen=True, slots=True, kw_only=True)
class Output:
    """Outputs of a run: its report and its page."""

    page: str | None
    shown: WatchPage
    is_live: bool
    quantities: Quantities
    as_json: bool

    def report(self, result: DriveResult, **details: int) -> None:
        """Print the result of a run; details are for programs."""
        if self.as_json:
            from rightofway.report.plan_data import describe_measures

            put_json({**describe_measures(result.plan.scenario), **details, **result.as_dict()})
        else:
            from rightofway.report.driving import report_drive

            put_report(report_drive(result, self.quantities))
