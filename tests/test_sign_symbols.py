"""The symbols of drawn traffic signs: what every one must be, and what tells them apart."""

from __future__ import annotations

import csv
import itertools
import tomllib
from importlib.resources import files

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from seewhy.domain.folder import domain_folder
from seewhy.errors import DomainError
from seewhy_lab.simulators.traffic_signs.outlines import arc, flatten, stroke, turned
from seewhy_lab.simulators.traffic_signs.symbols import ROLES, Fill, looks, symbol, symbol_names

FOLDER = files("seewhy_lab.simulators.traffic_signs")
CLASSES = domain_folder("traffic_signs") / "classes.csv"
ROWS = list(csv.DictReader(CLASSES.read_text(encoding="utf-8").splitlines()))
DATA = tomllib.loads((FOLDER / "symbols.toml").read_text(encoding="utf-8"))
SHOWN = sorted(
    {(row[key], row["class"]) for row in ROWS for key in ("primary_symbol", "secondary_symbol")}
)
SIZE = 48


def windings(fill: Fill) -> NDArray[np.int64]:
    """How often the outline runs around each pixel, shape (SIZE, SIZE)."""
    points = np.asarray(fill.points)
    across = (np.arange(SIZE) + 0.5) / SIZE + 1e-7
    count = np.zeros((SIZE, SIZE), np.int64)
    for (x0, y0), (x1, y1) in zip(points, np.roll(points, -1, axis=0), strict=True):
        rows = np.flatnonzero((across > min(y0, y1)) & (across <= max(y0, y1)))
        if len(rows):
            crossing = x0 + (across[rows] - y0) / (y1 - y0) * (x1 - x0)
            count[rows] += np.sign(y1 - y0).astype(np.int64) * (across[None] > crossing[:, None])
    return count


def painted(name: str, variant: str = "", *, seed: int = 0) -> NDArray[np.int64]:
    """The number of the role on each pixel, 0 where nothing is painted."""
    picture = np.zeros((SIZE, SIZE), np.int64)
    for fill in symbol(name, rng=np.random.default_rng(seed), variant=variant):
        number = 0 if fill.role == "paper" else 1 + ROLES.index(fill.role)
        picture[windings(fill) != 0] = number
    return picture


@pytest.mark.parametrize(("name", "variant"), SHOWN)
@pytest.mark.parametrize("seed", range(4))
def test_every_symbol_of_the_table_fills_the_unit_square(
    name: str, variant: str, seed: int
) -> None:
    fills = symbol(name, rng=np.random.default_rng(seed), variant=variant)
    assert bool(fills) == (name not in ("blank", "none"))
    assert {fill.role for fill in fills} <= set(ROLES)
    if fills:
        points = np.vstack([fill.points for fill in fills])
        low, high = points.min(axis=0), points.max(axis=0)
        assert -1e-4 <= low.min() < high.max() <= 1 + 1e-4
        if name not in ("numbers", "one_and_fifteen", "sixteen_and_thirtyone"):
            assert (high - low).max() > 0.9
        assert np.abs(low + high - 1.0).max() < 0.2


@pytest.mark.parametrize(("name", "variant"), SHOWN)
def test_no_area_has_a_hole_or_runs_around_a_place_twice(name: str, variant: str) -> None:
    for seed in range(6):
        for fill in symbol(name, rng=np.random.default_rng(seed), variant=variant):
            twice = np.abs(windings(fill)) > 1
            assert twice.sum() <= 1, (fill.role, np.argwhere(twice) / SIZE)


def test_symbols_that_tell_classes_apart_look_different() -> None:
    groups: dict[tuple[str, ...], set[str]] = {}
    rest = ("shape", "main_color", "border_color", "background_image", "cross")
    for row in ROWS:
        groups.setdefault(tuple(row[key] for key in rest), set()).add(row["class"])
    pictures = {
        row["class"]: [
            painted(row[key], row["class"]) for key in ("primary_symbol", "secondary_symbol")
        ]
        for row in ROWS
    }
    for group in groups.values():
        for one, other in itertools.combinations(sorted(group), 2):
            differing = sum(
                int((a != b).sum()) for a, b in zip(pictures[one], pictures[other], strict=True)
            )
            assert differing > 0.03 * SIZE**2, (one, other)


@pytest.mark.parametrize(
    ("name", "one", "other"),
    [
        ("left_turn", "bend_left", "no_left_turn"),
        ("right_turn", "bend_right", "no_right_turn"),
        ("cyclist", "cyclists_ahead", "no_bicycles"),
        ("people", "children_ahead", "shared_path"),
        ("oncoming_traffic", "give_way_to_oncoming", "priority_over_oncoming"),
        ("cross", "priority_from_right", "no_stopping"),
        ("fence", "level_crossing", "parking_on_pavement"),
        ("arrow", "straight_ahead", "one_way_street"),
    ],
)
def test_a_symbol_is_drawn_as_on_the_sign_of_the_class(name: str, one: str, other: str) -> None:
    assert set(looks(name, variant=one)).isdisjoint(looks(name, variant=other))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("left_turn", "right_turn"),
        ("left_then_right", "right_then_left"),
        ("narrow_on_left", "narrow_on_right"),
    ],
)
def test_left_and_right_are_mirror_images(one: str, other: str) -> None:
    for seed in range(6):
        differing = painted(one, seed=seed)[:, ::-1] != painted(other, seed=seed)
        assert differing.mean() < 0.01


