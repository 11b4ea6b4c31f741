"""The page of a fleet that is driven: live, looked back on, replayed, and without its server."""

from __future__ import annotations

import json
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import ExitStack, closing
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.request import Request, urlopen

import pytest

from rightofway.control import StateReport
from rightofway.control.commands import Commands
from rightofway.control.demo import drive_demo
from rightofway.control.journal import SqliteJournal
from rightofway.control.notices import Notices
from rightofway.control.operator import OPERATIONS
from rightofway.control.proofs import make_stray, take_fault
from rightofway.control.standstill import STILL
from rightofway.facts import Fact
from tests.builders.accessibility import serious
from tests.builders.browsers import expect
from tests.builders.drives import driven, watched
from tests.builders.floor_jobs import floor_plan
from tests.builders.languages import english_on
from tests.builders.plans import door
from tests.builders.players import Player, nameless_on, overlap

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator


@pytest.fixture
def stack() -> Iterator[ExitStack]:
    with ExitStack() as made:
        yield made


def opened(browser: Browser, stack: ExitStack, address: str, **context: Any) -> Player:
    """Return the page at an address, painted with what has happened."""
    made = stack.enter_context(
        browser.new_context(**{"viewport": {"width": 1280, "height": 800}, **context})
    )
    viewer = Player(made.new_page())
    viewer.page.goto(address)
    viewer.painted()
    return viewer


def row_of(viewer: Player, robot: str) -> Locator:
    """Return a robot's row in the list; rows name other robots, too."""
    rows = viewer.page.locator("#robot-list").get_by_role("option")
    return rows.filter(has=viewer.page.locator(".name", has_text=robot))


def shows(viewer: Player, tick: float) -> None:
    """Wait until a live page has come to a moment."""
    viewer.poll(lambda: viewer.tick == tick, f"the page at {tick}")


def told(viewer: Player) -> list[str]:
    """Return the sentences of the log, the latest first."""
    viewer.page.get_by_role("tab", name="Log").click()
    viewer.painted()
    rows = viewer.page.get_by_role("listbox", name="Log").get_by_role("option")
    return [text.split("\n")[0] for text in rows.all_inner_texts()]


def disc_at(viewer: Player, place: tuple[float, float], colour: str) -> bool:
    """Return whether a robot of a colour is drawn at a place of the site."""
    x, y = viewer.on_map(place)
    return any(
        abs(disc.x - x) < 3 and abs(disc.y - y) < 3
        for disc in viewer.discs()
        if disc.colour == colour and not disc.is_dashed
    )


def give(address: str, **order: str) -> Future[Any]:
    """Give an order, as a program does; the answer comes when time goes on."""
    request = Request(  # noqa: S310 (this machine)
        f"{address}drives/0/orders",
        json.dumps(order).encode(),
        {"content-type": "application/json"},
    )

    def send() -> Any:
        with urlopen(request, timeout=30) as answer:  # noqa: S310 (this machine)
            return json.load(answer)

    return ThreadPoolExecutor().submit(send)


def is_asked(viewer: Player, journal: Path) -> None:
    """Wait until an order has come that has no answer."""
    with closing(Commands(journal)) as commands:
        viewer.poll(commands.list_unanswered, "the order")


def colours(viewer: Player) -> list[str]:
    """Return the colours of the robots, by the dots of the list."""
    swatches = viewer.page.locator("#robot-list .swatch")
    return [
        str(swatch.evaluate("(it) => it.style.getPropertyValue('--robot')"))
        for swatch in swatches.all()
    ]


def test_a_page_follows_a_demo_from_the_first_release_to_home(
    browser: Browser, stack: ExitStack, tmp_path: Path
) -> None:
    """R2 goes through the door (N4) first; R1 waits for it at N0, then drives to N6."""
    drive = stack.enter_context(driven(door(), tmp_path / "demo.journal"))
    viewer = opened(browser, stack, stack.enter_context(watched(door(), tmp_path / "demo.journal")))
    expect(viewer.page.get_by_role("button", name="Live", pressed=True)).to_be_visible()
    expect(row_of(viewer, "R1")).to_contain_text("waits for R2")
    blue, red = colours(viewer)
    assert disc_at(viewer, (0.5, 0.5), blue)
    row_of(viewer, "R2").click()
    card = viewer.page.locator("#card")
    expect(card).to_contain_text("ReleasedN1, N4, N7, N8")  # its base, at once
    expect(card).to_contain_text("Planned nextN7, N4, N1, N2")
    drive.let(2)
    shows(viewer, 2)
    expect(row_of(viewer, "R1")).to_contain_text("driving")
    assert disc_at(viewer, (1.5, 1.5), red)
    expect(card).to_contain_text("ReleasedN7, N8")
    drive.let(5)
    expect(row_of(viewer, "R2")).to_contain_text("waits for R1")
    assert told(viewer)[:2] == [
        "R2 waits at N8 until R1 is at N6",
        "R2 has done its work at N8 (1 of 1)",
    ]
    drive.end()
    expect(viewer.page.get_by_text("the control has ended")).to_be_visible()
    assert told(viewer)[0] == "R1 is at the end of its way, N0"
    viewer.page.get_by_role("tab", name="Robots").click()
    for robot in ("R1", "R2"):
        expect(row_of(viewer, robot)).to_contain_text("done")
    shows(viewer, 12)
    assert disc_at(viewer, (0.5, 0.5), blue)
    assert disc_at(viewer, (2.5, 0.5), red)
    assert viewer.complaints == []


