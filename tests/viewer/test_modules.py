"""The map as modules of another page: a site, a canvas, a theme and texts are enough."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from shutil import copytree
from threading import Thread
from typing import TYPE_CHECKING, Any

import pytest

from rightofway.io.sites import Choice, read_sites
from rightofway.languages import read_texts
from rightofway.viz import make_site_data
from rightofway.viz.page import document
from rightofway.viz.page.document import make_style_sheet
from tests.builders.canvases import Canvases

if TYPE_CHECKING:
    from playwright.sync_api import Browser

LAYOUTS = Path(__file__).parents[1] / "data" / "layouts"
ASSETS = Path(document.__file__).parent / "assets"

PAGE = """<!doctype html><title>editor</title><style>STYLE</style>
<div class="map" style="height: 400px"><canvas id="plot" tabindex="0"></canvas>
<div class="hover" hidden></div></div>
<script type="module">
import { MapView } from "./assets/map/map_view.js";
import { Site } from "./assets/plan/site.js";
import { Theme } from "./assets/drawing/theme.js";
import { learn, setLanguage } from "./assets/language/language.js";
learn({ en: await (await fetch("texts.json")).json() });
setLanguage("en");
const raw = await (await fetch("site.json")).json();
const view = new MapView(document.getElementById("plot"), new Site(raw), new Theme());
view.viewport.fit();
view.paint();
</script>"""


class Quiet(SimpleHTTPRequestHandler):
    """Serves files without a word."""

    def log_message(self, *_: Any) -> None:
        """Write nothing."""


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    copytree(ASSETS, tmp_path / "assets")
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(tmp_path)))
    Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}"
    server.shutdown()
    server.server_close()


def test_a_site_alone_is_drawn(browser: Browser, tmp_path: Path, address: str) -> None:
    ((_, site),) = read_sites(LAYOUTS / "plant.xml", Choice()).sites
    (tmp_path / "site.json").write_text(json.dumps(make_site_data(site)), encoding="utf-8")
    (tmp_path / "index.html").write_text(
        PAGE.replace("STYLE", make_style_sheet()), encoding="utf-8"
    )
    (tmp_path / "texts.json").write_text(json.dumps(read_texts()), encoding="utf-8")
    (tmp_path / "favicon.ico").write_bytes(b"")
    context = browser.new_context()
    viewer = Canvases(context.new_page())
    viewer.page.goto(f"{address}/index.html")
    names = {"Dock · Socket", "End · Saw 1"}
    viewer.poll(lambda: names <= {each.text for each in viewer.texts("plot")}, "names on the map")
    viewer.page.hover("#plot", position={"x": 200, "y": 200})
    assert "x " in viewer.text(".hover")
    assert viewer.complaints == []
    context.close()
