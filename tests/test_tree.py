"""The decision tree: sound paths, sentences, and files that are checked when they are read."""

from __future__ import annotations

import json
import warnings
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import ModelError
from seewhy.induction.sentence import say_path
from seewhy.induction.tree import DecisionTree, PathCondition, TreeNode, TreePath
from seewhy_lab.simulators.traffic_signs.source import signs

FEATURES = {
    "count": ["1", "2", "3", "4"],
    "hue": ["red", "green", "blue"],
    "lean": ["yes", "no"],
    "level": ["-1", "0", "1"],
}
VECTORS = st.tuples(*(st.sampled_from(values) for values in FEATURES.values()))
PARTLY_KNOWN = st.tuples(*(st.sampled_from([*values, None]) for values in FEATURES.values()))


def holds(path: TreePath, vector: tuple[str | None, ...]) -> bool:
    values = dict(zip(FEATURES, vector, strict=True))
    return all(values[c.feature] in c.values for c in path.conditions)


OPEN_SIGNS = {
    "children_ahead": 154,
    "priority_at_junction": 154,
    "separate_paths": 152,
    "roundabout": 150,
    "parking_on_pavement": 150,
    "level_crossing": 150,
    "dead_end": 150,
    "no_overtaking": 150,
}
"""Signs that their features tell apart, with a few photographs of some beside drawings of all."""


def test_classes_that_features_tell_apart_are_not_pruned_together() -> None:
    domain = load_domain("traffic_signs")
    vectors = {name: domain.vector(signs()[name]) for name in OPEN_SIGNS}
    scenes = [(vectors[name], name) for name, count in OPEN_SIGNS.items() for _ in range(count)]
    tree = DecisionTree({key: feature.values for key, feature in domain.features.items()})
    tree.fit([vector for vector, _ in scenes], [name for _, name in scenes], seed=2)
    assert {name: tree.classify(vector) for name, vector in vectors.items()} == {
        name: name for name in OPEN_SIGNS
    }


@settings(max_examples=40)
@given(st.lists(st.tuples(VECTORS, st.sampled_from(["up", "down", "aside"])), min_size=1))
def test_every_scene_satisfies_its_path_and_no_other(
    scenes: list[tuple[tuple[str, ...], str]],
) -> None:
    vectors, labels = [v for v, _ in scenes], [label for _, label in scenes]
    tree = DecisionTree(FEATURES).fit(vectors, labels)
    paths = tree.paths()
    assert sum(path.support for path in paths) == len(scenes)
    for vector in vectors:
        assert [path for path in paths if holds(path, vector)] == [tree.path(vector)]
        assert tree.path(vector).label == tree.classify(vector)
    for path in paths:
        here = [label for vector, label in scenes if holds(path, vector)]
        assert len(here) == path.support
        assert here.count(path.label) / len(here) == pytest.approx(path.precision)
        assert len({c.feature for c in path.conditions}) == len(path.conditions)
        for condition in path.conditions:
            assert set(condition.values) < set(FEATURES[condition.feature])
            assert condition.values


@settings(max_examples=40)
@given(st.lists(st.tuples(PARTLY_KNOWN, st.sampled_from(["up", "down"])), min_size=1))
def test_unknown_values_are_classified_and_said(
    scenes: list[tuple[tuple[str | None, ...], str]],
) -> None:
    tree = DecisionTree(FEATURES).fit([v for v, _ in scenes], [label for _, label in scenes])
    paths = tree.paths()
    assert sum(path.support for path in paths) == len(scenes)
    for vector, _ in scenes:
        assert tree.path(vector) in paths
        assert sum(tree.probability(vector).values()) == pytest.approx(1.0)
    # Numbers always keep a value; only of a category can none be left.
    for path in paths:
        assert all(c.values for c in path.conditions if c.feature in ("count", "level", "lean"))


def test_categories_are_never_ordered() -> None:
    """The middle one of three categories is told from the other two by one condition."""
    scenes = [("1", hue, "no", "0") for hue in FEATURES["hue"]] * 10
    labels = ["up", "down", "up"] * 10
    assert DecisionTree(FEATURES).fit(scenes, labels).paths() == (
        TreePath((PathCondition("hue", ("red", "blue")),), "up", 20, 1.0),
        TreePath((PathCondition("hue", ("green",)),), "down", 10, 1.0),
    )


