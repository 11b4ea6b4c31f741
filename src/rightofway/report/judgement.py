"""Sentences on faults found by the judge, each with its reason and a remedy."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from rightofway.check import Fault, Report
from rightofway.facts import Fact
from rightofway.report.facts import FactWriter
from rightofway.report.phrases import Phrase, chain_items
from rightofway.report.quantities import Quantities

Values = Mapping[str, Any]


def name_fault(kind: str, count: int = 1) -> Phrase:
    """Return the name of a kind of fault, in the plural for other counts than 1."""
    return Phrase(f"{kind}: name", number=str(count))


def describe_fault(fault: Fault, quantities: Quantities | None = None) -> tuple[Phrase, Phrase]:
    """Return the reason and the remedy of a fault."""
    writer = FactWriter(fault.scenario, quantities)
    return _fill(writer, fault, "reason"), _fill(writer, fault, "remedy")


def write_fault_message(fault: Fault, quantities: Quantities | None = None) -> Phrase:
    """Return the reason of a fault, and its remedy in brackets."""
    reason, remedy = describe_fault(fault, quantities)
    return Phrase("reason and remedy", reason=reason, remedy=remedy)


def write_fault(fault: Fault, quantities: Quantities | None = None) -> Phrase:
    """Return when a fault begins, its kind, and its message."""
    writer = FactWriter(fault.scenario, quantities)
    return Phrase(
        "fault at moment",
        moment=writer.quantities.format_moment(fault.tick),
        kind=name_fault(fault.kind),
        message=write_fault_message(fault, quantities),
    )


def summarize_report(report: Report) -> Phrase:
    """Return the number of faults of each kind, in a line."""
    if report.ok:
        return Phrase("no fault")
    kinds = [
        Phrase("faults of kind", number=str(count), kind=name_fault(kind, count))
        for kind, count in report.counts.items()
    ]
    faults = Phrase("n_faults", number=str(report.total))
    return Phrase("faults by kind", faults=faults, kinds=chain_items(kinds))


def list_report_sentences(report: Report, quantities: Quantities | None = None) -> Iterator[Phrase]:
    """Yield the number of faults of each kind, and each fault that is listed."""
    yield summarize_report(report)
    for fault in report.faults:
        yield write_fault(fault, quantities)
    if unlisted := report.total - len(report.faults):
        yield Phrase("unlisted faults", number=str(unlisted))


def _fill(writer: FactWriter, fault: Fault, part: str) -> Phrase:
    kind: str = fault.kind
    if kind == "jump" and len(set(fault.vertices)) == 1:
        kind = "jump, twice"
    ends = fault.vertices + fault.vertices[:1]
    values: dict[str, Any] = {"robots": fault.robots}
    if fault.robots:
        first, *_, last = (*fault.robots, fault.robots[-1])
        values |= {"robot": first, "one": first, "other": last}
    values |= {
        "vertex": ends[0],
        "tail": ends[0],
        "head": ends[1],
        "vertices": fault.vertices,
        "moment": fault.tick,
        **fault.numbers,
    }
    values |= _SHAPES.get((fault.kind, part), _keep)(values)
    return writer.fill(f"{kind}: {part}", values)


def _keep(_: Values) -> Values:
    return {}


def _select_booking(begin: int, end: int | None) -> Fact:
    return (
        Fact("booked for ever", begin=begin)
        if end is None
        else Fact("booked until", begin=begin, end=end)
    )


def _select_place(ends: Sequence[int]) -> Fact:
    return (
        Fact("vertex", vertex=ends[0])
        if len(ends) == 1
        else Fact("directed edge", tail=ends[0], head=ends[1])
    )


def _select_whereabouts(ends: Sequence[int]) -> Fact:
    return (
        Fact("at vertex", vertex=ends[0])
        if len(ends) == 1
        else Fact("between vertices", tail=ends[0], head=ends[-1])
    )


def _select_needs(values: Values) -> Values:
    times = (("working", values["work"]), ("turning", values["turn"]))
    return {"need": [Fact(kind, time=time) for kind, time in times if time]}


def _select_closed(values: Values) -> Values:
    ends, end = values["vertices"], values["end"]
    place = Fact("vertex", vertex=ends[0])
    if len(ends) > 1:
        place = Fact("edge", tail=ends[0], head=ends[1])
    return {
        "place": place,
        "until": Fact("for ever") if end is None else Fact("until", end=end),
    }


_SHAPES: Mapping[tuple[str, str], Callable[[Values], Values]] = {
    ("backwards", "reason"): lambda values: {
        "moment": values["enter"],
        "next": values["head"],
        "earlier": values["leave"],
    },
    ("too fast", "remedy"): lambda values: {"moment": values["earliest"]},
    ("turn cut short", "remedy"): lambda values: {
        "vertex": values["next"],
        "moment": values["earliest"],
    },
    ("wrong home", "remedy"): lambda _: {"moment": 0},
    ("wrong start", "remedy"): lambda _: {"moment": 0},
    ("outside visit", "reason"): lambda values: {
        "time": _select_booking(values["since"], values["until"])
    },
    ("stranded", "reason"): lambda values: {
        "way": Fact("no way to charge")
        if values["least"] is None
        else Fact("way to charge", least=values["least"])
    },
    ("wrong end", "remedy"): lambda values: {"vertex": values["end"]},
    ("work cut short", "reason"): _select_needs,
    ("work cut short", "remedy"): lambda values: {"time": values["missing"]},
    ("vertex conflict", "reason"): lambda values: {
        "time": _select_booking(values["begin"], values["end"]),
        "other_time": _select_booking(values["other_begin"], values["other_end"]),
    },
    ("headway", "remedy"): lambda values: {"moment": values["earliest"]},
    ("rotation", "reason"): lambda values: {"robots": values["moving"]},
    ("space conflict", "reason"): lambda values: {
        "bookings": [
            Fact("booking", robot=robot, place=_select_place(ends))
            for robot, ends in zip(values["robots"], values["places"], strict=True)
        ]
    },
    ("too close", "reason"): lambda values: {
        "moment": values["instant"],
        "place": _select_whereabouts(values["places"][0]),
        "other_place": _select_whereabouts(values["places"][1]),
    },
    ("zone conflict", "reason"): lambda values: {"other_vertex": values["vertices"][1]},
    ("closed", "reason"): _select_closed,
    ("stop at pass", "remedy"): lambda values: {"moment": values["late"]},
    ("barred", "reason"): lambda values: {
        "why": Fact("near a wall")
        if values["type"] is None
        else Fact("barred for type", type=values["type"])
    },
}
"""Values of a part of a sentence that follow from those of the fault."""
