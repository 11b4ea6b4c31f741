"""The main job of the README by an installed package: ``python tests/wheel_works.py``.

Run in the environment that is tried, in any folder; needs nothing but the package. With the extra
`studio` the server must answer, too.
"""

from __future__ import annotations

import subprocess
import sys
import sysconfig
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

import rightofway
from rightofway import _core

COMMAND = Path(sysconfig.get_path("scripts")) / "rightofway"


def run(folder: str, *words: str) -> str:
    """Run the installed command in a folder and return what it writes."""
    done = subprocess.run(
        [COMMAND, *words], cwd=folder, check=True, capture_output=True, text=True, encoding="utf-8"
    )
    return done.stdout + done.stderr


def plan_and_show(folder: str) -> None:
    """Take an example, plan it, check it, write its page: what the README begins with."""
    examples = Path(rightofway.__file__).parent / "examples"
    run(folder, "plan", str(examples / "door.yaml"), "-o", "door.json", "--page", "door.html")
    assert "no fault" in run(folder, "check", "door.json")
    assert (Path(folder) / "door.html").stat().st_size > 100_000


def ask_the_studio(folder: str) -> None:
    """Start the studio and wait for the address that it prints, with its key."""
    with subprocess.Popen(
        [COMMAND, "studio", folder, "--no-browser"],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as server:
        assert server.stdout is not None
        line = next((line for line in server.stdout if "http://127.0.0.1:" in line), None)
        server.terminate()
    assert line, "the studio printed no address"


if __name__ == "__main__":
    with TemporaryDirectory() as scratch:
        plan_and_show(scratch)
        if find_spec("fastapi") and find_spec("uvicorn"):
            ask_the_studio(scratch)
    version = ".".join(map(str, sys.version_info[:3]))
    works = f"rightofway {rightofway.__version__} works on Python {version}"
    sys.stdout.write(f"{works}: {_core.__file__}\n")
