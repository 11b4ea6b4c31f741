"""Reports of 80 columns, and sentences of the library in German, as pages show them."""

from __future__ import annotations

from fractions import Fraction

from rightofway import load, solve
from rightofway.facts import Fact
from rightofway.io import load_with_notes
from rightofway.io.layouts.draft import LayoutDraft
from rightofway.io.layouts.formats import describe_layout
from rightofway.report.facts import write_note, write_notes
from rightofway.report.lines import COLUMNS, Facts, Table, lay_out
from rightofway.report.phrases import say_count
from rightofway.report.plan import report_decisions, summarize_plan
from rightofway.report.quantities import Quantities
from rightofway.site.layout import LayoutVertex
from tests.builders.languages import translate
from tests.cli.conftest import EXAMPLES


def test_no_line_of_a_report_is_longer_than_80_columns() -> None:
    plan = solve(load(EXAMPLES / "warehouse.yaml"), "two-level")
    for text in (
        summarize_plan(plan, Quantities.of(plan.scenario)),
        report_decisions(plan, Quantities.of(plan.scenario)),
    ):
        assert max(map(len, text.splitlines())) <= COLUMNS


def test_columns_are_as_wide_as_their_words() -> None:
    facts = Facts([("flowtime", say_count(2, "tick", "ticks")), ("makespan", "1")])
    assert lay_out([facts]) == "flowtime  2 ticks\nmakespan  1"
    table = Table(("robot", "alone"), [("R1", "10"), ("R2", "never")])
    assert lay_out([table]) == "robot  alone\nR1        10\nR2     never"


def test_notes_of_a_reader_are_said_in_german() -> None:
    (note,) = write_notes(load_with_notes(EXAMPLES / "floor.yaml").notes)
    assert note == "floor cut into 24 x 16 = 384 cells of 0.5 m"
    assert translate(note) == "Grundriss in 24 x 16 = 384 Zellen von 0,5 m geteilt"
    draft = LayoutDraft("LIF layout")
    level = draft.begin_level()
    for name, x in (("A", 0), ("B", 2)):
        level.vertices[name] = LayoutVertex(name=name, at=(Fraction(x), Fraction(0)))
    draft.repair(Fact("number as text"), "A", "B")
    layout = draft.make_layout()
    (note,) = write_notes(layout.notes)
    assert note == "2 times: a number is written as text: A and B"
    assert translate(note) == "2-mal: eine Zahl ist als Text geschrieben: A und B"
    description = write_note(describe_layout(layout))
    assert description == "a LIF layout with 2 vertices"
    assert translate(description) == "LIF layout (2 Knoten)"
