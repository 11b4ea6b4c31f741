"""Conditions of a request before any route sees it, and the headers of every answer.

Each page that is open in the same browser can send requests to this server. So a request must name
the server by a name of its own (a foreign page that has its name lead here, by DNS rebinding, names
itself), must not come from a foreign page, and what it changes must be JSON, which a form cannot
send. Where the server listens to other machines, each request also needs the token.
"""

from __future__ import annotations

import asyncio
import json
import secrets
import sys
import time
from collections.abc import Awaitable, Callable, MutableMapping
from contextlib import nullcontext
from dataclasses import dataclass, field
from html import escape
from http.cookies import CookieError, SimpleCookie
from ipaddress import ip_address
from typing import Any
from urllib.parse import parse_qs, unquote_to_bytes, urlencode

from starlette.exceptions import HTTPException

from rightofway.errors import describe_defect
from rightofway.studio.errors import Refused, StudioError
from rightofway.studio.workspace import CLIMBS

MAX_BODY = 20_000_000
"""The longest body of a request [bytes]."""

LONGEST_PATH = 2000
"""The longest path of a request, with its query [bytes]."""

LONGEST_HEAD = 16_000
"""The headers of a request, all together [bytes]."""

STALLS, TAKES = 10.0, 60.0
"""A client may be silent that long within a body, and its body may take that long to come [s]."""

UNREAD = 30.0
"""A client that reads nothing of a stream of events for so long is hung up on [s]."""

LARGE_BODY, MOST_LARGE = 1_000_000, 8
"""So many requests with a body of more bytes are worked on at once; the others wait."""

HTTP = 80
"""The port that an address does not name."""

COOKIE = "rightofway-token"
"""Name of the cookie of the token."""

TOO_SLOW = 408
"""The status of a request whose body does not come; its connection is closed."""

CUT_OFF = {400, 413}
"""Statuses of a refusal after which the rest of what a client has sent is not read."""

READS = {"GET", "HEAD"}
CHANGES = {"POST", "PUT", "PATCH", "DELETE"}

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; font-src 'self'; frame-src 'self'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'self'"
)
"""The content policy of the studio's pages, unless a route has its own."""

HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cache-control", b"no-store"),
)

Scope = MutableMapping[str, Any]
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Access:
    """The permitted senders of requests.

    Attributes
    ----------
    hosts
        Names by which the server may be called, with port; None for any.
    token
        The token that a request must show; empty for none.
    """

    hosts: frozenset[str] | None
    token: str = ""

    @classmethod
    def on(cls, host: str, port: int) -> Access:
        """Return the access to a server that listens on an address."""
        if is_loopback(host):
            names = ("127.0.0.1", "localhost", "[::1]", host)
            usual = names if port == HTTP else ()
            return cls(hosts=frozenset([*usual, *(f"{name}:{port}" for name in names)]))
        return cls(hosts=None, token=secrets.token_urlsafe(24))


def is_loopback(host: str) -> bool:
    """Return whether only this machine reaches an address."""
    if host == "localhost":
        return True
    try:
        return ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return False


@dataclass(slots=True)
class _Request:
    """A request, as far as it is judged before its body is read."""

    scope: Scope
    headers: dict[bytes, bytes] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name, value in self.scope["headers"]:
            if name in self.headers and name in {b"host", b"origin", b"content-length"}:
                raise Refused(f"the header {name.decode()} stands twice (send it once)")
            self.headers[name] = value

    @property
    def is_large(self) -> bool:
        """Whether its body is large, or may be."""
        length = self.get_header("content-length")
        return bool(self.get_header("transfer-encoding")) or int(length or 0) > LARGE_BODY

    @property
    def length_of_head(self) -> int:
        """Length of its headers [bytes]."""
        return sum(len(name) + len(value) for name, value in self.scope["headers"])

    def get_header(self, name: str) -> str:
        """Return a header, empty where there is none."""
        return self.headers.get(name.encode(), b"").decode("latin-1")


