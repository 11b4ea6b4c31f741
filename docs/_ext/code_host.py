"""Pages that can be read without a build: Markdown for Sphinx is in comments.

A comment that begins with ``<!-- sphinx`` on a line of its own contains Markdown for Sphinx; code
hosts do not show it. Sphinx leaves out the text between ``<!-- not sphinx -->`` and
``<!-- end -->``. An equation is a block of the language ``math``, which both draw. With the tag
``gallery``, a link to its page follows each command of the gallery.
"""  # noqa: INP001 (a Sphinx extension, found by its path)

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

FOR_SPHINX = re.compile(r"^<!-- sphinx\n(.*?)^-->$", re.MULTILINE | re.DOTALL)
FOR_CODE_HOSTS = re.compile(r"^<!-- not sphinx -->$.*?^<!-- end -->$", re.MULTILINE | re.DOTALL)
ROOT_PAGE = re.compile(r"\]\(((?:\.\./)*)\.\./(CONTRIBUTING|CHANGELOG)\.md")
OUTSIDE = re.compile(r"\[([^\]]*)\]\((?:\.\./)+(benchmarks/README\.md)\)")
MADE = re.compile(r"^```sh gallery\n(?:.*\n)*?.*\b([\w-]+\.html)\n```$", re.MULTILINE)
EQUATION = re.compile(r"^( *)```math$", re.MULTILINE)


def reveal(app: Sphinx, _page: str, source: list[str]) -> None:
    """Give Sphinx its own Markdown, and links to the pages that include those of the root."""
    text = FOR_SPHINX.sub(r"\1", FOR_CODE_HOSTS.sub("", source[0]))
    text = ROOT_PAGE.sub(lambda link: f"]({link[1]}{link[2].lower()}.md", text)
    text = OUTSIDE.sub(r"\1 (`\2`)", text)
    if app.tags.has("gallery"):
        text = MADE.sub(r'\g<0>\n\n<p><a href="\1">Play it</a></p>', text)
    source[0] = EQUATION.sub(r"\1```{math}", text)


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the reader."""
    app.connect("source-read", reveal)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
