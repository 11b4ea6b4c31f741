"""``rightofway bench`` as a user meets it: rows, reports, interruptions, messages."""

from __future__ import annotations

import json
import shutil
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from rightofway.bench import process
from tests.builders.suites import rows_of, soon, write_suite
from tests.cli.conftest import EXAMPLES, Cli


def files() -> list[str]:
    return sorted(path.name for path in Path.cwd().iterdir())


def test_the_example_is_run_and_reported_on(cli: Cli) -> None:
    pytest.importorskip("matplotlib")
    ended = cli("bench", EXAMPLES / "suite.toml", "--report", "report.html")
    assert ended.code == 0
    assert ended.out.splitlines()[0] == "planner    solved  ratio  first plan [s]"
    assert ended.out.splitlines()[1].startswith("two-level   27/27  1.")
    rows = rows_of("results.csv")
    # 3 counts x 3 seeds x 2 fleets on the random grid, 3 x 2 in the warehouse, 3 at the door
    assert Counter(row["map"] for row in rows) == {
        "random-16-16-10": 18, "warehouse-10-20-10-2-1": 6, "door": 3,
    }  # fmt: skip
    for row in rows:
        assert (row["solved"], row["valid"], row["status"]) == ("yes", "yes", "solved")
        ratio = int(row["flowtime"]) / int(row["lower_bound"])
        assert float(row["ratio"]) == pytest.approx(ratio, abs=1e-6)
        assert 0 < float(row["first_plan_seconds"]) <= float(row["wall_seconds"]) < 5
        assert float(row["cpu_seconds"]) > 0
        assert 20 < float(row["peak_memory"]) < 500
        assert row["compiler"].split()[0] in {"GCC", "Clang", "MSVC"}
    [door] = {(row["flowtime"], row["lower_bound"]) for row in rows if row["map"] == "door"}
    assert door == ("19", "18")  # as the paper has it
    page = Path("report.html").read_text(encoding="utf-8")
    assert page.count("data:image/svg+xml") == 2
    assert "27 of 27" in page


def test_a_second_run_does_nothing_but_report(cli: Cli) -> None:
    write_suite("two-level", seeds=2)
    first = cli("bench", "suite.toml")
    content = Path("results.csv").read_bytes()
    again = cli("bench", "suite.toml", "--json")
    assert "2 of 2 cases are there already" in again.err
    assert Path("results.csv").read_bytes() == content
    data = json.loads(again.out)
    assert (data["results"], data["cases"]) == ("results.csv", 2)
    [planner] = data["planners"]
    assert (planner["planner"], planner["cases"], planner["solved"]) == ("two-level", 2, 2)
    assert f"{planner['ratio']['median']:.3f}" in first.out


SHIFTS = """format = "rightofway-suite/1"
maps = [{scenario = "jobs.yaml", name = "site", counts = [1, 3]}]
fleets = [{name = "fleet"}]
planners = [{name = "shift", options = {lead = 0, known = "poisson:1/60"}}]
limits = [0.2]
"""


def test_a_suite_of_shifts_answers_how_many_robots_are_needed(cli: Cli) -> None:
    Path("suite.toml").write_text(SHIFTS, encoding="utf-8")
    shutil.copy(EXAMPLES / "jobs.yaml", "jobs.yaml")
    ended = cli("bench", "suite.toml", "--in-time", "100%")
    assert ended.code == 0
    lines = ended.out.splitlines()
    assert lines[0] == "site, fleet"
    head = ["robots", "shifts", "done", "in", "time", "jobs/h", "median", "[s]", "95", "%", "[s]"]
    assert lines[1].split() == [*head, "wait", "idle"]
    assert [line.split()[:2] for line in lines[2:4]] == [["1", "1/1"], ["3", "1/1"]]
    assert lines[-1].startswith("site, fleet: ")
    assert max(map(len, lines)) <= 80
    data = json.loads(cli("bench", "suite.toml", "--in-time", "0", "--json").out)
    assert data["planners"] == []
    [sizes] = data["shifts"]
    assert (sizes["map"], sizes["least_robots"]) == ("site", 1)
    assert [size["robots"] for size in sizes["sizes"]] == [1, 3]


