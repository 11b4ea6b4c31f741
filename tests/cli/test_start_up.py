"""What the command imports: heavy modules are imported where they are used, and nowhere else.

Seconds differ from machine to machine; the imported modules do not. `benchmarks/start_up.sh` has
the seconds.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

HEAVY = {
    "PIL",
    "asyncio",
    "fastapi",
    "http",
    "matplotlib",
    "networkx",
    "openpyxl",
    "pandas",
    "uvicorn",
    "xml.sax",
}
EXAMPLES = Path(__file__).parents[2] / "examples"


def imported_by(*words: str) -> set[str]:
    """Return the modules that a process of the command has imported at its end."""
    script = (
        "import sys; from rightofway.cli.main import run; assert run(sys.argv[1:]) == 0;"
        "print('\\n', *sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, *words], check=True, capture_output=True, text=True
    )
    return set(done.stdout.splitlines()[-1].split())


def test_the_version_needs_no_room_and_no_library_but_click() -> None:
    loaded = imported_by("--version")
    assert not loaded & {*HEAVY, "numpy", "pydantic", "yaml", "rightofway._core"}
    rooms = {name.split(".")[1] for name in loaded if name.startswith("rightofway.")}
    assert rooms <= {"cli", "deadline", "errors", "figures", "phrases", "provision"}


def test_a_plan_needs_only_what_reads_and_plans(tmp_path: Path) -> None:
    plan = str(tmp_path / "door.json")
    loaded = imported_by("plan", str(EXAMPLES / "door.yaml"), "-o", plan)
    assert not loaded & HEAVY
    assert not {name for name in loaded if name.startswith(("rightofway.viz", "rightofway.studio"))}


def test_a_classic_plan_needs_no_library_that_reads_documents(tmp_path: Path) -> None:
    """A `.scen` file is a list of numbers, and the plan is written without any model of it."""
    scen = str(EXAMPLES / "maps" / "warehouse-10-20-10-2-1-random-1.scen")
    plan = str(tmp_path / "plan.json")
    loaded = imported_by("plan", scen, "-k", "4", "--planner", "lacam", "-o", plan)
    assert not loaded & {*HEAVY, "pydantic", "yaml", "email", "urllib.request", "zipfile"}
    assert not loaded & {"rightofway.io.scenario.shape", "rightofway.io.fields"}


def test_a_package_that_is_imported_imports_its_rooms_when_they_are_used() -> None:
    script = (
        "import sys, rightofway; print(*sys.modules);"
        "assert rightofway.model.Plan is rightofway.Plan;"
        "import rightofway.check, rightofway.solve;"
        "assert rightofway.check.__name__ == 'check' and callable(rightofway.check);"
        "assert callable(rightofway.solve)"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], check=True, capture_output=True, text=True
    )
    assert "numpy" not in done.stdout.split()
