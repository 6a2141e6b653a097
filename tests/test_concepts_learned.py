"""The laboratory's comparison of learners: its recipe of concepts, its columns, its table."""

from __future__ import annotations

import csv
import sys
from importlib.util import find_spec
from itertools import permutations
from pathlib import Path

import numpy as np
import pytest

from seewhy.induction.things.conditions import Alike, HasValue, Pattern, Related, There
from seewhy.induction.things.coverage import where
from seewhy.induction.things.thing_table import as_bits, thing_table
from seewhy_lab.commands import concepts_learned
from seewhy_lab.concepts.learners import columns_of
from seewhy_lab.concepts.recipe import (
    FAMILIES,
    LotScene,
    family_called,
    random_concept,
    random_scene,
)


@pytest.mark.parametrize("name", FAMILIES)
def test_neither_few_nor_most_scenes_fall_under_a_concept(name: str) -> None:
    family = family_called(name)
    rng = np.random.default_rng(0)
    others = [random_scene(family, rng) for _ in range(100)]
    for kind in family.kinds:
        concept = random_concept(family, rng, kind)
        share = sum(map(concept.holds, others)) / len(others)
        assert 0.05 < share < 0.95, concept.text
        assert concept.literals > 0


def test_what_the_recipe_tells_of_scenes_is_what_conditions_say() -> None:
    """The recipe asks its own scenes, and the learner its table: they agree."""
    family = family_called("zendo")
    assert family.domain.things is not None
    rng = np.random.default_rng(1)
    drawn = [random_scene(family, rng) for _ in range(60)]
    vectors = list(map(family.vector, drawn))
    table = thing_table(family.domain.things, family.domain.schema, vectors)
    red, large = HasValue(0, "colour", "red"), HasValue(1, "size", "large")

    def on(scene: LotScene) -> bool:
        return any(
            scene.things[a]["colour"] == "red" and scene.things[b]["size"] == "large"
            for a, b in scene.related["on"]
        )

    def alike(scene: LotScene) -> bool:
        return any(
            scene.things[a]["shape"] == scene.things[b]["shape"]
            and (a, b) in scene.related["in_front"]
            for a, b in permutations(range(len(scene.things)), 2)
        )

    for pattern, holds in (
        (Pattern.of(2, [red, large, Related(0, 1, "on")]), on),
        (Pattern.of(2, [Related(0, 1, "in_front"), Alike(0, 1, "shape")]), alike),
    ):
        expected = as_bits(np.array([holds(scene) for scene in drawn]))
        assert where(table, There(pattern)).tolist() == expected.tolist()


def test_columns_count_and_tell_what_there_is() -> None:
    family = family_called("set")
    assert family.domain.things is not None
    red = {"number": "one", "colour": "red", "shading": "solid", "shape": "oval"}
    scene = LotScene((red, red, {**red, "colour": "green"}), {"left": frozenset({(0, 1)})})
    table = thing_table(family.domain.things, family.domain.schema, [family.vector(scene)])
    (row,) = columns_of(table)
    counted = dict(
        zip((v for values in table.features.values() for v in values), row, strict=False)
    )
    assert (counted["red"], counted["green"], counted["purple"], counted["oval"]) == (2, 1, 0, 3)
    assert set(row[len(counted) :].tolist()) == {0.0, 1.0}


def test_the_command_prints_what_each_learner_comes_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = tmp_path / "rows.csv"
    told = ["--count", "1", "--families", "set", "--learners", "SeeWhy", "--scenes", "60"]
    monkeypatch.setattr(sys, "argv", ["concepts_learned", *told, "--out", str(rows)])
    concepts_learned.main()
    lines = capsys.readouterr().out.splitlines()
    assert lines[:2] == ["| scenes | noise | SeeWhy |", "|---|---|---|"]
    assert [line.split("|")[2].strip() for line in lines[2:]] == ["0 %", "5 %", "10 %"]
    with rows.open(encoding="utf-8") as stream:
        found = list(csv.DictReader(stream))
    assert len(found) == 3
    assert lines[2].startswith("| set | 0 % | 100.0 %, 1 of 1, ")
    assert [row["accuracy"] for row in found if row["noise"] == "0.0"] == ["1.0"]


@pytest.mark.skipif(find_spec("foldrpp") is not None, reason="FOLD-R++ is installed")
def test_a_learner_that_is_not_there_is_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["concepts_learned"])
    with pytest.raises(SystemExit) as exit_:
        concepts_learned.main()
    assert exit_.value.code == 2
    assert "leave it out: --learners SeeWhy tree" in capsys.readouterr().err
