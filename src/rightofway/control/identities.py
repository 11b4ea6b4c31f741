"""Identities of the robots of a plan: their file, and topics.

A file names each robot of the plan as messages do. Keys beside ``robots`` hold for all robots that
do not have them themselves.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator

from rightofway.control.work_items import find_charge_step
from rightofway.errors import InputError, find_nearest, name_file, quote
from rightofway.io.content import read_text
from rightofway.io.documents import parse_document
from rightofway.io.faults import Faults, validate
from rightofway.io.fields import Angle, Document, NotNegative, make_field, make_optional
from rightofway.io.scenario.writer import format_yaml
from rightofway.model import ActionUse, StopAction
from rightofway.model.actions import ACTION
from rightofway.site.geometry import Frame

__all__ = [
    "IDENTITY_KEYS",
    "VERSIONS",
    "Identity",
    "format_identities",
    "load_identities",
    "make_identity_like",
    "make_simulated_identities",
]

VERSIONS = ("2.0.0", "2.1.0", "3.0.0")
"""Versions of the norm that a robot may speak."""

FORBIDDEN = frozenset("/+#$")
"""Characters that may not be in a part of a topic."""

IDENTITIES_FORMAT = "rightofway-identities/1"


WORK = StopAction(action="rightofway.job")
"""The action of a robot at a stop, where nothing else is given."""

START_CHARGING = StopAction(action="startCharging")
STOP_CHARGING = StopAction(action="stopCharging")


@dataclass(frozen=True, slots=True, kw_only=True)
class Identity:
    """A robot as messages name it, and as it sees the site.

    Attributes
    ----------
    manufacturer, serial_number
        Which robot it is; neither has ``/``, ``+``, ``#`` or ``$``, because topics have both.
    version
        Of the norm, one of `VERSIONS`.
    interface
        The first part of its topics; by default ``uagv``, from 3.0 on ``vda5050``.
    map_id
        The name of its map.
    frame
        Where the frame of that map lies in the site's frame, y upwards in both [m, rad].
    deviation
        How far from a vertex it may call itself arrived [m]; None for half the clearance.
    work
        Its usual action at a stop.
    pick, drop
        Its usual actions where a load is picked and dropped. None: `work`, if that is not the
        default one, else an action of that name.
    start_charging, stop_charging
        Its actions at a charging place.
    repeats_work
        Whether an update repeats the work of the node that it begins with, as the norm has it. That
        work is finished; robots that do it twice want it left out.

    Raises
    ------
    InputError
        If a part of a topic is empty or has a forbidden character, or the version is unknown.
    """

    manufacturer: str
    serial_number: str
    version: str = "2.1.0"
    interface: str = ""
    map_id: str = "map"
    frame: Frame = field(default_factory=Frame)
    deviation: float | None = None
    work: StopAction = WORK
    pick: StopAction | None = None
    drop: StopAction | None = None
    start_charging: StopAction = START_CHARGING
    stop_charging: StopAction = STOP_CHARGING
    repeats_work: bool = True

    def __post_init__(self) -> None:
        if self.version not in VERSIONS:
            known = ", ".join(VERSIONS)
            message = f"{quote(self.version)} is no version of VDA 5050 (one of {known})"
            raise InputError.at("version", message)
        if not self.interface:
            object.__setattr__(self, "interface", "uagv" if self.version < "3" else "vda5050")
        for key in ("interface", "manufacturer", "serial_number"):
            value = getattr(self, key)
            if not value or FORBIDDEN & set(value):
                message = f"{quote(value)} cannot be part of a topic (leave out / + # $)"
                raise InputError.at(key, message)

    def find_action(self, item: str, use: ActionUse = "work") -> StopAction:
        """Return the usual action for an item of work, see `rightofway.control.work_items`.

        Parameters
        ----------
        item
            The item.
        use
            The kind of its stop.
        """
        step = find_charge_step(item)
        if step is not None:
            return self.start_charging if step == "begin" else self.stop_charging
        own = {"work": self.work, "pick": self.pick, "drop": self.drop}[use]
        if own is not None:
            return own
        return StopAction(action=use) if self.work == WORK else self.work

    def get_topic(self, name: str) -> str:
        """Return a topic of this robot.

        Parameters
        ----------
        name
            Its last part: ``order``, ``instantActions``, ``state``, ``connection``, ``factsheet``.
        """
        major = f"v{self.version[0]}"
        return f"{self.interface}/{major}/{self.manufacturer}/{self.serial_number}/{name}"


def _check_topic_part(value: str) -> str:
    if not value or FORBIDDEN & set(value):
        raise ValueError(f"{quote(value)} cannot be part of a topic (leave out / + # $)")
    return value


TopicPart = Annotated[str, AfterValidator(_check_topic_part)]


class _FrameDocument(Document):
    """The position of the frame of a robot's map in the frame of the site."""

    x: Angle = make_optional("its origin in the site's frame [m]")
    y: Angle = make_optional("its origin in the site's frame, upwards [m]")
    yaw: Angle = make_optional("the angle by which it is turned, counterclockwise [rad]")


Action = Annotated[StopAction, ACTION]


