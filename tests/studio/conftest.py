"""One studio for all tests that leave it as it was, in a folder with examples."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from tests.builders.studios import running

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with scenarios, a workbook's neighbour, and a secret beside it."""
    outside = tmp_path_factory.mktemp("site")
    (outside / "secret.yaml").write_text("format: secret\n")
    folder = outside / "floor"
    folder.mkdir()
    for name in ("door.yaml", "bay.yaml", "floor.yaml"):
        shutil.copy(EXAMPLES / name, folder)
    (folder / "link.yaml").symlink_to(outside / "secret.yaml")
    (folder / "out").symlink_to(outside)
    (folder / ".hidden.yaml").write_text("format: hidden\n")
    return folder


@pytest.fixture(scope="session")
def client(folder: Path) -> Iterator[httpx.Client]:
    """Return a client of a studio on that folder."""
    with running(folder) as client:
        yield client
