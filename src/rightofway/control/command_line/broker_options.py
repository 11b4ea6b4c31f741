"""The options of commands that connect to a broker."""

from __future__ import annotations

from typing import Any

import click


def add_login_options(command: Any) -> Any:
    """Add the options that say where the broker is, and how to log in."""
    for option in reversed(
        (
            click.option("--broker", metavar="URL",
                         help="The MQTT broker: mqtt://host, mqtt://user@host:port, or mqtts://…"
                         " with TLS."),
            click.option("--password-file", metavar="FILE",
                         help="The password for the broker; by default it is read from"
                         " RIGHTOFWAY_BROKER_PASSWORD."),
            click.option("--ca-file", metavar="FILE",
                         help="Certificates to trust with mqtts://, in PEM format; by default those"
                         " of the system."),
        )
    ):  # fmt: skip
        command = option(command)
    return command


def add_identities_option(command: Any) -> Any:
    """Add the option that names the robots."""
    return click.option("--identities", metavar="FILE",
                        help="Manufacturer and serial number of each robot (YAML)."
                        )(command)  # fmt: skip


def add_broker_options(command: Any) -> Any:
    """Add the options of a broker, and of the identities of its robots."""
    return add_login_options(add_identities_option(command))
