"""``rightofway bench --dask`` with a real cluster: a scheduler and workers, each a process."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from rightofway.bench import cluster
from tests.builders.suites import rows_of, soon, write_suite
from tests.cli.conftest import Cli

pytest.importorskip("distributed")
pytestmark = pytest.mark.usefixtures("others")

SCHEDULER = ["scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
WORKER = ["worker", "--nthreads", "1", "--no-nanny", "--no-dashboard"]
FILE = ["--scheduler-file", "cluster.json"]

Process = subprocess.Popen[bytes]


def dask(*args: str) -> Process:
    command = [sys.executable, "-m", "dask", *args, *FILE]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


@contextmanager
def started(workers: int) -> Iterator[tuple[str, Process, list[Process]]]:
    """Start a cluster; yield its address, its scheduler and its workers; end it."""
    running = [dask(*SCHEDULER)]
    try:
        assert soon(lambda: Path("cluster.json").exists() and Path("cluster.json").stat().st_size)
        address = json.loads(Path("cluster.json").read_text(encoding="utf-8"))["address"]
        running += [dask(*WORKER) for _ in range(workers)]
        yield address, running[0], running[1:]
    finally:
        for process in reversed(running):
            process.kill()
            process.wait()


@contextmanager
def bench(address: str) -> Iterator[subprocess.Popen[str]]:
    """Start the command; yield it; end it."""
    command = [sys.executable, "-m", "rightofway", "bench", "suite.toml", "--dask", address]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True) as running:
        try:
            yield running
        finally:
            running.kill()


def has_rows(count: int) -> bool:
    return Path("results.csv").exists() and len(rows_of("results.csv")) >= count


def tries_of(worker: Process) -> int:
    """Return how many cases a worker has begun."""
    notes = Path.cwd().glob("try-*")
    return sum(note.read_text(encoding="utf-8") == str(worker.pid) for note in notes)


@pytest.mark.usefixtures("cli")
def test_no_result_is_lost_nor_doubled_when_a_worker_dies() -> None:
    """Two workers, ten cases of half a second; one worker is killed in the middle of a case."""
    write_suite("sleepy", seeds=10)
    with started(workers=2) as (address, _, (first, _second)), bench(address) as running:
        assert soon(lambda: has_rows(2))
        done = tries_of(first)
        assert soon(lambda: tries_of(first) > done), "no new case began"
        first.kill()
        _, err = running.communicate(timeout=60)
    assert running.returncode == 0, err
    rows = rows_of("results.csv")
    assert sorted(int(row["seed"]) for row in rows) == list(range(10))
    assert {row["status"] for row in rows} == {"solved"}
    assert len(list(Path.cwd().glob("try-*"))) > 10, "no case was tried twice"


@pytest.mark.usefixtures("cli")
def test_a_case_that_takes_its_workers_with_it_is_a_row(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES", "0")
    write_suite("patricide")
    with started(workers=1) as (address, _, _), bench(address) as running:
        _, err = running.communicate(timeout=60)
    assert running.returncode == 0, err
    [row] = rows_of("results.csv")
    assert (row["status"], row["message"]) == (
        "killed",
        "each worker that tried it died, perhaps for its memory",
    )


def test_a_scheduler_that_goes_away_is_told_and_the_rows_are_kept(cli: Cli) -> None:
    write_suite("sleepy", seeds=6)
    with started(workers=1) as (address, scheduler, _), bench(address) as running:
        assert soon(lambda: has_rows(1))
        scheduler.kill()
        _, err = running.communicate(timeout=90)
    assert running.returncode == 2, err
    assert f"{address}: the scheduler went away" in err.splitlines()[-1]
    kept = len(rows_of("results.csv"))
    assert f"{kept} of 6 cases are there already" in cli("bench", "suite.toml").err
    assert sorted(row["seed"] for row in rows_of("results.csv")) == list("012345")


def test_a_cluster_that_does_not_answer_is_told(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "PATIENCE", 1)
    write_suite("two-level")
    ended = cli("bench", "suite.toml", "--dask", "tcp://127.0.0.1:9")
    assert ended.code == 2
    assert ended.err.startswith("tcp://127.0.0.1:9: no scheduler answers: ")
    assert ended.err.endswith("(start one with: dask scheduler)\n")


@pytest.mark.usefixtures("cli")
def test_a_worker_without_the_package_is_told(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    write_suite("two-level")
    with monkeypatch.context() as patch:
        hidden = "import sys; sys.modules['rightofway'] = None"
        (tmp_path / "sitecustomize.py").write_text(hidden, encoding="utf-8")
        patch.setenv("PYTHONPATH", str(tmp_path))
        with started(workers=1) as (address, _, _):
            patch.undo()
            with bench(address) as running:
                _, err = running.communicate(timeout=60)
    assert running.returncode == 2
    line = err.splitlines()[-1]
    assert line.startswith(f"{address}: a worker cannot run cases: ")
    assert line.endswith("(install this rightofway on all workers)")
