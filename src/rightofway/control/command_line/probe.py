"""``rightofway probe``: a conversation with one robot, and how it speaks VDA 5050."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

import click

from rightofway.cli.completion import PLANS, complete_files
from rightofway.cli.inputs import read_plan
from rightofway.cli.options import as_json_option
from rightofway.cli.terminal import complain, put_json, put_report
from rightofway.control.command_line.broker_options import (
    Login,
    add_identities_option,
    add_login_options,
    add_look_ahead_option,
)
from rightofway.errors import InputError, quote

if TYPE_CHECKING:
    from rightofway.control.plan_fit import PlanFit

EXAMPLES = """\b
Examples:
  rightofway probe --broker mqtt://hub --identity ACME/A-001
  rightofway probe --broker mqtt://hub --identity ACME/A-001 --order N4 --json
  rightofway probe --broker mqtt://hub --plan p.json --identities r.yaml \\
      --robot R1
"""


@click.command(epilog=EXAMPLES, short_help="Ask one robot how it speaks VDA 5050.")
@add_login_options
@click.option("--identity", metavar="MANUFACTURER/SERIAL",
              help="The robot, as its topics name it.")  # fmt: skip
@click.option("--plan", "plan", type=click.Path(), shell_complete=complete_files(*PLANS),
              help="Compare the robot with the orders of this plan; it needs --identities and"
              " --robot.")  # fmt: skip
@add_identities_option
@click.option("--robot", metavar="NAME", help="The robot in the plan.")
@add_look_ahead_option
@click.option("--order", "node", metavar="NODE",
              help="Send the orders without asking, with this node. By default the command asks"
              " first, and uses the node of the robot.")  # fmt: skip
@as_json_option("findings")
def probe(
    *,
    login: Login,
    identity: str | None,
    plan: str | None,
    identities: str | None,
    robot: str | None,
    look_ahead: int,
    node: str | None,
    as_json: bool,
) -> int:
    """Request the state and the factsheet of one robot, and send it a first order.

    The orders have a single node, the present one, so the robot does not move. The report lists
    the features of the robot and its departures from the norm. Exit code 1: the robot departs
    from the norm, or the control cannot drive it.
    """
    from rightofway.control.probe import Probe

    if login.broker is None:
        raise click.UsageError("a robot is at a broker (give --broker)")
    fit = _choose_robot(plan, identities, robot, look_ahead)
    manufacturer, serial = _read_identity(identity, fit)
    address = login.make_broker()

    def ask(place: str) -> bool:
        return node is not None or click.confirm(
            f"Send orders of the node {place} alone, at which the robot stays?", err=True
        )

    complain(f"listening at {address.address}; a robot reports every 30 s at least")
    talk = Probe(manufacturer, serial, ask=ask, node=node, fit=fit)
    result = asyncio.run(talk.run(address))
    if as_json:
        put_json(result.as_dict())
    else:
        from rightofway.report.probe import report_probe

        put_report(report_probe(result))
    return int(result.count("departs") + result.count("blocks") > 0)


def _choose_robot(
    plan: str | None, identities: str | None, robot: str | None, look_ahead: int
) -> PlanFit | None:
    """Return the robot of a plan with which the real one is compared; None without a plan."""
    if plan is None and identities is None and robot is None:
        return None
    if plan is None or identities is None or robot is None:
        raise click.UsageError("--plan, --identities and --robot belong together (give all three)")
    from rightofway.control.identities import load_identities
    from rightofway.control.names import find_robot
    from rightofway.control.plan_fit import PlanFit

    opened = read_plan(plan)
    names = [known.name for known in opened.scenario.robots]
    fleet = load_identities(identities, names)
    number = find_robot(names, robot)
    return PlanFit(plan=opened, identities=fleet, robot=number, look_ahead=look_ahead)


def _read_identity(identity: str | None, fit: PlanFit | None) -> tuple[str, str]:
    """Return manufacturer and serial number of the robot."""
    if fit is not None and identity is None:
        own = fit.identities[fit.robot]
        return own.manufacturer, own.serial_number
    if identity is None:
        raise click.UsageError("a probe is of one robot (give --identity, or --plan and --robot)")
    manufacturer, _, serial = identity.partition("/")
    if not (manufacturer and serial):
        message = f"{quote(identity)} is no robot (give its manufacturer and serial: ACME/A-001)"
        raise InputError.at("identity", message)
    return manufacturer, serial
