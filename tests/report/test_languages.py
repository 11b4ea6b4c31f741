"""Reports in the language of their reader: the sentences of the page, in 80 columns."""

from __future__ import annotations

from fractions import Fraction

import pytest

from rightofway import load, solve
from rightofway.io import load_with_notes
from rightofway.io.layouts.draft import LayoutDraft
from rightofway.io.layouts.formats import describe_layout
from rightofway.languages import ENGLISH, find_languages, translate
from rightofway.phrases import Phrase, say_count
from rightofway.report.lines import COLUMNS, Facts, Table, lay_out
from rightofway.report.plan import report_decisions, summarize_plan
from rightofway.site.layout import LayoutVertex
from tests.cli.conftest import EXAMPLES


def test_a_summary_in_german_has_the_sentences_of_the_page() -> None:
    plan = solve(load(EXAMPLES / "door.yaml"), "two-level")
    text = summarize_plan(plan, plan.scenario.quantities, "de")
    assert "Zeitsumme    19 Zeiteinheiten" in text
    assert "Bei Zeit 0: R1 wartet 1 Zeiteinheit in N0, bis R2 N1 verlässt." in text
    assert "Roboter  fertig  allein  Umwege  macht Platz  wartet" in text


@pytest.mark.parametrize("language", [ENGLISH, *find_languages()])
def test_no_line_of_a_report_is_longer_than_80_columns(language: str) -> None:
    plan = solve(load(EXAMPLES / "warehouse.yaml"), "two-level")
    for text in (
        summarize_plan(plan, plan.scenario.quantities, language),
        report_decisions(plan, plan.scenario.quantities, language),
    ):
        assert max(map(len, text.splitlines())) <= COLUMNS


def test_columns_are_as_wide_as_the_words_of_the_language() -> None:
    facts = Facts([(Phrase("flowtime"), say_count(2, "tick", "ticks")), (Phrase("makespan"), "1")])
    assert lay_out([facts]) == "flowtime  2 ticks\nmakespan  1"
    assert lay_out([facts], "de") == "Zeitsumme    2 Zeitschritte\nGesamtdauer  1"
    table = Table((Phrase("robot"), Phrase("alone")), [("R1", "10"), ("R2", Phrase("never"))])
    assert lay_out([table], "de") == "Roboter  allein\nR1           10\nR2          nie"


def test_notes_of_a_reader_are_said_in_german() -> None:
    (note,) = load_with_notes(EXAMPLES / "floor.yaml").notes
    assert note == "floor cut into 24 x 16 = 384 cells of 0.5 m"
    assert translate(note, "de") == "Boden in 24 x 16 = 384 Zellen von 0.5 m geteilt"
    draft = LayoutDraft("LIF layout")
    level = draft.begin_level()
    for name, x in (("A", 0), ("B", 2)):
        level.vertices[name] = LayoutVertex(name=name, at=(Fraction(x), Fraction(0)))
    draft.repair(Phrase("a number is written as text"), "A", "B")
    layout = draft.make_layout()
    assert layout.notes == ("2 times: a number is written as text: A and B",)
    assert translate(layout.notes[0], "de") == "2-mal: eine Zahl ist als Text geschrieben: A und B"
    assert describe_layout(layout) == "a LIF layout with 2 vertices"
    assert translate(describe_layout(layout), "de") == "LIF layout (2 Knoten)"


def test_text_that_is_no_phrase_is_said_as_it_is() -> None:
    assert translate("by hand", "de") == "by hand"
