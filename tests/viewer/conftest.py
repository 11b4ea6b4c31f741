"""Opens pages in a headless Chromium; without one, these tests are not collected."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from rightofway.dispatch import ShiftRecord
from rightofway.errors import NoPlanExists
from rightofway.model import ExecutionTrace, Plan, SteadyState
from rightofway.viz import Background, write_page, write_shift_page
from tests.builders.browsers import CHROMIUM
from tests.builders.players import Player

if TYPE_CHECKING:
    from playwright.sync_api import Browser

collect_ignore_glob = [] if CHROMIUM else ["test_*.py"]

Opener = Callable[..., Player]


@contextmanager
def pages(browser: Browser, directory: Path) -> Iterator[Opener]:
    """Yield a function that opens the page of a plan or a shift.

    It is still unless ``reduced_motion`` says no.
    """
    contexts = []

    def open_page(
        plan: Plan | ShiftRecord,
        fragment: str = "",
        *,
        steady: Sequence[SteadyState] = (),
        actual: ExecutionTrace | None = None,
        no_plan: NoPlanExists | None = None,
        background: Background | None = None,
        title: str = "",
        others: Sequence[tuple[Plan, str]] = (),
        **context: Any,
    ) -> Player:
        path = directory / "plan.html"
        if isinstance(plan, ShiftRecord):
            write_shift_page(plan, path, title=title)
        else:
            write_page(
                plan,
                path,
                steady=steady,
                actual=actual,
                no_plan=no_plan,
                background=background,
                title=title,
                others=others,
            )
        contexts.append(browser.new_context(**{"reduced_motion": "reduce", **context}))
        viewer = Player(contexts[-1].new_page())
        viewer.page.goto(f"{path.as_uri()}{fragment}")
        viewer.painted()
        viewer.requests = [url for url in viewer.requests if not url.startswith(path.as_uri())]
        return viewer

    yield open_page
    for context in contexts:
        context.close()


@pytest.fixture
def show(browser: Browser, tmp_path: Path) -> Iterator[Opener]:
    with pages(browser, tmp_path) as open_page:
        yield open_page


def pixel(viewer: Player, canvas: str, x: float, y: float) -> list[int]:
    """Return a colour as red, green, blue, opacity."""
    return list(viewer.pixel(canvas, x, y))
