"""Learn rules from the same tables: SeeWhy, FOLD-R++, scikit-learn's tree, imodels.

Numbers are cut into four at the quartiles of the training rows, for all learners alike; labels of
training rows are wrong as often as `noise` says, those of testing rows never. Literals are the
tests of features in all rules together (of a tree: on all its paths). SeeWhy's tolerance (of three)
and the tree's pruning are those that do best in cross-validation on the training rows, which the
time does not include.

    pip install -e '.[benchmarks]'
    python benchmarks/rule_learners.py
"""

from __future__ import annotations

import argparse
import csv
import time
import warnings
from collections.abc import Callable, Sequence
from itertools import product

import numpy as np
from scipy.stats import sem
from sklearn import datasets
from sklearn.model_selection import GridSearchCV, StratifiedKFold, StratifiedShuffleSplit
from sklearn.preprocessing import KBinsDiscretizer
from sklearn.tree import DecisionTreeClassifier

from seewhy.domain.domain import load_domain
from seewhy.induction.axiom_learning import LearningOptions, decide_by_candidates, learn_axioms
from seewhy.induction.scene_table import scene_table
from seewhy.knowledge.reasoner import Reasoner

SEEDS = 5
NOISE = (0.0, 0.05, 0.1)
TOLERANCES = (0.0, 0.05, 0.1)
SCENES = 1000

Rows = np.ndarray
Fitted = tuple[Callable[[Rows], np.ndarray], int]
"""How rows are classified, and the number of literals."""


def structures(seed: int) -> tuple[Rows, np.ndarray, bool]:
    """Scenes of the structures, annotated by the knowledge."""
    domain = load_domain("structure_stability")
    space = list(product(*(feature.values for feature in domain.features.values())))
    decisions = Reasoner(domain.knowledge, domain.schema).decide_all(space)
    decided = [
        (vector, decision.label)
        for vector, decision in zip(space, decisions, strict=True)
        if decision.label
    ]
    drawn = np.random.default_rng(seed).integers(len(decided), size=SCENES)
    places = [
        {value: n for n, value in enumerate(feature.values)} for feature in domain.features.values()
    ]
    rows = [
        [place[value] for place, value in zip(places, decided[n][0], strict=True)] for n in drawn
    ]
    return np.array(rows), np.array([decided[n][1] == "stable" for n in drawn]), False


def signs(seed: int) -> tuple[Rows, np.ndarray, bool]:
    """Traffic signs, all kinds equally often: whether one warns of a danger (code A…)."""
    domain = load_domain("traffic_signs")
    with (domain.folder / "classes.csv").open(encoding="utf-8", newline="") as stream:
        kinds = list(csv.DictReader(stream))
    places = {
        key: {value: n for n, value in enumerate(feature.values)}
        for key, feature in domain.features.items()
    }
    drawn = np.random.default_rng(seed).integers(len(kinds), size=SCENES)
    rows = [[place[kinds[n][key]] for key, place in places.items()] for n in drawn]
    return np.array(rows), np.array([kinds[n]["code"].startswith("A") for n in drawn]), False


def shipped(load: Callable[[], object], positive: int) -> Callable[[int], tuple]:
    """A table of scikit-learn: whether a row is of one class."""

    def table(_: int) -> tuple[Rows, np.ndarray, bool]:
        loaded = load()
        return loaded.data, loaded.target == positive, True

    return table


TABLES = {
    "structures": structures,
    "signs (warning)": signs,
    "iris (versicolor)": shipped(datasets.load_iris, 1),
    "wine (first)": shipped(datasets.load_wine, 0),
    "breast cancer": shipped(datasets.load_breast_cancer, 1),
    "digits (zero)": shipped(datasets.load_digits, 0),
}


def seewhy_rules(rows: Rows, labels: np.ndarray, tolerance: float) -> Fitted:
    """The axioms of one class, the other being the rest: as the rule learners beside it do.

    Axioms are learned for both; kept are those that classify the training rows better, or as well
    with fewer literals.
    """
    most = rows.max(axis=0)
    features = {
        f"f{n}": tuple(map(str, range(int(greatest) + 1))) for n, greatest in enumerate(most)
    }
    vectors = [tuple(map(str, row)) for row in rows]
    learned = learn_axioms(
        features, vectors, list(map(str, labels)), decide=decide_by_candidates(features),
        options=LearningOptions(tolerance=tolerance),
    )  # fmt: skip

    def spoken(some: Rows, label: bool) -> np.ndarray:
        bounded = [tuple(map(str, row)) for row in np.minimum(some, most)]
        table = scene_table(features, bounded, ["?"] * len(bounded))
        by_row = np.zeros(len(table.vectors), dtype=bool)
        for judgement in learned.accepted:
            if judgement.candidate.label == str(label):
                by_row |= table.satisfying(judgement.candidate.conditions)
        found = np.zeros(len(bounded), dtype=bool)
        for speaks, positions in zip(by_row, table.scenes, strict=True):
            found[list(positions)] = speaks
        return found if label else ~found

    literals = {
        label: sum(
            judgement.candidate.literals
            for judgement in learned.accepted
            if judgement.candidate.label == str(label)
        )
        for label in (True, False)
    }
    chosen = max(
        (True, False), key=lambda label: ((spoken(rows, label) == labels).mean(), -literals[label])
    )
    return lambda some: spoken(some, chosen), literals[chosen]


