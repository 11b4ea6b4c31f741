"""Where and with what a case is run."""

from __future__ import annotations

import os
import platform
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

import rightofway
from rightofway.search import compiler

__all__ = ["cores", "machine"]


@cache
def machine() -> dict[str, Any]:
    """Return commit, versions and hardware, as rows have them."""
    return {
        "commit": _commit(),
        "version": rightofway.__version__,
        "cpu": _cpu(),
        "cores": cores(),
        "compiler": compiler(),
        "python": platform.python_version(),
    }


def cores() -> int:
    """Return how many cores this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


def _commit() -> str:
    """Return the commit of our sources, ``-dirty`` if they differ from it; empty if unknown.

    An installed package may lie in a repository that has nothing to do with it, so git must know
    its files.
    """
    if not _git("ls-files", "--error-unmatch", Path(rightofway.__file__).name):
        return ""
    return _git("describe", "--always", "--dirty", "--abbrev=12", "--exclude=*")


def _git(*args: str) -> str:
    command = ["git", "-C", str(Path(rightofway.__file__).parent), *args]
    try:
        ended = subprocess.run(command, capture_output=True, check=True, text=True)  # noqa: S603
    except (OSError, subprocess.CalledProcessError):
        return ""
    return ended.stdout.strip()


def _cpu() -> str:
    """Return the model of the processor; the architecture where the system does not tell."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    models = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(models, "") or platform.processor() or platform.machine()
