"""The MQTT broker: its address, passwords and certificates, and connections to it."""

from __future__ import annotations

import asyncio
import os
import secrets
import ssl
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote, urlsplit

from rightofway.control.endpoints import Letter
from rightofway.errors import InputError, quote

if TYPE_CHECKING:
    import aiomqtt

__all__ = ["Broker", "LatestMessages", "check_cancellation"]

PASSWORD = "RIGHTOFWAY_BROKER_PASSWORD"  # noqa: S105 (the name of a variable)
"""The environment variable with the password."""

PORTS = {"mqtt": 1883, "mqtts": 8883}
"""The usual port of each scheme."""

MANY = 10_000
"""Messages of one turn that may wait for their sending before aiomqtt complains."""

KEEP_ALIVE = 10
"""Seconds after which a broker and its client miss each other."""


class LatestMessages(asyncio.Queue[Any]):
    """A queue in which a newer message of a topic takes the place of one that was not taken.

    It has one message of each topic at most, so a flood cannot fill the memory, and no topic keeps
    the others waiting.

    Notes
    -----
    A state that is replaced is a state that was lost, and any state may be lost (QoS 0). The rule
    of release needs none of them: a state proves arrivals and finished actions by its own content,
    facts only grow, and the latest state has all of them. It has the last node of its order, and
    actions stay in its list, FINISHED, as long as the robot has that order. The control sends no
    other order before it has taken a state that allows it. Of a connection only the latest state
    counts, and a robot reports its factsheet again when it is asked.
    """

    def _init(self, maxsize: int) -> None:  # noqa: ARG002 (the number of topics is the limit)
        self._queue: dict[str, Any] = {}

    def _put(self, item: Any) -> None:
        self._queue[str(item.topic)] = item

    def _get(self) -> Any:
        return self._queue.pop(next(iter(self._queue)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Broker:
    """An MQTT broker.

    Attributes
    ----------
    host, port
        Where it listens.
    user, password
        As whom to log in; None without.
    tls
        How the connection is encrypted; None for not at all.
    """

    host: str
    port: int
    user: str | None = None
    password: str | None = field(default=None, repr=False)
    tls: ssl.SSLContext | None = None

    @classmethod
    def of(
        cls,
        url: str,
        *,
        password_file: str | None = None,
        ca_file: str | None = None,
        cert_file: str | None = None,
        key_file: str | None = None,
    ) -> Broker:
        """Return the broker of a URL.

        Parameters
        ----------
        url
            ``mqtt://host``, ``mqtt://user@host:port``, or ``mqtts://…`` with TLS. The password
            comes from the environment or a file, because others can read a command line.
        password_file
            A file with the password; by default the environment has it.
        ca_file
            Certificates to trust, in PEM format; by default those of the system.
        cert_file, key_file
            The certificate of this client and its key, in PEM format; the key may be in the file of
            the certificate.

        Raises
        ------
        InputError
            If the URL is none of a broker, or a file cannot be read.
        """
        if not (find_spec("aiomqtt") and find_spec("prometheus_client")):
            message = "needs packages that are not installed (pip install 'rightofway[control]')"
            raise InputError.at("broker", message)
        try:
            parts = urlsplit(url)
            port = parts.port or PORTS.get(parts.scheme)
        except ValueError:
            parts, port = urlsplit(""), None
        if port is None or not parts.hostname or parts.path.strip("/") or parts.query:
            remedy = "give mqtt://host, mqtt://user@host:port, or mqtts://… with TLS"
            raise InputError.at("broker", f"{quote(url)} is no address of a broker ({remedy})")
        if parts.password is not None:
            remedy = f"set {PASSWORD}, or give --password-file"
            raise InputError.at("broker", f"a password is in the address ({remedy})")
        password = os.environ.get(PASSWORD)
        if password_file is not None:
            password = _read_content(password_file, "password-file").rstrip("\r\n")
        user = unquote(parts.username) if parts.username else None
        if user is None and password is not None:
            message = "a password is given without a user (write mqtt://user@host)"
            raise InputError.at("broker", message)
        files = {"ca-file": ca_file, "cert-file": cert_file, "key-file": key_file}
        for option, path in files.items():
            if path is not None and parts.scheme == "mqtt":
                message = "certificates are given without TLS (write mqtts://host)"
                raise InputError.at(option, message)
        if key_file is not None and cert_file is None:
            raise InputError.at(
                "key-file", "a key is given without a certificate (give --cert-file)"
            )
        tls = _make_tls(ca_file, cert_file, key_file) if parts.scheme == "mqtts" else None
        return cls(host=parts.hostname, port=port, user=user, password=password, tls=tls)

    @property
    def address(self) -> str:
        """Its address, in short."""
        return f"{self.host}:{self.port}"

    @asynccontextmanager
    async def open_client(
        self, name: str, will: Letter | None = None, *, takes_latest: bool = False
    ) -> AsyncIterator[aiomqtt.Client]:
        """Open a connection: nothing is kept for it when it is gone.

        A task that is cancelled ends, even where the connection fails as it is closed.

        Parameters
        ----------
        name
            How its identifier begins; the rest is made up, so that two never have the same.
        will
            The message that the broker sends, retained, when the connection breaks.
        takes_latest
            Whether only the latest message of each topic counts, see `LatestMessages`.
        """
        import aiomqtt

        client = aiomqtt.Client(
            self.host,
            self.port,
            username=self.user,
            password=self.password,
            tls_context=self.tls,
            identifier=f"{name}-{secrets.token_hex(4)}",
            clean_session=True,
            keepalive=KEEP_ALIVE,
            timeout=KEEP_ALIVE,
            queue_type=LatestMessages if takes_latest else None,
            will=None if will is None else aiomqtt.Will(will.topic, will.payload, 1, retain=True),
        )
        client.pending_calls_threshold = MANY
        try:
            async with client:
                yield client
        except (aiomqtt.MqttError, BaseExceptionGroup):
            check_cancellation()
            raise


def check_cancellation() -> None:
    """End the task at hand if it was cancelled, whatever has become of that since.

    `asyncio.wait_for`, by which aiomqtt waits, loses a cancellation in Python 3.11 where the task
    it waits for ends at the same time; and an error of a connection that is closed takes its place.
    A loop that sends or connects again would then go on for ever.

    In Python 3.11 and 3.12 a task also counts as cancelled after it has left a task group of which
    a task failed while the group waited for its end: let the body of the group do what lasts.

    Raises
    ------
    asyncio.CancelledError
        If the task was cancelled.
    """
    task = asyncio.current_task()
    if task is not None and task.cancelling():
        raise asyncio.CancelledError


def _make_tls(ca_file: str | None, cert_file: str | None, key_file: str | None) -> ssl.SSLContext:
    tls = ssl.create_default_context()
    if ca_file is not None:
        _read_content(ca_file, "ca-file")
        try:
            tls.load_verify_locations(ca_file)
        except ssl.SSLError as error:
            message = f"has no certificates in PEM format: {error} (give another file)"
            raise InputError.at("ca-file", message, ca_file) from error
    if cert_file is not None:
        _read_content(cert_file, "cert-file")
        if key_file is not None:
            _read_content(key_file, "key-file")
        try:
            tls.load_cert_chain(cert_file, key_file, password=_refuse_password)
        except (ssl.SSLError, ValueError) as error:
            message = f"has no certificate with its key in PEM format: {error} (give --key-file)"
            raise InputError.at("cert-file", message, cert_file) from error
    return tls


def _refuse_password() -> str:
    """Refuse to ask for the password of a key: nobody may be there."""
    raise ValueError("the key has a password, remove it: openssl rsa -in key.pem")


def _read_content(path: str, option: str) -> str:
    try:
        return Path(path).read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InputError.at(option, f"cannot be read: {reason} (check the path)", path) from error
