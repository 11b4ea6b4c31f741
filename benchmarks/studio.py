"""The studio with 1000 robots in a real browser: how soon it answers, how smoothly it plays.

``python -m benchmarks.studio`` opens the warehouse of the examples in a headless Chromium of 1280 x
800 pixels and writes the table of docs/results/studio.md; it takes less than a minute. Figures of
requests are what a client waits, the median of three. *Longest task* is the longest time in which
the page answers nobody, from the press on; the browser reports those of 50 ms and more. Frames are
counted while a plan plays at eight times its usual speed.
"""

from __future__ import annotations

import shutil
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from benchmarks.common import RESULTS, table, write_tables
from tests.builders.browsers import Viewer, chromium
from tests.builders.drawing import StudioPage
from tests.builders.studios import Command, command, over, planned

if TYPE_CHECKING:
    import httpx
    from playwright.sync_api import Browser

MAPS = Path(__file__).parents[1] / "examples" / "maps"
MAP = "warehouse-10-20-10-2-1"
ROBOTS, FEW = 1000, 200
SIZE = {"width": 1280, "height": 800}
SECONDS = 5
"""How long the plan is searched for, and how long it is played [s]."""

Row = tuple[str, str]

TASKS = """
window.tasks = [];
new PerformanceObserver((list) => list.getEntries().forEach((each) => tasks.push(each.duration)))
  .observe({ type: "longtask", buffered: true });
"""

FRAMES = """(seconds) => new Promise((done) => {
  const times = [];
  tasks.length = 0;
  const frame = (now) => {
    times.push(now);
    if (now - times[0] < 1000 * seconds) requestAnimationFrame(frame);
    else done({ gaps: times.slice(1).map((each, i) => each - times[i]), tasks });
  };
  requestAnimationFrame(frame);
})"""

TYPED = """async (text) => {
  const input = () => document.querySelector("td.speed input");
  const isBusy = () => document.querySelector("[aria-busy=true]") !== null;
  const until = (holds) => new Promise((done) => {
    const observer = new MutationObserver(() => look());
    const look = () => holds() && (observer.disconnect(), done());
    observer.observe(document.body, { attributes: true, childList: true, subtree: true });
    look();
  });
  const painted = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  const type = (text) => {
    input().focus();
    input().value = text;
    input().dispatchEvent(new Event("change", { bubbles: true }));
  };
  const isWrong = () => input().getAttribute("aria-invalid") === "true";
  tasks.length = 0;
  let began = performance.now();
  type("0");
  await until(isWrong);
  await painted();
  const fault = performance.now() - began;
  began = performance.now();
  type(text);
  await until(() => !isWrong());
  await until(() => !isBusy());
  return [fault, performance.now() - began];
}"""
"""Types a speed that is refused and then one that is right: the cell is marked, then it is not, and
the page is no longer busy when the findings are there."""


def milliseconds(work: Callable[[], httpx.Response], times: int = 3) -> str:
    """Return how long a client waits for an answer."""
    taken = []
    for _ in range(times):
        began = time.perf_counter()
        work().raise_for_status()
        taken.append(1000 * (time.perf_counter() - began))
    return f"{statistics.median(taken):.0f} ms"


def of_requests(client: httpx.Client, document: Any, moved: Any, number: int) -> Iterator[Row]:
    """Yield how soon the server answers."""

    def survey(of: Any, *, inspects: bool) -> Callable[[], httpx.Response]:
        return lambda: client.post("/survey", json={"document": of, "inspects": inspects})

    yield "open the file", milliseconds(lambda: client.get(f"/documents/{MAP}.scen"))
    yield "faults after a change", milliseconds(survey(document, inspects=False))
    yield "findings after a robot has moved", milliseconds(survey(moved, inspects=True), 1)
    yield "findings after a speed has changed", milliseconds(survey(moved, inspects=True))
    payload = f"/runs/{number}/payload"
    yield "playback, first request", milliseconds(lambda: client.get(payload), 1)
    yield "playback, further requests", milliseconds(lambda: client.get(payload))
    size = int(client.get(payload).headers["content-length"])
    yield "its size, compressed", f"{size / 1000:.0f} kB"
    yield "reasons of waits", milliseconds(lambda: client.get(f"/runs/{number}/losses"), 1)


def of_change(client: httpx.Client, document: Any) -> Iterator[Row]:
    """Yield how soon there is a plan after a change, from the plan before it."""
    first, *others = document["robots"][:FEW]
    number = planned(client, {**document, "robots": [first, *others]}, time_limit=2)["number"]
    taken = []
    for speed in ("1/2", "1/3", "1/4"):
        changed = {**document, "robots": [{**first, "speed": speed}, *others]}
        body = {"document": changed, "start": number, "based_on": number, "time_limit": 1}
        began = time.perf_counter()
        run = client.post("/runs", json=body).json()["number"]
        while not client.get(f"/runs/{run}").json()["has_plan"]:
            time.sleep(0.002)
        taken.append(1000 * (time.perf_counter() - began))
        over(client, run)
    yield (
        f"a plan of {FEW} robots after one has another speed",
        f"{statistics.median(taken):.0f} ms",
    )


