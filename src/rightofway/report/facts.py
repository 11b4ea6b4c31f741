"""Sentences of facts, from the templates of `rightofway.languages`.

A template has values in braces, with the form in which people read them: ``{robot:robot}`` is the
name of a robot, ``{time:duration}`` a number of ticks as a time. A value without a form is text, a
number, or another fact.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence, Sized
from dataclasses import replace
from fractions import Fraction
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any

from typing_extensions import TypedDict

from rightofway.errors import Blockage
from rightofway.facts import Fact
from rightofway.languages import VALUE, find_text, read_texts
from rightofway.model import Scenario
from rightofway.report.phrases import (
    Phrase,
    chain_items,
    join_first,
    join_items,
    mark_figure,
    to_parts,
)
from rightofway.report.place_names import PlaceNames, describe_middle
from rightofway.report.quantities import Quantities, format_decimal
from rightofway.units import Units

if TYPE_CHECKING:
    from rightofway.metrics import Site

__all__ = ["FactData", "FactWriter", "write_notes"]


class FactData(TypedDict):
    """A fact as plain data: its kind, and its values by name."""

    kind: str
    values: dict[str, Any]


@cache
def list_forms(template: str) -> tuple[tuple[str, str], ...]:
    """Return the names of the values of a template, each with its form."""
    return tuple(VALUE.findall(template))


def count_things(values: Mapping[str, Any]) -> str:
    """Return the number that chooses a template: the value ``number``, or the count of robots."""
    number = values.get("number", values.get("robots", ()))
    return str(len(number) if isinstance(number, Sized) and not isinstance(number, str) else number)


MOST_NAMES = 8
"""Names that a sentence lists."""

ROBOTS = {"robot", "robots", "robots_in_turn", "few_robots"}
VERTICES = {"few_places", "lane", "name", "place", "spot", "spots", "vertex", "vertices"}
"""Forms of values that are robots and vertices."""

MOMENTS = {"moment", "until"}
QUANTITIES = {*MOMENTS, "duration", "fine_length", "length", "speed", "time"}
"""Forms of values that are written with the units of a scenario; text is written already."""


class FactWriter:
    """Writes facts about one scenario.

    Parameters
    ----------
    about
        The scenario of robots, vertices and ticks, an inspected site, or units of lengths; None for
        facts that have none.
    quantities
        How times and lengths are written; those of the scenario unless given.
    """

    def __init__(
        self, about: Scenario | Site | Units | None, quantities: Quantities | None = None
    ) -> None:
        self._about = about
        self._quantities = quantities

    def write(self, fact: Fact | str) -> str:
        """Return the sentence of a fact; English text of other packages stays as it is."""
        if isinstance(fact, str):
            return fact
        return self.fill(fact.kind, fact.values)

    def fill(self, kind: str, values: Mapping[str, Any]) -> Phrase:
        """Return the template of a kind with its values in their forms."""
        number = count_things(values)
        forms = list_forms(find_text(kind, number))
        texts = {name: self._show(form, values[name]) for name, form in forms}
        return Phrase(kind, **{"number": number, **texts})

    def _show(self, form: str, value: Any) -> str:
        """Return a value in a form; all other forms are facts about a number of things."""
        if form in QUANTITIES and isinstance(value, str):
            return value
        if form in self._forms:
            return self._forms[form](value)
        return self.write(Fact(form, number=value))

    def export(self, fact: Fact | str) -> FactData:
        """Return a fact as plain data for JSON: robots and vertices by name, times in ticks."""
        if isinstance(fact, str):
            fact = Fact("other", text=fact)
        forms = dict(list_forms(find_text(fact.kind, count_things(fact.values))))
        values = {
            name: self._convert_value(forms.get(name, ""), value)
            for name, value in fact.values.items()
        }
        return {"kind": fact.kind, "values": values}

    def _convert_value(self, form: str, value: Any) -> Any:
        if isinstance(value, Fact):
            return self.export(value)
        if isinstance(value, tuple | list):
            return [self._convert_value(form, item) for item in value]
        if form in ROBOTS:
            return self.name_robot(value)
        if form in VERTICES:
            return self.about.roadmap.name(value)
        if isinstance(value, Fraction):
            return value.numerator if value.denominator == 1 else float(value)
        return value

    def name_values(self, fact: Fact, since: int = 0) -> Fact:
        """Return a fact about no scenario: names for robots and vertices, text for quantities.

        Parameters
        ----------
        fact
            The fact.
        since
            Ticks after which its points in time begin to count.
        """
        forms = dict(list_forms(find_text(fact.kind, count_things(fact.values))))

        def name_value(form: str, value: Any) -> Any:
            if isinstance(value, Fact):
                return self.name_values(value, since)
            if form in QUANTITIES:
                return str(self._show(form, value + since if form in MOMENTS else value))
            if isinstance(value, tuple | list):
                return tuple(name_value(form, item) for item in value)
            return self._convert_value(form, value)

        values = {name: name_value(forms.get(name, ""), item) for name, item in fact.values.items()}
        return Fact(fact.kind, **values)

    @property
    def about(self) -> Scenario | Site:
        """The scenario or site of the values."""
        about = self._about
        assert about is not None, "a fact with robots or places has a scenario or a site"
        assert not isinstance(about, Units), "units have no robots and no places"
        return about

    @property
    def scenario(self) -> Scenario:
        """The scenario of the values."""
        assert isinstance(self._about, Scenario), "a fact with times has a scenario"
        return self._about

    @cached_property
    def quantities(self) -> Quantities:
        """How times and lengths are written."""
        if self._quantities is not None:
            return self._quantities
        if isinstance(self._about, Scenario):
            return Quantities.of(self._about)
        units = self._about or Units()
        if not isinstance(units, Units):
            units = units.units
        return Quantities(units=units, tick=Fraction(1))

    @cached_property
    def _places(self) -> PlaceNames:
        return PlaceNames(self.scenario, numbered=True)

    @cached_property
    def _plain_places(self) -> PlaceNames:
        return PlaceNames(self.scenario)

    @cached_property
    def _forms(self) -> Mapping[str, Callable[[Any], str]]:
        return {
            "": self._write_text,
            "factor": lambda factor: mark_figure(f"{float(factor):g}"),
            "listed": ", ".join,
            "word": Phrase,
            "few": lambda values: join_few(list(map(self._write_text, values))),
            "few_places": lambda vertices: join_few(list(map(self.name_place, vertices))),
            "few_robots": lambda robots: join_few(list(map(self.name_robot, robots))),
            "place": self.name_place,
            "spot": self._describe_place,
            "robots_in_turn": lambda robots: chain_items(list(map(self.name_robot, robots))),
            "spots": lambda places: chain_items(list(map(self._describe_place, places))),
            "speed": self.quantities.format_speed,
            "time": self._write_time,
            "times": lambda times: chain_items(list(map(self._write_time, times))),
            "list": lambda facts: chain_items(list(map(self.write, facts))),
            "and": lambda facts: join_items([self.write(fact) for fact in facts]),
            "angle": lambda degrees: format_decimal(degrees, 6),
            "decimal": lambda number: mark_figure(f"{number:g}"),
            "fine_length": self._write_fine_length,
            "first": lambda names: join_first(list(map(self._write_text, names))),
            "duration": cache(self.quantities.format_duration),
            "lane": self._name_lane,
            "length": self.quantities.format_length,
            "lengths": lambda values: join_items(list(map(self.quantities.format_length, values))),
            "moment": cache(self.quantities.format_moment),
            "name": self._write_name,
            "number": format_decimal,
            "percent": lambda share: f"{round(100 * share)} %",
            "fine_percent": lambda share: mark_figure(f"{share:.1%}"),
            "robot": self.name_robot,
            "robots": lambda robots: join_items(list(map(self.name_robot, robots))),
            "soc": lambda share: f"{format_decimal(100 * share, 6)} %",
            "rounded": lambda number: mark_figure(f"{number:.3g}"),
            "until": self._write_until,
            "vertex": self.name_vertex,
            "vertices": lambda vertices: join_items(list(map(self.name_vertex, vertices))),
        }

    def _write_text(self, value: Fact | Fraction | str | int) -> str:
        return self.write(value) if isinstance(value, Fact | str) else str(value)

    def _write_fine_length(self, value: Fraction) -> str:
        """Return a length with up to six decimals, and its unit if it has one."""
        return f"{format_decimal(value, 6)} {self.quantities.units.length or ''}".rstrip()

    def name_robot(self, robot: int | str) -> str:
        """Return a robot's name; a name stays as it is, also of vertices."""
        if isinstance(robot, str):
            return robot
        return self.about.robots[robot].name

    def name_vertex(self, vertex: int | str) -> str:
        """Return the name of a vertex for people, whether the roadmap has it or not."""
        if isinstance(vertex, str):
            return vertex
        if 0 <= vertex < self.scenario.roadmap.n_vertices:
            return self._places(vertex)
        return Phrase("vertex by number", number=str(vertex))

    def name_place(self, vertex: int | str) -> str:
        """Return the name of a vertex with its use, without the number of a cell.

        On an inspected site: ``D1 (station Press)``, ``(2.25, 0.75, home of R1)``.
        """
        if isinstance(vertex, str):
            return vertex
        about = self.about
        if isinstance(about, Scenario):
            return self._plain_places(vertex)
        use = about.places.get(vertex)
        if about.roadmap.has_cells and about.units.length:
            middle = describe_middle(about.roadmap, vertex)
            if use is None:
                return Phrase("middle", middle=middle)
            return Phrase("middle with detail", middle=middle, what=self.write(use))
        name = about.roadmap.name(vertex)
        return name if use is None else Phrase("name with detail", name=name, what=self.write(use))

    def _write_name(self, vertex: int | str) -> str:
        return vertex if isinstance(vertex, str) else self.about.roadmap.name(vertex)

    def _name_lane(self, ends: Sequence[int]) -> Phrase:
        tail, head = map(self._write_name, ends)
        return Phrase("lane", tail=tail, head=head)

    def _describe_place(self, vertex: int | str) -> str:
        return vertex if isinstance(vertex, str) else self._plain_places.describe_place(vertex)

    def _write_time(self, value: Fraction) -> str:
        """Return a time [time unit], without words where no unit is known."""
        times = replace(self.quantities, tick=Fraction(1), in_ticks=False)
        has_unit = times.units.seconds is not None
        return times.format_duration(value) if has_unit else times.format_cell(value)

    def _write_until(self, tick: int) -> str:
        """Return a point in time that follows another one in a sentence: ``2``, ``6 min 23 s``."""
        quantities = self.quantities
        has_unit = quantities.time_unit and not quantities.in_ticks
        return quantities.format_moment(tick) if has_unit else quantities.format_cell(tick)


