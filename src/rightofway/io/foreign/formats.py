"""Which formats of other programs there are, and how a file is recognized."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path

from rightofway.errors import InputError
from rightofway.io.content import read_text
from rightofway.io.foreign import lacam, lns2, planviz, planviz_writer, schedule
from rightofway.io.foreign.trajectories import ForeignPlan, plan_of_trajectories
from rightofway.io.locations import add_lines
from rightofway.kinds.table import make_words
from rightofway.model import Plan


@dataclass(frozen=True, slots=True, kw_only=True)
class ForeignFormat:
    """A format of other programs.

    Attributes
    ----------
    summary
        Which programs write it, and how it looks.
    is_document
        Whether it is YAML or JSON, so that places of faults have lines.
    recognizes
        Returns whether a text is probably of this format.
    read
        Returns the plan of a text.
    write
        Returns the text of a plan.
    """

    summary: str
    is_document: bool = False
    recognizes: Callable[[str], bool]
    read: Callable[[str], ForeignPlan]
    write: Callable[[Plan], str]


FOREIGN_FORMATS: dict[str, ForeignFormat] = {
    "lacam": ForeignFormat(
        summary="lacam, pypibt, mapf-visualizer: a line of cells for each step",
        recognizes=lacam.recognizes, read=lacam.read, write=lacam.write,
    ),
    "lns2": ForeignFormat(
        summary="MAPF-LNS2, EECBS: a line of cells for each agent",
        recognizes=lns2.recognizes, read=lns2.read, write=lns2.write,
    ),
    "planviz": ForeignFormat(
        summary="PlanViz, League of Robot Runners: actions of each agent as JSON",
        is_document=True, recognizes=planviz.recognizes, read=planviz.read,
        write=planviz_writer.write,
    ),
    "schedule": ForeignFormat(
        summary="multi_agent_path_planning, libMultiRobotPlanning: a YAML schedule",
        is_document=True, recognizes=schedule.recognizes, read=schedule.read, write=schedule.write,
    ),
}  # fmt: skip
"""The formats by name."""


def format_of_text(text: str) -> ForeignFormat | None:
    """Return the format of another program that a text is in, or None.

    Parameters
    ----------
    text
        The content of a file.
    """
    return next((foreign for foreign in FOREIGN_FORMATS.values() if foreign.recognizes(text)), None)


def is_foreign(path: Path | str) -> bool:
    """Return whether a file is a plan in a format of another program, perhaps one with faults.

    Parameters
    ----------
    path
        The file; ``-`` is standard input.
    """
    try:
        return format_of_text(read_text(Path(path))) is not None
    except InputError:
        return False


def read_foreign(
    text: str, path: Path, map_file: Path | None = None, scen: Path | None = None
) -> Plan | None:
    """Return the plan of a text in a format of another program, or None for any other text.

    Parameters
    ----------
    text
        The content of a file.
    path
        The file; a map that the plan names is looked for beside it.
    map_file, scen
        The map, and the starts and goals, where the user names files.

    Raises
    ------
    InputError
        With every fault, its line and remedy.
    """
    foreign = format_of_text(text)
    if foreign is None:
        return None
    with add_lines(text) if foreign.is_document else nullcontext():
        return plan_of_trajectories(foreign.read(text), path, map_file, scen)


def format_foreign(plan: Plan, name: str) -> str:
    """Return a plan as the text of a file for another program.

    Parameters
    ----------
    plan
        A plan on a grid.
    name
        A key of `FOREIGN_FORMATS`.

    Raises
    ------
    InputError
        If the name is unknown, or the roadmap is no grid.
    """
    return FOREIGN_FORMATS[make_words(*sorted(FOREIGN_FORMATS)).read_at("name", name)].write(plan)
