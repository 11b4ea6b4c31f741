"""What import contracts cannot see: the native core is no Python module."""

import subprocess
import sys


def test_the_judge_does_without_the_native_core() -> None:
    code = "import sys, rightofway.check; print('rightofway._core' in sys.modules)"
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True)
    assert ended.stdout == "False\n"