def test_rows_of_another_commit_are_kept_and_told(cli: Cli) -> None:
    write_suite("two-level", seeds=2)
    cli("bench", "suite.toml")
    header, first, second = Path("results.csv").read_text(encoding="utf-8").splitlines()
    cells = first.split(",")
    cells[header.split(",").index("commit")] = "deadbeef0000"
    lines = [header, ",".join(cells), second, ""]
    Path("results.csv").write_text("\n".join(lines), encoding="utf-8")
    ended = cli("bench", "suite.toml")
    assert ended.err.splitlines()[:2] == [
        "2 of 2 cases are there already",
        "1 of them by another commit (give another -o to run them again)",
    ]
    assert "deadbeef0000" in Path("results.csv").read_text(encoding="utf-8")


def test_a_larger_suite_runs_only_what_is_new(cli: Cli) -> None:
    write_suite("two-level", seeds=1)
    cli("bench", "suite.toml")
    write_suite("two-level", seeds=3)
    assert "1 of 3 cases are there already" in cli("bench", "suite.toml").err
    assert sorted(row["seed"] for row in rows_of("results.csv")) == ["0", "1", "2"]


ENDS = {
    "chatty": ("solved", "yes", "well rested"),
    "lazy": ("gave up", "", "it is too hot"),
    "liar": ("invalid plan", "no", "liar made a plan with 3 faults: "),
    "suicide": ("killed", "", "its process was ended by SIGKILL, perhaps for its memory. "),
    "quitter": ("defect", "", "its process ended with code 3. assertion failed: x > 0"),
    "hungry": ("out of memory", "", "no room for 1e12 bytes"),
    "buggy": ("defect", "", 'RuntimeError: two lines, "quoted"'),
}


@pytest.mark.usefixtures("others")
def test_however_a_case_ends_it_is_a_row_with_the_reason(cli: Cli) -> None:
    write_suite(*ENDS)
    ended = cli("bench", "suite.toml")
    assert ended.code == 1  # a plan was wrong
    rows = {row["planner"]: row for row in rows_of("results.csv")}
    assert {name: (row["status"], row["valid"]) for name, row in rows.items()} == {
        name: end[:2] for name, end in ENDS.items()
    }
    for name, (_, _, message) in ENDS.items():
        assert rows[name]["message"].startswith(message.rstrip())
    assert ended.out.splitlines()[2:4] == ["lazy        0/1", "liar        0/1"]
    assert cli("bench", "suite.toml").out == ended.out


@pytest.mark.usefixtures("others")
def test_a_case_that_does_not_end_is_ended(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process, "GRACE", -9)  # 3 x 5 s - 9 s = 6 s
    write_suite("stuck")
    assert cli("bench", "suite.toml").code == 0
    [row] = rows_of("results.csv")
    assert (row["status"], row["message"]) == ("overran", "it was ended after 6 s")
    assert is_gone(int(Path("stuck").read_text(encoding="utf-8")))


def is_gone(number: int) -> bool:
    """Return whether a process has ended; one that nobody has asked about yet counts as such."""
    try:
        status = Path(f"/proc/{number}/stat").read_text(encoding="utf-8")
    except FileNotFoundError:
        return True
    return status.rpartition(")")[2].split()[0] == "Z"


# Python itself would answer an interrupt while it still imports the package; and whoever runs the
# tests in the background has interrupts ignored, which children inherit.
RUN = (
    "import signal, sys; from rightofway.cli.main import run;"
    "signal.signal(signal.SIGINT, signal.default_int_handler); sys.exit(run(sys.argv[1:]))"
)