class Guard:
    """Refuses requests, bounds their bodies, and puts headers on answers.

    Parameters
    ----------
    app
        The application that gets the requests that are not refused.
    access
        Who may send requests.
    """

    def __init__(self, app: App, access: Access) -> None:
        self._app = app
        self._access = access
        self._large = asyncio.Semaphore(MOST_LARGE)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        if scope["type"] != "http":
            await send({"type": "websocket.close", "code": 1008})
            return
        answer = _Answer(send)
        try:
            request = _Request(scope)
            self._refuse_foreign(request)
            if await self._is_sign_in(request, answer):
                return
            self._ask_token(request)
            async with self._large if request.is_large else nullcontext():
                await self._app(scope, _Body(receive).receive, answer.send)
        except StudioError as refused:
            await answer.refuse(refused.status, refused.error)
        except Exception as error:  # noqa: BLE001 (a defect of ours: one line, and the server goes on)
            message = describe_defect(error)
            print(message, file=sys.stderr)  # noqa: T201 (a server's log)
            await answer.refuse(500, {"kind": "defect", "message": message})

    def _refuse_foreign(self, request: _Request) -> None:
        """Refuse all requests but those of our own page, a program here, or an address bar."""
        scope, method = request.scope, request.scope["method"]
        if method not in READS | CHANGES:
            raise Refused(
                f"the method {method[:20]!r} is not known (see /api/v1/openapi.json)", 405
            )
        raw = scope.get("raw_path") or scope["path"].encode()
        if len(raw) + len(scope["query_string"]) > LONGEST_PATH:
            raise Refused(f"the path is longer than {LONGEST_PATH} bytes (shorten it)", 414)
        if request.length_of_head > LONGEST_HEAD:
            raise Refused(f"the headers are longer than {LONGEST_HEAD} bytes (send fewer)", 431)
        if CLIMBS.search(unquote_to_bytes(raw)):
            raise Refused("the path has a part that climbs, or a control code (give plain names)")
        host, origin = request.get_header("host"), request.get_header("origin")
        if self._access.hosts is not None and host.lower() not in self._access.hosts:
            names = " or ".join(sorted(self._access.hosts)[:2])
            raise Refused(f"{host[:100]!r} is no name of this studio (call it {names})", 421)
        if origin and origin.lower() not in {f"http://{host}".lower(), f"https://{host}".lower()}:
            raise Refused("a page of another origin asks (open the studio itself)", 403)
        site, mode = request.get_header("sec-fetch-site"), request.get_header("sec-fetch-mode")
        is_opened = method in READS and mode == "navigate" and scope["path"] == "/"
        if site in {"cross-site", "same-site"} and not is_opened:
            raise Refused("a page of another site asks (open the studio itself)", 403)
        self._refuse_body(request, method)

    @staticmethod
    def _refuse_body(request: _Request, method: str) -> None:
        length = request.get_header("content-length")
        if length and request.get_header("transfer-encoding"):
            # A proxy before the studio may go by the other one, and see another request after it.
            raise Refused("the body has a length and comes in chunks (give one of them)")
        if length and not (length.isascii() and length.isdecimal()):
            raise Refused(f"{length[:20]!r} is no length of a body (give a whole number)")
        if length and int(length[:20]) > MAX_BODY:
            raise Refused(f"the body has {length[:20]} bytes (give at most {MAX_BODY})", 413)
        has_body = length not in {"", "0"} or bool(request.get_header("transfer-encoding"))
        kind = request.get_header("content-type").partition(";")[0].strip().lower()
        wanted = {"application/json"}
        if (
            method == "PUT"
        ):  # a page cannot put without asking first, and we answer no such question
            wanted.add("application/octet-stream")
        if has_body and method in CHANGES and kind not in wanted:
            raise Refused(f"{kind[:50]!r} is no type of a body here (give application/json)", 415)

    async def _is_sign_in(self, request: _Request, answer: _Answer) -> bool:
        """Put the token of the address that was printed into a cookie; true if that is all."""
        query = parse_qs(request.scope["query_string"].decode("latin-1"))
        given = query.pop("token", [""])[0]
        if not (self._access.token and given and request.scope["path"] == "/"):
            return False
        if not secrets.compare_digest(given.encode(), self._access.token.encode()):
            raise Refused("the token is wrong (use the address that the studio printed)", 401)
        rest = f"?{urlencode(query, doseq=True)}" if query else ""
        cookie = f"{COOKIE}={self._access.token}; HttpOnly; SameSite=Strict; Path=/"
        if request.scope.get("scheme") == "https":
            cookie += "; Secure"
        await answer.send(
            {
                "type": "http.response.start",
                "status": 200,
                "headers": [
                    (b"content-type", b"text/html; charset=utf-8"),
                    (b"set-cookie", cookie.encode()),
                ],
            }
        )
        # Not a redirection: after a link on another page, a browser would go on without the cookie.
        page = f'<!doctype html><meta http-equiv="refresh" content="0; url=/{escape(rest)}">'
        await answer.send({"type": "http.response.body", "body": page.encode()})
        return True

    def _ask_token(self, request: _Request) -> None:
        if not self._access.token:
            return
        shown = request.get_header("authorization").removeprefix("Bearer ")
        try:
            cookie = SimpleCookie(request.get_header("cookie")).get(COOKIE)
        except CookieError:
            cookie = None
        wanted = self._access.token.encode()
        for given in (shown, cookie.value if cookie else ""):
            if secrets.compare_digest(given.encode(), wanted):
                return
        raise Refused("a token is needed (use the address that the studio printed)", 401)


