"""The studio as a program: an address, a server, a browser, an end."""

from __future__ import annotations

import contextlib
import ipaddress
import socket
import ssl
import threading
import webbrowser
from collections.abc import Callable, Iterator
from pathlib import Path

import uvicorn
from fastapi import FastAPI

from rightofway.errors import InputError
from rightofway.io.content import find_remedy_for_missing
from rightofway.studio.app import create_app, create_watch
from rightofway.studio.connections import AT_ONCE, Connection, allow_descriptors
from rightofway.studio.guard import Access
from rightofway.studio.session import Studio
from rightofway.studio.watching import Watched

PORT = 7477
"""The port that is taken where it is free, so that an address can be kept."""


class _Server(uvicorn.Server):
    """Hangs up on listeners before it waits for them."""

    def __init__(self, config: uvicorn.Config, studio: Studio, ready: Callable[[], None]) -> None:
        super().__init__(config)
        self._studio = studio
        self._ready = ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            self._ready()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self._studio.runs.hang_up()
        self._studio.drives.hang_up()
        await super().shutdown(sockets)


def serve(
    studio: Studio,
    *,
    host: str,
    port: int | None,
    certificate: str | None = None,
    key: str | None = None,
    has_page: bool,
    opens_browser: bool,
    say: Callable[[str], None],
) -> None:
    """Serve a studio until it is interrupted.

    Raises
    ------
    InputError
        If the address cannot be listened on, or the certificate cannot be used.
    """
    refuse_certificate(certificate, key)
    allow_descriptors()
    listener = bind_socket(host, port)
    actual = listener.getsockname()[1]
    access = Access.on(host, actual)
    query = f"?token={access.token}" if access.token else ""
    address = f"http{'s' if certificate else ''}://{_name_host(host)}:{actual}/{query}"

    def ready() -> None:
        say(f"studio: {address} (end it with Ctrl-C)")
        if studio.store.trouble:
            trouble = studio.store.trouble
            say(f"drafts and runs are kept in memory only, until the studio ends: {trouble}")
        if opens_browser:
            threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()

    config = _make_config(create_app(studio, access, has_page=has_page), certificate, key)
    with contextlib.closing(listener), contextlib.suppress(KeyboardInterrupt):
        _Server(config, studio, ready).run(sockets=[listener])


def _make_config(
    app: FastAPI, certificate: str | None = None, key: str | None = None
) -> uvicorn.Config:
    return uvicorn.Config(
        app,
        http=Connection,
        ws="none",
        backlog=AT_ONCE,
        ssl_certfile=certificate,
        ssl_keyfile=key,
        log_level="critical",
        access_log=False,
        server_header=False,
        timeout_graceful_shutdown=3,
        h11_max_incomplete_event_size=16_384,
    )


@contextlib.contextmanager
def serve_watch(
    watched: Watched, *, host: str, port: int | None, say: Callable[[str], None]
) -> Iterator[None]:
    """Serve the page of a fleet that is driven, in a thread, as long as the context lasts.

    Raises
    ------
    InputError
        If the address cannot be listened on.
    """
    listener = bind_socket(host, port)
    actual = listener.getsockname()[1]
    access = Access.on(host, actual)
    query = f"?token={access.token}" if access.token else ""
    server = uvicorn.Server(_make_config(create_watch(watched, access)))
    thread = threading.Thread(target=server.run, args=([listener],), daemon=True)
    with contextlib.closing(listener):
        thread.start()
        say(f"watch it: http://{_name_host(host)}:{actual}/{query}")
        try:
            yield
        finally:
            watched.hang_up()
            server.should_exit = True
            thread.join(5)


def refuse_certificate(certificate: str | None, key: str | None) -> None:
    """Refuse a certificate or key that TLS cannot use; without either there is no TLS."""
    if certificate is None:
        if key is not None:
            raise InputError.at("--key", "is given without --certificate (give both)")
        return

    def password() -> str:
        raise InputError.at("--key", f"{key or certificate} has a password (take it off)")

    try:
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(certificate, key, password)
    except OSError as error:  # that of TLS is one, too
        reason = getattr(error, "reason", None) or error.strerror or str(error)
        files = f"{certificate} and {key}" if key else certificate
        message = f"{files} cannot be used: {reason} (give a certificate and its key in PEM format)"
        raise InputError.at("--certificate", message) from None


def bind_socket(host: str, port: int | None) -> socket.socket:
    """Return a socket that listens on an address; on a free port where none is given."""
    for candidate in (PORT, 0) if port is None else (port,):
        family = socket.AF_INET6 if ":" in host else socket.AF_INET
        # The protocol is named, because only then asyncio sends the parts of an answer at once; the
        # second part would wait for an acknowledgement of the first, 40 ms (Nagle's algorithm).
        listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((host.strip("[]"), candidate))
            listener.listen(100)
        except (OSError, OverflowError) as error:
            listener.close()
            if port is not None or candidate == 0:
                reason = getattr(error, "strerror", None) or str(error)
                where = host if port is None else f"{host}:{port}"
                message = f"{where} cannot be listened on: {reason} (give another)"
                raise InputError.at("--host" if port is None else "--port", message) from None
        else:
            return listener
    raise AssertionError("the last port is returned or refused")


def _name_host(host: str) -> str:
    """Return how a browser on this machine calls an address."""
    with contextlib.suppress(ValueError):
        if ipaddress.ip_address(host.strip("[]")).is_unspecified:
            return socket.gethostname()
    return f"[{host}]" if ":" in host and not host.startswith("[") else host


def split_folder_and_file(given: Path) -> tuple[Path, str | None]:
    """Return the folder that a studio is for, and the file in it that is opened first.

    Raises
    ------
    InputError
        If there is neither.
    """
    if given.is_dir():
        return given, None
    if given.is_file():
        return given.parent, given.name
    message = f"there is no such file or folder ({find_remedy_for_missing(given)})"
    raise InputError.at("", message, str(given))