def of_start(browser: Browser, root: str) -> Iterator[Row]:
    """Yield how soon the start page is there, in a browser that has nothing of it."""
    taken = []
    for _ in range(3):
        context = browser.new_context(viewport=SIZE)  # type: ignore[arg-type]
        began = time.perf_counter()
        StudioPage(context.new_page(), root)
        taken.append(1000 * (time.perf_counter() - began))
        context.close()
    yield "from the address to the start page", f"{statistics.median(taken):.0f} ms"


def of_studio(browser: Browser, root: str, number: int) -> Iterator[Row]:
    """Yield how soon and how smoothly the page of the studio answers."""
    context = browser.new_context(viewport=SIZE)  # type: ignore[arg-type]
    context.add_init_script(TASKS)
    began = time.perf_counter()
    studio = StudioPage(context.new_page(), root)
    studio.go("file", f"{MAP}.scen")
    yield "from the address to the map", f"{time.perf_counter() - began:.1f} s"
    yield "longest task until then", longest(studio)
    yield "longest task of the table", pressed(studio, lambda: studio.tab("Robots"))
    studio.settle()
    studio.page.wait_for_timeout(1000)
    fault, findings = studio.page.evaluate(TYPED, "2")
    yield "a speed is typed: faults on the page", f"{fault:.0f} ms"
    yield "a speed is typed: findings on the page", f"{findings:.0f} ms"
    yield "longest task of that", longest(studio)
    studio.tab("Plan")
    row = studio.row(number).get_by_role("button").first
    yield "longest task of a plan that is shown", pressed(studio, row.click)
    studio.page.get_by_role("combobox", name="Speed").select_option("8")
    play = studio.button("Play")
    if play.is_visible():
        play.click()
    yield from of_frames(studio, "the studio")
    context.close()


def of_page(browser: Browser, root: str, number: int) -> Iterator[Row]:
    """Yield how smoothly the single page of the same plan plays."""
    context = browser.new_context(viewport=SIZE)  # type: ignore[arg-type]
    context.add_init_script(TASKS)
    viewer = Viewer(context.new_page())
    viewer.page.goto(f"{root}api/v1/runs/{number}/page")
    viewer.painted()
    viewer.page.wait_for_timeout(1000)
    viewer.page.get_by_role("combobox", name="Speed").select_option("8")
    play = viewer.page.get_by_role("button", name="Play", exact=True)
    if play.is_visible():  # it plays by itself unless the address says what to show
        play.click()
    yield from of_frames(viewer, "the single page")
    context.close()


def of_frames(viewer: Viewer, what: str) -> Iterator[Row]:
    """Yield how long frames take while a plan plays, and what the page keeps in memory."""
    viewer.page.wait_for_timeout(500)
    found = viewer.page.evaluate(FRAMES, SECONDS)
    gaps = sorted(found["gaps"])
    median, late = statistics.median(gaps), gaps[int(0.9 * len(gaps))]
    yield f"frames of {what}: median, 90th percentile", f"{median:.1f} ms, {late:.1f} ms"
    yield f"longest task of {what} while it plays", longest(viewer)
    viewer.page.request_gc()
    memory = viewer.page.evaluate("performance.memory.usedJSHeapSize") / 1e6
    yield f"memory of {what}", f"{memory:.0f} MB"


def pressed(viewer: Viewer, press: Callable[[], None]) -> str:
    """Return the longest task that follows from something that is done."""
    viewer.page.evaluate("tasks.length = 0")
    press()
    viewer.page.wait_for_timeout(2000)
    return longest(viewer)


def longest(viewer: Viewer) -> str:
    """Return the longest task since the list was emptied."""
    found = max(viewer.page.evaluate("tasks"), default=0)
    return f"{found:.0f} ms" if found else "below 50 ms"


def rows(studio: Command, browser: Browser) -> Iterator[Row]:
    """Yield all figures."""
    client = studio.client
    document = client.get(f"/documents/{MAP}.scen").json()["document"]
    first, second, *others = document["robots"]
    swapped = [{**first, "home": second["home"]}, {**second, "home": first["home"]}, *others]
    number = planned(client, document, time_limit=SECONDS)["number"]
    root = str(client.base_url).removesuffix("api/v1/")
    yield from of_requests(client, document, {**document, "robots": swapped}, number)
    yield from of_change(client, document)
    yield from of_start(browser, root)
    yield from of_studio(browser, root, number)
    yield from of_page(browser, root, number)


def main() -> None:
    """Write the table."""
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        shutil.copy(MAPS / f"{MAP}.map", folder)
        lines = (MAPS / f"{MAP}-random-1.scen").read_text().splitlines()[: ROBOTS + 1]
        Path(folder, f"{MAP}.scen").write_text("\n".join(lines) + "\n")
        with command(Path(folder), "--no-history") as studio:
            figures = table((f"{ROBOTS} robots", "figure"), rows(studio, browser))
    write_tables(RESULTS / "studio.md", "studio", {"figures": figures})


if __name__ == "__main__":
    main()
