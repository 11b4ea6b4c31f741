"""Sentences of facts: one table of templates for each language, ``texts/en.json`` and others.

A template has values in braces, with the form in which people read them: ``{robot:robot}`` is the
name of a robot, ``{time:duration}`` a number of ticks as a time. A value without a form is text, a
number, or another fact.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache, cached_property
from importlib.resources import files
from typing import Any

from rightofway.errors import join_names
from rightofway.facts import Fact
from rightofway.model import Scenario
from rightofway.model.place_names import PlaceNames
from rightofway.phrases import Phrase, join_items
from rightofway.quantities import Quantities, Units, format_decimal

__all__ = ["FactWriter", "read_templates", "strip_forms"]

VALUE = re.compile(r"\{(\w+)(?::(\w+))?\}")
"""A value of a template: its name, and the form in which it is shown."""


@cache
def read_templates() -> Mapping[str, Any]:
    """Return the English templates: of faults, and of all other facts."""
    text = files("rightofway").joinpath("texts", "en.json").read_text("utf-8")
    templates: Mapping[str, Any] = json.loads(text)
    return templates


@cache
def strip_forms(template: str) -> str:
    """Return a template with the names of its values only."""
    return VALUE.sub(r"{\1}", template)


@cache
def list_forms(template: str) -> tuple[tuple[str, str], ...]:
    """Return the names of the values of a template, each with its form."""
    return tuple(VALUE.findall(template))


def choose_template(template: str | Mapping[str, str], values: Mapping[str, Any]) -> str:
    """Return a template; of several, that for the number of things, or else the one for others.

    That is the value ``number``, or how many ``robots`` there are.
    """
    if isinstance(template, str):
        return template
    number = values["number"] if "number" in values else len(values["robots"])
    return template.get(str(number), template["other"])


class FactWriter:
    """Writes facts about one scenario.

    Parameters
    ----------
    scenario
        The scenario of robots, vertices and ticks; None for facts that have none.
    quantities
        How times and lengths are written; those of the scenario unless given.
    """

    def __init__(self, scenario: Scenario | None, quantities: Quantities | None = None) -> None:
        self._scenario = scenario
        self._quantities = quantities

    def write(self, fact: Fact | str) -> str:
        """Return the sentence of a fact; English text of other packages stays as it is."""
        if isinstance(fact, str):
            return fact
        template = read_templates()["facts"][fact.kind]
        return self.fill(choose_template(template, fact.values), fact.values)

    def fill(self, template: str, values: Mapping[str, Any]) -> Phrase:
        """Return a template with its values in their forms."""
        texts = {name: self._show(form, values[name]) for name, form in list_forms(template)}
        return Phrase(strip_forms(template), **texts)

    def _show(self, form: str, value: Any) -> str:
        """Return a value in a form; all other forms are facts about a number of things."""
        if form in self._forms:
            return self._forms[form](value)
        return self.write(Fact(form, number=value))

    @property
    def scenario(self) -> Scenario:
        """The scenario of the values."""
        assert self._scenario is not None, "a fact with robots, places or times has a scenario"
        return self._scenario

    @cached_property
    def quantities(self) -> Quantities:
        """How times and lengths are written."""
        if self._quantities is None and self._scenario is None:
            return Quantities(units=Units(), tick=Fraction(1))
        return self._quantities or self.scenario.quantities

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
            "few": lambda facts: join_names([self.write(fact) for fact in facts]),
            "few_places": lambda vertices: join_names(list(map(self._name_place, vertices))),
            "few_robots": lambda robots: join_names(list(map(self.name_robot, robots))),
            "place": self._name_place,
            "spot": self._describe_place,
            "and": lambda facts: join_items([self.write(fact) for fact in facts]),
            "angle": lambda degrees: format_decimal(degrees, 6),
            "duration": cache(self.quantities.format_duration),
            "length": self.quantities.format_length,
            "moment": cache(self.quantities.format_moment),
            "number": format_decimal,
            "robot": self.name_robot,
            "robots": lambda robots: join_items(list(map(self.name_robot, robots))),
            "until": self._write_until,
            "vertex": self.name_vertex,
            "vertices": lambda vertices: join_items(list(map(self.name_vertex, vertices))),
        }

    def _write_text(self, value: Fact | Fraction | str | int) -> str:
        return self.write(value) if isinstance(value, Fact | str) else str(value)

    def name_robot(self, robot: int) -> str:
        """Return a robot's name."""
        return self.scenario.robots[robot].name

    def name_vertex(self, vertex: int) -> str:
        """Return the name of a vertex for people, whether the roadmap has it or not."""
        if 0 <= vertex < self.scenario.roadmap.n_vertices:
            return self._places(vertex)
        return Phrase("vertex {number}", number=str(vertex))

    def _name_place(self, vertex: int) -> str:
        return self._plain_places(vertex)

    def _describe_place(self, vertex: int) -> str:
        return self._plain_places.describe_place(vertex)

    def _write_until(self, tick: int) -> str:
        """Return a point in time that follows another one in a sentence: ``2``, ``6 min 23 s``."""
        quantities = self.quantities
        has_unit = quantities.time_unit and not quantities.in_ticks
        return quantities.format_moment(tick) if has_unit else quantities.format_cell(tick)


def list_texts() -> Sequence[str]:
    """Return the English templates of all faults and facts."""
    templates = read_templates()
    faults = templates["faults"].values()
    texts = [text for fault in faults for text in (fault["reason"], fault["remedy"])]
    names = [name for fault in faults for name in fault.get("names", ())]
    facts = [
        text
        for fact in templates["facts"].values()
        for text in ([fact] if isinstance(fact, str) else fact.values())
    ]
    return [*texts, *names, *facts]


def list_template_texts() -> Sequence[str]:
    """Return the English texts of all faults and facts, without forms."""
    return list(map(strip_forms, list_texts()))
