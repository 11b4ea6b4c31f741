"""Texts cut to fit a terminal: lines of a text, columns of a word."""

from __future__ import annotations

from unicodedata import combining, east_asian_width

MAX_LINES = 120
"""Lines of a text that people read; a longer one ends with how to see the rest."""


def measure_text(text: str) -> int:
    """Return how many columns of a terminal a text takes."""
    return sum(
        0 if combining(character) else 2 if east_asian_width(character) in "WF" else 1
        for character in text
    )
