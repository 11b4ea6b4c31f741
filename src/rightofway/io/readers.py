"""Files opened by their content: scenarios, plans, workbooks, files of other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rightofway.errors import InputError, name_file
from rightofway.files import as_path
from rightofway.io.collector import pause_garbage_collection
from rightofway.io.content import is_own_document, read_text, refuse_picture
from rightofway.io.scenario.reader import Loaded, read_classic, read_scenario
from rightofway.kinds.arguments import checks_arguments
from rightofway.model import Plan, Scenario

WORKBOOKS = (".xlsx", ".xlsm", ".xls", ".ods")
"""How the names of workbooks end; the last two are refused with what to do."""


@checks_arguments
def load(path: Path | str, count: int | None = None, jobs: Path | str | None = None) -> Scenario:
    """Return the scenario of a file.

    Parameters
    ----------
    path
        A scenario as YAML or JSON; a workbook (`.xlsx`); a problem of the League of Robot Runners;
        or a `.scen` file, which is classic MAPF: unit speeds, no work, no turning, no way back, the
        map in the same folder or in ``../maps``.
    count
        Number of robots: the first rows of a `.scen` file; None for all. Other files have a fixed
        number of robots.
    jobs
        A file of jobs for a scenario as YAML or JSON, instead of its own jobs: CSV, a list of jobs
        as YAML or JSON, transport orders of openTCS or task requests of Open-RMF.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy.
    """
    return load_with_notes(path, count, jobs).scenario


def load_with_notes(
    path: Path | str, count: int | None = None, jobs: Path | str | None = None
) -> Loaded:
    """Return the scenario of a file with the notes of its reader; otherwise as `load`.

    Parameters
    ----------
    path
        A scenario as YAML or JSON, a workbook or a `.scen` file.
    count, jobs
        As for `load`.
    """
    path = as_path(path)
    if jobs is not None and path.suffix.lower() in {".scen", *WORKBOOKS}:
        message = "is for a scenario as YAML or JSON (write the jobs into a sheet, or take it out)"
        raise InputError.at("jobs", message, str(path))
    if path.suffix.lower() == ".scen":
        return read_classic(path, count)
    if path.suffix.lower() in WORKBOOKS:
        from rightofway.io.workbook import load_workbook_scenario

        _refuse_count(count)
        return load_workbook_scenario(path)
    # What a kind of files needs is imported with the first one: a `.scen` file needs none of it.
    from rightofway.io.locations import open_document

    with name_file(str(path)):
        _refuse_count(count)
        text = _read_text(path)
        if not is_own_document(text):
            _refuse_other_kinds(path, text)
    with pause_garbage_collection(), open_document(path, text) as document:
        return _read_scenario(_replace_jobs(document, jobs), text, path)


def _replace_jobs(document: Any, jobs: Path | str | None) -> Any:
    """Return a document with the jobs of a file, and the times that it gives for orders."""
    if jobs is None or not isinstance(document, dict):
        return document
    given = document.get("jobs")
    times = given if isinstance(given, dict) and "table" in given else {}
    return {**document, "jobs": {**times, "table": str(as_path(jobs, "jobs").absolute())}}


def _read_scenario(document: Any, text: str, path: Path) -> Loaded:
    """Return the scenario of a document, which may be a problem of the League of Robot Runners."""
    if not is_own_document(text):
        from rightofway.io.scenario import league

        if league.recognizes(text):
            return league.read_problem(document, path)
    return read_scenario(document, path.parent)


@checks_arguments
def load_plan(
    path: Path | str, map_file: Path | str | None = None, scen: Path | str | None = None
) -> Plan:
    """Return the plan of a file.

    Parameters
    ----------
    path
        A plan as JSON or YAML, or in a format of `FOREIGN_FORMATS`; ``-`` is standard input.
    map_file
        The ``.map`` of a plan of another program. By default, the map named by the plan or the
        ``.scen`` file, in the folder of that file.
    scen
        A ``.scen`` file with the starts and goals of a plan of another program.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy. A plan that breaks rules is not
        at fault here: `rightofway.check` judges it.
    """
    from rightofway.io.locations import open_document
    from rightofway.io.plan.reader import parse_plan

    path = as_path(path)
    kinds = {".scen": "a .scen file", **dict.fromkeys(WORKBOOKS, "a workbook")}
    kind = kinds.get(path.suffix.lower())
    if kind:
        raise InputError.at("", f"{kind} holds a scenario, not a plan (plan it first)", str(path))
    text, foreign = _read_foreign(path, map_file, scen)
    if foreign is not None:
        return foreign
    with open_document(path, text) as document:
        return parse_plan(document, pictures=path.parent)


def load_either(
    path: Path | str,
    count: int | None = None,
    map_file: Path | str | None = None,
    scen: Path | str | None = None,
) -> Plan | Loaded:
    """Return the plan or the scenario of a file, by its ``format``.

    Parameters
    ----------
    path
        A plan or scenario as JSON, or a scenario as YAML, workbook or `.scen`.
    count
        As for `load`.
    map_file, scen
        As for `load_plan`.

    Raises
    ------
    InputError
        As `load_plan` and `load` do.
    """
    path = as_path(path)
    if path.suffix.lower() in {".scen", *WORKBOOKS}:
        return load_with_notes(path, count)
    from rightofway.io.locations import open_document
    from rightofway.io.plan.reader import parse_plan

    with name_file(str(path)):
        _refuse_count(count)
    text, foreign = _read_foreign(path, map_file, scen)
    if foreign is not None:
        return foreign
    with open_document(path, text) as document:
        kind = document.get("format") if isinstance(document, dict) else None
        is_plan = isinstance(kind, str) and kind.startswith("rightofway-plan/")
        if is_plan:
            return parse_plan(document, pictures=path.parent)
        return _read_scenario(document, text, path)


def _read_text(path: Path) -> str:
    """Return the text of a file; pictures and pages are refused."""
    refuse_picture(path)
    text = read_text(path)
    if text[:14].lower() == "<!doctype html":
        message = "this is a page (give the scenario or the plan that it was made of)"
        raise InputError.at("", message)
    return text


def _refuse_other_kinds(path: Path, text: str) -> None:
    """Refuse plans of other programs and layouts, with a remedy."""
    from rightofway.io.foreign import format_of_text
    from rightofway.io.layouts import refuse_layout

    if format_of_text(text):
        message = "is a plan of another program, not a scenario (check, show or improve it)"
        raise InputError.at("", message)
    refuse_layout(path, text)


def _refuse_count(count: int | None) -> None:
    """Refuse a number of robots for a file that is not a list of starts and goals."""
    if count is not None:
        message = f"the count {count} is for a .scen file, and this is none (leave it out)"
        raise InputError.at("", message)


def _read_foreign(
    path: Path, map_file: Path | str | None, scen: Path | str | None
) -> tuple[str, Plan | None]:
    """Return the text of a file, and its plan if it is one of another program."""
    with name_file(str(path)):
        text = _read_text(path)
        places = {"map_file": map_file, "scen": scen}
        files = [
            None if given is None else as_path(given, place) for place, given in places.items()
        ]
        plan = None
        if not is_own_document(text):
            from rightofway.io.foreign import read_foreign
            from rightofway.io.layouts import refuse_layout

            plan = read_foreign(text, path, *files)
            if plan is None and not any(files):
                refuse_layout(path, text)
        if plan is None and any(files):
            message = "the file has its own map and robots in it (leave out --map and --scen)"
            raise InputError.at("", message)
    return text, plan
