"""What import contracts cannot see: the native core is no Python module."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_the_judge_does_without_the_native_core() -> None:
    code = "import sys, rightofway.check; print('rightofway._core' in sys.modules)"
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True)
    assert ended.stdout == "False\n"


def test_a_benchmark_is_read_without_the_readers_of_other_formats() -> None:
    """They take a twentieth of the time of a first plan of four hundred robots."""
    scen = "examples/maps/warehouse-10-20-10-2-1-random-1.scen"
    others = "'foreign', 'workbook', 'layouts.formats', 'plan.reader', 'site_plans'"
    code = (
        f"import sys, rightofway; print(len(rightofway.load({scen!r}, 2).robots), [room for room in"
        f" ({others}) if f'rightofway.io.{{room}}' in sys.modules])"
    )
    ended = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, check=True, text=True, cwd=ROOT
    )
    assert ended.stdout == "2 []\n"
