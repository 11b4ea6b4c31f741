"""Lanes: plain ``pytest`` runs the quick one, CI ``slow`` as well, ``just nightly`` the rest."""

from __future__ import annotations

import gc
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.builders.browsers import chromium

pytest_plugins = ["tests.builders.laws", "tests.builders.reruns"]

if TYPE_CHECKING:
    from playwright.sync_api import Browser

TESTS = Path(__file__).parent

SLOW = (
    "bench/test_results.py",  # thousands of cut files
    "benchmarks/",  # scripts that measure
    "campaigns/",  # processes on all cores
    "cli/test_bench.py",  # a process for each case of a suite
    "cli/test_bench_cluster.py",  # starts a Dask cluster
    "cli/test_large_numbers.py",  # hundreds of runs of commands
    "cli/test_process.py",  # starts the command as a process, and interrupts it
    "conformance/test_execution.py",  # hundreds of runs for each planner and scenario
    "conformance/test_samples.py",  # plans on 36 real layouts
    "control/test_chaos.py",  # five runs of each kind, and of each broken wording
    "control/test_chaos_jobs.py",  # runs of each kind, with a plan for each round
    "control/test_jobs_at_broker.py",  # a broker, and processes that are killed
    "control/test_standstill.py",  # a hundred fleets
    "laws/test_best_timetable.py",
    "laws/test_fixed_routes.py",  # the optimum of each planner's routes
    "laws/test_io_fuzz.py",
    "laws/test_time_limits.py",
    "planners/test_limits.py",  # limits of time, and interrupts
    "planners/test_passing.py",  # every planner on every site with passed vertices
    "repair/test_flip.py",  # plans of all flips
    "studio/test_accessibility.py",  # a browser
    "studio/test_attacks.py",  # thousands of requests
    "studio/test_beginning.py",  # a browser
    "studio/test_bombs.py",  # a studio, and a browser
    "studio/test_drives.py",  # a process for each drive
    "studio/test_connection.py",  # a browser, and processes that are killed
    "studio/test_documents.py",  # a process for each studio
    "studio/test_drawing.py",  # a browser
    "studio/test_editing.py",  # a browser
    "studio/test_faulty_plans.py",  # a browser
    "studio/test_guard.py",  # bodies of 100 MB
    "studio/test_jobs.py",  # a browser
    "studio/test_languages.py",  # a browser
    "studio/test_page.py",  # a browser
    "studio/test_plans_page.py",  # a browser
    "studio/test_robots_table.py",  # a browser
    "studio/test_runs.py",  # plans
    "studio/test_sizes.py",  # a browser
    "studio/test_store.py",  # studios that start and stop
    "studio/test_stories.py",  # a browser
    "studio/test_streams.py",  # a browser
    "studio/test_studies_page.py",  # a browser
    "studio/test_survival.py",  # starts the command as a process, and kills it
    "studio/test_what_if.py",  # a browser
    "studio/test_worker.py",  # starts processes
    "test_reruns.py",  # pytest within pytest
    "viewer/",  # a browser
    "viz/test_spreadsheet.py",  # LibreOffice
)
"""Files and folders of the slow lane: what takes more than about four seconds."""


NIGHTLY = (
    "studio/test_accessibility.py",  # twelve states, two themes, two languages
    "viewer/test_large_fleet.py",  # a thousand robots
)
"""Files that CI leaves out, with the tests that are marked so."""


QUICK = "not slow and not nightly"
"""The expression that `pyproject.toml` gives to plain ``pytest``."""


def files_of(lane: Iterable[str]) -> set[Path]:
    """Return the test files of a lane."""
    named = (TESTS / name for name in lane)
    return {
        file for path in named for file in (path.rglob("test_*.py") if path.is_dir() else [path])
    }


SLOW_FILES, NIGHTLY_FILES = files_of(SLOW), files_of(NIGHTLY)


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Have the quick lane import no file that has nothing for it, but count what is asked for."""
    if config.option.markexpr != QUICK or any(".py" in argument for argument in config.args):
        return None
    return collection_path in SLOW_FILES | NIGHTLY_FILES or None  # None: others decide


def pytest_collection_finish() -> None:
    """Have later collections of garbage leave out what lives to the end: thousands of tests."""
    gc.collect()
    gc.freeze()


def pytest_sessionfinish() -> None:
    """Have Python free all at its end: nanobind reports what is left."""
    gc.unfreeze()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the tests of the lanes, before any are deselected."""
    for item in items:
        if item.path in SLOW_FILES:
            item.add_marker(pytest.mark.slow)
        if item.path in NIGHTLY_FILES:
            item.add_marker(pytest.mark.nightly)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Return a headless browser; while it runs, its process can run no other event loop."""
    with chromium() as browser:
        yield browser
