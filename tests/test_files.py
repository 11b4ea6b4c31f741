"""Files are written whole or not at all."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.files import remove_abandoned, write_whole


def test_a_file_that_could_not_be_written_is_as_it_was(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    write_whole(path, "old")
    with pytest.raises(InputError, match="the file cannot be written"):
        write_whole(path, "new \ud800")  # no UTF-8: writing fails half way
    assert path.read_text(encoding="utf-8") == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_an_interrupt_leaves_nothing_half_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_whole(tmp_path / "plan.json", "new")
    assert list(tmp_path.iterdir()) == []


def test_where_nothing_can_be_written_is_told(tmp_path: Path) -> None:
    for path, fault in [
        (
            tmp_path / "no" / "plan.json",
            f"there is no directory '{tmp_path / 'no'}' (make it first)",
        ),
        (tmp_path, "this is a directory (give a file name in it)"),
        (Path("a\0b"), "the file cannot be written: embedded null byte"),
    ]:
        with pytest.raises(InputError) as caught:
            write_whole(path, "text")
        assert str(caught.value) == f"{path}: {fault}" or fault in str(caught.value)


def test_a_link_is_followed_and_kept(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old", encoding="utf-8")
    (tmp_path / "link").symlink_to("real")
    write_whole(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text(encoding="utf-8") == "new"


def test_a_device_is_written_to_not_replaced() -> None:
    if sys.platform != "win32":
        write_whole(Path("/dev/null"), "text")
        assert not Path("/dev/null").is_file()


WRITE = """
import os, signal, sys
from rightofway import files

def interrupt(_):
    files.os.fsync = lambda _: None  # that of the folder comes after it
    os.kill(os.getpid(), int(sys.argv[2]))

files.os.fsync = interrupt
files.write_whole(sys.argv[1], "new")
"""
"""A program that gets a signal while it writes a file."""


@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL")
@pytest.mark.parametrize("name", ["plan.json", "[a-z]*.json", "a.b.1.part", "x\ny"])
def test_the_next_write_removes_what_a_kill_has_left(tmp_path: Path, name: str) -> None:
    for _ in range(2):
        killed = [sys.executable, "-c", WRITE, str(tmp_path / name), str(int(signal.SIGKILL))]
        subprocess.run(killed, check=False)
    parts = [path.name for path in tmp_path.iterdir()]
    assert len(parts) == 1  # the second program has removed that of the first
    assert parts[0].startswith(f".{name}.")
    write_whole(tmp_path / name, "new")
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.skipif(sys.platform == "win32", reason="there are no signals to stop a program")
def test_what_another_program_still_writes_is_not_removed(tmp_path: Path) -> None:
    target = tmp_path / "plan.json"
    stopped = [sys.executable, "-c", WRITE, str(target), str(int(signal.SIGSTOP))]
    with subprocess.Popen(stopped) as program:
        os.waitid(os.P_PID, program.pid, os.WSTOPPED | os.WNOWAIT)
        [part] = tmp_path.iterdir()
        remove_abandoned(part)
        write_whole(target, "of this program")
        assert part.exists()
        program.send_signal(signal.SIGCONT)
    assert (program.returncode, target.read_text(encoding="utf-8")) == (0, "new")


@pytest.mark.parametrize("name", ["plan.json", "plan.json.12.part", ".plan.json.part", ".1.part"])
def test_only_files_with_names_of_half_written_ones_are_removed(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    path.write_text("mine")
    remove_abandoned(path)
    assert path.exists()


def test_a_part_that_was_made_just_now_may_be_locked_soon(tmp_path: Path) -> None:
    part = tmp_path / ".plan.json.12.part"
    part.touch()
    remove_abandoned(part)
    assert part.exists()
    os.utime(part, (time.time() - 60,) * 2)
    remove_abandoned(part)
    assert not part.exists()
