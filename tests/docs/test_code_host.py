"""What Sphinx reads instead of what a code host shows."""

from __future__ import annotations

import runpy
from types import SimpleNamespace

from tests.builders.pages import DOCS

REVEAL = runpy.run_path(str(DOCS / "_ext" / "code_host.py"))["reveal"]


def read(text: str, *tags: str) -> str:
    source = [text]
    app = SimpleNamespace(tags=SimpleNamespace(has=lambda tag: tag in tags))
    REVEAL(app, "page", source)
    return source[0]


def test_what_only_sphinx_understands_comes_out_of_its_comment() -> None:
    assert read("one\n<!-- sphinx\n```{toctree}\nmodel\n```\n-->\ntwo\n") == (
        "one\n```{toctree}\nmodel\n```\n\ntwo\n"
    )


def test_what_is_for_code_hosts_is_left_out_and_generated_parts_stay() -> None:
    text = "one\n<!-- not sphinx -->\n![a](b.png)\n<!-- end -->\ntwo\n"
    assert read(text) == "one\n\ntwo\n"
    generated = "<!-- generated: decisions -->\n\n- one\n\n<!-- end -->\n"
    assert read(generated) == generated


def test_links_to_the_root_lead_to_the_pages_that_include_it() -> None:
    assert read("[how](../../CONTRIBUTING.md#code)") == "[how](../contributing.md#code)"
    assert read("[new](../CHANGELOG.md)") == "[new](changelog.md)"
    assert read("[figures](../benchmarks/README.md)") == "figures (`benchmarks/README.md`)"


def test_an_equation_of_a_code_host_is_one_of_sphinx() -> None:
    assert read("```math\nx\n```\n") == "```{math}\nx\n```\n"


def test_a_page_of_the_gallery_is_linked_where_it_was_made() -> None:
    text = (
        "```sh gallery\nrightofway plan a.yaml -o a.json\nrightofway show a.json -o a.html\n```\n"
    )
    assert read(text) == text
    assert read(text, "gallery") == text + '\n<p><a href="a.html">Play it</a></p>\n'
