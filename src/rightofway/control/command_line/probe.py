"""``rightofway probe``: a conversation with one robot, and how it speaks VDA 5050."""

from __future__ import annotations

import asyncio

import click

from rightofway.cli.options import as_json_option
from rightofway.cli.terminal import complain, put_json, put_report
from rightofway.control.command_line.broker_options import add_login_options
from rightofway.errors import InputError, quote

EXAMPLES = """\b
Examples:
  rightofway probe --broker mqtt://hub --identity ACME/A-001
  rightofway probe --broker mqtt://hub --identity ACME/A-001 --order N4 --json
"""


@click.command(epilog=EXAMPLES, short_help="Ask one robot how it speaks VDA 5050.")
@add_login_options
@click.option("--identity", required=True, metavar="MANUFACTURER/SERIAL",
              help="The robot, as its topics name it.")  # fmt: skip
@click.option("--order", "node", metavar="NODE",
              help="Send the orders of the probe without asking, at this node. By default the"
              " command asks first, and takes the node where the robot is.")  # fmt: skip
@as_json_option("findings")
def probe(
    *,
    broker: str | None,
    password_file: str | None,
    ca_file: str | None,
    identity: str,
    node: str | None,
    as_json: bool,
) -> int:
    """Ask one robot for its state and its factsheet, and give it a first order.

    The orders have a single node, the one where the robot is, so it does not move. The report says
    what the robot supports and where it departs from the norm. Exit code 1: it departs, or the
    control cannot drive it.
    """
    from rightofway.control.broker import Broker
    from rightofway.control.probe import Probe

    if broker is None:
        raise click.UsageError("a robot is at a broker (give --broker)")
    manufacturer, slash, serial = identity.partition("/")
    if not (manufacturer and slash and serial):
        message = f"{quote(identity)} is no robot (give its manufacturer and serial: ACME/A-001)"
        raise InputError.at("identity", message)
    address = Broker.of(broker, password_file=password_file, ca_file=ca_file)

    def ask(place: str) -> bool:
        return node is not None or click.confirm(
            f"Send orders of the node {place} alone, at which the robot stays?", err=True
        )

    complain(f"listening at {address.address}; a robot reports every 30 s at least")
    talk = Probe(manufacturer, serial, ask=ask, node=node)
    result = asyncio.run(talk.run(address))
    if as_json:
        put_json(result.as_dict())
    else:
        from rightofway.report.probe import report_probe

        put_report(report_probe(result))
    return int(result.count("departs") + result.count("blocks") > 0)
