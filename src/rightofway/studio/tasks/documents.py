"""Documents: opened from any file that the library reads, validated, inspected, drawn, written."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import asdict, replace
from decimal import Decimal
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, InputFault
from rightofway.facts import Fact
from rightofway.io import (
    Loaded,
    dump_scenario,
    format_plan,
    is_layout,
    load_either,
    load_with_notes,
    make_example,
    read_layout,
)
from rightofway.io.json_text import format_json
from rightofway.io.layouts import describe_layout
from rightofway.io.locations import locate, open_document
from rightofway.io.readers import WORKBOOKS
from rightofway.io.scenario.reader import read_scenario
from rightofway.io.scenario.writer import format_yaml
from rightofway.io.sites import make_sites
from rightofway.io.yaml_text import parse_yaml
from rightofway.metrics import inspect, measure
from rightofway.model import Plan, Scenario
from rightofway.report.facts import write_note, write_notes
from rightofway.report.inspection import export_finding
from rightofway.report.phrases import mark_figure, to_parts
from rightofway.report.quantities import Quantities
from rightofway.studio.messages import Blobs, Emit, as_fault_data
from rightofway.viz.verdict import give_verdict

Result = tuple[Any, ...]


def open_file(_emit: Emit, _blobs: Blobs, *, path: str, count: int | None = None) -> Result:
    """Open a file: a scenario as its document, faults and all; a layout as the map of a new one.

    Robots of a new one are for the user to place. A plan is a blob, with its costs.
    """
    file = Path(path)
    if is_layout(file):
        example = make_example(file, file.with_suffix(".yaml"))
        document = parse_yaml(example.text)
        new = Fact("new scenario", layout=describe_layout(read_layout(file)))
        notes = to_parts(write_notes([*example.notes, new]))
        return (
            {"kind": "layout", "document": {**as_plain(document), "robots": []}, "notes": notes},
        )
    if file.suffix.lower() in {".scen", *WORKBOOKS}:
        return (_make_document("scenario", load_with_notes(file, count)),)
    try:
        loaded = load_either(file, count)
    except InputError:
        return (_read_with_faults(file),)
    if isinstance(loaded, Plan):
        return (
            {"kind": "plan", "figures": compute_figures(loaded)},
            format_plan(loaded).encode(),
        )
    return ({**_make_document("scenario", loaded), "document": read_document(file)},)


def _make_document(kind: str, loaded: Loaded) -> dict[str, Any]:
    document = as_plain(dump_scenario(loaded.scenario))
    return {"kind": kind, "document": document, "notes": to_parts(write_notes(loaded.notes))}


def _read_with_faults(file: Path) -> dict[str, Any]:
    """Return a scenario that has faults, to be mended in the studio; other files are refused."""
    with open_document(file) as document:
        if isinstance(document, dict) and isinstance(document.get("map"), dict):
            return {"kind": "scenario", "document": as_plain(document), "notes": []}
    load_either(file)
    raise AssertionError("a file with faults is refused")


def read_document(file: Path) -> Any:
    """Return the content of a YAML or JSON file, as plain data."""
    with open_document(file) as document:
        return as_plain(document)


def as_plain(value: Any) -> Any:
    """Return a document for JSON; a decimal that no float stands for exactly becomes text."""
    if isinstance(value, Decimal):
        number = float(value)
        return number if Decimal(repr(number)) == value else str(value)
    if isinstance(value, dict):
        return {key: as_plain(item) for key, item in value.items()}
    return [as_plain(item) for item in value] if isinstance(value, list) else value


def load_document(document: Any, folder: str) -> Loaded:
    """Return the scenario of a document that would stand in a folder, with names in its faults."""
    try:
        return read_scenario(document, Path(folder))
    except InputError as error:
        raise InputError(_name_faults(error.faults, document)) from None


def _name_faults(faults: Sequence[InputFault], document: Any) -> list[InputFault]:
    """Return faults with the names of list items; lines mean nothing here."""
    located = locate(faults, json.dumps(document))
    return [fault.place_at(replace(fault.location, line=None)) for fault in located]


def validate_document(_emit: Emit, _blobs: Blobs, *, document: Any, folder: str) -> Result:
    """Return the faults of a document, or the notes of its reader."""
    try:
        loaded = load_document(document, folder)
    except InputError as error:
        return (
            {"ok": False, "faults": [as_fault_data(fault) for fault in error.faults], "notes": []},
        )
    return ({"ok": True, "faults": [], "notes": to_parts(write_notes(loaded.notes))},)


def inspect_document(_emit: Emit, _blobs: Blobs, *, document: Any, folder: str) -> Result:
    """Return the weaknesses of the floor of a document, as `rightofway inspect --json` has it."""
    loaded = load_document(document, folder)
    sites = make_sites(loaded.scenario, loaded.notes)
    [(_, site)] = sites.sites
    result = inspect(site)
    return (
        {
            "what": write_note(sites.description),
            "notes": to_parts(write_notes(sites.notes)),
            **asdict(replace(result, findings=())),
            "findings": [export_finding(site, finding) for finding in result.findings],
        },
    )


def write_document(_emit: Emit, _blobs: Blobs, *, document: Any, folder: str, name: str) -> Result:
    """Return the text of a document as a file of some name has it: .yaml, .yml, .json or .xlsx."""
    suffix = Path(name).suffix.lower()
    if suffix in {".yaml", ".yml"}:
        return (None, format_yaml(document).encode())
    if suffix == ".json":
        return (None, format_json(document).encode())
    if suffix == ".xlsx":
        from rightofway.io.workbook.writer import format_workbook

        return (None, format_workbook(dump_scenario(load_document(document, folder).scenario)))
    message = f"{name!r} does not end in .yaml, .yml, .json or .xlsx (give a name that does)"
    raise InputError.at("path", message)


_digests: list[tuple[Scenario, str]] = []  # of the last scenario: a search makes many plans of one


def compute_digest(scenario: Scenario) -> str:
    """Return a digest that scenarios of the same content share, whatever file they stand in."""
    for known, digest in _digests:
        if known is scenario:
            return digest
    text = json.dumps(dump_scenario(scenario), sort_keys=True, default=str)
    _digests[:] = [(scenario, hashlib.sha256(text.encode()).hexdigest())]
    return _digests[0][1]


def compute_figures(plan: Plan) -> dict[str, Any]:
    """Return the costs of a plan, in ticks and for people, and how much of an old plan it kept.

    ``scenario`` is the digest of the scenario that it is of, ``faults`` how many the judge finds.
    """
    metrics, duration = measure(plan), Quantities.of(plan.scenario).format_duration
    costs = {
        "flowtime": metrics.flowtime,
        "makespan": metrics.makespan,
        "lower_bound": metrics.lower_bound,
        "alone": metrics.flowtime_alone,
    }
    text = {key: to_parts(duration(ticks)) for key, ticks in costs.items()}
    text["gap"] = "" if metrics.gap is None else to_parts(mark_figure(f"{metrics.gap:.1%}"))
    tick, units = plan.scenario.problem.clock.tick, plan.scenario.units
    data = {
        **costs,
        "text": text,
        "tick": tick.as_integer_ratio(),
        "units": units.to_document(),
        "scenario": compute_digest(plan.scenario),
        "faults": give_verdict(plan).total,
    }
    if plan.run.start is None:
        return data
    return {**data, "start": asdict(plan.run.start), "robots": len(plan.tracks)}