class _SharedDocument(Document):
    """The settings of all robots, or of one."""

    manufacturer: TopicPart = make_optional("the maker of the robot, as topics have it")
    version: Literal["2.0.0", "2.1.0", "3.0.0"] = make_optional(
        f"the version of VDA 5050: {', '.join(VERSIONS)}; 2.1.0 by default"
    )
    interface: TopicPart = make_optional(
        "the first part of topics; uagv by default, vda5050 from 3.0.0 on"
    )
    map: str = make_optional("the name of the robot's map; map by default")
    frame: _FrameDocument = make_optional(
        "{x, y, yaw} of the frame of that map in the site's frame"
    )
    deviation: NotNegative = make_optional(
        "how far from a place the robot may call itself arrived [m]; half the clearance by default"
    )
    work: Action = make_optional(
        "{action, parameters, blocking, retriable, description} of what a robot does at a stop"
    )
    pick: Action = make_optional(
        "the same where a load is picked; by default work, if it is given, else pick"
    )
    drop: Action = make_optional(
        "the same where a load is dropped; by default work, if it is given, else drop"
    )
    start_charging: Action = make_optional(
        "the same with which a robot begins to charge; startCharging by default"
    )
    stop_charging: Action = make_optional(
        "the same with which it ends that; stopCharging by default"
    )
    repeats_work: bool = make_optional(
        "true, or false for robots that do work twice which the next update of an order repeats"
    )


IDENTITY_KEYS = frozenset(_SharedDocument.fields)
"""Keys of robots in the file of identities, apart from the serial number."""


class _RobotDocument(_SharedDocument):
    """A robot of the plan."""

    serial: TopicPart = make_field("the serial number of the robot, as topics have it")


class IdentitiesDocument(_SharedDocument):
    """The robots of a plan as messages name them."""

    format: Literal["rightofway-identities/1"] = make_field(
        "the format of the file: rightofway-identities/1"
    )
    robots: dict[str, _RobotDocument] = make_field(
        "the robots of the plan by their names, each with a serial number"
    )


def load_identities(path: Path | str, names: Sequence[str]) -> list[Identity]:
    """Return the identities of robots, in their order.

    Parameters
    ----------
    path
        A YAML or JSON file.
    names
        The robots of the plan.

    Raises
    ------
    InputError
        With every fault: a robot without an identity, one that the plan does not have, two robots
        of one serial number, keys that are unknown.
    """
    with name_file(str(path)):
        document = validate(IdentitiesDocument, parse_document(read_text(Path(path)), Path(path)))
        faults = Faults()
        for name in document.robots:
            if name not in names:
                near = find_nearest(name, names)
                remedy = f"did you mean {near!r}?" if near else "take it out"
                faults.note(("robots", name), f"the plan has no robot of this name ({remedy})")
        owners = dict[str, str]()
        identities = list[Identity]()
        for name in names:
            own = document.robots.get(name)
            if own is None:
                faults.note("robots", f"{name} is missing (give its manufacturer and serial)")
                continue
            identity = faults.attempt(("robots", name), _read_identity, own, document)
            if identity is None:
                continue
            identities.append(identity)
            other = owners.setdefault(identity.get_topic(""), name)
            if other != name:
                message = f"{quote(own.serial)} is the serial number of {other}, too (correct one)"
                faults.note(("robots", name, "serial"), message)
        faults.stop(["robots"])
        return identities


def _read_identity(own: _RobotDocument, shared: _SharedDocument) -> Identity:
    given = {**shared.get_given(*IDENTITY_KEYS), **own.get_given(*IDENTITY_KEYS)}
    if "manufacturer" not in given:
        raise InputError.at("manufacturer", "is missing (give it here, or for all robots)")
    return Identity(serial_number=own.serial, **_convert_keys(given))


def make_identity_like(like: Identity, document: Mapping[str, Any]) -> Identity:
    """Return the identity of one more robot.

    Parameters
    ----------
    like
        The identity that has the values of keys that are not given.
    document
        The serial number of the robot, and other keys of robots in the file of identities.

    Raises
    ------
    InputError
        With every fault of the document.
    """
    own = validate(_RobotDocument, document)
    given = _convert_keys(own.get_given(*IDENTITY_KEYS))
    if "version" in given:
        given.setdefault("interface", "")  # the usual one of that version
    return replace(like, serial_number=own.serial, **given)


def _convert_keys(given: dict[str, Any]) -> dict[str, Any]:
    """Return the attributes of an identity that keys of a file give."""
    frame = given.pop("frame", None)
    if frame is not None:
        given["frame"] = Frame(**frame.get_given("x", "y", "yaw"))
    if "map" in given:
        given["map_id"] = given.pop("map")
    if "deviation" in given:
        given["deviation"] = float(given["deviation"])
    return given


def make_simulated_identities(names: Sequence[str], version: str = "2.1.0") -> list[Identity]:
    """Return identities for simulated robots.

    Parameters
    ----------
    names
        The robots of the plan.
    version
        Of the norm.
    """
    return [
        Identity(manufacturer="rightofway", serial_number=f"robot{number}", version=version)
        for number in range(len(names))
    ]


def format_identities(names: Sequence[str], identities: Sequence[Identity]) -> str:
    """Return the file of identities of simulated robots.

    Parameters
    ----------
    names
        The robots of the plan.
    identities
        Theirs, all of one manufacturer and version.
    """
    document = {
        "format": IDENTITIES_FORMAT,
        "manufacturer": identities[0].manufacturer,
        "version": identities[0].version,
        "robots": {
            name: {"serial": identity.serial_number}
            for name, identity in zip(names, identities, strict=True)
        },
    }
    return format_yaml(document)