def test_the_arrows_of_a_roundabout_follow_each_other() -> None:
    fills = symbol("yield", rng=np.random.default_rng(5))
    third = len(fills) // 3
    centre = np.array([0.5, 0.5])
    for fill, following in itertools.pairwise([fills[0], fills[third], fills[2 * third], fills[0]]):
        low = np.asarray(fill.points) - centre
        next_one = np.asarray(following.points) - centre
        middle, after = low.mean(axis=0), next_one.mean(axis=0)
        # A third of a turn, whatever the width of the whole was stretched to.
        cosine = middle @ after / np.linalg.norm(middle) / np.linalg.norm(after)
        assert abs(cosine + 0.5) < 0.12


def test_colours_that_belong_to_the_symbol_are_said() -> None:
    def roles(name: str, variant: str) -> set[str]:
        fills = symbol(name, rng=np.random.default_rng(0), variant=variant)
        return {fill.role for fill in fills}

    assert roles("oncoming_traffic", "give_way_to_oncoming") == {"black", "red"}
    assert roles("oncoming_traffic", "priority_over_oncoming") == {"red", "white"}
    assert roles("cross", "no_stopping") == {"red"}
    assert roles("cross", "priority_from_right") == {"ink"}
    assert roles("no_passing", "no_overtaking") == {"red", "black"}
    assert roles("barrier", "dead_end") == {"ink", "red"}


def test_numbers_and_directions_vary_and_depend_on_the_generator_only() -> None:
    for name, least in (("speed_limit", 5), ("weight_limit", 5), ("height_limit", 5)):
        written = {values for _, values in looks(name)}
        assert len(written) >= least
        drawn = {symbol(name, rng=np.random.default_rng(seed)) for seed in range(60)}
        assert len(drawn) > 10
    assert len({drawing for drawing, _ in looks("side_arrow")}) == 4
    again = [symbol("truck", rng=np.random.default_rng(7)) for _ in range(2)]
    assert again[0] == again[1]


@given(name=st.sampled_from(symbol_names()), seed=st.integers(0, 2**32 - 1))
def test_every_symbol_takes_as_much_from_the_generator(name: str, seed: int) -> None:
    rng, other = np.random.default_rng(seed), np.random.default_rng(seed)
    symbol(name, rng=rng)
    other.integers(2**31)
    assert rng.integers(2**62) == other.integers(2**62)


def test_an_unknown_symbol_is_refused_with_those_there_are() -> None:
    with pytest.raises(DomainError, match=r"no traffic sign symbol 'unicorn'.*symbols\.toml.*cow"):
        symbol("unicorn", rng=np.random.default_rng(0))


def test_the_drawings_are_all_used_and_all_there() -> None:
    parts = {name: entry["parts"] for name, entry in DATA["drawing"].items()}
    named = {
        name
        for by_class in DATA["symbol"].values()
        for group in by_class.values()
        for name in group
    }
    named |= {part["use"] for group in parts.values() for part in group if "use" in part}
    assert named == set(parts)
    classes = {row["class"] for row in ROWS} | {"usual"}
    assert {key for by_class in DATA["symbol"].values() for key in by_class} <= classes
    assert {name for name, _ in SHOWN} == set(symbol_names())


def test_the_notation_of_paths() -> None:
    ((curve, closed),) = flatten("M0 0 Q2 0 2 2", steps=2)
    assert curve.tolist() == [[0.0, 0.0], [1.5, 0.5], [2.0, 2.0]]
    assert not closed
    ((cubic, _),) = flatten("M0 0 C0 3 3 3 3 0", steps=2)
    assert cubic.tolist() == [[0.0, 0.0], [1.5, 2.25], [3.0, 0.0]]
    assert [len(line) for line, _ in flatten("M0 0 1 1 2 2 M-1 .5 L3,4 Z")] == [3, 2]
    for wrong in ("", "L0 0", "M0 0 H3", "M0 0 L3"):
        with pytest.raises(ValueError, match="the path"):
            flatten(wrong)


@given(
    length=st.floats(0.5, 9.0),
    width=st.floats(0.1, 0.4),
    degrees=st.floats(-180.0, 180.0),
)
def test_a_stroke_is_as_wide_as_its_pen(length: float, width: float, degrees: float) -> None:
    line = turned(np.array([[0.0, 0.0], [length, 0.0]]), degrees, centre=np.array([1.0, 2.0]))
    (outline,) = stroke(line, width=width)
    x, y = outline.T
    area = abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0
    assert area == pytest.approx(length * width)


def test_a_ring_leaves_its_middle_free() -> None:
    halves = stroke(arc((0.5, 0.5), 0.4)[:-1], width=0.1, closed=True)
    covered = np.zeros((SIZE, SIZE), bool)
    for half in halves:
        covered |= windings(Fill(tuple((float(x), float(y)) for x, y in half), "ink")) != 0
    at = (np.arange(SIZE) + 0.5) / SIZE - 0.5
    distance = np.hypot(at[None], at[:, None])
    assert not covered[distance < 0.33].any()
    assert covered[(distance > 0.37) & (distance < 0.43)].all()
