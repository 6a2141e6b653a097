"""Relations that are measured from boxes: what holds of them whatever the boxes are."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from seewhy.data.measured import MEASURES, STANDING, feet
from seewhy.data.thing import BoundingBox

CORNERS = st.integers(0, 40)
BOXES = st.builds(
    lambda left, top, width, height: BoundingBox(left, top, left + width, top + height),
    CORNERS,
    CORNERS,
    st.integers(1, 20),
    st.integers(1, 20),
)
ONE_WAY = sorted(set(MEASURES) - {"touching"})


@pytest.mark.parametrize("name", ONE_WAY)
@given(first=BOXES, second=BOXES)
def test_what_holds_one_way_does_not_hold_the_other(
    name: str, first: BoundingBox, second: BoundingBox
) -> None:
    assert not (MEASURES[name](first, second) and MEASURES[name](second, first))
    assert not MEASURES[name](first, first)


@pytest.mark.parametrize("name", ONE_WAY)
@given(first=BOXES, second=BOXES, third=BOXES)
def test_what_holds_of_neighbours_holds_along_the_row(
    name: str, first: BoundingBox, second: BoundingBox, third: BoundingBox
) -> None:
    measure = MEASURES[name]
    if measure(first, second) and measure(second, third):
        assert measure(first, third)


@given(first=BOXES, second=BOXES)
def test_touching_holds_both_ways_and_of_what_lies_inside(
    first: BoundingBox, second: BoundingBox
) -> None:
    touching = MEASURES["touching"]
    assert touching(first, second) == touching(second, first)
    assert touching(first, first)
    if MEASURES["inside"](first, second):
        assert touching(first, second)


@given(first=BOXES, second=BOXES)
def test_converses(first: BoundingBox, second: BoundingBox) -> None:
    for one, other in (
        ("left", "right"),
        ("above", "below"),
        ("nearer", "behind"),
        ("in_front", "behind"),
    ):
        assert MEASURES[one](first, second) == MEASURES[other](second, first)


@given(first=BOXES, second=BOXES, across=st.integers(-30, 30), down=st.integers(-30, 30))
def test_only_where_they_are_to_each_other_counts(
    first: BoundingBox, second: BoundingBox, across: int, down: int
) -> None:
    moved = [
        BoundingBox(box.left + across, box.top + down, box.right + across, box.bottom + down)
        for box in (first, second)
    ]
    assert {name: measure(*moved) for name, measure in MEASURES.items()} == {
        name: measure(first, second) for name, measure in MEASURES.items()
    }


def test_each_by_an_example() -> None:
    small, large = BoundingBox(10, 10, 20, 20), BoundingBox(30, 30, 60, 90)
    assert {name for name, measure in MEASURES.items() if measure(small, large)} == {
        "left",
        "above",
        "behind",
    }
    assert {name for name, measure in MEASURES.items() if measure(large, small)} == {
        "right",
        "below",
        "nearer",
        "in_front",
        "larger",
    }


def test_the_foot_of_a_stack() -> None:
    stands_on = [("a", "b"), ("b", "c"), ("e", "d")]
    assert feet("abcde", stands_on) == {"a": "c", "b": "c", "c": "c", "d": "d", "e": "d"}
    assert set(MEASURES) > STANDING


def test_what_would_stand_on_itself_is_at_its_own_foot() -> None:
    assert feet("ab", [("a", "b"), ("b", "a")]) == {"a": "a", "b": "b"}
    assert feet("a", [("a", "a")]) == {"a": "a"}
