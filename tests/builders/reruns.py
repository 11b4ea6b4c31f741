"""Tests that drive a browser are tried again where they fail; each is named, and few may be.

A machine that is busy elsewhere can keep a browser from answering in time. No other test is tried
again: what fails now and then there is a race in the program.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

RERUNS = 2
"""How often a test with a browser is tried again."""

MOST = 0.01
"""The part of the tests with a browser that may need it; with more, the session fails."""

BROWSER = "browser"
"""The fixture that gives a browser; a test has it itself or by another fixture."""


def drives_browser(item: pytest.Item) -> bool:
    """Whether a test drives a browser."""
    return BROWSER in getattr(item, "fixturenames", ())


class Reruns:
    """Counts tests with a browser, and those of them that were tried again.

    With xdist, the process that reports counts those of all workers.
    """

    def __init__(self) -> None:
        self._tests = set[str]()
        self._again = dict[str, int]()

    @pytest.hookimpl(tryfirst=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Have tests with a browser tried again; their reports bring a mark to whoever counts."""
        for item in filter(drives_browser, items):
            item.user_properties.append((BROWSER, True))
            if item.config.pluginmanager.hasplugin("rerunfailures"):
                item.add_marker(pytest.mark.flaky(reruns=RERUNS))

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Count a test with a browser once, and each time that it was tried again."""
        if (BROWSER, True) not in map(tuple, report.user_properties):
            return
        self._tests.add(report.nodeid)
        if report.outcome == "rerun":  # type: ignore[comparison-overlap]  # pytest-rerunfailures' own
            self._again[report.nodeid] = self._again.get(report.nodeid, 0) + 1

    @property
    def are_too_many(self) -> bool:
        """Whether more tests were tried again than may be."""
        return len(self._again) > MOST * len(self._tests)

    @pytest.hookimpl(trylast=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Fail a session with too many; a worker of xdist does not judge its share."""
        if hasattr(session.config, "workerinput") or not self.are_too_many:
            return
        if session.exitstatus == pytest.ExitCode.OK:
            session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Name each test that was tried again."""
        if not self._again:
            return
        terminalreporter.section("tests with a browser that were tried again")
        for line in self._lines():
            terminalreporter.line(line)

    def _lines(self) -> Iterator[str]:
        for test, times in sorted(self._again.items()):
            yield f"{test}: {times} of {RERUNS} times"
        share = f"{len(self._again)} of {len(self._tests)} tests with a browser"
        if self.are_too_many:
            yield f"FAILED: {share} were tried again, more than {MOST:.0%} (mend their races)"
        else:
            yield f"{share} were tried again"


def pytest_configure(config: pytest.Config) -> None:
    """Count in each session of its own."""
    config.pluginmanager.register(Reruns(), "browser-reruns")
