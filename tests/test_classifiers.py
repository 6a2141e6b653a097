"""The tree and the axioms within scikit-learn: its checks, tables of words, rules."""

from __future__ import annotations

import pytest
from sklearn.model_selection import cross_val_score
from sklearn.utils.estimator_checks import check_estimator

from seewhy.induction.axiom_classifier import AxiomClassifier
from seewhy.induction.feature_classifier import FeatureClassifier
from seewhy.induction.rule_table import COLUMNS
from seewhy.induction.tree_classifier import TreeClassifier

SCENES = [["1", "no"], ["2", "no"], ["3", "no"], ["3", "yes"], ["10", "yes"]] * 12
CLASSES = ["up", "up", "up", "down", "down"] * 12


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("model", [TreeClassifier(), AxiomClassifier()], ids=type)
def test_it_passes_the_checks_of_scikit_learn(model: FeatureClassifier) -> None:
    found = check_estimator(model, on_skip=None)
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


def test_axioms_decide_and_the_tree_what_they_leave_open() -> None:
    # Of four blocks that lean some stand and some fall, in a way that no feature tells.
    scenes = [["3", "no"], ["3", "yes"], ["4", "no"], ["4", "yes"], ["4", "yes"]] * 20
    classes = ["up", "down", "up", "up", "down"] * 20
    model = AxiomClassifier().fit(scenes, classes)
    said = {(judgement.candidate.label, str(judgement.candidate)) for judgement in model.axioms_}
    assert {label for label, _ in said} == {"up", "down"}
    assert model.predict_proba([["4", "no"], ["3", "yes"]]).tolist() == [[0.0, 1.0], [1.0, 0.0]]
    assert model.predict_proba([["4", "yes"]]).tolist() == [[0.5, 0.5]]
    # Of what training did not show no axiom speaks.
    assert model.predict_proba([["3", "sideways"]]).max() < 1.0


def test_a_tolerance_keeps_axioms_that_a_slip_contradicts() -> None:
    slip = [*CLASSES]
    slip[0] = "down"
    asked = [
        {condition.feature for condition in judgement.candidate.conditions}
        for judgement in AxiomClassifier(tolerance=0.05).fit(SCENES, slip).axioms_
    ]
    assert asked == [{"x1"}, {"x1"}]
    (_, standing) = AxiomClassifier().fit(SCENES, slip).axioms_
    assert {condition.feature for condition in standing.candidate.conditions} == {"x0", "x1"}


def test_its_axioms_are_rules() -> None:
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    table = pandas.DataFrame(SCENES, columns=["count", "lean"])
    rules = AxiomClassifier().fit(table, CLASSES).get_rules()
    assert tuple(rules.columns) == COLUMNS
    assert rules[["rule", "sentence", "support"]].values.tolist() == [
        ["up if lean = no.", "if lean is no, then up", 36],
        ["down if lean = yes.", "if lean is yes, then down", 24],
    ]
