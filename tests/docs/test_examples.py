"""Every example of the documentation is run as a reader would run it, in a copy of the examples."""

from __future__ import annotations

import doctest
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

import pytest

from rightofway.cli.main import run
from tests.builders.pages import PAGES, ROOT, Block, blocks, title_of

RUN = {"python", "console"}
QUICK = {"README.md", "docs/python.md", "docs/model.md"}
"""Pages of the quick lane; the others take a minute of a processor."""

PAGES_WITH_EXAMPLES = [
    pytest.param(page, marks=() if title_of(page) in QUICK else pytest.mark.slow, id=title_of(page))
    for page in PAGES
    if any(block.language in RUN for block in blocks(page))
]


@pytest.mark.parametrize("page", PAGES_WITH_EXAMPLES)
def test_the_examples_of_a_page_do_what_it_says(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Blocks run in order and share files and names; what they print is compared."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"__name__": "__main__"}
    for block in blocks(page):
        where = f"{title_of(page)}, line {block.line}"
        if block.file_name is not None:
            Path(block.file_name).write_text(block.text, encoding="utf-8")
        if block.file_name == "pyproject.toml":
            install(block.text)
        elif block.language == "python":
            run_python(block, names, where)
        elif block.language == "console":
            run_console(block, where)


def run_python(block: Block, names: dict[str, Any], where: str) -> None:
    if ">>>" not in block.text:
        exec(compile(block.text, where, "exec"), names)  # noqa: S102 (our own examples)
        return
    test = doctest.DocTestParser().get_doctest(block.text, names, where, where, block.line)
    said: list[str] = []
    results = doctest.DocTestRunner(verbose=False).run(test, out=said.append, clear_globs=False)
    names.update(test.globs)
    assert results.failed == 0, "".join(said)


def run_console(block: Block, where: str) -> None:
    """Run each line behind ``$``; the lines up to the next are its output, ``…`` for anything."""
    for example in re.split(r"^\$ ", block.text, flags=re.MULTILINE)[1:]:
        command, _, expected = example.partition("\n")
        printed = run_command(command)
        pattern = ".*".join(map(re.escape, expected.split("…")))
        message = f"{where}: $ {command}\nprinted\n{printed}\nnot\n{expected}"
        assert re.fullmatch(pattern, printed, re.DOTALL), message


def run_command(command: str) -> str:
    """Return what a command writes to a terminal of 80 columns.

    One of the package runs in this process, which has its imports; the shell runs all others, and
    those of a package that the page has made.
    """
    if re.fullmatch(r"rightofway [^|<>;&$*()\\]*", command) and not Path("pyproject.toml").exists():
        written = io.StringIO()
        with (
            pytest.MonkeyPatch.context() as patch,
            redirect_stdout(written),
            redirect_stderr(written),
        ):
            patch.setenv("COLUMNS", "80")
            run(shlex.split(command)[1:])
        return written.getvalue()
    return shell(command)


def shell(command: str) -> str:
    """Return what a command of a shell writes."""
    scripts = str(Path(sys.executable).parent)
    environment = {
        **os.environ,
        "PATH": os.pathsep.join((scripts, os.environ["PATH"])),
        "PYTHONPATH": os.pathsep.join((".", os.environ.get("PYTHONPATH", ""))),
        "PYTHONUTF8": "1",
        "COLUMNS": "80",
    }
    done = subprocess.run(
        ["bash", "-c", command],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env=environment,
        text=True,
        encoding="utf-8",
        check=False,
    )
    return done.stdout


def install(pyproject: str) -> None:
    """Make the entry points of a package known, as ``pip install -e .`` would."""
    project = tomllib.loads(pyproject)["project"]
    info = Path(f"{project['name'].replace('-', '_')}-{project['version']}.dist-info")
    info.mkdir()
    metadata = f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n"
    (info / "METADATA").write_text(metadata, encoding="utf-8")
    points = (
        f"[{group}]\n" + "".join(f"{name} = {target}\n" for name, target in entries.items())
        for group, entries in project["entry-points"].items()
    )
    (info / "entry_points.txt").write_text("\n".join(points), encoding="utf-8")


def test_a_wrong_output_in_a_page_is_noticed() -> None:
    """The comparison itself: it takes an ellipsis for anything, and nothing else."""
    run_console(Block(("console",), "$ echo one two\none …\n", 1), "here")
    with pytest.raises(AssertionError, match="printed"):
        run_console(Block(("console",), "$ echo one two\none\n", 1), "here")
    with pytest.raises(AssertionError, match="Got"):
        run_python(Block(("python",), ">>> 1 + 1\n3\n", 1), {}, "here")
