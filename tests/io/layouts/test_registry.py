"""Formats of other packages."""

from fractions import Fraction
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from rightofway.io import layouts, read_layout
from rightofway.io.layouts import LayoutFormat, formats
from rightofway.site.layout import Layout, LayoutVertex, Level

ORIGIN = Fraction(0), Fraction(0)

LINES = LayoutFormat(
    summary="a name on each line",
    content="text",
    recognizes=lambda text: text.startswith("places:"),
    read=lambda text, _: Layout(
        kind="list",
        levels=(
            Level(
                name="",
                vertices=tuple(LayoutVertex(name=name, at=ORIGIN) for name in text.split()[1:]),
                edges=(),
            ),
        ),
    ),
)


def test_other_packages_add_formats(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    point = EntryPoint("lines", f"{__name__}:LINES", formats.GROUP)
    monkeypatch.setattr(EntryPoint, "load", lambda _: LINES)
    monkeypatch.setattr("importlib.metadata.entry_points", lambda group: [point] if group else [])
    layouts.list_layout_formats.cache_clear()
    path = tmp_path / "places"
    path.write_text("places: dock press", encoding="utf-8")
    found = read_layout(path)
    layouts.list_layout_formats.cache_clear()
    assert isinstance(found, Layout)
    assert [vertex.name for vertex in found.get_level().vertices] == ["dock", "press"]
