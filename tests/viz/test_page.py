"""The page as a file: whole, closed to the network, safe whatever names a plan brings."""

import base64
import hashlib
import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from rightofway.errors import InputError
from rightofway.model import Tick
from rightofway.report.place_names import PlaceNames
from rightofway.units import Units
from rightofway.viz import make_frame, make_page, make_payload, make_png, write_page
from rightofway.viz.page.schema import Payload
from rightofway.viz.page.scripts import order_scripts
from rightofway.viz.page.texts import find_texts
from tests.builders.languages import read_entry
from tests.builders.payloads import payload_in, template_in
from tests.builders.plans import (
    counter,
    counter_late,
    counter_steady,
    crowd,
    door,
    door_shifted,
    hostile,
    loop,
)

EVIL = "</script><script>hacked=1</script><!--<img src=x onerror=hacked=1>\u2028&amp;'\"{{title}}"


class Elements(HTMLParser):
    """Collects tags, attributes, and the text in script elements."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str | None]] = []
        self.texts: dict[str, list[str]] = {}
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += attrs

    def handle_data(self, data: str) -> None:
        self.texts.setdefault(self.tags[-1] if self.tags else "", []).append(data)


def test_the_page_carries_the_payload() -> None:
    assert payload_in(make_page(door())) == json.loads(json.dumps(make_payload(door())))


def text_in(payload: Payload, index: int) -> str:
    """Return a text of a payload in English."""
    return read_entry(payload["phrases"], index)


def test_the_page_has_the_figures_of_a_decision_as_the_report_has_them() -> None:
    plan = door()
    decision = replace(
        plan.run.decisions[0],
        conflicts_left=(None, 3),
        completion_sums=(Tick(18), None),
    )
    plan = replace(plan, run=replace(plan.run, decisions=(decision,)))
    payload = make_payload(plan)
    (data,) = payload["decisions"]
    rows = [[text_in(payload, part) for part in row] for row in data["figures"]]
    assert rows == [
        ["Conflicts left", "impossible", "3"],
        ["Sum of completion times", "18 time units", "no way"],
    ]
    assert find_texts(payload)["de"]["facts"]["figure: conflicts left"] == "Übrige Konflikte"


def test_the_page_calls_cells_after_robots_as_reports_do() -> None:
    """Only where lengths have a unit: else a cell goes by its number."""
    assert "places" not in make_payload(door())
    plan = door()
    scenario = replace(plan.scenario, units=Units(length="m", time="s"))
    payload, names = make_payload(replace(plan, scenario=scenario)), PlaceNames(scenario)
    places = {vertex: text_in(payload, text) for vertex, text in payload["places"]}
    assert places == names.of_robots
    assert places[int(scenario.robots[0].home)] == "the home of R1"


def test_a_small_plan_makes_a_small_page() -> None:
    assert (
        len(make_page(door()).encode()) < 308_000
    )  # 40 kB are texts in two languages; fields, checks for types and times of day took 7 kB


def test_names_bring_no_element_and_no_attribute_with_them() -> None:
    harmless, evil = Elements(make_page(hostile("x"))), Elements(make_page(hostile(EVIL)))
    assert evil.tags == harmless.tags
    assert [name for name, _ in evil.attributes] == [name for name, _ in harmless.attributes]


def test_names_come_through_as_they_are() -> None:
    payload = payload_in(make_page(hostile(EVIL)))
    assert payload["robots"][0]["name"] == EVIL
    assert payload["map"]["names"][0] == EVIL
    assert payload["reroutes"][0]["because"] == ["other", {"text": EVIL}]


def test_a_name_that_is_no_valid_unicode_can_be_written(tmp_path: Path) -> None:
    write_page(hostile("half \ud800"), tmp_path / "page.html")
    assert payload_in((tmp_path / "page.html").read_text("utf-8"))["robots"][0]["name"][-1] == (
        "\ud800"
    )


def test_only_our_own_scripts_and_style_may_run() -> None:
    page = make_page(door())
    policy = dict(re.findall(r"([a-z]+-src) ([^;\"]*)", page))
    scripts = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    digests = [
        base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() for script in scripts
    ]
    assert policy["default-src"] == "'none'"
    assert policy["script-src"].split() == [f"'sha256-{digest}'" for digest in digests]
    assert "unsafe" not in "".join(policy.values())


def test_the_page_names_no_address() -> None:
    page = make_page(door()).replace("http://www.w3.org/2000/svg", "")  # a name, not an address
    assert not re.search(r"https?://|//[a-z]+\.|@import|url\(", page)


def test_every_script_is_on_a_page_and_short() -> None:
    used = {
        module
        for entry in ("main", "jobs_main", "shift_main", "inspect_main", "watch_main", "widget")
        for module in order_scripts(entry)
    }
    assets = Path(make_page.__code__.co_filename).parent / "assets"
    for script in assets.rglob("*.js"):
        assert script.relative_to(assets).with_suffix("").as_posix() in used
        is_table = script.parent.name == "texts"
        lines = script.read_text("utf-8").splitlines()
        code = [line for line in lines if not line.lstrip().startswith(("/**", "*"))]  # not types
        assert len(code) < (600 if is_table else 400)


def test_long_lists_are_written_as_differences() -> None:
    robot = make_payload(door())["robots"][0]
    assert robot["vertices"] == [0, 1, 2, 2, -1, 1, -2, -2, -1]
    assert robot["enter"] == [0, 2, 1, 1, 1, 2, 1, 1, 1]


def test_a_thousand_robots_take_less_than_two_megabytes() -> None:
    assert len(make_page(crowd(1000)).encode()) < 2_000_000


def test_lost_time_has_its_cause() -> None:
    # R1 waits for R2 in vertex 0 to get to 1, which R2 leaves, from tick 0 to 1, for 1 tick
    payload = make_payload(door())
    assert [row[:-1] for row in payload["losses"]] == [(0, 0, 1, 0, 0, 1, 1, 0, 1, 1)]
    assert template_in(payload, payload["losses"][0][-1]) == ("waits for place")
    assert make_payload(door())["robots"][0]["lost"] == (0, 0, 1)


def test_stages_tell_which_visit_serves_them() -> None:
    # vertex, work, turning, visit: the stop c, then the way home
    assert make_payload(loop())["robots"][0]["stages"] == [(2, 4, 2, 2), (0, 0, 2, 4)]


def test_edges_of_several_lengths_are_told_one_by_one() -> None:
    assert make_payload(loop())["robots"][0]["drive"] == [0, 2, 2, 3, 2]
    assert make_payload(door())["robots"][0]["drive"] == 1


@pytest.mark.parametrize(("occupancy", "ahead"), [("one", False), ("both", True)])
def test_the_rule_of_occupancy_is_told(occupancy: str, *, ahead: bool) -> None:
    assert make_payload(loop(occupancy=occupancy))["booksAhead"] is ahead


def test_a_page_replaces_what_was_there(tmp_path: Path) -> None:
    target = tmp_path / "page.html"
    target.write_text("old")
    write_page(door(), target)
    assert target.read_text("utf-8") == make_page(door())
    assert list(tmp_path.iterdir()) == [target]


def test_a_page_that_cannot_be_written_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no directory"):
        write_page(door(), tmp_path / "nowhere" / "page.html")
    assert list(tmp_path.iterdir()) == []


def test_a_notebook_shows_laps_and_late_runs_too() -> None:
    extras: Any = {"steady": [counter_steady()], "actual": counter_late()}
    frame = Elements(make_frame(counter(), **extras))
    assert dict(frame.attributes)["srcdoc"] == make_page(counter(), **extras)


def test_a_notebook_without_frames_still_has_a_picture() -> None:
    picture = dict(Elements(make_frame(door())).attributes)["src"] or ""
    head, data = picture.split(",")
    assert head == "data:image/png;base64"
    assert base64.b64decode(data) == make_png(door())


def test_a_notebook_shows_the_page_in_a_sandbox() -> None:
    frame = make_frame(hostile(EVIL))
    elements = Elements(frame)
    assert elements.tags == ["div", "img", "iframe"]
    assert dict(elements.attributes)["sandbox"] == "allow-scripts"
    assert dict(elements.attributes)["srcdoc"] == make_page(hostile(EVIL))


def test_plans_of_different_scenarios_have_maps_of_their_own() -> None:
    payload = make_payload(door(), others=[(door_shifted(1), "B.json"), (loop(), "C.json")])
    same, different = payload["others"]
    assert "map" not in same
    assert different["map"] != payload["map"]
    assert same["line"] == payload["line"]
    assert payload["comparison"]["robots"][0] == {"name": "R1", "completion": [20, 22, None]}


def test_times_in_a_unit_and_in_none_are_not_compared() -> None:
    plan = door()
    timed = replace(plan, scenario=replace(plan.scenario, units=Units(time="s")))
    with pytest.raises(InputError, match=r"B.json: its times are in s, those of .* in no unit"):
        make_page(plan, others=[(timed, "B.json")])
