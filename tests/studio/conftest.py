"""One studio for all tests of its API, in a folder with examples; each page has one of its own."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import httpx
import pytest

from tests.builders.drawing import StudioPage, studio_page
from tests.builders.studios import running

if TYPE_CHECKING:
    from playwright.sync_api import Browser

EXAMPLES = Path(__file__).parents[2] / "examples"


def furnished(outside: Path) -> Path:
    """Return a folder with scenarios, a workbook's neighbour, and a secret beside it."""
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
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder that all tests of the API share."""
    return furnished(tmp_path_factory.mktemp("site"))


@pytest.fixture
def own_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of one test."""
    return furnished(tmp_path_factory.mktemp("site"))


@pytest.fixture(scope="session")
def client(folder: Path) -> Iterator[httpx.Client]:
    """Return a client of a studio on that folder."""
    with running(folder) as client:
        yield client


@pytest.fixture
def studio(browser: Browser, own_folder: Path) -> Iterator[StudioPage]:
    """Return the page of a studio at its start."""
    with studio_page(browser, own_folder, size=(1440, 900), keeps=False) as studio:
        yield studio


@pytest.fixture
def floor(studio: StudioPage) -> StudioPage:
    """Return the page with a floor of 12 x 8 m in cells of 0.5 m."""
    studio.button("Create the floor").click()
    studio.opened()
    return studio


@pytest.fixture
def lanes(studio: StudioPage) -> StudioPage:
    """Return the page with a roadmap of one lane: V1 at (0, 0), V2 at (4, 0)."""
    studio.button("Draw lanes instead").click()
    studio.opened()
    return studio
