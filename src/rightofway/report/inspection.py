"""Reports on an inspection: what a file is, how large its sites are, and what will hurt on them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from rightofway.metrics import HEADINGS, Inspection, Site, describe_site
from rightofway.phrases import Phrase
from rightofway.report.lines import Paragraph, Part


def report_inspection(
    source: str,
    description: str,
    notes: Iterable[str],
    results: Sequence[tuple[str, Site, Inspection]],
    limit: int,
) -> Iterator[Part]:
    """Yield what a file is, what its reader notes, and for each level its size and its findings.

    ``limit`` findings of each kind are listed; the name of a level is empty where there is but one.
    """
    yield Phrase("{file}: {text}", file=source, text=description)
    for note in notes:
        yield Paragraph(note, "  ")
    for name, site, inspection in results:
        yield ""
        if name:
            yield Phrase("Level {name}", name=name)
        yield from describe_site(site, inspection)
        yield from _findings(inspection, limit)


def _findings(inspection: Inspection, limit: int) -> Iterator[Part]:
    if not inspection.findings:
        yield Phrase("Nothing was found that will hurt.")
        return
    of_severity = Counter(finding.severity for finding in inspection.findings)
    of_kind = Counter((finding.severity, finding.kind) for finding in inspection.findings)
    listed: Counter[tuple[str, str]] = Counter()
    severity = ""
    for finding in inspection.findings:
        if finding.severity != severity:
            severity = finding.severity
            number = str(of_severity[severity])
            yield ""
            yield Phrase("{heading}: {number}", heading=HEADINGS[severity], number=number)
        group = severity, finding.kind
        listed[group] += 1
        if listed[group] <= limit:
            text = Phrase("{reason} ({remedy})", reason=finding.fact, remedy=finding.remedy)
            yield Paragraph(text, "  ")
        elif listed[group] == limit + 1:
            text = Phrase(
                "and {number} more: {kind} (see --limit)",
                number=str(of_kind[group] - limit),
                kind=finding.kind,
            )
            yield Paragraph(text, "  ")
