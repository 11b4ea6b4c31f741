"""The pages of the documentation and the fenced blocks in them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

__all__ = ["DOCS", "PAGES", "ROOT", "SDIST", "Block", "blocks", "title_of"]

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
SDIST = (ROOT / "PKG-INFO").exists()
"""Whether this is a source distribution: all that a checkout has, but for pictures."""
PAGES = [
    *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")),
    *(page for page in sorted(DOCS.rglob("*.md")) if "_build" not in page.parts),
]

_FENCE = re.compile(
    r"^(?P<fence>`{3,})(?P<info>[^\n`]*)\n(?P<text>.*?)^(?P=fence)$", re.MULTILINE | re.DOTALL
)


@dataclass(frozen=True, slots=True)
class Block:
    """A fenced block: the words behind its fence, its text, and the line it begins in."""

    info: tuple[str, ...]
    text: str
    line: int

    @property
    def language(self) -> str:
        return self.info[0] if self.info else ""

    @property
    def file_name(self) -> str | None:
        """The second word of ``python in_turn.py``: the reader saves the block under it."""
        is_file = len(self.info) > 1 and "." in self.info[1] and not self.language.startswith("{")
        return self.info[1] if is_file else None


def blocks(page: Path) -> Iterator[Block]:
    """Yield the fenced blocks of a page in order."""
    text = page.read_text(encoding="utf-8")
    for match in _FENCE.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        yield Block(tuple(match["info"].split()), match["text"], line)


def title_of(page: Path) -> str:
    """Return a page as test ids name it."""
    return page.relative_to(ROOT).as_posix()
