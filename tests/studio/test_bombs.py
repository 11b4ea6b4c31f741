"""Files and names that mean harm: small ones that unfold to large ones, and text that is code."""

from __future__ import annotations

import io
import json
import re
import struct
import time
import zipfile
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import httpx
import openpyxl  # type: ignore[import-untyped]
import pytest

from tests.builders.browsers import Viewer, needs_browser
from tests.builders.drawing import StudioPage
from tests.builders.studios import DOOR, planned, running

if TYPE_CHECKING:
    from playwright.sync_api import Browser

SOON = 20.0
"""An answer to a bomb comes within that time, long before a worker is killed [s]."""

RAW = {"content-type": "application/octet-stream"}


def aliases() -> bytes:
    """Return nine lists of nine times the list before: 387 million values."""
    lines = ["a0: &a0 [x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 10)]
    return "\n".join(lines).encode()


def merges() -> bytes:
    lines = ["a0: &a0 {k: 1}"]
    lines += [f"a{n}: &a{n} {{<<: [{', '.join([f'*a{n - 1}'] * 9)}]}}" for n in range(1, 10)]
    return "\n".join(lines).encode()


def laughs(element: str) -> bytes:
    """Return entities that each stand for ten of the one before."""
    entities = ["<!ENTITY e0 'ha'>"]
    entities += [f"<!ENTITY e{n} '{f'&e{n - 1};' * 10}'>" for n in range(1, 10)]
    text = f"<!DOCTYPE {element} [{''.join(entities)}]><{element}>&e9;</{element}>"
    return f"<?xml version='1.0'?>{text}".encode()


def secret_entity() -> bytes:
    return b"<!DOCTYPE model [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><model>&x;</model>"


def workbook() -> bytes:
    """Return a workbook whose only part is 300 MB of spaces."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("xl/workbook.xml", b" " * 300_000_000)
    return made.getvalue()


def picture(width: int, height: int) -> bytes:
    """Return a PNG that says that it is larger than it is."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        checked = kind + data
        return struct.pack(">I", len(data)) + checked + struct.pack(">I", zlib.crc32(checked))

    size = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) + chunk(b"IDAT", zlib.compress(b"\0" * 10**6))
    )


ROS = b"""image: bomb.png
resolution: 0.05
origin: [0, 0, 0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.2
"""
BOMBS = {
    "aliases.yaml": (aliases, "aliases stand for more than"),
    "merges.yaml": (merges, "aliases stand for more than"),
    "circle.yaml": (lambda: b"a: &a {b: *a}", "stands inside what it names"),
    "call.yaml": (lambda: b"!!python/object/apply:os.system ['true']", "is not allowed"),
    "deep.yaml": (lambda: b"[" * 100_000, "nested more than"),
    "deep.json": (lambda: b"[" * 100_000, "nested more than"),
    "deep.xml": (lambda: b"<model>" + b"<a>" * 100_000, "more than 64 deep"),
    "laughs.graphml": (lambda: laughs("graphml"), "is not allowed"),
    "laughs.xml": (lambda: laughs("model"), "is not allowed"),
    "secret.xml": (secret_entity, "is not allowed"),
    "spaces.xlsx": (workbook, "longer than"),
    "picture.yaml": (lambda: ROS, "more than 64000000 pixels"),
    "far.map": (lambda: b"type octile\nheight 9999999999\nwidth 9999999999\nmap\n.", "no size"),
}


@pytest.mark.parametrize("name", BOMBS)
def test_a_file_that_unfolds_without_end_is_refused_soon(client: httpx.Client, name: str) -> None:
    made, message = BOMBS[name]
    client.put("/files/bomb.png?replace=true", content=picture(60_000, 60_000), headers=RAW)
    put = client.put(f"/files/{name}?replace=true", content=made(), headers=RAW)
    assert put.status_code == 200, put.text
    began = time.monotonic()
    opened = client.get(f"/documents/{name}")
    assert time.monotonic() - began < SOON
    assert opened.status_code == 422
    assert message in opened.json()["error"]["message"]


