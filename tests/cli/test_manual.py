"""Help as a command, the manual page, the scripts for completion, and the version as JSON."""

from __future__ import annotations

import json
import shutil
import subprocess

import pytest

from rightofway import __version__
from rightofway.cli.parts import MODULES
from tests.cli.conftest import Cli


def test_help_shows_what_the_option_of_the_command_shows(cli: Cli) -> None:
    for words in ((), ("plan",), ("help",)):
        assert cli("help", *words) == cli(*words, "--help")


def test_help_of_an_unknown_command_names_it(cli: Cli) -> None:
    ended = cli("help", "paln")
    assert ended.code == 2
    assert "has no command 'paln' (`rightofway --help` shows" in ended.err


def test_the_manual_page_has_every_command_and_option(cli: Cli) -> None:
    page = cli("help", "--man").out
    assert page.startswith('.TH "RIGHTOFWAY" "1"')
    for name in MODULES:
        assert f'.SS "rightofway {name}' in page
    assert "\\-\\-time\\-limit" in page
    assert page.isascii()


def test_a_command_has_a_manual_page_of_its_own(cli: Cli) -> None:
    page = cli("help", "--man", "check").out
    assert page.startswith('.TH "RIGHTOFWAY-CHECK" "1"')
    assert ".SH COMMANDS" not in page


@pytest.mark.skipif(shutil.which("groff") is None, reason="no groff here")
def test_groff_reads_the_manual_page_without_a_warning(cli: Cli) -> None:
    page = cli("help", "--man").out
    command = ["groff", "-man", "-z", "-wall", "-W", "break"]
    printed = subprocess.run(command, input=page, text=True, capture_output=True, check=True)
    assert printed.stderr == ""


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_a_shell_gets_the_script_that_calls_the_program(cli: Cli, shell: str) -> None:
    script = cli("completion", shell).out
    assert f"_RIGHTOFWAY_COMPLETE={shell}_complete" in script


def test_the_version_as_json_has_what_a_report_of_a_defect_needs(cli: Cli) -> None:
    for words in (("--version", "--json"), ("--json", "-V")):
        version = json.loads(cli(*words).out)
        assert version["version"] == __version__
        assert set(version) == {"version", "python", "platform", "plugins"}


def test_json_without_a_command_is_refused_with_the_remedy(cli: Cli) -> None:
    ended = cli("--json")
    assert (ended.code, ended.out) == (2, "")
    assert "--json belongs to --version, or after a command" in ended.err


def test_an_option_without_a_command_is_no_command(cli: Cli) -> None:
    assert "Missing command" in cli("--debug").err
