"""SeeWhy's rules about things, and others that learn from conditions written out as columns.

The columns are what a propositionaliser would write: how many things have each value, whether
there is a thing of each two values, whether two things stand in each relation, with none, one or
both of them of some value, and whether two things are alike, or different, in each feature, with
none or one of them of some value. A column counts as many literals as it asks.
"""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from seewhy.induction.axiom_learning import Fate
from seewhy.induction.things.conditions import Alike, Atom, HasValue, Pattern, Related, There
from seewhy.induction.things.coverage import counted, matches, where
from seewhy.induction.things.rule_learning import classified, learn_thing_rules
from seewhy.induction.things.thing_table import Bits, ThingTable

__all__ = ["LEARNERS", "LONGEST", "Fitted", "Learner", "columns_of"]

LONGEST = 5.0
"""Seconds of processor time; what ends takes less than one."""

_MOST_COUNTED = 6
_FOLDS = 5
_PRUNINGS = 12


@dataclass(frozen=True)
class Fitted:
    """How the scenes of a table are classified, and the literals of what was learned.

    ``ended`` is False where learning took longer than :data:`LONGEST`: all scenes are then of the
    class of most.
    """

    predict: Callable[[ThingTable], NDArray[np.bool_]]
    literals: int
    ended: bool = True


Learner = Callable[[ThingTable, NDArray[np.bool_], int], Fitted]
"""Learns from scenes and whether each is good; the number settles what is left to chance."""


def columns_of(table: ThingTable) -> NDArray[np.float64]:
    """Return the conditions of a table of scenes, of shape (scenes, columns)."""
    columns = [_number(table, atom) for atom in _values(table)]
    columns += [_digits(where(table, There(pattern)), table.scenes) for pattern in _patterns(table)]
    return np.stack(columns, axis=1)


def _literals(table: ThingTable) -> list[int]:
    """How much each column asks."""
    return [1] * len(_values(table)) + [len(pattern.atoms) for pattern in _patterns(table)]


def _values(table: ThingTable, thing: int = 0) -> list[HasValue]:
    return [
        HasValue(thing, key, value) for key, values in table.features.items() for value in values
    ]


def _patterns(table: ThingTable) -> Iterator[Pattern]:
    for first, second in combinations(_values(table), 2):
        if first.feature != second.feature:
            yield Pattern.of(1, [first, second])
    between: list[Atom] = [Related(0, 1, relation) for relation in table.relations]
    between += [Alike(0, 1, key, holds) for key in table.compared for holds in (True, False)]
    for atom in between:
        yield Pattern.of(2, [atom])
        for value in _values(table):
            yield Pattern.of(2, [atom, value])
            if isinstance(atom, Related):
                yield Pattern.of(2, [atom, value.renamed({0: 1})])
                for other in _values(table, 1):
                    yield Pattern.of(2, [atom, value, other])


def _number(table: ThingTable, atom: HasValue) -> NDArray[np.float64]:
    found = matches(table, Pattern.of(1, [atom]))
    numbers = np.zeros(table.scenes)
    for least in range(1, _MOST_COUNTED + 1):
        numbers += _digits(counted(table, found, least), table.scenes)
    return numbers


def _digits(bits: Bits, count: int) -> NDArray[np.float64]:
    digits = np.unpackbits(bits.astype("<u8").view(np.uint8), bitorder="little")
    return digits[:count].astype(np.float64)


def things(table: ThingTable, good: NDArray[np.bool_], _: int) -> Fitted:
    """SeeWhy: rules about things; what they leave open is of the class of most scenes."""
    labels = ["good" if label else "bad" for label in good.tolist()]
    judged = learn_thing_rules(table, labels, classes=("good", "bad"))
    rules = [judgement.rule for judgement in judged if judgement.fate is Fate.ACCEPTED]
    most = bool(good.mean() >= 0.5)

    def predict(other: ThingTable) -> NDArray[np.bool_]:
        known = {"good": True, "bad": False, None: most}
        return np.array([known[label] for label in classified(other, rules)])

    return Fitted(predict, sum(rule.literals for rule in rules))


def tree(table: ThingTable, good: NDArray[np.bool_], seed: int) -> Fitted:
    """scikit-learn's tree over the columns, pruned by cross-validation."""
    from sklearn.model_selection import GridSearchCV
    from sklearn.tree import DecisionTreeClassifier

    rows = columns_of(table)
    grown = DecisionTreeClassifier(random_state=seed)
    path = np.unique(np.clip(grown.cost_complexity_pruning_path(rows, good).ccp_alphas, 0, None))
    chosen = path[np.linspace(0, max(0, len(path) - 2), _PRUNINGS).astype(int)]
    search = GridSearchCV(grown, {"ccp_alpha": np.unique(chosen)}, cv=_FOLDS).fit(rows, good)
    nodes = search.best_estimator_.tree_

    asked = _literals(table)

    def below(node: int, above: int) -> int:
        """The literals of all paths through a node; those above it are in each of them."""
        left, right = nodes.children_left[node], nodes.children_right[node]
        if left == -1:
            return above
        here = above + asked[nodes.feature[node]]
        return below(left, here) + below(right, here)

    return Fitted(lambda other: search.predict(columns_of(other)).astype(bool), below(0, 0))


class _TooLongError(Exception):
    """A learner took too long."""


@contextmanager
def _limited() -> Iterator[None]:
    """End what takes longer than :data:`LONGEST`, of processor time."""

    def end(*_: object) -> None:
        raise _TooLongError

    before = signal.signal(signal.SIGPROF, end)
    signal.setitimer(signal.ITIMER_PROF, LONGEST)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def fold(table: ThingTable, good: NDArray[np.bool_], _: int) -> Fitted:
    """FOLD-R++ over the columns, as it is; of some scenes it does not end."""
    from foldrpp import Foldrpp

    def dictionaries(rows: NDArray[np.float64]) -> list[dict[str, float]]:
        return [dict(zip(names, map(float, row), strict=True)) for row in rows]

    rows = columns_of(table)
    # A column that is the same everywhere says nothing, and takes as long as any other.
    telling = np.flatnonzero(rows.std(axis=0) > 0)
    names = [f"c{number}" for number in telling]
    asked = np.array(_literals(table))[telling].tolist()
    model = Foldrpp(str_attrs=[], num_attrs=names, label="label", pos_val="1")
    data = dictionaries(rows[:, telling])
    for row, label in zip(data, good, strict=True):
        row["label"] = int(label)
    try:
        with _limited():
            model.fit(data)
    except _TooLongError:
        most = bool(good.mean() >= 0.5)
        return Fitted(lambda other: np.full(other.scenes, most), 0, ended=False)
    model.asp()  # writes exceptions as rules of their own, so that they are counted too
    return Fitted(
        lambda other: np.array(model.predict(dictionaries(columns_of(other)[:, telling]))).astype(
            bool
        ),
        sum(asked[names.index(item[0])] for rule in model.flat_rules for item in rule[1]),
    )


LEARNERS: dict[str, Learner] = {"SeeWhy": things, "FOLD-R++": fold, "tree": tree}
"""What learns, by its name."""
