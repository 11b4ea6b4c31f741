"""Make the pages of the gallery: ``python -m tests.builders.gallery FOLDER [--pictures]``.

docs/gallery/index.md has the commands, in blocks of the kind ``sh gallery``, and the files that
they read. Each command is run in a folder that has the examples and samples of the repository.
With ``--pictures`` a headless Chromium takes the picture of each page.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image

from tests.builders.browsers import FRAMES, chromium
from tests.builders.pages import DOCS, ROOT, blocks

__all__ = ["GALLERY", "commands", "make_pages"]

GALLERY = DOCS / "gallery" / "index.md"
PICTURES = DOCS / "images" / "gallery"
TICKS = {
    "warehouse": 120,
    "jobs": 40,
    "plant": 12000,
    "ros": 600,
    "laps": 40,
    "discs": 16,
    "zone": 1200,
}
"""Instants that pictures show, where it is not tick 4."""

SMALL = (800, 500)
"""Width and height of a picture [pixels]."""

PAGE = re.compile(r"\b[\w-]+\.html$")


def commands() -> Iterator[str]:
    """Yield the commands of the gallery in order."""
    for block in blocks(GALLERY):
        if block.info == ("sh", "gallery"):
            yield from block.text.splitlines()


def make_pages(work: Path, folder: Path) -> list[Path]:
    """Run all commands in one folder and return the pages, moved to another folder."""
    for name in ("examples", "tests"):
        (work / name).symlink_to(ROOT / name)
    for block in blocks(GALLERY):
        if block.file_name is not None:
            (work / block.file_name).write_text(block.text, encoding="utf-8")
    scripts = Path(sys.executable).parent
    environment = {**os.environ, "PATH": os.pathsep.join((str(scripts), os.environ["PATH"]))}
    folder.mkdir(parents=True, exist_ok=True)
    pages = []
    for command in commands():
        sys.stdout.write(f"{command}\n")
        subprocess.run(
            ["bash", "-c", command],
            cwd=work,
            env=environment,
            check=True,
            stdout=subprocess.DEVNULL,
        )
        if page := PAGE.search(command):
            pages.append(Path(shutil.move(work / page[0], folder / page[0])))
    return pages


def take_pictures(pages: Iterable[Path]) -> None:
    """Write a picture of each page, in the middle of what it plays."""
    PICTURES.mkdir(exist_ok=True)
    with chromium() as browser:
        view = browser.new_page(viewport={"width": 1120, "height": 700})
        for page in pages:
            view.goto(f"{page.resolve().as_uri()}#tick={TICKS.get(page.stem, 4)}")
            view.evaluate(FRAMES)
            picture = Image.open(BytesIO(view.screenshot()))
            small = picture.convert("RGB").resize(SMALL, Image.Resampling.LANCZOS)
            small = small.quantize(256, kmeans=4)
            small.save(PICTURES / f"{page.stem}.png", optimize=True)


if __name__ == "__main__":
    target = Path(sys.argv[1])
    with TemporaryDirectory() as folder:
        made = make_pages(Path(folder), target)
    if "--pictures" in sys.argv[2:]:
        take_pictures(made)
