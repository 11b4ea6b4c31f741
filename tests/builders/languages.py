"""English that no German page may have, and phrases in German."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

from rightofway.languages import LANGUAGES, VALUE, choose_text, list_values, read_texts
from rightofway.report.phrases import Phrase

if TYPE_CHECKING:
    from playwright.sync_api import Frame

    from tests.builders.browsers import Viewer

ENGLISH = (
    "above", "after", "all", "allow", "alone", "and", "another", "any", "are", "as", "at",
    "away", "be", "because", "before", "behind", "below", "beside", "between", "both", "but",
    "by", "came", "can", "cannot", "choose", "close", "closed", "do", "does", "done", "down",
    "driving", "each", "either", "empty", "end", "every", "far", "fast", "faults", "few",
    "finding", "findings", "first", "follow", "following", "for", "from", "further", "give",
    "given", "goes", "had", "has", "have", "how", "if", "into", "is", "it", "its", "keep",
    "lanes", "laps", "later", "least", "leave", "left", "less", "let", "lose", "made", "make",
    "may", "mean", "more", "most", "must", "need", "never", "new", "next", "no", "none", "nor",
    "not", "nothing", "of", "off", "on", "once", "one", "only", "or", "other", "others", "out",
    "over", "own", "place", "places", "press", "quick", "robots", "routes", "rule", "same",
    "see", "select", "share", "should", "show", "since", "some", "speed", "stay",
    "such", "take", "than", "that", "the", "their", "them", "then", "there", "these",
    "they", "this", "those", "times", "to", "together", "too", "turns", "under", "until", "use",
    "used", "vertices", "wait", "waiting", "waits", "way", "were", "what", "when", "where",
    "whether", "which", "while", "who", "why", "will", "with", "without", "work", "working",
    "works", "would", "yet", "you", "your",
)  # fmt: skip
"""Frequent English words that are no German ones."""

LOOK = """([words, texts, names]) => {
  const found = [];
  const isName = (node) =>
    node.closest("code, pre, script, style, noscript, iframe, [translate=no]") !== null;
  const isMessage = (node) => node.closest("[lang]")?.lang === "en"; // of a reader
  const english = texts.map((text) => new RegExp(`^${text}$`, "u"));
  const look = (text, node) => {
    let rest = (text ?? "").trim();
    for (const name of names) rest = rest.replaceAll(name, "");
    const said = rest.toLowerCase().match(/\\p{L}+/gu) ?? [];
    const isEnglish =
      said.some((word) => words.includes(word)) ||
      english.some((text) => text.test(rest)) ||
      /\\d\\.\\d|\\d%/.test(rest); // "1.5 s", "4.4%"
    if (isEnglish && !isName(node) && !isMessage(node)) found.push(rest.slice(0, 120));
  };
  const tree = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = tree.nextNode(); node; node = tree.nextNode())
    look(node.textContent, node.parentElement);
  const attributes = ["aria-label", "aria-valuetext", "title", "placeholder", "alt",
    "aria-roledescription"];
  for (const node of document.querySelectorAll("*"))
    for (const name of attributes) look(node.getAttribute(name), node);
  for (const field of document.querySelectorAll("input:not([type]), input[type=search]"))
    look(field.value, field);
  look(document.title, document.body);
  return [...new Set(found)];
}"""


@cache
def list_english_texts() -> list[str]:
    """Return patterns of the English texts that differ from the German ones."""
    english, german = (dict(_list_texts(read_texts(code))) for code in LANGUAGES)
    same = set(german.values())
    texts = {text for key, text in english.items() if german.get(key) != text} - same
    return [
        VALUE.sub(".+", re.sub(r"[.*+?^$()|[\]\\/]", r"\\\g<0>", text))
        for text in sorted(texts)
        if len(re.findall(r"[A-Za-z]{2,}", VALUE.sub("", text))) > ("{" in text)
    ]


def _list_texts(node: Any, path: str = "") -> Iterator[tuple[str, str]]:
    if isinstance(node, str):
        yield path, node
        return
    for key, each in node.items() if isinstance(node, dict) else enumerate(node):
        yield from _list_texts(each, f"{path}.{key}")


def english_on(viewer: Viewer | Frame, *names: str) -> list[str]:
    """Return the texts of a page, hidden ones too, that are English or have English numbers.

    Parameters
    ----------
    viewer
        The page, or a frame in it.
    *names
        Names that people have given, which are not translated.
    """
    page = viewer.page if hasattr(viewer, "complaints") else viewer
    found: list[str] = page.evaluate(LOOK, [sorted(ENGLISH), list_english_texts(), list(names)])
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