def test_what_is_released_is_drawn(browser: Browser, stack: ExitStack, tmp_path: Path) -> None:
    """Beside the middle of N7, on R2's base, is a paler red; once R2 is past, there is none."""
    drive = stack.enter_context(driven(door(), tmp_path / "demo.journal"))
    viewer = opened(browser, stack, stack.enter_context(watched(door(), tmp_path / "demo.journal")))
    expect(row_of(viewer, "R1")).to_contain_text("waits for R2")
    spot = viewer.on_map((1.5, 2.2))  # between N4 and N7
    red, green, blue, _ = viewer.colour(spot)
    assert red > max(green, blue) + 20
    drive.let(5)
    shows(viewer, 5)
    viewer.page.get_by_text("Floor", exact=True).click()  # no lines to planned places
    viewer.painted()
    red, green, blue, _ = viewer.colour(spot)
    assert red <= max(green, blue) + 20


def state(viewer: Player) -> tuple[Any, ...]:
    """Return what a page says and draws at the moment shown."""
    viewer.page.get_by_role("tab", name="Robots").click()
    viewer.painted()
    viewer.page.get_by_text("Floor", exact=True).click()
    viewer.painted()
    discs = sorted((disc.colour, round(disc.x), round(disc.y)) for disc in viewer.discs())
    rows = viewer.page.locator("#robot-list").get_by_role("option").all_inner_texts()
    return discs, rows


def test_a_replay_shows_what_the_live_page_has_shown(
    browser: Browser, stack: ExitStack, tmp_path: Path
) -> None:
    journal = tmp_path / "demo.journal"
    drive = stack.enter_context(driven(door(), journal))
    live = opened(browser, stack, stack.enter_context(watched(door(), journal)))
    seen = {}
    for tick in (2, 5, 8):
        drive.let(tick)
        shows(live, tick)
        live.painted()
        seen[tick] = state(live)
    drive.end()
    replay = opened(
        browser, stack, stack.enter_context(watched(door(), journal, takes_orders=False))
    )
    expect(replay.page.get_by_text("the control has ended")).to_be_visible()
    expect(replay.page.get_by_role("toolbar", name="Orders to the robots")).to_be_hidden()
    for tick, shown in seen.items():
        replay.seek(tick)
        assert state(replay) == shown, tick
    assert replay.end == 12


def test_who_looks_back_stays_there_and_comes_back_by_a_button(
    browser: Browser, stack: ExitStack, tmp_path: Path
) -> None:
    drive = stack.enter_context(driven(door(), tmp_path / "demo.journal"))
    viewer = opened(browser, stack, stack.enter_context(watched(door(), tmp_path / "demo.journal")))
    drive.let(4)
    shows(viewer, 4)
    viewer.seek(1)
    drive.let(6)
    expect(viewer.page.get_by_text("looking back")).to_be_visible()
    expect(row_of(viewer, "R1")).to_contain_text("waits for R2")
    assert viewer.tick == 1
    viewer.page.get_by_role("button", name="Live").click()
    shows(viewer, 6)
    assert viewer.complaints == []