def started(*args: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-c", RUN, "bench", "suite.toml", *args],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def lines_of(path: str) -> Sequence[bytes]:
    return Path(path).read_bytes().splitlines() if Path(path).exists() else []


@pytest.fixture
def half_done(cli: Cli, others: None) -> Iterator[subprocess.Popen[str]]:
    """Yield a run of eight cases of half a second each of which two at least are done."""
    del cli, others  # they set the scene
    write_suite("sleepy", seeds=8)
    running = started()
    assert soon(lambda: len(lines_of("results.csv")) >= 3)
    yield running
    running.kill()
    running.communicate()


def test_an_interrupt_keeps_what_is_done_and_the_next_run_goes_on(
    cli: Cli, half_done: subprocess.Popen[str]
) -> None:
    half_done.send_signal(signal.SIGINT)
    out, err = half_done.communicate(timeout=30)
    kept = len(lines_of("results.csv")) - 1
    assert (half_done.returncode, out) == (130, "")
    assert [line for line in err.splitlines() if line][-2:] == [
        f"results.csv has {kept} of 8 cases; the same command goes on from here",
        "interrupted",
    ]
    assert 2 <= kept < 8
    assert f"{kept} of 8 cases are there already" in cli("bench", "suite.toml").err
    assert sorted(row["seed"] for row in rows_of("results.csv")) == list("01234567")


def test_a_kill_in_the_middle_of_a_row_spoils_nothing(
    cli: Cli, half_done: subprocess.Popen[str]
) -> None:
    half_done.kill()
    half_done.wait()
    content = Path("results.csv").read_bytes()
    rows = content.splitlines(keepends=True)
    with Path("results.csv").open("ab") as file:
        file.write(rows[1].replace(b",", b";", 1)[:40])  # what a kill in a write may leave
    errors = list[str]()

    def goes_on() -> bool:
        errors.append(cli("bench", "suite.toml").err)
        return "another run" not in errors[-1]  # the cases of the run that was killed end soon

    assert soon(goes_on)
    assert f"{len(rows) - 1} of 8 cases are there already" in errors[-1]
    assert Path("results.csv").read_bytes().startswith(content)
    assert sorted(row["seed"] for row in rows_of("results.csv")) == list("01234567")
    assert {row["status"] for row in rows_of("results.csv")} == {"solved"}


@pytest.mark.usefixtures("others", "cli")
def test_cases_do_not_outlive_a_run_that_was_killed() -> None:
    write_suite("stuck")
    running = started()
    assert soon(lambda: Path("stuck").exists() and Path("stuck").read_text(encoding="utf-8"))
    running.kill()
    running.communicate()
    number = int(Path("stuck").read_text(encoding="utf-8"))
    assert soon(lambda: is_gone(number))


def test_two_runs_do_not_write_to_one_file(cli: Cli, half_done: subprocess.Popen[str]) -> None:
    assert half_done.poll() is None
    ended = cli("bench", "suite.toml")
    assert (ended.code, ended.err) == (
        2,
        "results.csv: another run is writing to it (wait for its end, or give another file)\n",
    )


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["nowhere.toml"], "nowhere.toml: there is no such file (check the path)"),
        (["door.yaml"], 'door.yaml: a suite is TOML (begin it with format = "rightofway-suite/1")'),
        (["suite.toml", "-o", "rows.txt"], "'rows.txt' does not end in .csv"),
        (["suite.toml", "-o", "no/rows.csv"], "there is no directory 'no' (make it first)"),
        (["suite.toml", "--report", "r.pdf"], "'r.pdf' does not end in .html or .md"),
        (["suite.toml", "--in-time", "95"], "'95' is no share: '95' is above 1 (give a share"),
        (["suite.toml", "--in-time", "-1%"], "'-1%' is no share: '-1' is negative (give 0 or"),
        (["suite.toml", "--jobs", "0"], "0 does not fit (give a whole number of 1 or more)"),
        (["suite.toml", "--jobs", "2", "--dask", "tcp://x:1"], "choose one"),
        (["suite.toml", "-o", "other.csv"], "other.csv:1: this is no file of results as"),
    ],
)
def test_bad_use_ends_with_2_and_one_message(cli: Cli, args: list[str], message: str) -> None:
    write_suite("two-level")
    Path("other.csv").write_text("name,age\nAda,36\n", encoding="utf-8")
    ended = cli("bench", *args)
    assert (ended.code, ended.out) == (2, "")
    assert message in ended.err
    assert Path("other.csv").read_text(encoding="utf-8") == "name,age\nAda,36\n"
    assert files() == ["other.csv", "suite.toml"]


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["--report", "r.html"], "a report needs matplotlib (pip install 'rightofway[bench]')"),
        (["--dask", "tcp://x:1"], "a cluster needs distributed (pip install 'rightofway[dask]')"),
    ],
)
def test_what_is_missing_is_told_before_any_case_is_run(
    cli: Cli, monkeypatch: pytest.MonkeyPatch, args: list[str], message: str
) -> None:
    monkeypatch.setattr("rightofway.extras.find_spec", lambda _: None)
    write_suite("two-level")
    ended = cli("bench", "suite.toml", *args)
    assert (ended.code, ended.err) == (2, f"{message}\n")
    assert files() == ["suite.toml"]


def test_help_imports_nothing_heavy() -> None:
    code = (
        "import sys; from rightofway.cli.main import run; run(['bench', '--help']);"
        "print(sorted({'matplotlib', 'distributed', 'pydantic', 'concurrent.futures',"
        " 'rightofway.bench', 'rightofway._core'} & set(sys.modules)), file=sys.stderr)"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True)
    assert ended.stderr.strip() == "[]"
