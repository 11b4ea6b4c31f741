"""The command: its address, its folder, and what it needs."""

from __future__ import annotations

import socket
from pathlib import Path

import pytest
from click.testing import CliRunner

from rightofway.cli.main import commands, run
from rightofway.errors import InputError
from rightofway.studio.guard import Access, is_loopback
from rightofway.studio.serve import bound, folder_and_file


def test_without_the_extra_it_says_how_to_install_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("rightofway.cli.studio.find_spec", lambda _: None)
    assert run(["studio"]) == 2
    assert "pip install 'rightofway[studio]'" in capsys.readouterr().err


def test_a_path_that_is_not_there_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["studio", "nowhere.yaml", "--no-browser"]) == 2
    assert "nowhere.yaml: there is no such file or folder" in capsys.readouterr().err


def test_a_file_is_opened_in_its_folder(tmp_path: Path) -> None:
    (tmp_path / "door.yaml").touch()
    assert folder_and_file(tmp_path / "door.yaml") == (tmp_path, "door.yaml")
    assert folder_and_file(tmp_path) == (tmp_path, None)


def test_a_port_that_is_taken_is_refused_and_a_free_one_is_found_by_itself() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        with pytest.raises(InputError, match="cannot be listened on"):
            bound("127.0.0.1", taken.getsockname()[1])
        with bound("127.0.0.1", None) as one, bound("127.0.0.1", None) as other:
            assert one.getsockname()[1] != other.getsockname()[1]


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1", "127.9.9.9"])
def test_on_the_loopback_address_names_are_checked_and_no_token_is_needed(host: str) -> None:
    access = Access.on(host, 80)
    assert access.hosts
    assert access.token == ""


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.168.0.7", "127.evil.example"])  # noqa: S104
def test_elsewhere_a_token_is_needed(host: str) -> None:
    assert not is_loopback(host)
    assert len(Access.on(host, 80).token) >= 32


def test_help_names_the_extra() -> None:
    assert "extra `studio`" in " ".join(
        CliRunner().invoke(commands, ["studio", "-h"]).output.split()
    )
