"""Pictures of things on a table: what is drawn is what is said of it."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np
import pytest

import seewhy
from seewhy.data.dataset_domain import domain_of
from seewhy.data.making import make_dataset
from seewhy.errors import DatasetError, DomainError

pytest.importorskip("mujoco")

from seewhy_lab.commands.tables_fall import measured_rightly, share_fallen, taken_away
from seewhy_lab.simulators.tabletop.source import draw, random_scene
from seewhy_lab.simulators.tabletop.table import COLOURS, Table
from seewhy_lab.simulators.tabletop.visibility import LEAST_PIXELS, seen_things
from seewhy_lab.simulators.thing_rows import boxes

COUNT = 12
HUES = {
    "red": (1, 0, 0),
    "green": (0, 1, 0),
    "blue": (0, 0, 1),
    "cyan": (0, 1, 1),
    "yellow": (1, 1, 0),
}
"""Which of red, green and blue a colour has much of."""


@pytest.fixture(scope="module")
def drawn() -> list[tuple]:
    return [draw(seed=2, index=index) for index in range(COUNT)]


def rows_of_table(table: Table) -> list[tuple[str, ...]]:
    return sorted((one.size, one.colour, one.material, one.shape) for one in table.things)


def test_what_is_said_is_what_stands_there(drawn: list[tuple]) -> None:
    stacked = 0
    for index, (picture, features, label, things, related) in enumerate(drawn):
        table, view, scene = random_scene(seed=2, index=index)
        assert (picture.shape, features, label) == ((240, 320, 3), {}, None)
        said = [(row["size"], row["colour"], row["material"], row["shape"]) for row in things]
        assert sorted(said) == rows_of_table(table)
        assert [row["thing"] for row in things] == [str(n + 1) for n in range(len(things))]
        middles = [row["left"] + row["right"] for row in things]
        assert middles == sorted(middles)
        assert len(related) == sum(thing.support is not None for thing in table.things)
        stacked += len(related)
        of_boxes = boxes(seen_things(scene, view, size=320), len(things))
        given = [(row["left"], row["top"], row["right"], row["bottom"]) for row in things]
        assert sorted(of_boxes) == sorted(given)
    assert stacked > 3


def test_boxes_hold_what_is_seen_and_no_more() -> None:
    for index in range(COUNT):
        table, view, scene = random_scene(seed=2, index=index)
        seen = seen_things(scene, view, size=320)
        for number, (left, top, right, bottom) in enumerate(boxes(seen, len(table.things))):
            mask = seen == number
            inside = mask[top:bottom, left:right]
            # The pictures in which that was counted are half as wide: a few pixels are rounding.
            assert inside.sum() == mask.sum() >= LEAST_PIXELS * 0.8
            assert all(edge.any() for edge in (inside[0], inside[-1], inside.T[0], inside.T[-1]))


def test_colours_are_those_that_are_said() -> None:
    checked = set()
    for index in range(16):
        table, view, scene = random_scene(seed=2, index=index)
        wanted = [thing.colour in HUES for thing in table.things]
        if not any(wanted):
            continue
        picture = draw(seed=2, index=index)[0].astype(float)
        seen = seen_things(scene, view, size=320)
        for number, thing in enumerate(table.things):
            if thing.colour not in HUES:
                continue
            mean = picture[seen == number].mean(axis=0)
            much = [value for value, has in zip(mean, HUES[thing.colour], strict=True) if has]
            little = [value for value, has in zip(mean, HUES[thing.colour], strict=True) if not has]
            assert min(much) > max(little), (index, thing)
            checked.add(thing.colour)
    assert checked == set(HUES) <= set(COLOURS)


def test_stacks_as_hands_leave_them() -> None:
    for index in range(40):
        table, _, _ = random_scene(seed=2, index=index)
        carrying = [lower for _, lower in table.stands_on()]
        assert len(set(carrying)) == len(carrying)
        for upper, lower in table.stands_on():
            below, above = table.things[lower], table.things[upper]
            assert below.shape != "sphere"
            assert (below.size, above.size) != ("small", "large")
            assert above.z - above.half[1] == pytest.approx(below.top)


def test_the_same_seed_makes_the_same_bytes(drawn: list[tuple]) -> None:
    again = draw(seed=2, index=3)
    assert np.array_equal(again[0], drawn[3][0])
    assert again[1:] == drawn[3][1:]
    assert not np.array_equal(draw(seed=3, index=3)[0], drawn[3][0])
    larger = draw(seed=2, index=3, size=400)
    assert larger[0].shape == (300, 400, 3)
    assert [row["colour"] for row in larger[3]] == [row["colour"] for row in drawn[3][3]]


def test_golden_annotation(drawn: list[tuple]) -> None:
    text = repr([one[3:] for one in drawn[:6]])
    assert hashlib.sha256(text.encode()).hexdigest()[:16] == "7c6f05fc6bf10089"


def test_the_dataset_of_the_command(tmp_path: Path) -> None:
    tabletop = seewhy.load_domain("tabletop")
    made = make_dataset(tabletop, tmp_path / "out", count=3, seed=2, workers=1)
    assert (made.count, made.classes, made.determined) == (3, {}, None)
    dataset = seewhy.Dataset.load(tmp_path / "out", tabletop)
    expected = [draw(seed=2, index=index) for index in range(3)]
    for scene, (_, _, _, things, related) in zip(dataset.scenes, expected, strict=True):
        assert [thing.values["colour"] for thing in scene.things] == [
            row["colour"] for row in things
        ]
        assert [(one.relation, one.thing, one.other) for one in scene.related if one.holds] == (
            related
        )
    before = {path: path.read_bytes() for path in (tmp_path / "out").glob("*.csv")}
    make_dataset(tabletop, tmp_path / "out", count=3, seed=2, workers=1)
    assert before == {path: path.read_bytes() for path in (tmp_path / "out").glob("*.csv")}


def test_a_relation_that_the_domain_does_not_see(tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    folder.mkdir()
    bundled = seewhy.load_domain("tabletop").folder
    for name in ("knowledge.al", "questions.toml"):
        (folder / name).write_text((bundled / name).read_text())
    text = (bundled / "domain.toml").read_text()
    text = text.replace('"tabletop"', '"mine"')
    text = text.replace("seewhy_lab.simulators.tabletop.source", "pictures.py")
    (folder / "domain.toml").write_text(text)
    (folder / "pictures.py").write_text(
        "import numpy as np\n\n\n"
        "def draw(*, seed, index, size):\n"
        "    picture = np.zeros((size, size, 3), np.uint8)\n"
        "    things = [{'thing': 'a', 'shape': 'cube'}, {'thing': 'b', 'shape': 'sphere'}]\n"
        "    return picture, {}, None, things, [('beside', 'a', 'b')]\n"
    )
    with pytest.raises(DomainError) as problem:
        make_dataset(seewhy.load_domain(folder), tmp_path / "out", count=1, size=16, workers=1)
    assert str(problem.value) == (
        f"{folder}/domain.toml: the source 'pictures.py' must give relations among left, right, "
        "in_front, behind, on, under, got 'beside'"
    )


def test_the_domain_of_a_folder_is_found_by_its_things(tmp_path: Path) -> None:
    make_dataset(seewhy.load_domain("tabletop"), tmp_path, count=1, size=64, workers=1)
    assert domain_of(tmp_path).name == "tabletop"
    (tmp_path / "things.csv").unlink()
    with pytest.raises(DatasetError, match="fit none of the bundled domains"):
        domain_of(tmp_path)


def test_where_things_stand_is_measured_as_it_is() -> None:
    """Depth and sides are told by boxes, of stacks by what is at their foot."""
    right, pairs = measured_rightly(tables=30)
    assert pairs > 400
    assert right / pairs >= 0.98


def test_what_is_above_falls_when_that_is_taken_away() -> None:
    right, count = taken_away(tables=8)
    assert count > 20
    assert right == count


@pytest.mark.parametrize(
    ("upper", "lower", "share"),
    [
        (("cube", "small"), ("sphere", "large"), 1.0),
        (("sphere", "small"), ("sphere", "large"), 1.0),
        (("cube", "large"), ("cube", "small"), 0.0),
        (("cylinder", "small"), ("cylinder", "large"), 0.0),
    ],
)
def test_nothing_stays_on_a_ball(
    upper: tuple[str, str], lower: tuple[str, str], share: float
) -> None:
    assert share_fallen(upper, lower, runs=4, rng=np.random.default_rng(1)) == share


def test_pictures_too_small_for_a_thing_are_refused() -> None:
    seen = np.array([[-1, 0], [-1, 0]])
    assert boxes(seen, 1) == [(1, 0, 2, 2)]
    with pytest.raises(ValueError, match=r"make larger pictures \(--size\)"):
        boxes(seen, 2)