def test_numbers_without_end_are_faults_at_their_places(client: httpx.Client) -> None:
    robot = b'{"name": "R1", "home": "N0", "target": "N1", "speed": %s, "work": %s}'
    text = b'{"format": "rightofway-scenario/1", "map": {"grid": ["..."], "cell_size": %s},'
    numbers = b"1e400", b"9" * 10**6, b"1e-999999999"
    content = (text + b'"robots": [' + robot + b"]}") % numbers
    client.put("/files/numbers.json?replace=true", content=content, headers=RAW)
    document = client.get("/documents/numbers.json").json()["document"]
    faults = client.post("/validate", json={"document": document}).json()["faults"]
    assert {fault["place"] for fault in faults} >= {"map.cell_size", "robots[0].speed"}
    assert all(len(fault["message"]) < 300 for fault in faults)


FORMULA = '=HYPERLINK("http://evil.example")'
SCRIPT = "</script><script>window.injected = 1</script><img src=x onerror='injected = 1'>"


@pytest.mark.parametrize("name", [FORMULA, "+1+1", "@SUM(1)", "-2+3"])
def test_no_name_becomes_a_formula_in_a_workbook(client: httpx.Client, name: str) -> None:
    document = {**DOOR, "robots": [{**DOOR["robots"][0], "name": name}, DOOR["robots"][1]]}
    number = planned(client, document, name=name)["number"]
    exported = client.get(f"/runs/{number}/export/xlsx").content
    text = {"document": document, "name": "door.xlsx"}
    for content in (exported, client.post("/convert", json=text).content):
        sheets = openpyxl.load_workbook(io.BytesIO(content))
        cells = [cell for sheet in sheets for row in sheet.rows for cell in row]
        assert name in {cell.value for cell in cells}
        assert not [cell.value for cell in cells if cell.data_type == "f"]


@needs_browser
def test_no_name_becomes_markup_on_any_page(browser: Browser, tmp_path: Path) -> None:
    robots = [{**robot, "name": f"{SCRIPT}{k}"} for k, robot in enumerate(DOOR["robots"])]
    (tmp_path / "evil.yaml").write_text(json.dumps({**DOOR, "robots": robots}))
    with running(tmp_path, keeps=False, file="evil.yaml") as client:
        client.put(f"/drafts/{quote('<img src=x onerror=alert(1)>')}", json={"document": {}})
        number = planned(client, {**DOOR, "robots": robots}, name=SCRIPT[:200])["number"]
        root = str(client.base_url).removesuffix("api/v1/")
        context = browser.new_context(locale="en-GB", reduced_motion="reduce")
        studio = StudioPage(context.new_page(), root)
        studio.opened()
        studio.tab("Plan")
        studio.row(number).get_by_role("button", name=f"Play: {number}").click()
        studio.shown(number)
        for tab in ("Map", "Robots", "Plan"):
            studio.tab(tab)
        studio.start()
        page = Viewer(context.new_page())
        page.page.goto(f"{root}api/v1/runs/{number}/page")
        page.page.get_by_role("slider", name="Time").wait_for()
        for seen in (studio, page):
            assert seen.page.evaluate("window.injected") is None
            assert seen.page.locator("img[src=x]").count() == 0
            assert seen.complaints == []
        context.close()


@pytest.mark.parametrize("name", ["a\x1b[31m", "a\u202eb", "a\nb", "a\u2028b", "a\0"])
def test_names_that_cannot_be_printed_are_refused(client: httpx.Client, name: str) -> None:
    number = planned(client)["number"]
    kind = {"content-type": "application/json"}
    body = json.dumps({"name": name})
    refused = client.patch(f"/runs/{number}", content=body, headers=kind)
    assert refused.status_code == 422
    assert "can be printed" in refused.json()["error"]["message"]
    path = quote(f"{name}.yaml")
    assert client.put(f"/files/{path}", content=b"x", headers=RAW).status_code == 400
    assert client.put(f"/drafts/{path}", json={"document": {}}).status_code == 400


@pytest.mark.parametrize("name", ["a'b.yaml", "ü.yaml", "a;b.yaml", "$(id).yaml", "-rf.yaml"])
def test_no_file_name_reaches_a_header_or_is_an_option_of_the_command(
    client: httpx.Client, name: str
) -> None:
    client.put(f"/files/{quote(name)}?replace=true", content=json.dumps(DOOR), headers=RAW)
    headers = client.get(f"/files/{quote(name)}").headers
    assert headers["content-disposition"] == "attachment"
    run: Any = planned(client, source=name)
    command = client.get(f"/runs/{run['number']}/command").json()["command"]
    assert command.split()[2][0] != "-"
    disposition = client.get(f"/runs/{run['number']}/export/json").headers["content-disposition"]
    assert re.fullmatch(r'attachment; filename="[a-z0-9-]+\.json"', disposition)
