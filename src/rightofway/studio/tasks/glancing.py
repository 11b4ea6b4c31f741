"""A summary of a document for lists: its kind, its size, and a small picture of its map."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rightofway.errors import InputError
from rightofway.io import dump_scenario, is_layout, load_either, load_with_notes
from rightofway.io.scenario.reader import read_scenario
from rightofway.io.sites import Choice, Sites, make_sites, read_sites
from rightofway.model import Plan
from rightofway.report.examples import find_examples_folder
from rightofway.report.facts import write_note
from rightofway.report.quantities import format_decimal
from rightofway.site.scale import compute_extent
from rightofway.studio.messages import Blobs, Emit
from rightofway.studio.tasks.documents import Result, as_plain, read_document
from rightofway.studio.tasks.editing import read_map, read_readable
from rightofway.viz import make_preview
from rightofway.viz.palette import DARK, LIGHT


def glance_at(
    _emit: Emit, _blobs: Blobs, *, path: str = "", document: Any = None, dark: bool = False
) -> Result:
    """Return a glance at a path of the folder, or at a document; its picture is a blob.

    A scenario with faults is shown without its faulty parts.
    """
    kind, glance = (
        _read_file(Path(path)) if document is None else ("scenario", _read_document(document, "."))
    )
    site = max((site for _, site in glance.sites), key=lambda candidate: candidate.roadmap.n_edges)
    about = {
        "kind": kind,
        "description": write_note(glance.description),
        "robots": len(site.robots) if kind != "layout" else None,
        "extent": [format_decimal(length) for length in compute_extent(site.roadmap)],
        "unit": site.units.length,
    }
    return (about, make_preview(site, theme=DARK if dark else LIGHT))


def _read_file(file: Path) -> tuple[str, Sites]:
    if is_layout(file):
        return "layout", read_sites(file, Choice())
    try:
        loaded = load_either(file)
    except InputError:
        if file.suffix.lower() not in {".yaml", ".yml", ".json"}:
            raise
        document = read_document(file)
        if not isinstance(document, dict) or "map" not in document:
            raise
        return "scenario", _read_document(document, str(file.parent))
    if isinstance(loaded, Plan):
        return "plan", make_sites(loaded.scenario, ())
    return "scenario", make_sites(loaded.scenario, loaded.notes)


def _read_document(document: dict[str, Any], folder: str) -> Sites:
    loaded, _, faults = read_readable(document, folder)
    if loaded is not None:
        return make_sites(loaded.scenario, loaded.notes)
    site = read_map(document, folder)
    if site is None:
        raise InputError(faults)
    return Sites(description="", notes=(), sites=(("", site),))


def read_example(_emit: Emit, _blobs: Blobs, *, name: str) -> Result:
    """Return an example of the package as a document that names no other file."""
    file = find_examples_folder() / f"{name}.yaml"
    document = read_document(file)
    try:
        read_scenario(document, None)
    except InputError:
        document = as_plain(dump_scenario(load_with_notes(file).scenario))
    return ({"document": document},)
