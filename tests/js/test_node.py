"""The pure modules of the pages under Node: a case for each file ``*.test.js``."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).parent
FILES = sorted(HERE.rglob("*.test.js"))
NODE = shutil.which("node")


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(HERE)))
def test_the_modules_do_what_their_tests_claim(file: Path) -> None:
    """A developer may lack Node, CI may not."""
    if NODE is None:
        assert "CI" not in os.environ, "there is no Node (install nodejs)"
        pytest.skip("there is no Node")
    run = subprocess.run(
        [NODE, "--test-reporter=tap", file],  # --test would start a second process for it
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert "# tests 0" not in run.stdout
