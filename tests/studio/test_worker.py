"""What a worker process may do: its folder, its memory, its end."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.studio.messages import as_error
from rightofway.studio.worker import LARGE


def ran(code: str) -> str:
    """Return what a program prints that uses the functions of workers, or its last words."""
    words = f"from rightofway.studio.worker import *; from pathlib import Path; {code}"
    done = subprocess.run(
        [sys.executable, "-c", words], capture_output=True, text=True, check=False
    )
    return (done.stdout or done.stderr.strip().rpartition("\n")[2]).strip()


def test_a_confined_process_opens_its_folder_and_nothing_beside_it(tmp_path: Path) -> None:
    folder = tmp_path / "floor"
    folder.mkdir()
    for path in (folder / "inside", tmp_path / "floor2", tmp_path / "secret"):
        path.write_text(path.name)
    (folder / "link").symlink_to(tmp_path / "secret")
    confined = f"confine({str(folder)!r}); print(Path({{!r}}).read_text())"
    assert ran(confined.format(str(folder / "inside"))) == "inside"
    for outside in (tmp_path / "floor2", folder / "link", folder / "../secret", tmp_path / "new"):
        assert "outside of the folder" in ran(confined.format(str(outside)))
    written = f"confine({str(folder)!r}); Path({str(tmp_path / 'new')!r}).write_text('x')"
    assert "outside of the folder" in ran(written)
    assert not (tmp_path / "new").exists()


def test_a_confined_process_still_imports_modules(tmp_path: Path) -> None:
    assert (
        ran(f"confine({str(tmp_path)!r}); import wave, rightofway.bench; print('done')") == "done"
    )


@pytest.mark.skipif(sys.platform != "linux", reason="limits of memory differ")
def test_more_memory_than_its_part_is_an_error_and_not_the_end_of_the_machine() -> None:
    assert "MemoryError" in ran("limit_memory(); bytearray(2**46)")


@pytest.mark.skipif(sys.platform != "linux", reason="memory is counted otherwise")
def test_the_memory_of_whoever_starts_a_worker_is_not_its_own() -> None:
    """A worker that seems large is replaced after each job."""
    counted = (
        "from rightofway.studio.worker import measure_most_memory; print(measure_most_memory())"
    )
    started = f"import subprocess; subprocess.run([sys.executable, '-c', {counted!r}])"
    assert int(ran(f"whole = bytearray(LARGE); {started}")) < LARGE / 2
    assert int(ran("whole = bytearray(LARGE); print(measure_most_memory())")) > LARGE


@pytest.mark.parametrize(
    ("error", "kind"),
    [
        (InputError.at("robots", "are missing (add some)"), "input"),
        (NoPlanExists("they block each other"), "no_plan"),
        (GaveUp("time ran out"), "gave_up"),
        (KeyboardInterrupt(), "stopped"),
        (MemoryError(), "memory"),
        (TypeError("x"), "defect"),
    ],
)
def test_each_ending_has_its_kind_and_a_message(error: BaseException, kind: str) -> None:
    told = as_error(error)
    assert told["kind"] == kind
    assert told["message"]
    assert ("phrase" in told) == (kind in {"gave_up", "stopped", "memory"})