def test_a_page_that_has_lost_its_server_says_so_and_gets_what_it_has_missed(
    browser: Browser, stack: ExitStack, tmp_path: Path
) -> None:
    journal = tmp_path / "demo.journal"
    drive = stack.enter_context(driven(door(), journal))
    with watched(door(), journal) as address:
        viewer = opened(browser, stack, address)
        drive.let(3)
        shows(viewer, 3)
    expect(viewer.page.get_by_text("no connection; trying again")).to_be_visible()
    lost = viewer.page.get_by_role("alert").get_by_text("No connection to the control.")
    expect(lost).to_be_visible()
    box = lost.bounding_box()
    assert box is not None
    assert box["width"] >= 600
    for name in ("Hold all robots", "Let all robots go"):
        expect(viewer.page.get_by_role("button", name=name)).to_be_disabled()
    for name in ("R1", "R2"):
        expect(row_of(viewer, name)).to_contain_text("unknown")
    drive.let(5)
    port = int(address.rstrip("/").rpartition(":")[2])
    stack.enter_context(watched(door(), journal, port=port))
    expect(row_of(viewer, "R2")).to_contain_text("waits for R1")
    held_up = viewer.page.get_by_role("region", name="Robots that hold up others")
    expect(held_up).to_contain_text("R1 holds up 1 robot: R2")
    expect(lost).to_be_hidden()
    expect(viewer.page.get_by_role("button", name="Hold all robots")).to_be_enabled()
    shows(viewer, 5)
    assert told(viewer).count("R2 has done its work at N8 (1 of 1)") == 1


def test_a_person_holds_robots_and_lets_them_go(
    browser: Browser, stack: ExitStack, tmp_path: Path
) -> None:
    """Held at 0, R1 is let go last, by its own button."""
    journal = tmp_path / "demo.journal"
    drive = stack.enter_context(driven(door(), journal))
    viewer = opened(browser, stack, stack.enter_context(watched(door(), journal)))
    page = viewer.page
    page.get_by_role("button", name="Hold all robots").click()
    is_asked(viewer, journal)
    page.get_by_role("button", name="Let all robots go").click()
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("Release all robots?")
    dialog.get_by_role("button", name="Cancel").click()
    expect(dialog).to_be_hidden()
    drive.let(10**9)
    expect(row_of(viewer, "R2")).to_contain_text("held by a person")
    expect(page.get_by_text("carried out")).to_be_visible()
    row_of(viewer, "R2").click()
    page.get_by_role("button", name="Let R2 go").click()
    expect(page.get_by_role("button", name="Hold R2")).to_be_visible()
    row_of(viewer, "R1").click()
    page.get_by_role("button", name="Let R1 go").click()
    expect(page.get_by_text("the control has ended")).to_be_visible()
    expect(page.get_by_role("toolbar", name="Orders to the robots")).to_be_hidden()
    assert viewer.complaints == []


def test_two_people_at_two_screens_see_the_orders_of_each_other(
    browser: Browser, stack: ExitStack, tmp_path: Path
) -> None:
    """One holds all robots; both let them go, which counts once and is refused to no one."""
    journal = tmp_path / "demo.journal"
    drive = stack.enter_context(driven(door(), journal))
    address = stack.enter_context(watched(door(), journal))
    first, second = (opened(browser, stack, address) for _ in range(2))
    first.page.get_by_label("Your name").fill("Anna")
    first.page.get_by_role("button", name="Hold all robots").click()
    is_asked(first, journal)
    drive.let(5)
    for viewer in (first, second):
        expect(row_of(viewer, "R2")).to_contain_text("held by a person")
        expect(viewer.page.get_by_text("Last order: all robots: on hold, by Anna")).to_be_visible()
    for viewer in (first, second):
        viewer.page.get_by_role("button", name="Let all robots go").click()
        viewer.page.get_by_role("dialog").get_by_role("button", name="Yes").click()
    with closing(Commands(journal)) as commands:
        first.poll(lambda: len(commands.list_unanswered()) == 2, "both orders")
    drive.let(10**9)
    for viewer in (first, second):
        expect(viewer.page.get_by_text("the control has ended")).to_be_visible()
        assert viewer.complaints == []
    assert told(first) == told(second)


def test_a_robot_that_was_taken_off_the_floor_is_placed_by_a_person(
    browser: Browser, stack: ExitStack, tmp_path: Path
) -> None:
    """R1 is taken off at home; R2, which need not wait for it any more, comes home."""
    journal = tmp_path / "demo.journal"
    drive = stack.enter_context(driven(door(), journal))
    address = stack.enter_context(watched(door(), journal))
    viewer = opened(browser, stack, address)
    answer = give(address, kind="remove", name="R1")
    is_asked(viewer, journal)
    drive.let(5)
    assert answer.result()["done"]
    expect(row_of(viewer, "R1")).to_contain_text("off the floor")
    shows(viewer, 5)
    row_of(viewer, "R1").click()
    viewer.page.get_by_role("button", name="R1 is on the floor again").click()
    dialog = viewer.page.get_by_role("dialog")
    expect(dialog).to_contain_text("At which place is R1 put back on the map?")
    dialog.get_by_label("Place").fill("N99")
    dialog.get_by_role("button", name="Yes").click()
    is_asked(viewer, journal)
    drive.let(6)
    expect(viewer.page.get_by_text("no vertex is named 'N99'")).to_be_visible()
    assert viewer.complaints == []


