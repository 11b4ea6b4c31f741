"""What is said of decisions and losses, in phrases that keep their values."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rightofway.model import Decision, Plan, Tick
from rightofway.report.phrases import PhraseBook
from rightofway.report.quantities import Quantities
from rightofway.report.sentences import (
    Words,
    describe_decision,
    describe_reason,
    explain_decision,
    summarize_decision,
)
from rightofway.site import VertexId
from rightofway.units import Units
from tests.builders.plans import door

DECISION = Decision(
    tick=Tick(1),
    kind="vertex",
    vertices=(VertexId(3),),
    robots=(0, 1),
    waits=1,
    waits_at=VertexId(3),
    ticks=Tick(6),
    level="robot",
    conflicts_left=(4, 4),
    completion_sums=(Tick(50), Tick(47)),
)
"""R1 and R2 both want N4, and R2 waits for 6 s."""


@pytest.fixture
def words() -> Words:
    plan: Plan = door()
    plan = replace(plan, scenario=replace(plan.scenario, units=Units(time="s")))
    return Words(plan=plan, quantities=Quantities.of(plan.scenario))


def test_a_decision_is_explained_with_the_figures_of_both_choices(words: Words) -> None:
    assert "R2 waits 6 s in N4 and lets R1 go first." in describe_decision(words, DECISION)
    assert explain_decision(words, DECISION) == (
        "Robot level: either choice leaves as many conflicts in the whole system, so the smaller"
        " sum of completion times decides. Conflicts left: 4 if R1 waits, 4 if R2 waits. Sum of"
        " completion times: 50 s if R1 waits, 47 s if R2 waits."
    )


def test_a_line_on_a_decision_has_the_loss_and_the_reason(words: Words) -> None:
    assert summarize_decision(words, DECISION) == (
        "R2 waits for R1, N4",
        "at 1 s \u00b7 loses 6 s \u00b7 both done sooner in all",
    )


def test_of_an_only_choice_it_is_said_what_the_other_one_leads_to(words: Words) -> None:
    decision = replace(DECISION, level="only", waits=0, completion_sums=None)
    assert describe_reason(words, decision) == (
        "R2 cannot wait here: with the decisions taken before, no plan is possible then."
    )


def test_where_one_order_leads_to_no_plan_that_is_said(words: Words) -> None:
    decision = replace(DECISION, completion_sums=(None, Tick(47)))
    text = explain_decision(words, decision)
    assert "and only with R2 waiting do both get through." in text
    assert "Sum of completion times: no way if R1 waits, 47 s if R2 waits." in text


def test_a_book_of_phrases_has_each_text_once(words: Words) -> None:
    book = PhraseBook()
    first = book.add(describe_decision(words, DECISION))
    size = len(book.entries)
    assert book.add(describe_decision(words, DECISION)) == first
    assert len(book.entries) == size
    texts = [entry for entry in book.entries if isinstance(entry, str)]
    assert len(texts) == len(set(texts))
