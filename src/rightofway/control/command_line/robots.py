"""``rightofway robots``: simulated robots at a broker."""

from __future__ import annotations

import asyncio
from pathlib import Path

import click

from rightofway.cli.completion import PLANS, complete_files
from rightofway.cli.inputs import add_foreign_options, read_plan
from rightofway.cli.options import seed_option
from rightofway.cli.terminal import say, say_written
from rightofway.control.command_line.broker_options import Login, add_broker_options

EXAMPLES = """\b
Examples:
  rightofway robots plan.json --broker mqtt://hub --write-identities r.yaml
  rightofway robots plan.json --broker mqtt://hub --identities r.yaml
  rightofway robots plan.json --broker mqtt://hub --trouble stop:0.05 --seed 3
"""


@click.command(
    epilog=EXAMPLES,
    short_help="Simulate the robots of a PLAN at a broker (VDA 5050).",
)
@click.argument("plan", type=click.Path(), shell_complete=complete_files(*PLANS))
@add_foreign_options
@add_broker_options
@click.option("--write-identities", metavar="FILE",
              help="Write a file of identities for these robots, which `drive` reads.",
              )  # fmt: skip
@click.option("--vda-version", default="2.1.0", show_default=True, metavar="VERSION",
              help="The version of VDA 5050 of robots without --identities: 2.0.0, 2.1.0 or"
              " 3.0.0.")  # fmt: skip
@click.option("--serial", metavar="SERIAL",
              help="Simulate one robot more, of this serial number, in place of those of the PLAN:"
              " one that joins with `rightofway jobs`. With --at.")  # fmt: skip
@click.option("--at", metavar="PLACE", help="Where that robot is: a vertex or a station.")
@click.option("--like", metavar="ROBOT",
              help="The robot of the PLAN that it is like; needed if they differ.")  # fmt: skip
@click.option("--trouble", "troubles", multiple=True, metavar="KIND:SHARE",
              help="Random trouble: late:0.5 (drives take half as long again on average), or stop,"
              " error, offline or reset with their share of drives. May be"
              " repeated.")  # fmt: skip
@click.option("--time-scale", type=click.FloatRange(0, 100, min_open=True), default=1,
              show_default=True, metavar="FACTOR",
              help="Seconds of robot time in each second, up to 100.")  # fmt: skip
@seed_option
def robots(
    *,
    plan: str,
    login: Login,
    identities: str | None,
    write_identities: str | None,
    vda_version: str,
    serial: str | None,
    at: str | None,
    like: str | None,
    troubles: tuple[str, ...],
    time_scale: float,
    seed: int,
) -> None:
    """Simulate the robots of a PLAN at a broker, until interrupted.

    They begin at their homes and execute orders of VDA 5050, each with a connection of its own.
    The PLAN gives their homes and work times; lengths and speeds are in the orders.
    """
    from rightofway.control.identities import (
        format_identities,
        load_identities,
        make_simulated_identities,
    )
    from rightofway.control.robots import parse_troubles, run_robots

    if login.broker is None:
        raise click.UsageError("robots need a broker (give --broker)")
    if write_identities is not None and identities is not None:
        raise click.UsageError("--identities are there already (take --write-identities out)")
    opened = read_plan(plan)
    names = [robot.name for robot in opened.scenario.robots]
    fleet = (
        make_simulated_identities(names, vda_version)
        if identities is None
        else load_identities(identities, names)
    )
    begin = 0
    if serial is not None or at is not None or like is not None:
        from rightofway.control.joins import grow_identities, grow_plan, make_join_entry

        given = {"name": f"{names[0]} {serial}", "serial": serial, "at": at, "like": like}
        joined, begin = [make_join_entry(opened, given)], len(names)
        opened, fleet = grow_plan(opened, joined), grow_identities(names, fleet, joined)
    address = login.make_broker()
    trouble = parse_troubles(troubles)
    if write_identities is not None:
        Path(write_identities).write_text(format_identities(names, fleet), encoding="utf-8")
        say_written(write_identities)

    def is_up() -> None:
        say(f"{len(fleet) - begin} robots are at {address.address}; end them with Ctrl-C")

    def on_failure(error: BaseException) -> None:
        say(f"no connection to {address.address}: {error}; trying again")

    asyncio.run(
        run_robots(
            opened,
            fleet,
            address,
            trouble=trouble,
            seed=seed,
            time_scale=time_scale,
            begin=begin,
            is_up=is_up,
            on_failure=on_failure,
        )
    )
