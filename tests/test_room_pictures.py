"""The image source of the rooms: what is asked for is in view, and nothing else."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from seewhy_lab.simulators.robot_assistant import source
from seewhy_lab.simulators.robot_assistant.rendering import Built, render, visible_pixels
from seewhy_lab.simulators.robot_assistant.room import ON_TOP, furnished
from seewhy_lab.simulators.robot_assistant.source import OBJECTS, PEOPLE, draw, photograph
from seewhy_lab.simulators.robot_assistant.view import View, random_decor, random_view

NAMES = (*OBJECTS, *PEOPLE)


def test_a_picture_depends_on_seed_and_index_only() -> None:
    forwards = [draw(seed=3, index=index) for index in range(3)]
    backwards = [draw(seed=3, index=index) for index in (2, 1, 0)][::-1]
    for (one, features, label), (other, same_features, same_label) in zip(
        forwards, backwards, strict=True
    ):
        assert np.array_equal(one, other)
        assert (features, label) == (same_features, same_label)
    assert not np.array_equal(draw(seed=4, index=0)[0], forwards[0][0])


def test_the_order_of_the_names_does_not_matter() -> None:
    pictures = [
        photograph(objects, people, rng=np.random.default_rng(5), size=32)
        for objects, people in (
            (["desk", "cup", "sofa"], ["bob", "sally"]),
            ({"sofa", "desk", "cup"}, {"sally", "bob"}),
        )
    ]
    assert np.array_equal(*pictures)


def test_shape_type_and_features() -> None:
    for size in (32, 96, 112):
        picture, features, label = draw(seed=0, index=1, size=size)
        assert picture.shape == (size, size, 3)
        assert picture.dtype == np.uint8
        assert tuple(features) == NAMES
        assert set(features.values()) == {"yes", "no"}
        assert label == (
            "occupied" if "yes" in [features[person] for person in PEOPLE] else "empty"
        )


def test_a_larger_size_shows_the_same_room() -> None:
    small, features, _ = draw(seed=0, index=4, size=48)
    large, same_features, _ = draw(seed=0, index=4, size=192)
    assert features == same_features
    shrunk = large.reshape(48, 4, 48, 4, 3).mean(axis=(1, 3))
    assert np.abs(shrunk - small).mean() < 6.0
    assert np.abs(shrunk - draw(seed=0, index=5, size=48)[0]).mean() > 15.0


def test_every_thing_can_be_there_and_not_there() -> None:
    found = [draw(seed=1, index=index, size=16)[1] for index in range(30)]
    for name in NAMES:
        assert {features[name] for features in found} == {"yes", "no"}


def shown(
    objects: list[str], people: list[str], seed: int, monkeypatch: pytest.MonkeyPatch
) -> dict[str, int]:
    """How many of the 96 × 96 pixels of a picture show each thing."""
    counts: list[dict[str, int]] = []

    def count(built: Built, view: View, *, size: int) -> np.ndarray:
        counts.append(visible_pixels(built, view, size=96))
        return render(built, view, size=size)

    monkeypatch.setattr(source, "render", count)
    photograph(objects, people, rng=np.random.default_rng(seed), size=16)
    (seen,) = counts
    return seen


@pytest.mark.parametrize("name", NAMES)
def test_a_thing_alone_is_in_view_and_nothing_else(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    objects, people = [n for n in OBJECTS if n == name], [n for n in PEOPLE if n == name]
    seen = shown(objects, people, 7, monkeypatch)
    assert set(seen) == {name}
    assert seen[name] >= 15


@pytest.mark.parametrize("seed", range(6))
def test_everything_asked_for_is_in_view_and_nothing_else(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    present = np.random.default_rng(seed).uniform(size=len(NAMES)) < 0.5
    chosen = {name for name, there in zip(NAMES, present, strict=True) if there}
    seen = shown(
        [n for n in OBJECTS if n in chosen], [n for n in PEOPLE if n in chosen], seed, monkeypatch
    )
    assert set(seen) == chosen
    assert min(seen.values()) >= 15


def test_even_a_full_room_can_be_photographed(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = shown(list(OBJECTS), list(PEOPLE), 0, monkeypatch)
    assert set(seen) == set(NAMES)
    assert min(seen.values()) >= 10


def test_an_empty_room_can_be_photographed() -> None:
    assert photograph([], [], rng=np.random.default_rng(0), size=32).shape == (32, 32, 3)


def test_things_stand_beside_each_other_within_the_walls() -> None:
    for seed in range(8):
        room = furnished(OBJECTS, PEOPLE, np.random.default_rng(seed))
        assert room.names == set(NAMES)
        standing = [placed for placed in room.placed if placed.z == 0.0]
        assert not any(one.overlaps(other) for one, other in combinations(standing, 2))
        for placed in standing:
            wide, deep = placed.reach
            assert abs(placed.x) + wide <= room.width / 2.0 + 1e-9
            assert abs(placed.y) + deep <= room.depth / 2.0 + 1e-9


def test_small_things_stand_on_the_desk_where_there_is_one() -> None:
    room = furnished({"desk", *ON_TOP}, set(), np.random.default_rng(2))
    at = {placed.thing.name: placed for placed in room.placed}
    for name in ON_TOP:
        assert at[name].z == at["desk"].thing.top
    room = furnished({"computer"}, set(), np.random.default_rng(2))
    assert [placed.z > 0.0 for placed in room.placed if placed.thing.name == "computer"] == [True]


def test_views_light_and_looks_differ() -> None:
    rooms = [furnished({"desk"}, {"john"}, np.random.default_rng(i)) for i in range(10)]
    views = [random_view(room, np.random.default_rng(i)) for i, room in enumerate(rooms)]
    decors = [random_decor(room, np.random.default_rng(i)) for i, room in enumerate(rooms)]
    assert len({view.azimuth for view in views}) == 10
    assert len({decor.wall for decor in decors}) == 10
    assert len({decor.floor_kind for decor in decors}) > 1
    assert len({room.placed[0].thing.solids[0].colour for room in rooms}) == 10


@pytest.mark.parametrize(
    ("objects", "people", "message"),
    [
        (["dsk"], [], "there is no object 'dsk': did you mean 'desk'?"),
        (["bob"], [], f"there is no object 'bob': it must be one of: {', '.join(OBJECTS)}"),
        ([], ["sara"], "there is no person 'sara': did you mean 'sarah'?"),
        ([], ["xyz"], "there is no person 'xyz': it must be one of: bob, john, sarah, sally"),
    ],
)
def test_names_that_nobody_has_are_refused(
    objects: list[str], people: list[str], message: str
) -> None:
    with pytest.raises(ValueError) as error:  # noqa: PT011 - the whole text is compared
        photograph(objects, people, rng=np.random.default_rng(0))
    assert str(error.value) == message
