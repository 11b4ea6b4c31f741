"""What the command imports: heavy modules are imported where they are used, and nowhere else.

Seconds differ from machine to machine; the imported modules do not. `benchmarks/start_up.sh` has
the seconds.
"""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

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
OF_OTHER_WORK = {
    "io.fields",
    "io.layouts",
    "io.scenario.curves",
    "io.scenario.shape",
    "io.tables",
    "metrics.changes",
    "metrics.comparison",
    "metrics.inspection",
    "metrics.site",
    "precedence.period_curve",
    "precedence.sensitivity",
    "precedence.timed_event_graph",
    "search.cbs",
    "search.periodic_bookings",
    "site.layout",
    "site.quadtree",
}
"""Modules of rooms that a first plan of a classic fleet has no use for."""

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
    assert rooms <= {
        "cli",
        "deadline",
        "errors",
        "facts",
        "figures",
        "languages",
        "phrases",
        "provision",
    }


def test_a_plan_needs_only_what_reads_and_plans(tmp_path: Path) -> None:
    plan = str(tmp_path / "door.json")
    loaded = imported_by("plan", str(EXAMPLES / "door.yaml"), "-o", plan)
    assert not loaded & {*HEAVY, "pydantic", "pydantic_core", "rightofway.io.models"}
    unused = (
        *("control", "cyclic", "dispatch", "execution", "fleet_builder", "studio", "viz"),
        *("io.foreign", "io.layouts", "io.orders", "io.scenario.league", "io.tables"),
        *("io.workbook", "metrics.inspection", "metrics.named_collisions"),
    )
    prefixes = tuple(f"rightofway.{room}" for room in unused)
    assert not {name for name in loaded if name.startswith(prefixes)}


def test_help_imports_commands_of_rooms_above_and_nothing_else_of_them() -> None:
    loaded = imported_by("--help")
    above = {
        name for name in loaded if name.startswith(("rightofway.control", "rightofway.studio"))
    }
    assert above == {
        "rightofway.control",
        "rightofway.control.command_line",
        "rightofway.control.command_line.broker_options",
        "rightofway.control.command_line.drive",
        "rightofway.control.command_line.event_log",
        "rightofway.control.command_line.jobs",
        "rightofway.control.command_line.output",
        "rightofway.control.command_line.probe",
        "rightofway.control.command_line.robots",
        "rightofway.control.command_line.watch",
        "rightofway.control.messages",
        "rightofway.studio",
        "rightofway.studio.command_line",
    }


def test_a_classic_plan_needs_no_library_that_reads_documents(tmp_path: Path) -> None:
    """A `.scen` file is a list of numbers, and the plan is written without any model of it."""
    scen = str(EXAMPLES / "maps" / "warehouse-10-20-10-2-1-random-1.scen")
    plan = str(tmp_path / "plan.json")
    loaded = imported_by("plan", scen, "-k", "4", "--planner", "lacam", "-o", plan)
    assert not loaded & {*HEAVY, "pydantic", "yaml", "email", "urllib.request", "zipfile"}
    assert not loaded & {f"rightofway.{module}" for module in OF_OTHER_WORK}


@pytest.mark.parametrize(
    "room", ["control", "io", "io.layouts", "metrics", "precedence", "search", "viz"]
)
def test_a_room_gives_all_its_names_and_those_that_it_imports_later_once(room: str) -> None:
    package = import_module(f"rightofway.{room}")
    later = [name for names in package._MODULES.values() for name in names]
    assert set(later) <= set(package.__all__)
    assert len(later) == len(set(later))
    assert not set(later) & set(package._MODULES), "an imported module would hide the name"
    for name in package.__all__:
        assert getattr(package, name) is not None
    for module, names in package._MODULES.items():
        for name in names:
            assert getattr(package, name) is getattr(
                import_module(f"rightofway.{room}.{module}"), name
            )


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