def best_tolerance(rows: Rows, labels: np.ndarray, seed: int) -> float:
    """The greatest tolerance within a standard error of what cross-validation finds best."""
    folds = list(StratifiedKFold(5, shuffle=True, random_state=seed).split(rows, labels))
    scores = []
    for tolerance in TOLERANCES:
        right = []
        for train, test in folds:
            predict, _ = seewhy_rules(rows[train], labels[train], tolerance)
            right.append((predict(rows[test]) == labels[test]).mean())
        scores.append(right)
    means, best = np.mean(scores, axis=1), int(np.argmax(np.mean(scores, axis=1)))
    least = means[best] - sem(scores[best])
    return max(
        tolerance for tolerance, mean in zip(TOLERANCES, means, strict=True) if mean >= least
    )


def foldrpp_rules(rows: Rows, labels: np.ndarray, _: float) -> Fitted:
    """FOLD-R++ on numbers, as it is."""
    from foldrpp import Foldrpp, num_predicates

    names = [f"f{n}" for n in range(rows.shape[1])]

    def dictionaries(some: Rows) -> list[dict[str, float]]:
        return [dict(zip(names, map(float, row), strict=True)) for row in some]

    model = Foldrpp(str_attrs=[], num_attrs=names, label="label", pos_val="1")
    data = dictionaries(rows)
    for row, label in zip(data, labels, strict=True):
        row["label"] = int(label)
    model.fit(data)

    def predict(some: Rows) -> np.ndarray:
        return np.array(model.predict(dictionaries(some))).astype(bool)

    model.asp()  # writes exceptions as rules of their own, so that they are counted too
    return predict, num_predicates(model.flat_rules)


def best_pruning(rows: Rows, labels: np.ndarray, seed: int) -> float:
    """The strength of pruning that cross-validation prefers."""
    alphas = DecisionTreeClassifier(random_state=seed).cost_complexity_pruning_path(rows, labels)
    grid = {"ccp_alpha": np.unique(np.clip(alphas.ccp_alphas, 0, None))[:-1][-25:]}
    search = GridSearchCV(DecisionTreeClassifier(random_state=seed), grid, cv=5)
    return float(search.fit(rows, labels).best_params_["ccp_alpha"])


def tree_rules(rows: Rows, labels: np.ndarray, pruning: float) -> Fitted:
    """scikit-learn's tree."""
    tree = DecisionTreeClassifier(random_state=0, ccp_alpha=pruning).fit(rows, labels)
    return tree.predict, _path_literals(tree.tree_)


def _path_literals(tree: object) -> int:
    def below(node: int, depth: int) -> int:
        if tree.children_left[node] == -1:
            return depth
        return below(tree.children_left[node], depth + 1) + below(
            tree.children_right[node], depth + 1
        )

    return below(0, 0)


def imodels_rules(rows: Rows, labels: np.ndarray, _: float) -> Fitted:
    """The greedy rule list of imodels."""
    from imodels import GreedyRuleListClassifier

    model = GreedyRuleListClassifier()
    model.fit(rows, labels.astype(int))
    return lambda some: model.predict(some).astype(bool), len(model.rules_)


def nothing(*_: object) -> float:
    """There is nothing to choose."""
    return 0.0


LEARNERS = {
    "SeeWhy": (best_tolerance, seewhy_rules),
    "FOLD-R++": (nothing, foldrpp_rules),
    "tree": (best_pruning, tree_rules),
    "imodels": (nothing, imodels_rules),
}
"""Learner → how an option is chosen, and how rules are learned with it."""


def one(name: str, noise: float, seed: int) -> dict[str, tuple[float, int, float]]:
    """Accuracy, literals and seconds of every learner on one split of a table."""
    rows, labels, numbers = TABLES[name](seed)
    splitter = StratifiedShuffleSplit(1, test_size=1 / 3, random_state=seed)
    ((train, test),) = splitter.split(rows, labels)
    if numbers:
        cutter = KBinsDiscretizer(4, encode="ordinal", strategy="quantile")
        cutter.fit(rows[train])
        rows = cutter.transform(rows).astype(int)
    wrong = np.random.default_rng([seed, 1]).random(len(train)) < noise
    shown = np.where(wrong, ~labels[train], labels[train])
    found = {}
    for learner, (choose, fit) in LEARNERS.items():
        option = choose(rows[train], shown, seed)
        began = time.perf_counter()
        predict, literals = fit(rows[train], shown, option)
        seconds = time.perf_counter() - began
        found[learner] = ((predict(rows[test]) == labels[test]).mean(), literals, seconds)
    return found


def main() -> None:
    """Print a row for every table and noise: accuracy, literals and seconds of each learner."""
    warnings.filterwarnings("ignore")
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tables", nargs="*", default=list(TABLES), choices=list(TABLES))
    parser.add_argument("--seeds", type=int, default=SEEDS)
    options = parser.parse_args()
    print(f"| table | noise | {' | '.join(LEARNERS)} |")
    print("|---|---" + "|---" * len(LEARNERS) + "|")
    for name in options.tables:
        for noise in NOISE:
            found = [one(name, noise, seed) for seed in range(options.seeds)]
            cells: Sequence[str] = [
                "{:.1f} %, {:.1f}, {:.2f} s".format(
                    *np.mean(
                        [(100 * a, b, c) for a, b, c in (result[key] for result in found)], axis=0
                    )
                )
                for key in LEARNERS
            ]
            print(f"| {name} | {noise:.0%} | {' | '.join(cells)} |".replace("%,", "%,"), flush=True)


if __name__ == "__main__":
    main()
