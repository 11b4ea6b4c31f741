"""One studio for all tests of its API, in a folder with examples; each page has one of its own."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.builders.drawing import Opener, StudioPage, studio_page
from tests.builders.studios import Client, running

if TYPE_CHECKING:
    from playwright.sync_api import Browser

EXAMPLES = Path(__file__).parents[2] / "examples"


def furnish(folder: Path) -> None:
    """Put examples into a folder, and a secret beside it that links lead to."""
    outside = folder.parent
    (outside / "secret.yaml").write_text("format: secret\n")
    for name in ("door.yaml", "bay.yaml", "floor.yaml"):
        shutil.copy(EXAMPLES / name, folder)
    (folder / "link.yaml").symlink_to(outside / "secret.yaml")
    (folder / "out").symlink_to(outside)
    (folder / ".hidden.yaml").write_text("format: hidden\n")


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder that all tests of the API share."""
    folder = tmp_path_factory.mktemp("site") / "floor"
    folder.mkdir()
    furnish(folder)
    return folder


@pytest.fixture(scope="session")
def client(folder: Path) -> Iterator[Client]:
    """Return a client of a studio on that folder."""
    with running(folder) as client:
        yield client


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Client]:
    """Return a client of the server that pages share; they begin with `empty` or `site`."""
    folder = tmp_path_factory.mktemp("pages") / "floor"
    folder.mkdir()
    with running(folder, keeps=False) as client:
        yield client


@pytest.fixture
def empty(server: Client) -> Client:
    """Return a client of a studio without files, drafts and runs."""
    server.renew()
    return server


@pytest.fixture
def site(empty: Client) -> Client:
    """Return a client of a studio on a folder with examples."""
    furnish(empty.folder)
    return empty


@pytest.fixture
def studio(browser: Browser, site: Client) -> Iterator[StudioPage]:
    """Return the page of a studio at its start."""
    with studio_page(browser, site, viewport={"width": 1440, "height": 900}) as studio:
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


@pytest.fixture
def opened(browser: Browser, empty: Client) -> Iterator[Opener]:
    """Yield a function that opens a scenario in a studio of its own, at its tab of plans."""
    with ExitStack() as pages:

        def open_studio(text: str) -> StudioPage:
            empty.studio.file = "floor.yaml"
            (empty.folder / "floor.yaml").write_text(text)
            size = {"width": 1440, "height": 900}
            studio = pages.enter_context(studio_page(browser, empty, viewport=size))
            studio.opened()
            studio.tab("Plan")
            return studio

        yield open_studio
