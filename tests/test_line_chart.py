"""Charts of lines with bands."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import pytest

from seewhy.report.line_chart import Line, Point, draw_lines


def line(name: str, *values: float) -> Line:
    labels = ("100", "200", "all")
    points = (
        Point(label, value, value - 0.02, value + 0.02)
        for label, value in zip(labels, values, strict=False)
    )
    return Line(name, tuple(points))


def test_a_chart_is_a_whole_picture() -> None:
    lines = [line("SeeWhy", 0.81, 0.9, 0.93), line("<end> to & end", 0.7, 0.88)]
    figure = draw_lines(lines, ["100", "200", "all"], across="pictures", up="right")
    root = ElementTree.fromstring(figure.svg)
    namespace = "{http://www.w3.org/2000/svg}"
    assert len(root.findall(f"{namespace}polyline")) == 2
    assert len(root.findall(f"{namespace}polygon")) == 2
    circles = root.findall(f"{namespace}circle")
    assert len(circles) == 5
    assert circles[0][0].text == "SeeWhy, 100: 81.0 % (79.0 to 83.0 %)"
    texts = ["".join(text.itertext()) for text in root.iter(f"{namespace}text")]
    for said in ("100", "200", "all", "pictures", "right", "SeeWhy", "<end> to & end"):
        assert said in texts
    # Higher values are nearer to the top, and all lie on the picture.
    heights = [float(circle.get("cy") or 0) for circle in circles]
    assert heights[0] > heights[1] > heights[2]
    assert all(0 < height < figure.height for height in heights)


def test_a_line_that_covers_another_lets_it_be_seen() -> None:
    lines = [line("one", 0.5, 0.6), line("two", 0.5, 0.7), line("three", 0.5, 0.6)]
    figure = draw_lines(lines, ["100", "200"], across="", up="right")
    drawn = ElementTree.fromstring(figure.svg).findall("{http://www.w3.org/2000/svg}polyline")
    assert [curve.get("stroke-dasharray") for curve in drawn] == [None, None, "8 8"]


def test_a_long_name_of_an_axis_takes_two_lines() -> None:
    """It would reach beyond the axis otherwise, and over its numbers."""
    up = "explanatory answers, every relevant attribute"
    figure = draw_lines([line("one", 0.5)], ["100"], across="", up=up)
    ((first, second),) = [
        list(text)
        for text in ElementTree.fromstring(figure.svg).iter("{http://www.w3.org/2000/svg}text")
        if len(text)
    ]
    assert f"{first.text} {second.text}" == up


@pytest.mark.parametrize(
    ("values", "ticks"),
    [
        ((0.81, 0.9, 0.93), ["75 %", "80 %", "85 %", "90 %", "95 %"]),
        ((0.5, 0.5, 0.5), ["48 %", "49 %", "50 %", "51 %", "52 %"]),
        ((0.02, 0.5, 0.98), ["0 %", "20 %", "40 %", "60 %", "80 %", "100 %"]),
    ],
)
def test_ticks_are_round(values: tuple[float, ...], ticks: list[str]) -> None:
    figure = draw_lines([line("one", *values)], ["100", "200", "all"], across="", up="")
    assert re.findall(r">(\d+ %)</text>", figure.svg) == ticks


def test_a_chart_of_nothing() -> None:
    assert ElementTree.fromstring(draw_lines([], [], across="", up="").svg) is not None
