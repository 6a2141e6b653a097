"""Rules as a data frame: the same columns whatever they come from, and pandas only where asked."""

from __future__ import annotations

import sys
from dataclasses import replace

import pytest

from seewhy.domain.domain import load_domain
from seewhy.errors import SeeWhyError
from seewhy.induction.rule_table import COLUMNS, rules_of_axioms, rules_of_tree
from seewhy.induction.sentence import say_path
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.axiom import Origin

STRUCTURES = load_domain("structure_stability")
AXIOMS = STRUCTURES.knowledge.axioms


@pytest.fixture(scope="module")
def tree() -> DecisionTree:
    names = {key: feature.values for key, feature in STRUCTURES.features.items()}
    first = tuple(values[0] for values in names.values())
    last = tuple(values[-1] for values in names.values())
    return DecisionTree(names).fit([first, last] * 20, ["stable", "unstable"] * 20)


def test_a_tree_has_a_row_a_path(tree: DecisionTree) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    table = tree.get_rules(STRUCTURES)
    assert tuple(table.columns) == COLUMNS
    assert table["support"].tolist() == [path.support for path in tree.paths()]
    assert table["sentence"].tolist() == [say_path(STRUCTURES, path) for path in tree.paths()]
    assert set(table["kind"]) == {"path of a tree"}
    assert sorted(table["concludes"]) == ["stable", "unstable"]
    assert all(line.startswith("if ") for line in tree.get_rules()["sentence"])


def test_a_tree_without_scenes_has_no_rows() -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    table = rules_of_tree(DecisionTree({"lean": ["yes", "no"]}))
    assert (tuple(table.columns), len(table)) == (COLUMNS, 0)


def test_given_and_learned_axioms_are_told_apart() -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    learned = replace(AXIOMS[0], origin=Origin(learned=True, support=12, precision=0.75))
    table = rules_of_axioms([learned, AXIOMS[1]])
    assert tuple(table.columns) == COLUMNS
    assert table["rule"].tolist() == [str(AXIOMS[0]), str(AXIOMS[1])]
    assert table["sentence"].tolist() == [AXIOMS[0].text, AXIOMS[1].text]
    assert table["origin"].tolist() == ["learned", "given"]
    assert table.loc[0, ["support", "precision"]].tolist() == [12, 0.75]
    assert table["support"].isna().tolist() == [False, True]


def test_without_pandas(tree: DecisionTree, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(SeeWhyError, match=r"pip install 'seewhy\[tables\]'"):
        tree.get_rules()
