"""Reports on inspected sites: the kind of a file, the sizes of its sites, and findings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from rightofway.facts import Fact
from rightofway.metrics import Inspection, Site
from rightofway.metrics.site import Finding, Severity
from rightofway.report.facts import FactWriter, write_note, write_notes
from rightofway.report.lines import Paragraph, Part
from rightofway.site.scale import compute_extent

SEVERITIES: Mapping[Severity, Fact] = {
    "error": Fact("errors"),
    "warning": Fact("warnings"),
    "note": Fact("notes"),
}
"""The severities of findings, the worst first."""

EFFECTS: Mapping[Severity, Fact] = {
    "error": Fact("work is impossible"),
    "warning": Fact("robots will wait"),
}
"""The effect of findings on the work."""


def name_severity(severity: Severity) -> str:
    """Return the name of findings of a severity."""
    return FactWriter(None).write(SEVERITIES[severity])


def write_heading(severity: Severity) -> str:
    """Return the name of findings of a severity, with their effect on the work."""
    name = SEVERITIES[severity]
    effect = EFFECTS.get(severity)
    heading = name if effect is None else Fact("name and effect", name=name, effect=effect)
    return FactWriter(None).write(heading)


def describe_site(site: Site, inspection: Inspection) -> tuple[str, ...]:
    """Return the size of a site and its connectivity, in whole sentences."""
    return tuple(map(FactWriter(site).write, _list_facts(site, inspection)))


def _list_facts(site: Site, inspection: Inspection) -> Iterator[Fact]:
    edges = Fact("n_directed_edges", number=inspection.edges)
    if inspection.one_way:
        edges = Fact("one-way among edges", edges=edges, number=inspection.one_way)
    across, down = compute_extent(site.roadmap)
    yield Fact(
        "size of roadmap",
        vertices=inspection.vertices,
        edges=edges,
        width=across,
        height=down,
        places=inspection.places,
    )
    if len(inspection.parts) == 1:
        yield Fact("one part")
    else:
        yield Fact("parts", number=len(inspection.parts), sizes=inspection.parts)
    if inspection.sampled:
        some, of_all = inspection.sampled
        yield Fact("sampled routes", some=some, all=of_all)
    if inspection.well_formed:
        yield Fact("well formed")


def describe_finding(site: Site, finding: Finding) -> tuple[str, str]:
    """Return the fact and the remedy of a finding as parts of a sentence."""
    writer = FactWriter(site)
    return writer.write(finding.fact), writer.write(finding.remedy)


def export_finding(site: Site, finding: Finding) -> dict[str, Any]:
    """Return a finding as plain data for JSON, with an English sentence."""
    writer = FactWriter(site)
    return {
        "kind": finding.kind,
        "severity": finding.severity,
        "fact": writer.export(finding.fact),
        "remedy": writer.export(finding.remedy),
        "vertices": list(finding.vertices),
        "robots": list(finding.robots),
        "sentence": str(finding),
    }


def report_inspection(
    source: str,
    description: str | Fact,
    notes: Iterable[str | Fact],
    results: Sequence[tuple[str, Site, Inspection]],
    limit: int,
) -> Iterator[Part]:
    """Yield the kind of a file, the reader's notes, and for each level its size and findings.

    ``limit`` findings of each kind are listed; the name of a level is empty where there is but one.
    """
    yield f"{source}: {write_note(description)}"
    for note in write_notes(notes):
        yield Paragraph(note, "  ")
    for name, site, inspection in results:
        yield ""
        if name:
            yield f"Level {name}"
        yield from describe_site(site, inspection)
        yield from _list_findings(site, inspection, limit)


def _list_findings(site: Site, inspection: Inspection, limit: int) -> Iterator[Part]:
    if not inspection.findings:
        yield "No problems found."
        return
    of_severity = Counter(finding.severity for finding in inspection.findings)
    of_kind = Counter((finding.severity, finding.kind) for finding in inspection.findings)
    listed: Counter[tuple[str, str]] = Counter()
    severity: Severity | None = None
    for finding in inspection.findings:
        if finding.severity != severity:
            severity = finding.severity
            number = str(of_severity[severity])
            yield ""
            yield f"{write_heading(severity)}: {number}"
        group = severity, finding.kind
        listed[group] += 1
        if listed[group] <= limit:
            fact, remedy = describe_finding(site, finding)
            text = f"{fact} ({remedy})"
            yield Paragraph(text, "  ")
        elif listed[group] == limit + 1:
            text = f"and {of_kind[group] - limit} more: {finding.kind} (see --limit)"
            yield Paragraph(text, "  ")
