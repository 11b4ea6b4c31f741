"""Lanes of GraphML that are read as columns are those that are read one by one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import strategies as st

from rightofway.errors import InputError
from rightofway.io.layouts import graphml, xml_tree
from rightofway.io.layouts.formats import read_layout
from rightofway.io.layouts.xml_run import cut_run
from rightofway.io.layouts.xml_tree import parse_xml
from tests.builders.laws import law

EDGE = '<edge id="{id}" source="{tail}" target="{head}">\n <data key="d1">{length}</data>\n</edge>'
FORMS = (
    EDGE,
    EDGE.replace("\n", ""),
    EDGE.replace("</edge>", '<data key="d2">{speed}</data></edge>'),
    '<edge source="{tail}" target="{head}" length="{length}"/>',
    '<edge target="{head}" source="{tail}" SPEED_LIMIT="{speed}"></edge>',
    '<edge source="{tail}" target="{head}" directed="{flag}"/>',
    '<edge source="{tail}" target="{head}"><data key="{key}">{length}</data></edge>',
    '<edge source="{tail}" target="{head}"><data key="d3">{length}</data></edge>',
)
NUMBERS = st.sampled_from(["5", " 5.50 ", "6", "1/2", "0", "-1", "", "x", "1e400", "5]]>", "5\x02"])
ROWS = st.fixed_dictionaries(
    {
        "id": st.sampled_from(["e0", "e1", "", "a&amp;b"]),
        "tail": st.sampled_from(["a", "b", "c", "c", "lost", "a b"]),
        "head": st.sampled_from(["a", "b", "c", "&#99;"]),
        "length": st.one_of(st.sampled_from(["5", "6"]), NUMBERS),
        "speed": st.one_of(st.sampled_from(["1", "2"]), NUMBERS),
        "flag": st.sampled_from(["true", "false"]),
        "key": st.sampled_from(["d1", "d1", "d1", "d3"]),
    }
)
PLAIN = {"id": "e", "length": "5", "speed": "1", "flag": "true", "key": "d1"}

FILE = """<?xml version="1.0"?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
<key id="d1" for="edge" attr.name="weight"/><key id="d2" for="edge" attr.name="max_speed"/>
<key id="d3" for="edge" attr.name="colour"/>
<graph edgedefault="{directed}">
<node id="a" x="0" y="0"/><node id="b" x="3" y="4"/><node id="c" x="3" y="0"/>
{edges}
</graph>
</graphml>
"""


@st.composite
def files(draw: st.DrawFn) -> str:
    """Return a GraphML file whose lanes are written alike, apart from a few."""
    form, other = draw(st.sampled_from(FORMS)), draw(st.sampled_from(FORMS))
    odd = draw(st.lists(ROWS, max_size=2))
    names = draw(st.lists(st.sampled_from([("a", "b"), ("b", "c"), ("c", "a")]), max_size=6))
    edges = [form.format(**PLAIN, tail=tail, head=head) for tail, head in names]
    for row in odd:
        place = draw(st.integers(0, len(edges)))
        edges.insert(place, draw(st.sampled_from([form, other])).format(**row))
    directed = draw(st.sampled_from(["directed", "undirected"]))
    return FILE.format(directed=directed, edges=draw(st.sampled_from(["\n", "", "  "])).join(edges))


def read(text: str, run_of: str) -> Any:
    """Return the layout of a text as plain data, or its faults."""
    try:
        layout = graphml.read(parse_xml(text, run_of))
    except InputError as error:
        return str(error)
    (level,) = layout.levels
    table: Any = level.edges
    columns = (table.tails, table.heads, table.lengths, table.kind_of_lane)
    return [column.tolist() for column in columns], table.kinds, level.vertices, layout.notes


@law(files())
def test_lanes_in_columns_are_those_of_elements(text: str) -> None:
    assert read(text, graphml.LANE) == read(text, "")


def test_lanes_that_are_written_alike_are_a_run(monkeypatch: pytest.MonkeyPatch) -> None:
    edges = [EDGE.format(**PLAIN, tail=tail, head=head) for tail, head in ("ab", "bc", "ca")]
    text = FILE.format(directed="directed", edges="\n".join(edges))
    shorter, run = cut_run(text, "edge", 100)
    assert run is not None
    assert run.columns[1:3] == (("b", "c"), ("c", "a"))
    assert shorter.count("<edge") == 1
    assert shorter.count("\n") == text.count("\n")
    monkeypatch.delattr(xml_tree, "_expand_run")  # no element is made of it
    assert read(text, graphml.LANE)[0][0] == [0, 1, 2]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("<graph ", "<!-- <edge source='a' target='b'/> --><graph "),
        ("<graph ", '<?note <edge source="a" target="b"/>?><graph '),
        ("<node", '<g:edge source="a" target="b"/><node'),
    ],
)
def test_no_run_is_cut_where_only_expat_knows_the_elements(old: str, new: str) -> None:
    edges = '<edge source="a" target="b"/>' * 3
    text = FILE.format(directed="directed", edges=edges).replace(old, new, 1)
    assert cut_run(text, "edge", 100) == (text, None)


def test_faults_in_a_run_have_their_lines(tmp_path: Path) -> None:
    """The last lane begins in line 13: six lines come first, and each lane has three."""
    edges = [EDGE.format(**PLAIN, tail=tail, head=head) for tail, head in ("ab", "bc", "cx")]
    path = tmp_path / "road.graphml"
    path.write_text(FILE.format(directed="directed", edges="\n".join(edges)))
    with pytest.raises(InputError, match=":13: no vertex is named 'x'"):
        read_layout(path)
