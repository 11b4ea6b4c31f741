"""What is refused before any route sees it, and by routes that see paths."""

from __future__ import annotations

import asyncio
import json
import posixpath
import re
import socket
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import httpx
import pytest
from PIL import Image

import rightofway
from rightofway.studio.guard import Access, Guard
from tests.builders.studios import DOOR, Client, running, sent
from tests.builders.suites import soon


def refused(answer: httpx.Response) -> str:
    """Return the message of an error, after checking its form."""
    error = answer.json()["error"]
    assert error["status"] == answer.status_code
    assert {"status", "kind", "message", "faults"} <= set(error)
    assert "Traceback" not in answer.text
    return str(error["message"])


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:80", "127.0.0.1", "", "127.0.0.1:1"]
)
def test_a_foreign_name_of_the_server_is_refused(client: httpx.Client, host: str) -> None:
    """A page whose name was made to lead to this address (DNS rebinding) names itself."""
    answer = client.get("/files", headers={"host": host})
    assert answer.status_code == 421
    assert "is no name of this studio" in refused(answer)


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1:1", "file://"])
@pytest.mark.parametrize("method", ["GET", "POST", "PUT", "DELETE"])
def test_a_page_of_another_origin_is_refused(
    client: httpx.Client, origin: str, method: str
) -> None:
    answer = client.request(method, "/files", headers={"origin": origin})
    assert answer.status_code == 403


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_a_request_of_another_site_is_refused_also_without_its_origin(
    client: httpx.Client, site: str
) -> None:
    headers = {"sec-fetch-site": site, "sec-fetch-mode": "no-cors"}
    assert client.get("/files", headers=headers).status_code == 403


def test_its_own_page_may_ask(client: httpx.Client) -> None:
    origin = str(client.base_url).removesuffix("/api/v1/")
    headers = {"origin": origin, "sec-fetch-site": "same-origin"}
    assert client.post("/validate", json={"document": DOOR}, headers=headers).status_code == 200


@pytest.mark.parametrize(
    "kind", ["text/plain", "application/x-www-form-urlencoded", "multipart/form-data", ""]
)
def test_a_body_that_a_form_can_send_is_refused(client: httpx.Client, kind: str) -> None:
    answer = client.post("/validate", content=b'{"document": {}}', headers={"content-type": kind})
    assert answer.status_code == 415


def test_no_answer_invites_other_origins(client: httpx.Client) -> None:
    asked = {"origin": "http://evil.example", "access-control-request-method": "PUT"}
    for answer in (client.get("/files"), client.options("/files", headers=asked)):
        assert not [name for name in answer.headers if name.startswith("access-control")]


def test_every_answer_has_the_headers_of_the_guard(client: httpx.Client) -> None:
    root = str(client.base_url).removesuffix("api/v1/")
    for path in ("", "studio/assets/main.js", "studio/no.js", "api/v1/files", "api/v1/nothing"):
        headers = client.get(f"{root}{path}").headers
        assert headers["x-content-type-options"] == "nosniff"
        assert "unsafe" not in headers["content-security-policy"]
        assert headers["content-security-policy"].startswith("default-src 'none'")


ESCAPES = [
    "../secret.yaml",
    "..%2fsecret.yaml",
    "%2e%2e/secret.yaml",
    "a/../../secret.yaml",
    "..%5csecret.yaml",
    "%2fetc%2fpasswd",
    "/etc/passwd",
    "//etc/passwd",
    "door.yaml%00.png",
    "link.yaml",
    "out/secret.yaml",
    ".hidden.yaml",
    ".rightofway-studio.sqlite",
    "C:%5csecret.yaml",
    "a" * 300,
    "a%0ab",
]


@pytest.mark.parametrize("path", ESCAPES)
@pytest.mark.parametrize("resource", ["files", "documents", "drafts/../files"])
def test_no_path_climbs_out_of_the_folder(client: httpx.Client, resource: str, path: str) -> None:
    status, text = sent(client, "GET", f"/api/v1/{resource}/{path}")
    assert status in {400, 404}
    assert json.loads(text)["error"]["status"] == status
    body, kind = json.dumps({"document": DOOR}).encode(), "application/json"
    if resource == "files":
        body, kind = b"overwritten", "application/octet-stream"
    status, text = sent(client, "PUT", f"/api/v1/{resource}/{path}", body, kind)
    assert status in {400, 404, 422}
    assert json.loads(text)["error"]["status"] == status


