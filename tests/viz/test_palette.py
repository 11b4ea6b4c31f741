"""Colours that can be told apart and read."""

import itertools
import math
import re
from dataclasses import fields

import pytest

from rightofway.viz.palette import DARK, LIGHT, Theme, choose_colours, choose_ink, mix


def luminance(colour: str) -> float:
    """Return the relative luminance of WCAG 2.2."""
    channels = [channel / 255 for channel in bytes.fromhex(colour[1:])]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    """Return the contrast ratio of WCAG 2.2."""
    dark, light = sorted(map(luminance, (one, other)))
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_text_is_readable_on_every_ground(theme: Theme) -> None:
    for text, ground in itertools.product(
        (theme.ink, theme.muted), (theme.paper, theme.panel, theme.floor)
    ):
        assert contrast(text, ground) >= 4.5


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_the_bottleneck_stands_out_and_names_in_it_can_be_read(theme: Theme) -> None:
    assert min(contrast(theme.lit_edge, ground) for ground in (theme.paper, theme.floor)) >= 3
    assert contrast(theme.ink, theme.lit) >= 4.5


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_what_goes_wrong_on_the_floor_stands_out(theme: Theme) -> None:
    marks = (theme.held, theme.broken)
    assert min(contrast(mark, theme.paper) for mark in marks) >= 4.5


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_every_robot_shows_on_the_floor(theme: Theme) -> None:
    # WCAG asks 3 to 1 of graphical objects; the lightest hues come close to it, none vanishes.
    assert min(contrast(colour, theme.floor) for colour in choose_colours(1000)) > 2.4


def test_a_name_is_readable_on_every_robot() -> None:
    assert min(contrast(choose_ink(colour), colour) for colour in choose_colours(1000)) > 3


def test_the_first_ten_robots_are_far_apart() -> None:
    pairs = itertools.combinations(choose_colours(10), 2)
    assert min(distance(one, other) for one, other in pairs) > 55


def distance(one: str, other: str) -> float:
    """Return the distance of two colours in sRGB, 0 to 441."""
    channels = zip(bytes.fromhex(one[1:]), bytes.fromhex(other[1:]), strict=True)
    return math.sqrt(sum((a - b) ** 2 for a, b in channels))


def test_a_robot_keeps_its_colour_however_many_there_are() -> None:
    assert choose_colours(1000)[:7] == choose_colours(7)


def test_a_thousand_robots_have_nearly_a_thousand_colours() -> None:
    assert len(set(choose_colours(1000))) > 950


def test_mix_goes_from_one_colour_to_the_other() -> None:
    # half way from 0 to 255 is 127.5, which rounds to the even 128
    assert [mix("#000000", "#ff8000", share) for share in (0, 0.5, 1)] == [
        "#000000",
        "#804000",
        "#ff8000",
    ]


def test_a_theme_becomes_css_properties_of_the_same_names() -> None:
    found = dict(re.findall(r"--([a-z-]+):(#[0-9a-f]{6});", LIGHT.as_css()))
    assert found == {
        field.name.replace("_", "-"): getattr(LIGHT, field.name) for field in fields(LIGHT)
    }
