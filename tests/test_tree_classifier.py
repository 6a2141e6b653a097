"""The decision tree within scikit-learn: its own checks, pipelines over tables of words, rules."""

from __future__ import annotations

import pytest
from sklearn.model_selection import cross_val_score
from sklearn.utils.estimator_checks import check_estimator

from seewhy.induction.rule_table import COLUMNS
from seewhy.induction.tree_classifier import TreeClassifier

SCENES = [["1", "no"], ["2", "no"], ["3", "no"], ["3", "yes"], ["10", "yes"]] * 12
CLASSES = ["up", "up", "up", "down", "down"] * 12


@pytest.mark.filterwarnings("ignore")
def test_it_passes_the_checks_of_scikit_learn() -> None:
    found = check_estimator(TreeClassifier(), on_skip=None)
    passed = {check["check_name"] for check in found if check["status"] == "passed"}
    skipped = {check["check_name"] for check in found if check["status"] != "passed"}
    assert {"check_classifiers_train", "check_classifiers_classes", "check_fit2d_1sample"} <= passed
    # It computes with NumPy alone, and does not say that it takes arrays of other libraries.
    assert skipped <= {"check_array_api_input"}


def test_words_are_categories_and_whole_numbers_are_compared() -> None:
    model = TreeClassifier(smallest_leaf=1).fit(SCENES, CLASSES)
    assert model.predict([["2", "no"], ["10", "yes"]]).tolist() == ["up", "down"]
    assert model.predict_proba([["3", "yes"]]).tolist() == [[1.0, 0.0]]
    assert cross_val_score(TreeClassifier(), SCENES, CLASSES, cv=3).min() == 1.0


def test_a_value_that_training_did_not_show_is_not_known() -> None:
    model = TreeClassifier().fit([["red"], ["green"], ["blue"]] * 10, ["a", "b", "b"] * 10)
    assert model.predict([["violet"]]).tolist() == ["b"]


def test_its_rules_name_the_classes() -> None:
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    table = pandas.DataFrame(SCENES, columns=["count", "lean"])
    rules = TreeClassifier().fit(table, CLASSES).get_rules()
    assert tuple(rules.columns) == COLUMNS
    assert sorted(rules["rule"]) == ["down if lean = yes.", "up if lean = no."]


def test_options_are_checked_by_the_tree_and_labels_here() -> None:
    with pytest.raises(ValueError, match="Unknown label type"):
        TreeClassifier().fit(SCENES[:2], [0.1, 0.7])
