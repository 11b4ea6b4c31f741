"""The page of a fleet that is driven: its options, and its server beside a command."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.options import Whole
from rightofway.cli.parts import load_page_server
from rightofway.cli.terminal import complain
from rightofway.errors import InputError
from rightofway.files import write_whole

if TYPE_CHECKING:
    from rightofway.model import Plan


def add_page_options(command: Any) -> Any:
    """Add the options that say where the page is served."""
    for option in reversed(
        (
            click.option("--host", default="127.0.0.1", show_default=True, metavar="ADDRESS",
                         help="Address on which the page of --live or --replay and --metrics"
                         " listen. Other machines need the token in the printed address of the"
                         " page."),
            click.option("--port", type=Whole(1, 65535), metavar="PORT",
                         help="Port of the page; a free one by default."),
        )
    ):  # fmt: skip
        command = option(command)
    return command


@dataclass(frozen=True, slots=True, kw_only=True)
class WatchPage:
    """The page on which people watch robots that drive a plan.

    Attributes
    ----------
    plan
        The plan.
    title
        The subject of the page.
    host, port
        Where it is served.
    """

    plan: Plan
    title: str
    host: str
    port: int | None

    @contextmanager
    def serve(self, journal: Path, *, takes_orders: bool) -> Iterator[None]:
        """Serve the page of a journal as long as the context lasts."""
        self.require_packages("--live" if takes_orders else "--replay")
        server = load_page_server()
        watched = server.Watched(
            self.plan, journal, title=self.title, address="/drives/0/", takes_orders=takes_orders
        )
        with server.serve_watch(watched, host=self.host, port=self.port, say=complain):
            yield

    def write(self, journal: Path, path: str) -> None:
        """Write the page of all that a journal has, as one file."""
        self.require_packages("--replay")
        watched = load_page_server().Watched(
            self.plan, journal, title=self.title, takes_orders=False
        )
        write_whole(path, watched.make_page(is_whole=True))

    @staticmethod
    def require_packages(option: str) -> None:
        """Refuse an option whose packages are not installed."""
        if not (find_spec("fastapi") and find_spec("uvicorn")):
            message = "needs packages that are not installed (pip install 'rightofway[studio]')"
            raise InputError.at(option, message)

    def wait_for_interrupt(self) -> None:
        """Go on until Ctrl-C."""
        complain("the page stays until Ctrl-C")
        with suppress(KeyboardInterrupt):
            while True:
                time.sleep(3600)
