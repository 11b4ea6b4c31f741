"""Plans that simulated robots drive from inside the studio: begun, watched, held, stopped."""

from __future__ import annotations

import asyncio
import json
import threading
from pathlib import Path
from typing import Any

import httpx
import pytest
from pydantic import TypeAdapter

from rightofway.control.demo import drive_demo
from rightofway.studio import watching
from rightofway.studio.driving import MAX_DRIVES
from rightofway.studio.routes.answers import ANSWERS
from rightofway.viz.page.payload import make_payload
from tests.builders.plans import door
from tests.builders.studios import Client, planned
from tests.builders.suites import soon


@pytest.fixture
def site(client: Client) -> Client:
    """Return a client of a studio that drives nothing."""
    for drive in client.get("/drives").json()["drives"]:
        client.post(f"/drives/{drive['number']}/stop")
    return client


def begin(client: httpx.Client, run: int, **settings: Any) -> dict[str, Any]:
    """Begin a drive, and return what is said of it."""
    answer = client.post(f"/runs/{run}/drives", json=settings)
    assert answer.status_code == 201, answer.text
    drive: dict[str, Any] = answer.json()
    TypeAdapter(ANSWERS["POST", "/runs/{number}/drives"]).validate_python(drive, extra="forbid")
    return drive


def state(client: httpx.Client, drive: dict[str, Any]) -> str:
    return str(client.get(f"/drives/{drive['number']}").json()["state"])


def frame_of(client: Client, drive: dict[str, Any]) -> dict[str, Any]:
    """Return the first frame of a page: all that has happened."""
    address = f"{client.address}{drive['page'].lstrip('/')}stream"
    with httpx.stream("GET", address, timeout=30) as stream:
        for line in stream.iter_lines():
            if line.startswith("data: "):
                frame: dict[str, Any] = json.loads(line.removeprefix("data: "))
                return frame
    raise AssertionError("the stream has no frame")


def test_a_plan_is_driven_to_its_end_and_its_page_stays(site: Client) -> None:
    run = planned(site, planner="two-level", name="door")["number"]
    drive = begin(site, run, time_scale=1000)
    assert (drive["run"], drive["page"]) == (run, f"/drives/{drive['number']}/")
    assert soon(lambda: state(site, drive) == "done")
    page = httpx.get(f"{site.address}{drive['page'].lstrip('/')}")
    assert page.status_code == 200
    assert "<title>door: 2 robots</title>" in page.text
    frame = frame_of(site, drive)
    assert not frame["runs"]
    assert {"route", "arrived", "says"} <= {row[2] for row in frame["rows"]}
    assert drive["number"] in [one["number"] for one in site.get("/drives").json()["drives"]]


def test_robots_take_orders_of_the_page_until_the_drive_is_stopped(site: Client) -> None:
    """The door takes 10 time units: at this pace nobody arrives while the test runs."""
    drive = begin(site, planned(site, planner="two-level")["number"], time_scale=0.5)
    orders = f"{site.address}{drive['page'].lstrip('/')}orders"
    held = httpx.post(orders, json={"kind": "hold", "name": "R1"}, timeout=30).json()
    assert held["done"], held
    stopped = site.post(f"/drives/{drive['number']}/stop").json()
    assert (stopped["state"], stopped["error"]) == ("stopped", None)
    assert soon(lambda: not frame_of(site, drive)["runs"])
    rows = frame_of(site, drive)["rows"]
    assert ["hold", True] in [row[2:4] for row in rows]


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"delays": ["stop:R9@1+2"]}, "R9"),
        ({"delays": ["stop:R1@1"]}, "R1 would never complete"),
        ({"time_scale": 0}, "time_scale"),
        ({"speed": 3}, "speed"),
    ],
)
def test_what_cannot_be_driven_is_refused_with_the_reason(
    site: Client, settings: dict[str, Any], message: str
) -> None:
    before = site.get("/drives").json()
    answer = site.post(f"/runs/{planned(site)['number']}/drives", json=settings)
    assert answer.status_code == 422
    assert message in answer.json()["error"]["message"]
    assert site.get("/drives").json() == before


def test_a_drive_that_is_not_there_is_refused(site: Client) -> None:
    for answer in (
        site.get("/drives/9999"),
        site.post("/drives/9999/stop"),
        site.post("/runs/9999/drives", json={}),
        httpx.get(f"{site.address}drives/9999/"),
    ):
        assert answer.status_code == 404, answer.text


def test_no_more_than_a_few_plans_are_driven_at_once(site: Client) -> None:
    run = planned(site, planner="two-level")["number"]
    drives = [begin(site, run, time_scale=0.1) for _ in range(MAX_DRIVES)]
    refused = site.post(f"/runs/{run}/drives", json={"time_scale": 0.1})
    assert refused.status_code == 429
    assert f"{MAX_DRIVES} plans are driven already (stop one)" in refused.text
    for drive in drives:
        site.post(f"/drives/{drive['number']}/stop")
    assert {state(site, drive) for drive in drives} == {"stopped"}


def test_a_drive_whose_process_is_killed_has_failed(site: Client) -> None:
    drive = begin(site, planned(site, planner="two-level")["number"], time_scale=0.1)
    site.studio.drives.get(drive["number"]).job.kill()
    assert soon(lambda: state(site, drive) == "failed")
    error = site.get(f"/drives/{drive['number']}").json()["error"]
    assert error["kind"] == "died"


def test_what_pages_know_of_the_plan_is_made_once_and_never_by_the_loop_that_serves(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drive_demo(door(), journal=tmp_path / "door.journal")
    makers = list[threading.Thread]()

    def note(*given: Any, **named: Any) -> Any:
        makers.append(threading.current_thread())
        return make_payload(*given, **named)

    monkeypatch.setattr(watching, "make_payload", note)
    watched = watching.Watched(door(), tmp_path / "door.journal", title="door", takes_orders=True)

    async def ask() -> list[str]:
        return [await watched.make_page_aside() for _ in range(2)]

    first, second = asyncio.run(ask())
    assert first == second == watched.make_page()
    assert len(makers) == 1
    assert makers[0] is not threading.main_thread()