class _Body:
    """The body of a request, cut off where it is too long or comes too slowly."""

    def __init__(self, receive: Receive) -> None:
        self._receive = receive
        self._length = 0
        self._waited = 0.0
        self._is_whole = False

    async def receive(self) -> Message:
        message = await (self._receive() if self._is_whole else self._receive_part())
        self._length += len(message.get("body", b""))
        if self._length > MAX_BODY:
            # As an exception of Starlette, because FastAPI takes any other one for broken JSON.
            raise HTTPException(413, f"the body is longer than {MAX_BODY} bytes (give less)")
        return message

    async def _receive_part(self) -> Message:
        began = time.monotonic()
        try:
            async with asyncio.timeout(min(STALLS, TAKES - self._waited)):
                message = await self._receive()
        except TimeoutError:
            waited = f"{STALLS:g} s without a part, or {TAKES:g} s in all"
            raise HTTPException(
                TOO_SLOW, f"the body comes too slowly: {waited} (send again)"
            ) from None
        self._waited += time.monotonic() - began
        self._is_whole = not message.get("more_body", False)
        return message


class _Answer:
    """An answer with our headers."""

    def __init__(self, send: Send) -> None:
        self._send = send
        self._has_begun = False
        self._patience: float | None = None  # of one part [s]

    async def send(self, message: Message) -> None:
        if message["type"] == "http.response.start":
            self._has_begun = True
            headers = list(message.get("headers", ()))
            known = {name.lower() for name, _ in headers}
            headers += [pair for pair in HEADERS if pair[0] not in known]
            if message["status"] == TOO_SLOW:
                headers.append((b"connection", b"close"))
            if b"content-security-policy" not in known:
                headers.append((b"content-security-policy", POLICY.encode()))
            message = {**message, "headers": headers}
            if dict(headers).get(b"content-type", b"").startswith(b"text/event-stream"):
                self._patience = UNREAD
        try:
            async with asyncio.timeout(self._patience):
                await self._send(message)
        except TimeoutError:
            raise Refused("nobody reads the events (listen again)", TOO_SLOW) from None

    async def refuse(self, status: int, error: dict[str, Any]) -> None:
        """Answer with an error, where the answer has not begun."""
        if self._has_begun:
            return
        body = make_error_body(status, error)
        headers = [
            (b"content-type", b"application/json"),
            (b"content-length", str(len(body)).encode()),
        ]
        if status in CUT_OFF:
            headers.append((b"connection", b"close"))
        await self.send({"type": "http.response.start", "status": status, "headers": headers})
        await self.send({"type": "http.response.body", "body": body})


def make_error_body(status: int, error: dict[str, Any]) -> bytes:
    """Return the one form of all errors."""
    return json.dumps(
        {"error": {"status": status, "kind": "refused", "faults": [], **error}}
    ).encode()
