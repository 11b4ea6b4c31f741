"""Pairs of near points and lines: the grid of cells against all pairs, one by one."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from rightofway.site.nearness import Lines, PointGrid

Floats = NDArray[np.float64]


def scattered(seed: int, n: int, extent: float, longest: float) -> tuple[Floats, Floats]:
    """Return the ends of lines of lengths from very short to the longest, and one of length 0."""
    rng = np.random.default_rng(seed)
    begin = rng.uniform(-extent, extent, (n, 2))
    angle, length = rng.uniform(0, 7, n), longest * rng.uniform(0, 1, n) ** 4
    length[0] = 0
    return begin, begin + np.column_stack((np.cos(angle), np.sin(angle))) * length[:, None]


CASES = [(1, 60, 5.0, 3.0, 0.5), (2, 60, 1e6, 1e6, 1e4), (3, 60, 1.0, 40.0, 1e-7), (4, 1, 1, 1, 1)]


@pytest.mark.parametrize(("seed", "n", "extent", "longest", "distance"), CASES)
def test_points_within_the_distance_and_no_others_are_found(
    seed: int, n: int, extent: float, longest: float, distance: float
) -> None:
    points, others = scattered(seed, n, extent, longest)
    inside = np.vstack((points, others))
    one, other = PointGrid(inside, distance).find_near(inside)
    gaps = np.hypot(*(inside[:, None] - inside).transpose(2, 0, 1))
    assert sorted(zip(one, other, strict=True)) == list(map(tuple, np.argwhere(gaps <= distance)))


@pytest.mark.parametrize(("seed", "n", "extent", "longest", "distance"), CASES)
def test_points_within_the_distance_of_a_line_and_no_others_are_found(
    seed: int, n: int, extent: float, longest: float, distance: float
) -> None:
    begin, end = scattered(seed, n, extent, longest)
    lines, points = Lines(begin, end), np.vstack((begin, end))
    grid = PointGrid(points, distance + lines.piece)
    line, point = lines.find_near_points(grid, slice(n // 2, n), distance)
    near = {
        (k, j)
        for k in range(n // 2, n)
        for j, place in enumerate(points)
        if _gap(begin[k], end[k], place) <= distance
    }
    assert set(zip(line, point, strict=True)) == near


def _gap(begin: Floats, end: Floats, place: Floats) -> float:
    step, square = end - begin, float(((end - begin) ** 2).sum())
    share = min(max(float(step @ (place - begin)) / square, 0), 1) if square else 0
    return float(np.hypot(*(place - begin - share * step)))


def _cross(origin: Floats, one: Floats, other: Floats) -> float:
    (x, y), (to_x, to_y) = one - origin, other - origin
    return float(x * to_y - y * to_x)


@pytest.mark.parametrize(("seed", "n", "extent", "longest"), [case[:4] for case in CASES])
def test_lines_that_cross_are_found_once(seed: int, n: int, extent: float, longest: float) -> None:
    a, b = scattered(seed, n, extent, longest)
    lines = Lines(a, b)
    grid = PointGrid(lines.middles, lines.piece * (1 + 1e-9))
    parts = [lines.find_crossing(grid, slice(k, k + 7), 0) for k in range(0, n, 7)]
    found = [
        pair for one, other in parts for pair in zip(one.tolist(), other.tolist(), strict=True)
    ]
    crossing = {
        (i, j)
        for i in range(n)
        for j in range(i + 1, n)
        if _cross(a[i], b[i], a[j]) * _cross(a[i], b[i], b[j]) < 0
        if _cross(a[j], b[j], a[i]) * _cross(a[j], b[j], b[i]) < 0
    }
    assert len(found) == len(set(found))
    assert crossing <= set(found)
    assert len(found) <= len(crossing) + n  # a line of length 0 lies on both sides of none
