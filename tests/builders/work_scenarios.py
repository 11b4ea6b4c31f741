"""Small random scenarios with jobs, as documents: any loads, times, batteries and states."""

from __future__ import annotations

from random import Random
from typing import Any

ROWS, COLUMNS = 3, 4

TANK = {"drive": "1/40", "on": "1/400", "charge": "1/8", "reserve": "1/10"}


def draw_work_document(
    seed: int, *, n_robots: int = 2, n_jobs: int = 3, states: bool = False, windows: bool = True
) -> dict[str, Any]:
    """Draw a scenario with jobs on a small grid.

    Parameters
    ----------
    seed
        Of the draw.
    n_robots, n_jobs
        How many at most.
    states
        Whether robots may begin elsewhere than at home, later than at 0.
    windows
        Whether stops have `earliest` and `latest`.
    """
    draw = Random(seed)  # noqa: S311 (no secret depends on it)
    cells = list(range(ROWS * COLUMNS))
    blocked = set(draw.sample(cells, draw.randint(0, 2)))
    grid = [
        "".join("@" if row * COLUMNS + column in blocked else "." for column in range(COLUMNS))
        for row in range(ROWS)
    ]
    free = [cell for cell in cells if cell not in blocked]
    homes = draw.sample(free, draw.randint(1, n_robots))
    starts = draw.sample(free, len(homes))
    has_batteries = draw.random() < 0.4
    robots = []
    for number, home in enumerate(homes):
        robot: dict[str, Any] = {"name": f"R{number}", "home": f"N{home}"}
        robot["capacity"] = draw.choice([1, 1, 2])
        if states and draw.random() < 0.5:
            robot["start"] = {"at": f"N{starts[number]}", "ready": draw.randint(0, 4)}
        elif states:
            robot["start"] = {"at": f"N{starts[number]}"}
        if has_batteries:
            robot |= {"battery": "tank", "charging": [f"N{home}"]}
        robots.append(robot)
    jobs = [
        _draw_job(draw, free, number, windows=windows) for number in range(draw.randint(1, n_jobs))
    ]
    if len(jobs) > 1 and draw.random() < 0.3:
        jobs[-1]["after"] = ["J0"]
    return {
        "format": "rightofway-scenario/1",
        "map": {"grid": grid},
        "robots": robots,
        **({"batteries": {"tank": {**TANK}}} if has_batteries else {}),
        "jobs": jobs,
        "rules": {"turn": 0, "occupancy": draw.choice(["one", "both"])},
    }


def _draw_job(draw: Random, free: list[int], number: int, *, windows: bool) -> dict[str, Any]:
    job: dict[str, Any] = {"name": f"J{number}", "weight": draw.choice([1, 1, 2])}
    if draw.random() < 0.4:
        job |= {"at": f"N{draw.choice(free)}", "work": draw.randint(0, 3)}
    else:
        job |= {"pickup": f"N{draw.choice(free)}", "dropoff": f"N{draw.choice(free)}"}
        job |= {"pickup_work": draw.randint(0, 2), "load": 1}
    if windows and draw.random() < 0.4:
        job["earliest"] = draw.randint(0, 8)
    if windows and draw.random() < 0.3:
        job["latest"] = job.get("earliest", 0) + draw.randint(4, 20)
    if draw.random() < 0.3:
        job["due"] = draw.randint(0, 15)
    return job
