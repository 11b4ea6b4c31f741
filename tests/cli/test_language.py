"""The language of reports and messages: by an option of each command, or by the environment."""

from __future__ import annotations

import pytest

from rightofway.languages import find_languages
from tests.cli.conftest import EXAMPLES, Cli


def test_the_option_or_the_environment_names_the_language(
    cli: Cli, monkeypatch: pytest.MonkeyPatch
) -> None:
    scenario = EXAMPLES / "door.yaml"
    asked = cli("plan", scenario, "--language", "de").out
    monkeypatch.setenv("RIGHTOFWAY_LANGUAGE", "de")
    assert "Zeitverlust" in asked
    assert "Zeitverlust" in cli("plan", scenario).out
    assert "lost time" in cli("plan", scenario, "--language", "en").out


def test_a_language_that_is_not_known_is_refused_with_those_that_are(cli: Cli) -> None:
    ended = cli("--language", "xx", "examples")
    assert ended.code == 2
    assert f"'xx' is not a known language (give en or {' or '.join(find_languages())})" in ended.err