def test_numbers_are_compared() -> None:
    scenes = [(count, "red", "no", "0") for count in FEATURES["count"]] * 10
    assert DecisionTree(FEATURES).fit(scenes, ["up", "up", "up", "down"] * 10).paths() == (
        TreePath((PathCondition("count", ("1", "2", "3")),), "up", 30, 1.0),
        TreePath((PathCondition("count", ("4",)),), "down", 10, 1.0),
    )


def test_noise_is_pruned() -> None:
    vectors = [(*vector,) for vector in product(*FEATURES.values())] * 3
    labels = ["down" if vector[2] == "yes" else "up" for vector in vectors]
    labels[5], labels[70] = "down", "up"
    tree = DecisionTree(FEATURES).fit(vectors, labels)
    assert [path.conditions for path in tree.paths()] == [
        (PathCondition("lean", ("no",)),),
        (PathCondition("lean", ("yes",)),),
    ]


def test_the_nodes_are_those_of_the_paths() -> None:
    scenes = [(count, "red", lean, "0") for count in FEATURES["count"] for lean in ("yes", "no")]
    labels = ["down" if c in "34" and lean == "yes" else "up" for c, _, lean, _ in scenes]
    tree = DecisionTree(FEATURES).fit(scenes * 5, labels * 5)
    root = tree.root()
    assert root is not None

    def leaves(node: TreeNode) -> list[TreeNode]:
        return [leaf for branch in node.branches for leaf in leaves(branch)] or [node]

    def well_formed(node: TreeNode) -> bool:
        return (node.feature is None) == (not node.branches) and (
            not node.branches
            or (
                sum(branch.support for branch in node.branches) == node.support
                and all(map(well_formed, node.branches))
            )
        )

    assert well_formed(root)
    assert [(n.label, n.support, n.precision) for n in leaves(root)] == [
        (path.label, path.support, path.precision) for path in tree.paths()
    ]


def test_many_classes_of_few_scenes_are_no_reason_to_warn() -> None:
    vectors = list(product(*FEATURES.values()))[:30]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        DecisionTree(FEATURES).fit(vectors, [str(n) for n in range(30)])


def test_the_same_seed_grows_the_same_tree() -> None:
    vectors = list(product(*FEATURES.values()))
    labels = ["up" if (i * 7) % 5 < 2 else "down" for i in range(len(vectors))]
    one = DecisionTree(FEATURES).fit(vectors, labels, seed=4)
    other = DecisionTree(FEATURES).fit(vectors, labels, seed=4)
    assert one.paths() == other.paths()


# On disk --------------------------------------------------------------------------------------


def small_tree() -> DecisionTree:
    scenes = [(count, hue, "no", "0") for count in "1234" for hue in FEATURES["hue"]]
    labels = ["up" if c < "3" and hue != "red" else "down" for c, hue, _, _ in scenes]
    return DecisionTree(FEATURES).fit(scenes, labels)


def test_a_saved_tree_is_the_same(tmp_path: Path) -> None:
    tree = small_tree()
    tree.save(tmp_path)
    loaded = DecisionTree.load(tmp_path)
    assert (loaded.paths(), loaded.classes) == (tree.paths(), tree.classes)
    for vector in product(*FEATURES.values()):
        assert loaded.probability(vector) == tree.probability(vector)


def test_an_unfitted_tree(tmp_path: Path) -> None:
    tree = DecisionTree(FEATURES).fit([], [])
    assert (tree.fitted, tree.classes, tree.paths(), tree.root()) == (False, (), (), None)
    with pytest.raises(ValueError, match="the tree is not fitted; call fit with at least one"):
        tree.classify(("1", "red", "no", "0"))
    tree.save(tmp_path)
    assert not DecisionTree.load(tmp_path).fitted


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    small_tree().save(tmp_path)
    (tmp_path / "tree.json").unlink()
    with pytest.raises(ModelError) as problem:
        DecisionTree.load(tmp_path)
    assert str(problem.value) == (
        f"{tmp_path}/tree.json cannot be read (No such file or directory): train the model again"
    )