@pytest.mark.parametrize(
    "case",
    [
        ("clear", "R1 is where it is shown", "Is R1 at the shown place?", "done"),
        ("remove", "R1 is off the floor", "Is R1 off the floor?", "off the floor"),
    ],
)
def test_a_person_is_alarmed_and_says_what_has_become_of_a_robot_with_a_fault(
    browser: Browser, stack: ExitStack, tmp_path: Path, case: tuple[str, str, str, str]
) -> None:
    """The control is this test: it writes the journal of robots that are home, and answers."""
    command, button, question, then = case
    path = tmp_path / "demo.journal"
    drive_demo(door(), journal=path)
    journal = stack.enter_context(closing(SqliteJournal(path, lambda: 12.0)))
    commands = stack.enter_context(closing(Commands(path)))
    viewer = opened(browser, stack, stack.enter_context(watched(door(), path)))
    alarms = viewer.page.get_by_role("region", name="Alarms")
    notices = Notices(["R1", "R2"], lambda _: None, keep=lambda entry: journal.commit([entry]))
    notices.report_on(1, Fact("not connected"), "lost")
    expect(alarms).to_contain_text("R2 is not connected")
    stray = StateReport(order_id="", update_id=0, last_place="N4", last_sequence_id=0)
    journal.commit([take_fault(0, make_stray(stray), stray, notices.report_on)])
    expect(alarms).to_contain_text(
        "R1 is faulty: it is at N4, which it does not hold; a person has to look after it"
    )
    expect(row_of(viewer, "R1")).to_contain_text("alarm")
    row_of(viewer, "R2").click()
    expect(viewer.page.get_by_role("button", name="Hold R2")).to_be_visible()
    expect(viewer.page.get_by_role("button", name=button)).to_be_hidden()
    row_of(viewer, "R1").click()
    viewer.page.get_by_role("button", name=button, exact=True).click()
    dialog = viewer.page.get_by_role("dialog")
    expect(dialog).to_contain_text(question)
    dialog.get_by_role("button", name="Yes").click()
    is_asked(viewer, path)
    ((number, asked),) = commands.list_unanswered()
    assert json.loads(asked) == {"kind": command, "name": "R1"}
    journal.commit([{**OPERATIONS[command], "robot": 0}])
    fact = Fact("operated", robot="R1", operation=Fact(f"operation {command}"))
    commands.answer(number, {"done": True, "fact": fact.as_dict()})
    expect(viewer.page.get_by_text("carried out")).to_be_visible()
    expect(row_of(viewer, "R1")).to_contain_text(then)
    expect(alarms).not_to_contain_text("R1")
    expect(row_of(viewer, "R2")).to_contain_text("alarm")
    notices.report_on(1, None, "lost", is_over=True)
    notices.report_on(1, Fact("not moving", place="N1", target="N2"), STILL)
    expect(row_of(viewer, "R2")).to_contain_text("not moving")
    notices.report_on(1, None, STILL, is_over=True)
    expect(alarms).to_be_hidden()
    assert viewer.complaints == []


def test_alarms_are_acknowledged_by_name_and_all_screens_show_it(
    browser: Browser, stack: ExitStack, tmp_path: Path
) -> None:
    """The control is this test. An alarm that begins later was seen by nobody."""
    path = tmp_path / "demo.journal"
    drive_demo(door(), journal=path)
    journal = stack.enter_context(closing(SqliteJournal(path, lambda: 12.0)))
    commands = stack.enter_context(closing(Commands(path)))
    address = stack.enter_context(watched(door(), path))
    viewers = [opened(browser, stack, address) for _ in range(2)]
    notices = Notices(["R1", "R2"], lambda _: None, keep=lambda entry: journal.commit([entry]))
    notices.report_on(1, Fact("not connected"), "lost")
    for count, (viewer, person) in enumerate(zip(viewers, ("Anna", "Ben"), strict=True)):
        button = viewer.page.get_by_role("button", name="I have seen the alarms")
        button.click()
        expect(viewer.page.get_by_label("Your name")).to_be_focused()  # it is required
        viewer.page.get_by_label("Your name").fill(person)
        button.click()
        viewer.poll(lambda: len(commands.list_unanswered()) > count, "the order")  # noqa: B023
    for number, asked in commands.list_unanswered():
        seen = Fact("alarms seen", person=json.loads(asked)["name"])
        notices.report(seen)
        commands.answer(number, {"done": True, "fact": seen.as_dict()})
    expect(viewers[1].page.get_by_text("Anna has seen them before")).to_be_visible()
    button = viewers[0].page.get_by_role("button", name="I have seen the alarms")
    expect(button).to_be_hidden()
    notices.report_on(0, Fact("not connected"), "lost")
    expect(button).to_be_visible()
    for viewer in viewers:
        alarms = viewer.page.get_by_role("region", name="Alarms")
        expect(alarms).to_contain_text("R2 is not connected (seen by Anna)")
        expect(alarms.get_by_text("R1 is not connected")).not_to_contain_text("seen by")
        assert viewer.complaints == []


