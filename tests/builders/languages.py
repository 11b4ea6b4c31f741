"""Words of a language that no page of another language may have, and phrases in German."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rightofway.languages import VALUE, choose_text, list_values, read_texts
from rightofway.report.phrases import Phrase

if TYPE_CHECKING:
    from tests.builders.browsers import Viewer

ENGLISH = (
    "alone", "and", "are", "away", "before", "booking", "bookings", "by", "choose", "close",
    "decision", "decisions", "done", "draw", "drives", "driving", "edges", "every", "faults",
    "finding", "findings", "first", "for", "from", "goes", "home", "is", "it", "lane",
    "lanes", "later", "lap", "laps", "leave", "length", "lines", "lost", "more", "no", "none",
    "nothing", "of", "on", "one", "other", "over", "place", "places", "repeats", "robots",
    "routes", "save", "show", "speed", "stop", "stops", "that", "the", "there", "they",
    "time", "times", "to", "turning", "turns", "units", "vertices", "vertex", "wait", "waiting",
    "waits", "way", "what", "when", "where", "which", "who", "why", "with", "work", "working",
    "works",
)  # fmt: skip
"""Frequent English words of these pages that are no German ones."""

SAID = """(words) => {
  const found = [];
  const isEnglish = (node) => {
    const spoken = node.closest("[lang]")?.lang ?? document.documentElement.lang;
    return spoken === "en" || node.closest("code, pre, script, style, [translate=no]") !== null;
  };
  const look = (text, node) => {
    const said = (text ?? "").toLowerCase().match(/\\p{L}+/gu) ?? [];
    const foreign = said.filter((word) => words.includes(word));
    const isPoint = /\\d\\.\\d|\\d%/.test(text ?? ""); // "1.5 s", "4.4%"
    if ((foreign.length || isPoint) && !isEnglish(node)) found.push(text.trim().slice(0, 90));
  };
  const tree = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = tree.nextNode(); node; node = tree.nextNode())
    look(node.textContent, node.parentElement);
  for (const node of document.querySelectorAll("*"))
    for (const name of ["aria-label", "title", "placeholder", "alt", "aria-roledescription"])
      look(node.getAttribute(name), node);
  for (const field of document.querySelectorAll("input:not([type]), input[type=search]"))
    look(field.value, field);
  return [...new Set(found)];
}"""


def english_on(viewer: Viewer) -> list[str]:
    """Return the texts of a page, hidden ones too, that are English or have English numbers.

    Parameters
    ----------
    viewer
        The page. What it marks as English may be so.
    """
    found: list[str] = viewer.page.evaluate(SAID, list(ENGLISH))
    return found


def say(phrase: Any) -> str:
    """Return plain data of a phrase as the phrase.

    Parameters
    ----------
    phrase
        Text, or a kind and values, as `rightofway.phrases.to_parts` returns them.
    """
    if isinstance(phrase, str):
        return phrase
    kind, values = phrase
    return Phrase(kind, **{name: say(value) for name, value in values.items()})


def read_entry(entries: Sequence[Any], index: int) -> str:
    """Return a phrase of a page by its index.

    Parameters
    ----------
    entries
        Those of `rightofway.phrases.PhraseBook`.
    index
        The index of a text or a phrase.
    """
    entry = entries[index]
    if isinstance(entry, str):
        return entry
    kind, *values = entry
    names = list_values(entries[kind])
    texts = (read_entry(entries, value) for value in values)
    return Phrase(entries[kind], **dict(zip(names, texts, strict=True)))


def translate(text: str) -> str:
    """Return a phrase in German, as pages show it.

    Parameters
    ----------
    text
        Text for people; text that is no phrase is returned as it is.
    """
    return _translate(text, text.kind) if isinstance(text, Phrase) else str(text)


def _translate(phrase: Phrase, kind: str) -> str:
    facts, values = read_texts("de")["facts"], phrase.values
    if kind == "figure":
        return values["figure"].replace(".", ",").replace("%", " %")

    def write(match: re.Match[str]) -> str:
        value, form = values[match[1]], match[2]
        if form and form.startswith("n_") and isinstance(value, Phrase):
            return _translate(value, form)
        return translate(value)

    return VALUE.sub(write, choose_text(facts[kind], values))
