"""The options of commands that connect to a broker."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import wraps
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.options import Whole
from rightofway.control.messages import LOOK_AHEAD

if TYPE_CHECKING:
    from rightofway.control.broker import Broker


@dataclass(frozen=True, slots=True, kw_only=True)
class Login:
    """Address of the broker and login, as given by the user."""

    broker: str | None
    password_file: str | None
    ca_file: str | None
    cert_file: str | None
    key_file: str | None

    def make_broker(self) -> Broker:
        """Return the broker; refuse files that cannot be read."""
        from rightofway.control.broker import Broker

        assert self.broker is not None, "commands look whether it is given"
        return Broker.of(
            self.broker,
            password_file=self.password_file,
            ca_file=self.ca_file,
            cert_file=self.cert_file,
            key_file=self.key_file,
        )


LOGIN = (
    click.option("--broker", metavar="URL",
                 help="The MQTT broker: mqtt://host, mqtt://user@host:port, or mqtts://…"
                 " with TLS."),
    click.option("--password-file", metavar="FILE",
                 help="The password for the broker; by default it is read from"
                 " RIGHTOFWAY_BROKER_PASSWORD."),
    click.option("--ca-file", metavar="FILE",
                 help="Certificates to trust with mqtts://, in PEM format; by default those"
                 " of the system."),
    click.option("--cert-file", metavar="FILE",
                 help="The certificate of this client, for a broker that asks for one (PEM)."),
    click.option("--key-file", metavar="FILE",
                 help="The private key of that certificate (PEM), without a password; by default in"
                 " the file of the certificate."),
)  # fmt: skip
"""The options that become a `Login`."""


def add_login_options(command: Callable[..., Any]) -> Any:
    """Add the options that say where the broker is, and how to log in: the argument `login`."""

    @wraps(command)
    def call(**given: Any) -> Any:
        values = {field.name: given.pop(field.name) for field in fields(Login)}
        return command(login=Login(**values), **given)

    changed: Any = call
    for option in reversed(LOGIN):
        changed = option(changed)
    return changed


def add_identities_option(command: Any) -> Any:
    """Add the option that names the robots."""
    return click.option("--identities", metavar="FILE",
                        help="Manufacturer and serial number of each robot (YAML)."
                        )(command)  # fmt: skip


def add_look_ahead_option(command: Any) -> Any:
    """Add the option for the length of the base."""
    return click.option("--look-ahead", type=Whole(1), default=LOOK_AHEAD, show_default=True,
                        metavar="COUNT",
                        help="The most edges released ahead of a robot. All of them together"
                        " should be longer than its braking distance.")(command)  # fmt: skip


def add_broker_options(command: Any) -> Any:
    """Add the options of a broker, and of the identities of its robots."""
    return add_login_options(add_identities_option(command))
