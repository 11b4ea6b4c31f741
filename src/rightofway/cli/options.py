"""Options that several commands share, and the checks of their values before any work."""

from __future__ import annotations

import math
import stat
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rightofway.model import Scenario
    from rightofway.report.quantities import Quantities

    NumberType = click.ParamType[Fraction]
else:
    NumberType = click.ParamType  # takes no parameter in older versions of click

Callback = Callable[[click.Context, click.Parameter, Any], Any]
"""A function that click calls to check the value of an option."""


def require_writable(
    *suffixes: str, instead: dict[str, str] | None = None, stdout: bool = True
) -> Callback:
    """Return a callback that refuses, before any work, a file that cannot be written after it."""

    def check(_context: click.Context, _parameter: click.Parameter, path: str | None) -> str | None:
        if path is None or (path == "-" and stdout):
            return path
        fault = _explain_unwritable(Path(path), suffixes, instead or {})
        if fault:
            raise click.BadParameter(f"{path!r} {fault}")
        if Path(path).suffix.lower() == ".xlsx":
            from rightofway.extras import need

            need("openpyxl", "a workbook")
        return path

    return check


def _explain_unwritable(
    path: Path, suffixes: tuple[str, ...], instead: dict[str, str]
) -> str | None:
    if path.is_dir():
        return "is a directory (give a file name in it)"
    suffix = path.suffix.lower()
    if suffixes and suffix not in suffixes and not _is_device(path):
        *others, last = suffixes
        known = f"{', '.join(others)} or {last}" if others else last
        remedy = instead.get(suffix, "give a name that does")
        return f"does not end in {known} ({remedy.format(path)})"
    if not path.parent.is_dir():
        return f"cannot be written: there is no directory {str(path.parent)!r} (make it first)"
    return None


def _is_device(path: Path) -> bool:
    try:
        return not stat.S_ISREG(path.stat().st_mode)
    except (OSError, ValueError):
        return False


class Time(NumberType):
    """A time that is given as a number of time units, or of ticks."""

    name = "time"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> Fraction:
        """Return the number, exactly."""
        from rightofway.kinds.table import NOT_NEGATIVE

        try:
            return NOT_NEGATIVE.read(value)
        except ValueError as error:
            self.fail(str(error), param, ctx)


class Whole(click.IntRange):
    """A whole number from ``min`` on, up to ``max`` where there is one."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the number."""
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter:
            remedy = f"give a whole number from {self.min} to {self.max}"
            if self.max is None:
                remedy = f"give a whole number of {self.min} or more"
            self.fail(f"{value} does not fit ({remedy})", param, ctx)


def read_positive(given: str, remedy: str) -> float:
    """Return a number above 0, perhaps infinite, or refuse the value of an option."""
    try:
        number = float(given)
    except ValueError:
        raise click.BadParameter(f"{given!r} is not a number ({remedy})") from None
    if not number > 0:
        raise click.BadParameter(f"{number:g} is not positive ({remedy})")
    return number


def _read_seconds(_context: click.Context, _parameter: click.Parameter, given: str) -> float | None:
    """Return a time limit [s]; None for no limit."""
    remedy = "give seconds, or inf for no limit"
    seconds = read_positive(given, remedy)
    return None if seconds == math.inf else seconds


def _read_seed(_context: click.Context, _parameter: click.Parameter, given: str) -> int:
    from rightofway.kinds.numbers import parse_digits
    from rightofway.kinds.table import SEED

    try:
        return SEED.read(parse_digits(given))
    except ValueError as error:
        raise click.BadParameter(str(error)) from None


time_limit_option = click.option(
    "--time-limit",
    default="10",
    show_default=True,
    callback=_read_seconds,
    metavar="SECONDS",
    help="Time limit of the whole command; inf for none.",
)


seed_option = click.option(
    "--seed",
    default="0",
    show_default=True,
    callback=_read_seed,
    metavar="N",
    help="Seed of all random choices; the same seed gives the same result.",
)


ticks_option = click.option(
    "--ticks",
    "in_ticks",
    is_flag=True,
    help="Report times in ticks, as files have them.",
)


def choose_quantities(scenario: Scenario, *, in_ticks: bool = False) -> Quantities:
    """Return how a report writes times: in the scenario's units, or in ticks on request."""
    from rightofway.report.quantities import Quantities

    return replace(Quantities.of(scenario), in_ticks=in_ticks)


def as_json_option(content: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return the option that prints a result for programs."""
    return click.option("--json", "as_json", is_flag=True, help=f"Print the {content} as JSON.")


class ListingCommand(click.Command):
    """A command whose help lists the values of an option, then the examples."""

    def __init__(
        self, *args: Any, listing: Callable[[click.HelpFormatter], None], **kwargs: Any
    ) -> None:
        super().__init__(*args, **kwargs)
        self.listing = listing

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the list, then the examples."""
        self.listing(formatter)
        super().format_epilog(ctx, formatter)


def list_delays(formatter: click.HelpFormatter) -> None:
    """Write the causes of delay, for `ListingCommand`."""
    from rightofway.execution import CAUSES

    with formatter.section("Delays (times in time units; numbers may be fractions like 1/3)"):
        formatter.write_dl([example for cause in CAUSES.values() for example in cause.examples])
        formatter.write_paragraph()
        formatter.write_text("Several delays: with commas between, or a YAML or JSON list.")


def make_delays_option(default: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return the option that makes robots late."""
    return click.option("--delays", multiple=True, metavar="DELAYS",
                        help="Kinds of delays, see below; or a file with a list of them. May be"
                        f" repeated.  [default: {default}]")  # fmt: skip


def delay_texts(given: Sequence[str]) -> list[str]:
    """Return the causes of delay of the option; those of files are read."""
    from rightofway.io import DELAY_FILES, load_delays

    texts: list[str] = []
    for text in given:
        texts += load_delays(text) if text.lower().endswith(DELAY_FILES) else [text]
    return texts