@pytest.mark.parametrize("assets", ["studio/assets", "viz/page/assets"])
@pytest.mark.parametrize("path", [*ESCAPES, "../__init__.py", "vendor/../../app.py", "index.py"])
def test_no_asset_is_outside_of_the_assets(client: httpx.Client, assets: str, path: str) -> None:
    status, text = sent(client, "GET", f"/{assets}/{path}")
    assert status in {400, 404}
    assert json.loads(text)["error"]["status"] == status


def test_no_part_of_an_answer_waits_for_an_acknowledgement(client: Client) -> None:
    """With Nagle's algorithm, the body of an answer follows its head after 40 ms."""
    client.get("/files")
    (connection, *_) = client.server.server_state.connections
    taken = connection.transport.get_extra_info("socket")
    assert taken.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)


def test_a_file_of_the_page_is_sent_once(client: httpx.Client) -> None:
    address = str(client.base_url).removesuffix("api/v1/") + "studio/assets/main.js"
    first = client.get(address)
    again = client.get(address, headers={"if-none-match": first.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")
    assert client.get(address, headers={"if-none-match": '"other"'}).content == first.content


def test_the_page_names_its_modules_in_advance(client: httpx.Client) -> None:
    """Their addresses are paths of files below the package: imports lead to files on disk."""
    root = str(client.base_url).removesuffix("/api/v1/")
    named = set(re.findall(r'modulepreload" href="(.*?)"', client.get(f"{root}/").text))
    assert "/viz/page/assets/language/words.js" in named
    package = Path(rightofway.__file__).parent
    for address in named:
        assert (package / address.removeprefix("/")).is_file()
        folder = posixpath.dirname(address)
        module = client.get(f"{root}{address}")
        assert module.status_code == 200
        imported = re.findall(r'^import [^;]*?"(\S+)";$', module.text, re.MULTILINE)
        assert {posixpath.normpath(f"{folder}/{each}") for each in imported} <= named


OUTSIDE = ["../secret.yaml", "/etc/hostname", "link.yaml", "out/secret.yaml"]


@pytest.mark.parametrize("name", OUTSIDE)
@pytest.mark.parametrize(
    "part",
    [
        lambda name: {"map": {"file": name}},
        lambda name: {"map": {"layout": name}},
        lambda name: {"robots": {"table": name}},
        lambda name: {"robots": {"scen": name}},
    ],
    ids=["file", "layout", "table", "scen"],
)
def test_a_document_cannot_name_a_file_outside_of_the_folder(
    client: httpx.Client, part: Callable[[str], dict[str, Any]], name: str
) -> None:
    verdict = client.post("/validate", json={"document": {**DOOR, **part(name)}}).json()
    assert not verdict["ok"]
    assert "outside of the folder" in verdict["faults"][0]["message"]


def test_a_layout_cannot_name_a_picture_outside_of_the_folder(
    client: httpx.Client, folder: Path
) -> None:
    Image.new("L", (4, 4), 255).save(folder.parent / "secret.png")
    lines = "resolution: 0.5", "origin: [0, 0, 0]", "negate: 0"
    limits = "occupied_thresh: 0.65", "free_thresh: 0.25"
    for name, is_there in (("../secret.png", False), ("inside.png", True)):
        Image.new("L", (4, 4), 255).save(folder / "inside.png")
        (folder / "ros.yaml").write_text("\n".join((f"image: {name}", *lines, *limits)))
        opened = client.get("/documents/ros.yaml")
        assert opened.is_success == is_there, opened.text
        assert is_there or "outside of the folder" in opened.text


@pytest.mark.parametrize("place", ["..", "/", "../floor", "a/../..", ".", "out"])
def test_a_document_cannot_stand_outside_of_the_folder(client: httpx.Client, place: str) -> None:
    answer = client.post("/validate", json={"document": DOOR, "folder": place})
    assert answer.status_code == 400


def test_a_body_that_is_too_long_is_refused_before_it_is_read(client: httpx.Client) -> None:
    with socket.create_connection((client.base_url.host, client.base_url.port)) as connection:
        host = f"{client.base_url.host}:{client.base_url.port}"
        head = ("POST /api/v1/validate HTTP/1.1", f"Host: {host}", f"Content-Length: {10**8}")
        connection.sendall("\r\n".join((*head, "Content-Type: application/json", "", "")).encode())
        assert connection.recv(1000).startswith(b"HTTP/1.1 413 ")


def test_a_body_without_a_length_is_cut_off(client: httpx.Client) -> None:
    parts = (b" " * 10**6 for _ in range(25))
    kind = {"content-type": "application/json"}
    answer = client.post("/validate", content=parts, headers=kind)
    assert answer.status_code == 413
    refused(answer)


MALFORMED = [
    b"",
    b"{",
    b"[]",
    b"null",
    b"1",
    b'"text"',
    b"\xff\xfe",
    b'{"document": NaN}',
    b'{"document": {"a": NaN}}',
    b'{"document": {"a": 1e999}}',
    b'{"document": {"a": "\\ud800"}}',
    b'{"document": ' + b"[" * 100_000,
    b'{"document": {"a": ' + b"[" * 900 + b"]" * 900 + b"}}",
    b'{"document": {"map": "..."}}',
    b'{"document": {"format": "rightofway-scenario/1", "map": {"grid": 3}, "robots": "all"}}',
]


@pytest.mark.parametrize("body", MALFORMED)
@pytest.mark.parametrize("path", ["/validate", "/runs", "/convert"])
def test_a_malformed_body_has_an_answer_in_the_one_form(
    client: httpx.Client, path: str, body: bytes
) -> None:
    answer = client.post(path, content=body, headers={"content-type": "application/json"})
    assert answer.status_code < 500
    if answer.status_code >= 400:
        refused(answer)


def test_elsewhere_each_request_needs_the_token(folder: Path) -> None:
    access = Access.on("0.0.0.0", 0)  # noqa: S104 (the access to it, not the address)
    with running(folder, access, keeps=False) as client:
        assert client.get("/files").status_code == 401
        wrong = {"authorization": "Bearer wrong"}
        assert client.get("/files", headers=wrong).status_code == 401
        right = {"authorization": f"Bearer {access.token}"}
        assert client.get("/files", headers=right).status_code == 200
        root = str(client.base_url).removesuffix("api/v1/")
        signed = client.get(root, params={"token": access.token})
        assert 'content="0; url=/"' in signed.text
        assert {"HttpOnly", "SameSite=Strict"} <= set(signed.headers["set-cookie"].split("; "))
        assert client.get("/files").status_code == 200  # by the cookie


@pytest.mark.parametrize("name", ["numpy.py", "door", "run.sh", "page.html", "lib.so"])
def test_only_files_that_can_be_opened_are_put_into_the_folder(
    client: httpx.Client, name: str
) -> None:
    kind = {"content-type": "application/octet-stream"}
    assert client.put(f"/files/{name}", content=b"x", headers=kind).status_code == 400


def test_many_large_bodies_at_once_wait_for_each_other(client: httpx.Client) -> None:
    body = json.dumps({"document": {**DOOR, "note": "x" * 2_000_000}}).encode()
    kind = {"content-type": "application/json"}
    with ThreadPoolExecutor(20) as pool:
        send = partial(client.post, "/validate", content=body, headers=kind)
        answers = list(pool.map(lambda _: send().status_code, range(20)))
    assert set(answers) == {200}


def test_a_defect_of_ours_is_one_line_and_one_form(capsys: pytest.CaptureFixture[str]) -> None:
    async def broken(*_: Any) -> None:
        raise RuntimeError("first line\nsecond line")

    sent_back: list[Any] = []

    async def receive() -> dict[str, Any]:
        return {"type": "http.request", "body": b""}

    async def send(message: Any) -> None:
        sent_back.append(message)

    scope = {"type": "http", "method": "GET", "path": "/x", "query_string": b""}
    guard = Guard(broken, Access(hosts=None))
    asyncio.run(guard({**scope, "headers": [(b"host", b"h")]}, receive, send))
    assert sent_back[0]["status"] == 500
    error = json.loads(sent_back[1]["body"])["error"]
    assert error["message"] == "unexpected RuntimeError: first line second line (please report it)"
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize(
    "wrong",
    [
        b"Transfer-Encoding: chunked\r\nContent-Length: 2\r\n\r\n2\r\n{}\r\n0\r\n\r\n",
        b"Content-Length: 2\r\nContent-Length: 40\r\n\r\n{}",
        b"Transfer-Encoding: identity, chunked\r\n\r\n0\r\n\r\n",
        b"Transfer-Encoding: xchunked\r\n\r\n0\r\n\r\n",
        b"Content-Length: -1\r\n\r\n",
        b"Content-Length: +2\r\n\r\n{}",
        b"Content-Length: 2\r\nHost: evil.example\r\n\r\n{}",
    ],
)
def test_a_body_that_two_servers_may_cut_differently_ends_the_connection(
    client: httpx.Client, wrong: bytes
) -> None:
    """A proxy and the studio must not see different requests (request smuggling)."""
    head = b"POST /api/v1/validate HTTP/1.1\r\nHost: %s\r\nContent-Type: application/json\r\n"
    second = b"GET /api/v1/files HTTP/1.1\r\nHost: %s\r\n\r\n"
    host = f"{client.base_url.host}:{client.base_url.port}".encode()
    said = answers(client, head % host + wrong + second % host)
    assert said.startswith(b"HTTP/1.1 400 ")
    assert said.count(b"HTTP/1.1") == 1


def answers(client: httpx.Client, request: bytes) -> bytes:
    """Send bytes, and return all that comes back until the connection ends."""
    with socket.create_connection((client.base_url.host, client.base_url.port), 10) as connection:
        connection.sendall(request)
        with connection.makefile("rb") as said:
            return said.read()


def test_headers_that_are_too_long_are_refused(client: httpx.Client) -> None:
    answer = client.get("/files", headers={"x-note": "a" * 15_990})
    assert answer.status_code == 431
    assert "longer than 16000 bytes" in refused(answer)


@pytest.mark.parametrize("drip", [b"", b" "])
def test_a_body_that_comes_too_slowly_is_given_up(
    client: httpx.Client, monkeypatch: pytest.MonkeyPatch, drip: bytes
) -> None:
    """A client is silent within a body, or sends a byte from time to time."""
    monkeypatch.setattr("rightofway.studio.guard.STALLS", 0.3)
    monkeypatch.setattr("rightofway.studio.guard.TAKES", 0.6)
    host = f"{client.base_url.host}:{client.base_url.port}"
    head = f"PUT /api/v1/files/slow.yaml HTTP/1.1\r\nHost: {host}\r\nContent-Length: 1000000\r\n"
    with socket.create_connection((client.base_url.host, client.base_url.port), 10) as connection:
        connection.sendall(f"{head}Content-Type: application/octet-stream\r\n\r\n".encode())
        connection.settimeout(0.1)
        said = b""
        while not said:
            with suppress(TimeoutError):
                said = connection.recv(1000)
            if not said:  # else the other end has closed, and takes no more
                connection.sendall(drip)
    assert said.startswith(b"HTTP/1.1 408 ")
    assert client.get("/files").status_code == 200


def test_a_stream_that_nobody_reads_is_ended(
    client: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rightofway.studio.guard.UNREAD", 0.2)
    monkeypatch.setattr("rightofway.studio.events.HEARTBEAT", 0.1)
    monkeypatch.setattr("rightofway.studio.routes.runs._write_line", lambda _: "x" * 10**7)
    host = f"{client.base_url.host}:{client.base_url.port}"
    with socket.create_connection((client.base_url.host, client.base_url.port), 10) as connection:
        connection.sendall(f"GET /api/v1/events HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
        streams = client.studio.runs._listeners._of
        assert soon(lambda: streams)  # it has begun ...
        assert soon(lambda: not streams)  # ... and nobody reads it
        connection.settimeout(2)
        read = 0
        while part := connection.recv(10**6):
            read += len(part)
    assert read < 2 * 10**7  # a part that is sent already is all there is


def test_http_1_0_without_a_name_of_the_server_is_refused(client: httpx.Client) -> None:
    assert answers(client, b"GET /api/v1/files HTTP/1.0\r\n\r\n").startswith(b"HTTP/1.1 421 ")


def test_no_connection_becomes_a_websocket(client: httpx.Client) -> None:
    upgrade = {"connection": "Upgrade", "upgrade": "websocket", "sec-websocket-version": "13"}
    headers = {**upgrade, "sec-websocket-key": "dGhlIHNhbXBsZSBub25jZQ=="}
    assert client.get("/files", headers=headers).status_code == 200
    headers["origin"] = "http://evil.example"
    assert client.get("/files", headers=headers).status_code == 403


@pytest.mark.parametrize("is_after_another", [False, True])
@pytest.mark.parametrize("part", ["", "GET /api/v1/files HTTP/1.1\r\nHost: "])
def test_a_connection_without_a_whole_request_is_closed(
    client: httpx.Client, monkeypatch: pytest.MonkeyPatch, part: str, *, is_after_another: bool
) -> None:
    monkeypatch.setattr("rightofway.studio.connections.PATIENCE", 0.3)
    host = f"{client.base_url.host}:{client.base_url.port}"
    whole = f"GET /api/v1/files HTTP/1.1\r\nHost: {host}\r\n\r\n" if is_after_another else ""
    began = time.monotonic()
    with suppress(ConnectionResetError):
        answers(client, f"{whole}{part}".encode())
    assert time.monotonic() - began < 8  # a connection that has had an answer may rest for 5 s