@pytest.mark.parametrize(
    "content",
    [b"", b"[]", b'{"features": 3, "nodes": null}', b'{"features": {"count": ["1"]}}', b"\xff\xfe"],
)
def test_a_damaged_file_is_no_tree(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "tree.json").write_bytes(content)
    with pytest.raises(ModelError, match=r"tree\.json is damaged \(.*\): train the model again"):
        DecisionTree.load(tmp_path)


@pytest.mark.parametrize(
    ("table", "row", "wrong"),
    [
        ("left", 0, 0),  # a circle
        ("left", 0, 10_000),
        ("right", 0, -1),
        ("column", 0, 99),
        ("column", 0, -1),
        ("threshold", 0, "NaN"),
        ("support", 0, -3),
        ("shares", 0, [0.5]),
        ("shares", 0, ["Infinity", 0.0]),
        ("classes", 0, None),
    ],
)
def test_nodes_that_form_no_tree_are_refused(
    tmp_path: Path, table: str, row: int, wrong: object
) -> None:
    small_tree().save(tmp_path)
    described = json.loads((tmp_path / "tree.json").read_text())
    if wrong is None:
        described["nodes"][table] = []
    else:
        described["nodes"][table][row] = wrong
    (tmp_path / "tree.json").write_text(json.dumps(described))
    wrong_there = rf"its nodes do not form a tree|nodes\.{table}\.{row}\S*: Input should be"
    with pytest.raises(ModelError, match=wrong_there):
        DecisionTree.load(tmp_path)


def test_the_same_scenes_and_seed_give_the_same_file(tmp_path: Path) -> None:
    for name in ("first", "second"):
        small_tree().save(tmp_path / name)
    files = [(tmp_path / name / "tree.json").read_bytes() for name in ("first", "second")]
    assert files[0] == files[1]


def test_a_tree_of_other_features_is_refused(tmp_path: Path) -> None:
    """Its nodes ask about columns that the features do not have."""
    small_tree().save(tmp_path)
    described = json.loads((tmp_path / "tree.json").read_text())
    described["features"] = {"count": FEATURES["count"]}
    (tmp_path / "tree.json").write_text(json.dumps(described))
    with pytest.raises(ModelError, match="its nodes do not form a tree"):
        DecisionTree.load(tmp_path)


# In words -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("path", "text"),
    [
        (
            TreePath((), "stable", 40, 0.875),
            "of the structures that no rule decides, "
            "each is taken to be stable (0 of 4 features tested, "
            "88 % of 40 structures)",
        ),
        (
            TreePath((PathCondition("block_displaced", ("yes",)),), "unstable", 7, 1.0),
            "of the structures that no rule decides, "
            "if a block is displaced, then it is unstable (1 of 4 features tested, 100 % of 7 "
            "structures)",
        ),
        (
            TreePath(
                (
                    PathCondition("num_blocks", ("3", "4", "5")),
                    PathCondition("base", ("narrow",)),
                    PathCondition("block_displaced", ("no",)),
                ),
                "stable",
                212,
                0.941,
            ),
            "of the structures that no rule decides, "
            "if the structure has three to five blocks, it has a narrow base, and no block is "
            "displaced, then it is stable (3 of 4 features tested, 94 % of 212 structures)",
        ),
        (
            TreePath((PathCondition("base", ()),), "stable", 2, 0.5),
            "of the structures that no rule decides, "
            "if the width of the base is not known, then it is stable (1 of 4 features tested, "
            "50 % of 2 structures)",
        ),
    ],
)
def test_a_path_as_a_sentence(structures: Domain, path: TreePath, text: str) -> None:
    assert say_path(structures, path) == text


def test_a_leaf_of_equal_classes_says_all_of_them(structures: Domain) -> None:
    vector = structures.vector({"base": "wide"})
    tree = DecisionTree({key: feature.values for key, feature in structures.features.items()})
    tree.fit([vector, vector], ["unstable", "stable"], seed=0)
    (path,) = tree.paths()
    assert path.equals == tuple(label for label in ("stable", "unstable") if label != path.label)
    said = say_path(structures, path)
    assert f"and as often {path.equals[0]} (0 of 4 features tested, 50 % of 2 structures)" in said
