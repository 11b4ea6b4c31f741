"""What a notebook is given of a plan."""

import base64

import pytest

from rightofway.viz import bundle_of, make_png
from rightofway.viz.page import widget
from tests.builders.plans import door


def test_a_notebook_with_anywidget_has_a_live_page_and_a_picture_for_elsewhere(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pytest.importorskip("anywidget")
    monkeypatch.setattr(widget, "is_in_notebook", lambda: True)
    bundle = door()._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in bundle
    assert base64.b64decode(bundle["image/png"]) == make_png(door())
    assert bundle["text/html"].endswith(f'{bundle["image/png"]}">')  # and no frame
    assert bundle["text/plain"] == repr(door())


def test_a_notebook_without_anywidget_falls_back_to_the_frame(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(widget, "is_in_notebook", lambda: True)
    monkeypatch.setattr(widget, "find_spec", lambda _name: None)
    with pytest.raises(NotImplementedError):
        bundle_of(door())


def test_a_terminal_draws_nothing() -> None:
    assert not widget.is_in_notebook()
    with pytest.raises(NotImplementedError):
        bundle_of(door())
