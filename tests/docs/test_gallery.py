"""The gallery: each command ends in a page of its own, with its picture."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.builders.gallery import GALLERY, PAGE, PICTURES, commands, make_pages
from tests.builders.pages import SDIST

PAGES = [page[0] for command in commands() if (page := PAGE.search(command))]


def test_each_page_of_the_gallery_has_a_picture() -> None:
    text = GALLERY.read_text(encoding="utf-8")
    pictures = [f"{page.removesuffix('.html')}.png" for page in PAGES]
    assert len(set(PAGES)) == len(PAGES) >= 12
    assert all(f"](../images/gallery/{picture})" in text for picture in pictures)
    if not SDIST:
        assert sorted(path.name for path in PICTURES.iterdir()) == sorted(pictures)


@pytest.mark.nightly
def test_each_command_of_the_gallery_writes_its_page(tmp_path: Path) -> None:
    """What CI leaves out: it takes a minute."""
    work = tmp_path / "work"
    work.mkdir()
    assert [page.name for page in make_pages(work, tmp_path / "pages")] == PAGES
