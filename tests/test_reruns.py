"""Only tests that drive a browser are tried again; each is named, and too many fail the session."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest_plugins = ["pytester"]

ROOT = Path(__file__).parents[1]

TESTS = """
import pytest

@pytest.fixture
def browser():
    return "browser"

@pytest.fixture
def page(browser):
    return browser

tries = []

def test_page_that_is_late_once(page):
    tries.append(page)
    assert len(tries) > 1

@pytest.mark.parametrize("number", range({good}))
def test_page(page, number):
    pass

times = []

def test_server_with_a_race():
    times.append(1)
    assert {sound} or len(times) > 1
"""


@pytest.fixture
def session(pytester: pytest.Pytester) -> pytest.Pytester:
    """Return a folder of tests with the plugin, as conftest has it."""
    pytest.importorskip("pytest_rerunfailures")
    pytester.makeconftest(
        f"import sys\nsys.path.insert(0, {str(ROOT)!r})\npytest_plugins = ['tests.builders.reruns']"
    )
    return pytester


def outcome(session: pytest.Pytester, *options: str, good: int, sound: bool) -> pytest.RunResult:
    """Run the tests in a process of their own: one page late, some good ones, and a server."""
    session.makepyfile(TESTS.format(good=good, sound=sound))
    return session.runpytest_subprocess("-p", "no:cacheprovider", *options)


@pytest.mark.parametrize("options", [(), ("-n", "2")])
def test_a_test_with_a_browser_is_tried_again_and_named(
    session: pytest.Pytester, options: tuple[str, ...]
) -> None:
    """1 of 100 is 1 %, which may be."""
    result = outcome(session, *options, good=99, sound=True)
    assert result.parseoutcomes() == {"passed": 101, "rerun": 1}
    result.stdout.fnmatch_lines(
        [
            "*::test_page_that_is_late_once: 1 of 2 times",
            "1 of 100 tests with a browser were tried again",
        ]
    )
    assert result.ret == pytest.ExitCode.OK


@pytest.mark.parametrize("options", [(), ("-n", "2")])
def test_a_session_in_which_more_than_one_percent_were_tried_again_fails(
    session: pytest.Pytester, options: tuple[str, ...]
) -> None:
    """1 of 99 is more than 1 %."""
    result = outcome(session, *options, good=98, sound=True)
    result.stdout.fnmatch_lines(
        ["FAILED: 1 of 99 tests with a browser were tried again, more than 1% (mend their races)"]
    )
    assert result.ret == pytest.ExitCode.TESTS_FAILED


def test_a_race_without_a_browser_fails_at_once(session: pytest.Pytester) -> None:
    result = outcome(session, good=99, sound=False)
    result.stdout.fnmatch_lines(["FAILED *::test_server_with_a_race*"])
    assert result.ret == pytest.ExitCode.TESTS_FAILED


def test_the_tests_of_this_project_are_counted(request: pytest.FixtureRequest) -> None:
    assert request.config.pluginmanager.hasplugin("browser-reruns")