def test_the_page_compares_planned_and_actual_ends_of_jobs_as_they_change(
    browser: Browser, stack: ExitStack, tmp_path: Path
) -> None:
    """The late jobs are first; those of a robot are summed up."""
    journal = tmp_path / "demo.journal"
    options = {"delays": "exponential:0.5", "seed": 3}
    drive = stack.enter_context(driven(floor_plan(), journal, **options))
    viewer = opened(browser, stack, stack.enter_context(watched(floor_plan(), journal)))
    page = viewer.page
    tab = page.get_by_role("tab", name="Delays")
    expect(tab).to_have_text("Delays 0")
    tab.click()
    sums = page.locator("#ends-sums")
    expect(sums).to_have_text("0 done · 3 open")
    rows = page.locator("#end-list").get_by_role("option")
    expect(rows).to_have_count(3)
    expect(rows.filter(has_text="J1")).to_contain_text("R1 · planned")
    drive.end()
    expect(sums).to_contain_text("3 done · 0 open")
    expect(rows.first.locator(".late.wrong")).to_contain_text("late")
    expect(rows.first).to_contain_text("actual")
    page.get_by_role("button", name="By robot").click()
    expect(rows).to_have_count(2)
    expect(rows.filter(has_text="R2")).to_contain_text("2 done · 0 open")
    assert serious(viewer) == []
    assert nameless_on(viewer) == []
    assert viewer.complaints == []


def test_a_screen_on_a_wall_has_large_type(
    browser: Browser, stack: ExitStack, tmp_path: Path
) -> None:
    """By the button, and by the address; the type grows with the width of the screen."""
    journal = tmp_path / "demo.journal"
    drive_demo(door(), journal=journal)
    address = stack.enter_context(watched(door(), journal))
    viewer = opened(browser, stack, address)
    usual = viewer.box("#robot-list-0")["height"]
    viewer.page.get_by_role("button", name="Large type").click()
    large = viewer.box("#robot-list-0")["height"]
    assert round(large / usual, 1) == 1.2
    assert viewer.is_as_wide_as(1280)
    viewer.page.set_viewport_size({"width": 3840, "height": 2160})
    viewer.painted()
    assert round(viewer.box("#robot-list-0")["height"] / usual, 1) == 3.2
    viewer.page.set_viewport_size({"width": 1280, "height": 800})
    assert serious(viewer) == []
    viewer.page.get_by_role("button", name="Large type").click()
    assert viewer.box("#robot-list-0")["height"] == usual
    mark = "&" if "?" in address else "?"
    again = opened(browser, stack, f"{address}{mark}wall")
    assert again.box("#robot-list-0")["height"] == large
    assert viewer.complaints == again.complaints == []


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
def test_the_page_has_no_serious_fault_and_fits(
    browser: Browser, stack: ExitStack, tmp_path: Path, theme: str, width: int
) -> None:
    journal = tmp_path / "demo.journal"
    drive_demo(door(), journal=journal)
    viewer = opened(
        browser, stack, stack.enter_context(watched(door(), journal)),
        color_scheme=theme, locale="de", viewport={"width": width, "height": 800},
    )  # fmt: skip
    expect(viewer.page.get_by_text("die Steuerung ist zu Ende")).to_be_visible()
    assert english_on(viewer) == []
    assert nameless_on(viewer) == []
    assert serious(viewer) == []
    viewer.page.get_by_role("tab", name="Verlauf").click()
    viewer.painted()
    assert serious(viewer) == []
    assert english_on(viewer) == []
    assert viewer.is_as_wide_as(width)
    readout, state = (
        (box["x"], box["y"], box["x"] + box["width"], box["y"] + box["height"])
        for box in map(viewer.box, ("#readout", "#live-state"))
    )
    assert max(readout[2], state[2]) <= width
    assert not overlap(readout, state)
    assert viewer.complaints == []
