"""The command: its address, its folder, and what it needs."""

from __future__ import annotations

import re
import shutil
import socket
import subprocess
from pathlib import Path

import httpx
import pytest
from click.testing import CliRunner

from rightofway.cli.main import commands, run
from rightofway.errors import InputError
from rightofway.studio.guard import Access, is_loopback
from rightofway.studio.serve import bind_socket, refuse_certificate, split_folder_and_file
from tests.builders.studios import command


def test_without_the_extra_it_says_how_to_install_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("rightofway.studio.command_line.find_spec", lambda _: None)
    assert run(["studio"]) == 2
    assert "pip install 'rightofway[studio]'" in capsys.readouterr().err


def test_a_path_that_is_not_there_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["studio", "nowhere.yaml", "--no-browser"]) == 2
    assert "nowhere.yaml: there is no such file or folder" in capsys.readouterr().err


def test_a_file_is_opened_in_its_folder(tmp_path: Path) -> None:
    (tmp_path / "door.yaml").touch()
    assert split_folder_and_file(tmp_path / "door.yaml") == (tmp_path, "door.yaml")
    assert split_folder_and_file(tmp_path) == (tmp_path, None)


def test_a_port_that_is_taken_is_refused_and_a_free_one_is_found_by_itself() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        with pytest.raises(InputError, match="cannot be listened on"):
            bind_socket("127.0.0.1", taken.getsockname()[1])
        with bind_socket("127.0.0.1", None) as one, bind_socket("127.0.0.1", None) as other:
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


@pytest.fixture
def certificate(tmp_path: Path) -> tuple[str, str]:
    """Return the files of a new certificate and of its key."""
    if not shutil.which("openssl"):
        pytest.skip("there is no openssl")
    files = str(tmp_path / "own.pem"), str(tmp_path / "own.key")
    made = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2"]
    made += ["-subj", "/CN=localhost", "-out", files[0], "-keyout", files[1]]
    subprocess.run(made, check=True, capture_output=True)
    return files


@pytest.mark.slow
def test_with_a_certificate_the_connection_is_encrypted(
    tmp_path: Path, certificate: tuple[str, str]
) -> None:
    """Where other machines reach the studio, the cookie with the token never goes unencrypted."""
    tls = ("--certificate", certificate[0], "--key", certificate[1])
    with command(tmp_path, "--no-history", "--host", "0.0.0.0", *tls) as studio:  # noqa: S104
        printed = re.search(r"https://(\S+?):(\d+)/\?token=(\S+)", studio.first_line)
        assert printed, studio.first_line
        _, port, token = printed.groups()
        with httpx.Client(base_url=f"https://127.0.0.1:{port}", verify=False) as client:  # noqa: S501
            assert client.get("/api/v1/files").status_code == 401
            signed = client.get("/", params={"token": token})
            assert "Secure" in signed.headers["set-cookie"].split("; ")
            assert client.get("/api/v1/files").status_code == 200
        with httpx.Client() as plain, pytest.raises(httpx.TransportError):
            plain.get(f"http://127.0.0.1:{port}/api/v1/files")


@pytest.mark.slow
def test_a_certificate_that_cannot_be_used_is_refused(
    tmp_path: Path, certificate: tuple[str, str]
) -> None:
    (tmp_path / "text.pem").write_text("no certificate")
    locked = str(tmp_path / "locked.key")
    words = ["openssl", "rsa", "-aes256", "-passout", "pass:x", "-in", certificate[1]]
    subprocess.run([*words, "-out", locked], check=True, capture_output=True)
    refuse_certificate(None, None)
    refuse_certificate(*certificate)
    for given, message in (
        ((None, certificate[1]), "without --certificate"),
        (("nowhere.pem", None), "No such file"),
        ((str(tmp_path / "text.pem"), None), "cannot be used"),
        ((certificate[0], None), "cannot be used"),
        ((certificate[0], locked), "has a password"),
    ):
        with pytest.raises(InputError, match=message):
            refuse_certificate(*given)
