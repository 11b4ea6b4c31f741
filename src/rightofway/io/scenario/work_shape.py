"""The shape of jobs, batteries and states in a scenario document."""

from __future__ import annotations

from typing import Any, ClassVar

from rightofway.io.fields import (
    Actions,
    Amount,
    Angle,
    Count,
    Document,
    Moment,
    Name,
    NotNegative,
    Place,
    Positive,
    Share,
    Whole,
    make_field,
    make_optional,
)
from rightofway.site.places import list_kinds_of_places

PLACES = list_kinds_of_places(None)
WORK = "work time there [time unit], 0 by default"
EARLIEST = "the earliest begin of the work [time unit], or a time of day; 0 by default"
ACTIONS = (
    "the actions at the stop: one or a list, each its type or {action,"
    " parameters, blocking, retriable, description}; those of the place by default"
)
LATEST = "the latest end of the work [time unit], or a time of day; none by default"


class JobStopDocument(Document):
    """A stop of a job."""

    at: Place = make_field(f"a place: {PLACES}")
    work: NotNegative = make_optional(WORK)
    load: Whole = make_optional("by how much the load changes there, 0 by default")
    earliest: Moment = make_optional(EARLIEST)
    latest: Moment = make_optional(LATEST)
    actions: Actions = make_optional(ACTIONS)


FORMS: dict[str, tuple[str, ...]] = {
    "at": ("at", "work", "actions"),
    "pickup": (
        "pickup",
        "dropoff",
        "pickup_work",
        "dropoff_work",
        "load",
        "pickup_actions",
        "dropoff_actions",
    ),
    "stops": ("stops",),
}
"""The keys of each form of a job, by the key that it has at least."""


def _refuse_others(kind: str) -> dict[str, Any]:
    others = {key for other, keys in FORMS.items() if other != kind for key in keys}
    return {"anyOf": [{"required": [key]} for key in sorted(others)]}


class JobDocument(Document):
    """Work of one robot: a place, a pickup and a dropoff, or stops in a fixed order."""

    schema_extra: ClassVar = {
        "oneOf": [
            {"required": [kind, *required], "not": _refuse_others(kind)}
            for kind, required in (("at", ()), ("pickup", ("dropoff",)), ("stops", ()))
        ]
    }

    name: Name = make_field("a name of its own")
    at: Place = make_optional(f"the place to work at: {PLACES}")
    work: NotNegative = make_optional(WORK)
    pickup: Place = make_optional(f"the place where a load is picked up: {PLACES}")
    dropoff: Place = make_optional(f"the place where it is dropped off: {PLACES}")
    pickup_work: NotNegative = make_optional("work time at the pickup [time unit], 0 by default")
    dropoff_work: NotNegative = make_optional("work time at the dropoff [time unit], 0 by default")
    load: Amount = make_optional("the load that is picked up, a whole number, 1 by default")
    actions: Actions = make_optional(f"of at: {ACTIONS}")
    pickup_actions: Actions = make_optional("the same at the pickup")
    dropoff_actions: Actions = make_optional("the same at the dropoff")
    stops: list[JobStopDocument] = make_optional(
        "one or more {at, work, load, earliest, latest, actions}, in order", min_length=1
    )
    earliest: Moment = make_optional(
        "the earliest begin of the work of the first stop [time unit], or a time of day; "
        "0 by default"
    )
    latest: Moment = make_optional(
        "the latest end of the work of the last stop [time unit], or a time of day; none by default"
    )
    due: Moment = make_optional(
        "completion after this time costs more [time unit], or a time of day; none by default"
    )
    weight: Positive = make_optional("the weight compared with other jobs, above 0")
    types: list[Name] = make_optional("a list of types of the robots that may do it")
    robot: Name = make_optional("the name of the only robot that may do it")
    after: list[Name] = make_optional("a list of names of jobs that end before it begins")

    load_id: Name = make_optional("the name of the load, for the actions pick and drop")
    load_type: Name = make_optional("the type of the load, for the actions pick and drop")

    def check(self) -> None:
        """Refuse a job of no form or of several, and limits that are given twice."""
        given, forms = self.given, "give at, pickup and dropoff, or stops"
        kinds = [kind for kind, keys in FORMS.items() if given & set(keys)]
        if not kinds:
            raise ValueError(f"has no place to work at ({forms})")
        if len(kinds) > 1:
            first, other = (next(key for key in FORMS[kind] if key in given) for kind in kinds[:2])
            raise ValueError(f"has both {first} and {other} ({forms})")
        for key in ("pickup", "dropoff") if kinds == ["pickup"] else kinds:
            if key not in given:
                raise ValueError(f"has no {key} ({forms})")
        for key, place, which in (("earliest", 0, "first"), ("latest", -1, "last")):
            if self.stops and key in given and key in self.stops[place].given:
                raise ValueError(f"has {key}, and its {which} stop, too (give one of them)")


class JobTableDocument(Document):
    """Jobs of a file of their own: a CSV file, or orders of another program."""

    table: Name = make_field(
        "a .csv file, or a list of jobs or orders, relative to the scenario's own"
    )
    begin: Name = make_optional(
        "of orders: the instant of time 0, like 2026-11-28T06:00:00Z; by default the first one"
        " at which an order was made or may begin,, or the start of the scenario with an offset"
    )
    work: NotNegative = make_optional(
        "of orders: work time at stops without one [time unit], 0 by default"
    )


class BatteryDocument(Document):
    """How robots use and charge a battery; shares are of a full one."""

    drive: NotNegative = make_optional("share for each length unit of a drive, 0 by default")
    on: NotNegative = make_optional("share for each time unit until the robot rests, 0 by default")
    work: NotNegative = make_optional("share for each time unit of work, 0 by default")
    charge: NotNegative = make_optional(
        "share gained in each time unit of a charge, net, 0 by default"
    )
    reserve: Share = make_optional("the least state of charge, from 0 to 1, 0 by default")


class StateDocument(Document):
    """The place where a robot begins, and the work that it has done."""

    at: Place = make_optional(f"the place where it begins: {PLACES}; its home by default")
    ready: NotNegative = make_optional("until then it stays there [time unit]; 0 by default")
    heading: Angle = make_optional("angle from the site's x axis to its y axis [degrees]")
    soc: Share = make_optional("state of charge, from 0 to 1, 1 by default")
    begun: dict[Name, Count] = make_optional(
        "a mapping of jobs to the number of their stops that are done"
    )
