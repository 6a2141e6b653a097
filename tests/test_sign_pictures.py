"""Drawn signs: what their features say is what they show, and the same numbers draw the same."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from numpy.typing import NDArray

from seewhy.domain.domain import load_domain
from seewhy_lab.simulators.traffic_signs.non_signs import draw_non_sign
from seewhy_lab.simulators.traffic_signs.sign import Face, face, paint
from seewhy_lab.simulators.traffic_signs.source import draw, signs

STOP = {
    "shape": "octagon",
    "main_color": "red",
    "border_color": "white",
    "background_image": "none",
    "primary_symbol": "stop",
    "secondary_symbol": "none",
    "cross": "none",
}


def drawn(**changes: str) -> Face:
    return face({**STOP, **changes}, rng=np.random.default_rng(0))


def corners(sign: Face) -> NDArray[np.float64]:
    return np.ptp(sign.outline, axis=0)


def test_a_picture_depends_on_its_numbers_only() -> None:
    first, *rest = draw(seed=3, index=17, size=64)
    draw(seed=3, index=4, size=64)
    again, *others = draw(seed=3, index=17, size=64)
    assert np.array_equal(first, again)
    assert rest == others
    assert not np.array_equal(first, draw(seed=4, index=17, size=64)[0])


def test_sixty_two_pictures_show_every_class_once_with_the_features_of_the_table() -> None:
    table = signs()
    shown = [draw(seed=1, index=index, size=24) for index in range(62, 124)]
    assert Counter(label for *_, label in shown) == dict.fromkeys(table, 1)
    assert all(features == table[label] for _, features, label in shown)


def test_the_table_and_the_domain_speak_of_the_same_classes_and_values() -> None:
    domain = load_domain("traffic_signs")
    assert list(signs()) == list(domain.classes)
    for features in signs().values():
        assert features.keys() == domain.features.keys()
        assert all(features[key] in feature.values for key, feature in domain.features.items())


def test_pictures_are_cut_out_close_around_the_sign() -> None:
    for index in range(40):
        picture, features, _ = draw(seed=0, index=index, size=48)
        assert picture.dtype == np.uint8
        assert max(picture.shape[:2]) == 48
        if features["shape"] == "wide_rectangle":
            assert picture.shape[0] < 48 or picture.shape[1] == 48


@pytest.mark.parametrize(
    ("shape", "ratio"), [("tall_rectangle", 1 / 1.5), ("wide_rectangle", 1.5), ("square", 1.0)]
)
def test_plates_have_the_proportions_of_their_shape(shape: str, ratio: float) -> None:
    width, height = corners(drawn(shape=shape))
    assert width / height == pytest.approx(ratio, rel=0.04)


def test_the_ground_has_the_main_colour_and_the_rim_that_of_the_border() -> None:
    for main, border in (("white", "red"), ("blue", "red"), ("blue", "white")):
        plain = drawn(shape="circle", main_color=main, border_color=border, primary_symbol="blank")
        nearest = [
            min(
                ("white", "red", "blue"),
                key=lambda name: np.abs(np.subtract(paint(name, still()), patch.color)).sum(),
            )
            for patch in plain.patches
        ]
        assert nearest[-1] == main
        assert border in nearest[:-1]


def still() -> np.random.Generator:
    return np.random.default_rng(5)


def test_every_symbol_and_every_cross_adds_to_the_face() -> None:
    bare = len(drawn(primary_symbol="blank").patches)
    assert len(drawn().patches) > bare
    assert len(drawn(primary_symbol="blank", cross="black").patches) == bare + 1
    with_car = drawn(shape="tall_rectangle", primary_symbol="p", secondary_symbol="car")
    assert len(with_car.patches) > len(drawn(shape="tall_rectangle", primary_symbol="p").patches)


def test_symbols_stay_on_the_plate() -> None:
    for label, features in signs().items():
        shown = face(features, rng=np.random.default_rng(2), variant=label)
        low, high = shown.outline.min(axis=0), shown.outline.max(axis=0)
        for patch in shown.patches:
            assert (patch.points >= low - 0.03).all(), label
            assert (patch.points <= high + 0.03).all(), label


def test_pictures_without_a_known_sign_differ_and_repeat() -> None:
    first = [draw_non_sign(seed=0, index=index, size=32) for index in range(30)]
    again = [draw_non_sign(seed=0, index=index, size=32) for index in range(30)]
    assert all(np.array_equal(a, b) for a, b in zip(first, again, strict=True))
    assert len({picture.tobytes() for picture in first}) == 30
    assert all(max(picture.shape[:2]) == 32 for picture in first)
