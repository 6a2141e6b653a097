"""Where features are seen: maps of what matters, in Python, in pictures of answers, in JSON."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from conftest import RGB, Run, draw_tile
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError, NotFittedError, PictureError
from seewhy.perception.extractor import Seen
from seewhy.perception.where import ACROSS, MATTERS, Where, filled_in, find_where
from seewhy.report.card import draw_card, rests_on

SIDE = 32


class Quadrant:
    """Sees whether the mean of one quadrant is bright, and how many pictures it was shown."""

    size = SIDE
    values = {"light": ("off", "on"), "none": ("a", "b")}  # noqa: RUF012

    def __init__(self, down: int, right: int, *, steep: float = 12.0) -> None:
        half = SIDE // 2
        self.part = (slice(down * half, (down + 1) * half), slice(right * half, (right + 1) * half))
        self.steep = steep
        self.batches: list[int] = []

    def see(self, pictures: np.ndarray) -> Seen:
        self.batches.append(len(pictures))
        mean = pictures[:, *self.part].mean(axis=(1, 2, 3)) / 255
        on = 1 / (1 + np.exp(-self.steep * (mean - 0.3)))
        same = np.full(len(pictures), 0.7)
        return Seen(
            {"light": np.stack([1 - on, on], axis=1), "none": np.stack([same, 1 - same], axis=1)},
            {},
        )


def four_lights() -> np.ndarray:
    """A bright square in the middle of each quadrant."""
    picture = np.full((SIDE, SIDE, 3), 20, dtype=np.uint8)
    for down in (2, 18):
        for right in (2, 18):
            picture[down : down + 12, right : right + 12] = 230
    return picture


@pytest.mark.parametrize("down", [0, 1])
@pytest.mark.parametrize("right", [0, 1])
def test_the_quadrant_that_decides_is_marked(down: int, right: int) -> None:
    seeing = Quadrant(down, right)
    found = find_where(seeing, four_lights(), {"light": "on"})["light"]
    assert found.matters
    assert found.map.shape == (SIDE, SIDE)
    assert (found.map.min(), found.map.max()) == (0.0, 1.0)
    assert found.map[seeing.part].sum() > 0.9 * found.map.sum()
    best = np.unravel_index(found.map.argmax(), found.map.shape)
    assert (best[0] // 16, best[1] // 16) == (down, right)
    # What speaks for a value does not speak for its opposite.
    assert find_where(seeing, four_lights(), {"light": "off"})["light"].map[best] == 0.0


def filled_by_hand(picture: np.ndarray, hidden: np.ndarray) -> np.ndarray:
    """Pixel by pixel: the mean of all that is not hidden, as a Gaussian weighs it."""
    out = picture.astype(float)
    rows, columns = np.nonzero(~hidden)
    for y, x in zip(*np.nonzero(hidden), strict=True):
        scale = len(picture) / 12
        down = np.exp(-0.5 * ((rows - y) / scale) ** 2) + 1e-4
        right = np.exp(-0.5 * ((columns - x) / scale) ** 2) + 1e-4
        out[y, x] = np.average(picture[rows, columns], axis=0, weights=down * right)
    return out


def test_what_is_lost_is_what_hiding_windows_one_by_one_takes() -> None:
    rng = np.random.default_rng(0)
    picture = four_lights() // 2 + rng.integers(0, 100, (SIDE, SIDE, 3)).astype(np.uint8)
    seeing = Quadrant(0, 0)
    found = find_where(seeing, picture, {"light": "on"})["light"]
    assert seeing.batches == [1 + ACROSS**2]
    before = seeing.see(picture[None]).probabilities["light"][0, 1]
    assert found.probability == pytest.approx(before)
    step, losses = SIDE // (ACROSS + 1), {}
    for top in range(0, SIDE - step, step):
        for left in range(0, SIDE - step, step):
            hidden = np.zeros((SIDE, SIDE), dtype=bool)
            hidden[top : top + 2 * step, left : left + 2 * step] = True
            copy = filled_by_hand(picture, hidden).round().astype(np.uint8)
            after = seeing.see(copy[None]).probabilities["light"][0, 1]
            losses[top + step, left + step] = before - after
    assert len(losses) == ACROSS**2
    assert found.lost == pytest.approx(max(losses.values()), abs=2e-3)
    # In the middle of a window the map is nearly that window's loss alone.
    for (y, x), loss in losses.items():
        middle = found.map[y - 1 : y + 1, x - 1 : x + 1].mean() * found.lost
        others = [other for (v, w), other in losses.items() if max(abs(v - y), abs(w - x)) <= step]
        low, high = min(*others, 0.0), max(*others, 0.0)
        assert low - 5e-3 <= middle <= high * 1.25 + 5e-3
        if loss == max(losses.values()):
            assert middle > 0.7 * loss


def test_where_nothing_matters_it_is_said() -> None:
    found = find_where(Quadrant(0, 0), four_lights(), {"none": "a"})["none"]
    assert (found.lost, found.matters, found.map.max()) == (0.0, False, 0.0)
    assert found.to_text() == "no single place matters: hiding one takes at most 0.00 of p = 0.70"
    faint = find_where(Quadrant(0, 0, steep=0.02), four_lights(), {"light": "on"})["light"]
    assert 0.0 < faint.lost < MATTERS
    assert faint.map.max() == 0.0


def test_all_features_share_the_hidden_copies() -> None:
    seeing = Quadrant(0, 1)
    both = find_where(seeing, four_lights(), {"none": "b", "light": "on"})
    assert list(both) == ["none", "light"]
    assert seeing.batches == [1 + ACROSS**2]
    alone = find_where(seeing, four_lights(), {"light": "on"})["light"]
    np.testing.assert_array_equal(alone.map, both["light"].map)


def test_a_place_is_filled_with_its_surroundings() -> None:
    picture = np.full((16, 16, 3), 90, dtype=np.uint8)
    picture[:, 8:] = (10, 200, 30)
    masks = np.zeros((3, 16, 16), dtype=np.float32)
    masks[0, 4:8, 1:4] = 1
    masks[1, 4:8, 13:] = 1
    masks[2] = 1  # where nothing is left, nothing is known of the surroundings
    found = filled_in(picture, masks)
    assert found.dtype == np.uint8
    np.testing.assert_array_equal(found[:, 9:, :4][:2], np.full((2, 7, 4, 3), 90))
    np.testing.assert_allclose(found[0][4:8, 1:4].reshape(-1, 3), 90, atol=8)
    np.testing.assert_allclose(
        found[1][4:8, 13:].reshape(-1, 3), np.full((12, 3), (10, 200, 30)), atol=8
    )
    assert found.shape == (3, 16, 16, 3)


@pytest.mark.parametrize(
    ("picture", "values", "error"),
    [
        (
            np.zeros((16, 16, 3), dtype=np.uint8),
            {"light": "on"},
            "the picture must be uint8 of shape (32, 32, 3), got uint8 of shape (16, 16, 3): "
            "make it with as_picture",
        ),
        (
            np.zeros((32, 32, 3)),
            {"light": "on"},
            "the picture must be uint8 of shape (32, 32, 3), got float64 of shape (32, 32, 3): "
            "make it with as_picture",
        ),
        (four_lights(), {"lihgt": "on"}, "nothing sees 'lihgt'; did you mean 'light'?"),
        (four_lights(), {"light": "x"}, "'x' is no value of 'light'; it must be one of: off, on"),
    ],
)
def test_what_cannot_be_seen_is_said(
    picture: np.ndarray, values: dict[str, str], error: str
) -> None:
    with pytest.raises(DatasetError, match=f"^{re.escape(error)}$"):
        find_where(Quadrant(0, 0), picture, values)


def test_a_map_as_json() -> None:
    places = np.zeros((4, 4), dtype=np.float32)
    places[0, 1], places[3, 3] = 1.0, 0.12345
    assert Where("lean", "yes", 0.98765, 0.55555, places).to_dict() == {
        "feature": "lean",
        "value": "yes",
        "probability": 0.9877,
        "lost": 0.5555,
        "matters": True,
        "map": [[0.0, 1.0, 0.0, 0.0], [0.0] * 4, [0.0] * 4, [0.0, 0.0, 0.0, 0.123]],
    }
    large = np.zeros((112, 112), dtype=np.float32)
    large[:56] = 1
    told = Where("lean", "yes", 1.0, 1.0, large).to_dict()["map"]
    assert [sum(row) for row in told] == [32.0] * 16 + [0.0] * 16


def test_an_overlay_shows_the_marked_place_and_pales_the_rest() -> None:
    picture = np.full((16, 16, 3), (30, 160, 60), dtype=np.uint8)
    places = np.zeros((16, 16), dtype=np.float32)
    places[4:12, 4:12] = 1
    shown = np.asarray(Where("lean", "yes", 1.0, 1.0, places).picture(picture, side=64))
    assert shown.shape == (64, 64, 3)
    assert shown[32, 32].tolist() == [30, 160, 60]
    corner = shown[2, 2].tolist()
    assert corner[0] == corner[1] == corner[2] > 190
    red = (shown == (214, 39, 40)).all(axis=2)
    assert red.any()
    assert not red[22:42, 22:42].any()
    assert not red[:12].any()
    nothing = Where("lean", "yes", 1.0, 0.0, np.zeros_like(places)).picture(picture)
    assert len(np.unique(np.asarray(nothing))) == 1
    with pytest.raises(PictureError, match=r"no\.png does not exist"):
        Where("lean", "yes", 1.0, 1.0, places).picture(Path("no.png"))


# Agents -------------------------------------------------------------------------------------


@pytest.fixture
def tile() -> Image.Image:
    return draw_tile("red", "yes", 0)


def test_the_corners_of_a_tile_are_seen_where_the_tile_is(agent: Agent, dataset: Dataset) -> None:
    cornered = [scene for scene in dataset.of_split("test").scenes if scene.vector[1] == "no"]
    assert len(cornered) > 5
    for scene in cornered:
        found = agent.where(scene.picture)
        assert list(found) == ["colour", "round"]
        roundness = found["round"]
        assert (roundness.value, roundness.matters, roundness.map.shape) == ("no", True, (16, 16))
        pixels = np.asarray(Image.open(scene.picture).convert("RGB").resize((16, 16)), dtype=int)
        painted = np.abs(pixels - RGB[scene.vector[0] or ""]).sum(axis=2) < 150
        # More of the map than a map of noise would have there.
        assert roundness.map[painted].sum() / roundness.map.sum() > painted.mean() + 0.02


def test_where_follows_what_the_answer_takes_the_picture_to_be(
    agent: Agent, dataset: Dataset
) -> None:
    picture = dataset.scenes[0].picture
    scene = agent.classify(picture)
    assert {name: found.to_dict() for name, found in agent.where(picture).items()} == {
        name: found.to_dict() for name, found in agent.where(picture, scene=scene).items()
    }


def test_an_agent_that_is_not_trained_looks_at_nothing(tiles: Domain, tile: Image.Image) -> None:
    agent = Agent(tiles)
    for look in (agent.where, agent.nearest):
        with pytest.raises(NotFittedError, match=r"^the agent is not trained yet; call fit, or"):
            look(tile)


def test_networks_that_grew_name_no_pictures(
    agent: Agent, tile: Image.Image, run: Run, model_folder: Path, tmp_path: Path
) -> None:
    assert agent.nearest(tile) == ()
    path = tmp_path / "tile.png"
    tile.save(path)
    said = run("ask", model_folder, path, "is it round?", "--nearest").out
    assert said.endswith("\nmost like it in training: not kept\n")
    assert '"nearest": []' in run("ask", model_folder, path, "is it round?", "--json").out


# Pictures of answers ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("question", "features"),
    [
        ("why is it bad?", {"colour", "round"}),
        ("is it round?", {"round"}),
        ("what colour is it?", {"colour"}),
    ],
)
def test_an_answer_rests_on_what_it_names_or_needs(
    agent: Agent, dataset: Dataset, question: str, features: set[str]
) -> None:
    blue = next(scene for scene in dataset.scenes if scene.vector == ("blue", "no"))
    reply = agent.ask(blue.picture, question)
    assert rests_on(reply) == features
    card = draw_card(reply, blue.picture, where=agent.where(blue.picture, scene=reply.scene))
    root = ElementTree.fromstring(card.svg)
    svg = "{http://www.w3.org/2000/svg}"
    images = list(root.iter(f"{svg}image"))
    assert len(images) == 1 + len(features)
    words = [" ".join(text.itertext()) for text in root.iter(f"{svg}text")]
    for name in ("colour", "round"):
        title = f"{name}: {reply.features[name].value}"
        assert (title in words) == (name in features)
    told = [text for text in words if "hiding" in text]
    assert len(told) == len(features)
    # Nothing of the card lies below its edge, and the panels are above the reasons.
    assert all(
        float(element.get("y", "0")) + float(element.get("height", "0")) <= card.height
        for element in [*images, *root.iter(f"{svg}rect")]
        if "%" not in element.get("height", "")
    )
    lowest = max(float(span.get("y", "0")) for span in root.iter(f"{svg}tspan"))
    assert lowest <= card.height


def test_many_panels_stand_in_rows(agent: Agent, dataset: Dataset) -> None:
    blue = next(scene for scene in dataset.scenes if scene.vector == ("blue", "no"))
    reply = agent.ask(blue.picture, "why is it bad?")
    where = agent.where(blue.picture, scene=reply.scene)
    places = [
        [
            (element.get("x"), element.get("y"))
            for element in ElementTree.fromstring(card.svg).iter()
            if element.tag.endswith("image")
        ][1:]
        for card in (
            draw_card(reply, blue.picture, where=where, width=width) for width in (760, 300)
        )
    ]
    assert places[0][0][1] == places[0][1][1]
    assert places[1][0][0] == places[1][1][0]


def test_a_card_without_maps_is_as_it_was(agent: Agent, dataset: Dataset) -> None:
    picture = dataset.scenes[0].picture
    reply = agent.ask(picture, "is it round?")
    assert draw_card(reply, picture).svg.count("<image") == 1
    assert "hiding" not in draw_card(reply, picture).svg


def test_the_program_draws_where(
    run: Run, model_folder: Path, dataset: Dataset, tmp_path: Path
) -> None:
    picture, svg = dataset.scenes[0].picture, tmp_path / "why.svg"
    assert run("ask", model_folder, picture, "is it round?", "--picture", svg).code == 0
    assert svg.read_text().count("<image") == 2