def join_few(names: Sequence[str]) -> str:
    """Return names as a sentence has them; of more than eight, seven and the number of others."""
    if len(names) > MOST_NAMES:
        left = len(names) - MOST_NAMES + 1
        names = [*names[: MOST_NAMES - 1], Phrase("number more", number=str(left))]
    return join_items(names) if names else ""


def write_note(note: str | Fact) -> str:
    """Return a fact as a sentence; text stays as it is."""
    return FactWriter(getattr(note, "about", None)).write(note)


def export_note(note: str | Fact) -> FactData:
    """Return a fact as plain data for JSON, text too."""
    return FactWriter(getattr(note, "about", None)).export(note)


def pack_note(note: str | Fact) -> Any:
    """Return a fact for pages, which write it in their language; text stays as it is."""
    return to_parts(write_note(note))


def pack_summary(summary: str, *kinds: str) -> Any:
    """Return the first of some kinds that has a template; the summary of other packages is text."""
    known = read_texts()["facts"]
    return next((pack_note(Fact(kind)) for kind in kinds if kind in known), summary)


def write_blockage(blockage: Blockage) -> str:
    """Return the reason of a blockage, and its remedy if there is one."""
    return write_note(blockage.explain())


def write_notes(notes: Iterable[str | Fact]) -> list[str]:
    """Return notes of a reader as text, the facts among them as sentences."""
    return list(map(write_note, notes))
