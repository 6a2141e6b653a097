"""What is worth a label, and what follows from one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from seewhy.domain.domain import load_domain
from seewhy.labelling.following import Following
from seewhy.labelling.labelling_order import labelling_order, landscape
from seewhy.labelling.quick_heads import QuickHeads
from seewhy.new_domain.from_names import NamedDomain, domain_from_names


def clusters(*, count: int = 20, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Three clusters of pictures, and which cluster each is of."""
    generator = np.random.default_rng(seed)
    centres = np.array([[9.0, 0, 0, 0], [0, 9, 0, 0], [0, 0, 9, 0]])
    members = np.repeat(np.arange(3), count)
    return centres[members] + generator.normal(0, 0.5, (3 * count, 4)), members


def test_the_first_three_are_of_three_kinds() -> None:
    pooled, members = clusters()
    lie = landscape(pooled.astype(np.float32))
    first = [found.place for found in labelling_order(lie, {}, [], count=3)]
    assert set(members[first].tolist()) == {0, 1, 2}


def test_what_is_labelled_or_left_out_does_not_come() -> None:
    pooled, _ = clusters(count=2)
    lie = landscape(pooled.astype(np.float32))
    order = labelling_order(lie, {}, [0, 1], count=10, without={2})
    assert sorted(found.place for found in order) == [3, 4, 5]
    assert labelling_order(lie, {}, range(6)) == []


def test_of_pictures_that_lie_alike_the_unsure_and_the_disputed_come_first() -> None:
    lie = landscape(np.ones((4, 2), dtype=np.float32))
    shares = {"colour": np.array([[0.9, 0.1], [0.5, 0.5], [0.9, 0.1], [0.99, 0.01]])}
    assert labelling_order(lie, shares, [3], count=1)[0].place == 1
    disputed = np.array([False, False, True, False])
    order = labelling_order(lie, shares, [1, 3], count=2, disputed=disputed)
    assert [(found.place, found.disputed) for found in order] == [(2, True), (0, False)]


def test_an_outlier_is_not_the_first() -> None:
    pooled, _ = clusters()
    pooled = np.vstack([pooled, [[0, 0, 0, 9.0]]])
    lie = landscape(pooled.astype(np.float32))
    first = [found.place for found in labelling_order(lie, {}, [], count=3)]
    assert len(pooled) - 1 not in first


def test_the_order_needs_fewer_labels_than_chance() -> None:
    """Of a hundred pictures of one kind and five of each other, all kinds are soon seen."""
    generator = np.random.default_rng(0)
    members = np.repeat([0, 1, 2, 3], [100, 5, 5, 5])
    pooled = 9 * np.eye(4)[members] + generator.normal(0, 0.5, (len(members), 4))
    lie = landscape(pooled.astype(np.float32))
    first = [found.place for found in labelling_order(lie, {}, [], count=6)]
    assert set(members[first].tolist()) == {0, 1, 2, 3}


def test_heads_are_trained_again_only_where_labels_changed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from seewhy.labelling import quick_heads

    trained: list[int] = []
    fit = quick_heads.fit_head

    def counted(*arguments: object, **named: object) -> object:
        trained.append(1)
        return fit(*arguments, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(quick_heads, "fit_head", counted)
    pooled, members = clusters()
    heads = QuickHeads(pooled)
    targets = np.where(np.arange(len(members)) % 4 == 0, members, -1)
    seen = heads.probabilities("kind", targets, values=3)
    assert (seen.argmax(axis=1) == members).mean() > 0.9
    heads.probabilities("kind", targets.copy(), values=3)
    assert len(trained) == 1
    heads.probabilities("other", targets, values=3)
    assert len(trained) == 2


def test_what_is_recognised_is_judged_where_it_was_kept_out() -> None:
    pooled, members = clusters()
    targets = np.where(np.arange(len(members)) % 2 == 0, members, -1)
    counts = QuickHeads(pooled).held_out("kind", targets, values=4)
    assert counts.shown == (10, 10, 10, 0)
    assert sum(counts.right) >= 28
    nonsense = np.random.default_rng(1).permutation(targets)
    assert sum(QuickHeads(pooled).held_out("kind", nonsense, values=4).right) < 22


@pytest.fixture
def fruit(tmp_path: Path) -> Path:
    named = NamedDomain(table="class,colour,round\ngood,red,yes\nspoilt,green,\n")
    domain_from_names(named, tmp_path / "fruit", data="photos")
    return tmp_path / "fruit"


def test_features_follow_by_the_table(fruit: Path) -> None:
    following = Following(load_domain(fruit))
    assert following.features_of({"class": "good"}) == {"colour": "red", "round": "yes"}
    assert following.features_of({"class": "good", "round": "no"}) == {"colour": "red"}
    assert following.features_of({"class": "spoilt"})["colour"] == "green"
    assert following.features_of({"colour": "red"}) == {}


def test_features_follow_by_rules_that_leave_no_choice(tmp_path: Path) -> None:
    named = NamedDomain(("good", "spoilt"), {"colour": ("red", "green")})
    domain_from_names(named, tmp_path / "fruit", data="photos")
    knowledge = tmp_path / "fruit" / "knowledge.al"
    empty = knowledge.read_text()
    assert Following(load_domain(tmp_path / "fruit")).features_of({"class": "good"}) == {}
    rules = "of_kind(S, good) if colour(S, red).\n"
    knowledge.write_text(empty + rules)
    # Green ones are left open, and may be good as well.
    assert Following(load_domain(tmp_path / "fruit")).features_of({"class": "good"}) == {}
    knowledge.write_text(empty + rules + "of_kind(S, spoilt) if colour(S, green).\n")
    following = Following(load_domain(tmp_path / "fruit"))
    assert following.features_of({"class": "good"}) == {"colour": "red"}
    assert following.class_of({"colour": "green"}) == "spoilt"
    assert following.class_of({}) is None
