"""Actions of robots at stops: named, with parameters. No plan depends on them.

A stop without actions of its own has those of its place, see `PlaceActions`; without these, a robot
does its usual action. The fleet control translates actions to messages.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Literal, get_args

from rightofway.errors import quote
from rightofway.kinds.numbers import read_number
from rightofway.kinds.table import (
    LINE,
    NAME,
    TRUTH,
    VERTEX,
    Kind,
    coerce_fields,
    list_of,
    make_class,
    make_words,
)
from rightofway.site import Roadmap, VertexId

if TYPE_CHECKING:
    from rightofway.site.layout import Level

Blocking = Literal["none", "soft", "single", "hard"]
"""Whether a robot may drive (``none``, ``single``) and do other actions (``none``, ``soft``)
during an action; during a ``hard`` one it does neither."""

ActionUse = Literal["work", "pick", "drop"]
"""The kind of a stop: the load grows at a ``pick`` and falls at a ``drop``."""


UNLOAD = re.compile(r"unload|drop|deliver", re.IGNORECASE)
LOAD = re.compile(r"load|pick|fetch", re.IGNORECASE)


class Entries(tuple[tuple[str, Any], ...]):
    """A mapping of parameters or of a parameter, as pairs in their order."""

    __slots__ = ()


def freeze_value(value: object) -> Any:
    """Return a value of a parameter: text, truth value, number, tuple of values or `Entries`.

    Raises
    ------
    ValueError
        For None, values of other kinds, and numbers that no decimal of 15 digits stands for.
    """
    if isinstance(value, Entries | str | bool):
        return value
    if isinstance(value, Mapping):
        return Entries((NAME.read(key), freeze_value(item)) for key, item in value.items())
    if isinstance(value, list | tuple):
        return tuple(map(freeze_value, value))
    if value is None:
        remedy = "give text, a number, true or false, a list or a mapping"
        raise ValueError(f"None is no value of a parameter ({remedy})")
    number = read_number(value)
    if Fraction(repr(float(number))) != number:
        raise ValueError(f"{quote(value)} is no decimal of 15 digits (round it)")
    return number


def thaw_value(value: Any) -> Any:
    """Return a value of a parameter as JSON has it; the inverse of `freeze_value`."""
    if isinstance(value, Entries):
        return {key: thaw_value(item) for key, item in value}
    if isinstance(value, tuple):
        return list(map(thaw_value, value))
    if isinstance(value, Fraction):
        return int(value) if value.denominator == 1 else float(value)
    return value


def _read_parameters(value: object) -> Entries:
    if not isinstance(value, Mapping | Entries):
        raise ValueError(f"{quote(value)} is no mapping (give {PARAMETERS.name})")  # noqa: TRY004 (readers raise it)
    frozen: Entries = freeze_value(value)
    return frozen


PARAMETERS: Kind[Entries] = Kind(
    "a mapping of names to values", {"type": "object"}, _read_parameters
)


NO_PARAMETERS = Entries()


@dataclass(frozen=True, slots=True, kw_only=True)
class StopAction:
    """An action of a robot at a stop.

    Attributes
    ----------
    action
        The type of the action, as the robot names it.
    parameters
        A mapping of names to text, numbers, truth values, and lists and mappings of them; kept as
        pairs.
    blocking
        See `Blocking`.
    retriable
        Whether the action can be done again after it has failed.
    description
        For people; may be empty.

    Raises
    ------
    InputError
        With every value of another kind.
    """

    action: str
    parameters: Entries = NO_PARAMETERS
    blocking: Blocking = "hard"
    retriable: bool = False
    description: str = ""

    def __post_init__(self) -> None:
        coerce_fields(
            self,
            "",
            action=NAME,
            parameters=PARAMETERS,
            blocking=make_words(*get_args(Blocking)),
            retriable=TRUTH,
            description=LINE,
        )

    def to_document(self) -> dict[str, Any]:
        """Return the action as JSON has it, without defaults."""
        parameters = {"parameters": thaw_value(self.parameters)} if self.parameters else {}
        others = {
            key: value
            for key, value, default in (
                ("blocking", self.blocking, "hard"),
                ("retriable", self.retriable, False),
                ("description", self.description, ""),
            )
            if value != default
        }
        return {"action": self.action, **parameters, **others}


def _read_action(value: object) -> StopAction:
    """Return an action, that of a mapping, or that of its type alone."""
    if isinstance(value, StopAction):
        return value
    if isinstance(value, str):
        return StopAction(action=value)
    keys = list(StopAction.__dataclass_fields__)
    if not isinstance(value, Mapping) or "action" not in value:
        remedy = "give its type, or a mapping like {action: pick, parameters: {side: left}}"
        raise ValueError(f"{quote(value)} is no action ({remedy})")
    if unknown := [key for key in value if key not in keys]:
        raise ValueError(f"{quote(unknown[0])} is unknown (give {', '.join(keys)})")
    return StopAction(**value)


_ACTION_SCHEMA: dict[str, Any] = {
    "anyOf": [
        NAME.schema,
        {
            "type": "object",
            "properties": {
                "action": NAME.schema,
                "parameters": {"type": "object"},
                "blocking": {"type": "string", "enum": list(get_args(Blocking))},
                "retriable": {"type": "boolean"},
                "description": LINE.schema,
            },
            "required": ["action"],
            "additionalProperties": False,
        },
    ]
}

ACTION: Kind[StopAction] = Kind("an action", _ACTION_SCHEMA, _read_action)


def _read_actions(value: object) -> tuple[StopAction, ...]:
    """Return one or several actions."""
    is_one = isinstance(value, str | Mapping | StopAction)
    return (ACTION.read(value),) if is_one else list_of(ACTION).read(value)


ACTIONS: Kind[tuple[StopAction, ...]] = Kind(
    "an action or a list of actions",
    {"anyOf": [*_ACTION_SCHEMA["anyOf"], {"type": "array", "items": _ACTION_SCHEMA}]},
    _read_actions,
)
"""One or several actions; one may be its type alone. An empty list stands for no actions given."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlaceActions:
    """The actions of robots that stop at a place, where a stop has none of its own.

    Attributes
    ----------
    at
        The vertex.
    work, pick, drop
        Its actions for each kind of stop, see `ActionUse`; where empty, robots do their usual
        action.

    Raises
    ------
    InputError
        With every value of another kind.
    """

    at: VertexId
    work: tuple[StopAction, ...] = ()
    pick: tuple[StopAction, ...] = ()
    drop: tuple[StopAction, ...] = ()

    def __post_init__(self) -> None:
        uses = dict.fromkeys(get_args(ActionUse), ACTIONS)
        coerce_fields(self, "actions of a place", at=VERTEX, **uses)


PLACE_ACTIONS = list_of(make_class(PlaceActions), admits=list | tuple)


def merge_actions(
    others: Sequence[PlaceActions], own: Sequence[PlaceActions]
) -> tuple[PlaceActions, ...]:
    """Return actions of places; where both have some for a kind of stop, the second ones count."""
    merged = {actions.at: actions for actions in others}
    for actions in own:
        uses = {use: given for use in get_args(ActionUse) if (given := getattr(actions, use))}
        merged[actions.at] = replace(merged.get(actions.at, actions), **uses)
    return tuple(merged.values())


def read_drawn_actions(level: Level, roadmap: Roadmap) -> tuple[PlaceActions, ...]:
    """Return the actions of the vertices of a layout that are on a roadmap."""
    return tuple(
        PlaceActions(
            at=roadmap.get_vertex(vertex.name),
            **{use: json.loads(text) for use, text in vertex.actions},
        )
        for vertex in level.vertices
        if vertex.actions and vertex.name in (roadmap.labels or ())
    )


def find_use(load: int) -> ActionUse:
    """Return the kind of a stop by the change of the load there."""
    return "work" if load == 0 else "pick" if load > 0 else "drop"


def find_load_change(action: str) -> int:
    """Return the change of the load by an action of another program, as far as its type tells."""
    return -1 if UNLOAD.search(action) else 1 if LOAD.search(action) else 0
