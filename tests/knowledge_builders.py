"""Small random knowledge, and a second opinion on it that shares no code with SeeWhy."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, product

import clingo
from hypothesis import strategies as st

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.language import Knowledge, read_knowledge, read_literal
from seewhy.knowledge.scene import FeatureVector, SceneSchema

SIGNATURE = """\
#sort scene.
#sort shade = {dark, light}.
#sort num = 1..3.
#static f(scene).
#static g(scene, shade).
#static n(scene, num).
#static p(scene).
#static q(scene).
#static r(scene).
"""
VALUES: Mapping[str, tuple[str, ...]] = {
    "f": ("yes", "no"),
    "g": ("dark", "light"),
    "n": ("1", "2", "3"),
}
CLASSES = {
    "two": {"yes": "p(scene)", "no": "-p(scene)"},
    "three": {"first": "p(scene)", "second": "q(scene)", "third": "r(scene)"},
}
Beliefs = frozenset[str]


def schema_of(
    knowledge: Knowledge,
    features: Iterable[str],
    classes: Mapping[str, str],
    *,
    scene: str = "scene",
    costs: Mapping[str, int] | None = None,
) -> SceneSchema:
    """The schema of features that are declared as a domain declares them."""
    literals: dict[str, dict[str, Literal]] = {}
    for name in features:
        sorts = knowledge.signature.predicates[name].sorts
        if len(sorts) == 1:
            seen = Literal(predicate=name, arguments=(scene,))
            literals[name] = {"yes": seen, "no": seen.complement}
        else:
            literals[name] = {
                value: Literal(predicate=name, arguments=(scene, value))
                for value in knowledge.signature.members(sorts[1])
            }
    return SceneSchema(
        scene=scene,
        features=literals,
        classes={name: read_literal(text) for name, text in classes.items()},
        change_costs=dict(costs or {}),
    )


@dataclass(frozen=True)
class Rule:
    """One random axiom; its variables are S, the scene, and N where it speaks of ``n``."""

    head: str
    body: tuple[str, ...]
    default: bool = False

    def __str__(self) -> str:
        bound = self.body if any(_binds(c) for c in self.body) else ("scene(S)", *self.body)
        return f"{'default ' if self.default else ''}{self.head} if {', '.join(bound)}."

    def holds(self, beliefs: Beliefs) -> bool:
        """Whether all conditions hold for some N."""
        return min(self.failures(beliefs)) == 0

    def failures(self, beliefs: Beliefs) -> list[int]:
        """How many conditions fail, for every N that there is to choose."""
        numbers = VALUES["n"] if any("N" in c for c in self.body) else ("1",)
        return [
            sum(not _holds(_ground(c, number), beliefs) for c in self.body) for number in numbers
        ]

    @property
    def concludes(self) -> str:
        return _ground(self.head)


def _binds(condition: str) -> bool:
    return not condition.startswith("not ") and "S" in condition


def _ground(text: str, number: str = "N") -> str:
    return re.sub(r"\bN\b", number, text.replace("S", "scene")).replace(", ", ",")


def _holds(condition: str, beliefs: Beliefs) -> bool:
    comparison = re.fullmatch(r"(\d+) ([<>]) (\d+)", condition)
    if comparison:
        left, sign, right = comparison.groups()
        return int(left) > int(right) if sign == ">" else int(left) < int(right)
    if condition.startswith("not "):
        return condition[4:] not in beliefs
    return condition in beliefs


def opposite(literal: str) -> str:
    return literal[1:] if literal.startswith("-") else f"-{literal}"


@dataclass(frozen=True)
class World:
    """Random axioms over three features, with the beliefs that follow by the book."""

    rules: tuple[Rule, ...]
    classes: str = "two"
    costs: tuple[int, int, int] = (1, 1, 1)

    @property
    def source(self) -> str:
        return SIGNATURE + "\n".join(map(str, self.rules)) + "\n"

    def __repr__(self) -> str:
        lines = "\n".join(map(str, self.rules))
        return f"World({self.classes} classes, costs {self.costs})\n{lines}\n"

    @cached_property
    def knowledge(self) -> Knowledge:
        return read_knowledge(self.source)

    @cached_property
    def schema(self) -> SceneSchema:
        costs = dict(zip(VALUES, self.costs, strict=True))
        return schema_of(self.knowledge, VALUES, CLASSES[self.classes], costs=costs)

    @property
    def vectors(self) -> list[FeatureVector]:
        """All feature vectors, those with unknown values included."""
        return list(product(*((*values, None) for values in VALUES.values())))

    def rule(self, identifier: str) -> Rule:
        return self.rules[int(identifier[1:]) - 1]

    # By the book ------------------------------------------------------------------------------

    def answer_sets(
        self, vector: FeatureVector, given_up: Iterable[int] = (), *, contradictory: bool = False
    ) -> list[Beliefs]:
        """The answer sets by clingo's own classical negation.

        The defaults numbered ``given_up`` have their exceptions added as rules. With
        ``contradictory`` a literal and its complement do not exclude each other.
        """
        key = (vector, frozenset(given_up), contradictory)
        if key not in self._solved:
            self._solved[key] = self._solve(vector, key[1], contradictory)
        return self._solved[key]

    @cached_property
    def _solved(self) -> dict[tuple[FeatureVector, frozenset[int], bool], list[Beliefs]]:
        return {}

    def _solve(
        self, vector: FeatureVector, given_up: frozenset[int], contradictory: bool
    ) -> list[Beliefs]:
        lines = ["scene(scene).", *(f"{fact}." for fact in facts(vector))]
        for number, rule in enumerate(self.rules):
            body = ", ".join(("scene(S)", *rule.body))
            unless = f", not {opposite(rule.head)}" if rule.default else ""
            lines.append(f"{rule.head} :- {body}{unless}.")
            if number in given_up:
                lines.append(f"{opposite(rule.head)} :- {body}.")
        return solve("\n".join(lines), contradictory=contradictory)

    def preferred(self, vector: FeatureVector, minimality: str) -> list[Beliefs]:
        """The answer sets under every minimal set of exceptions to defaults (CR-Prolog)."""
        return [
            beliefs
            for given_up in self.exceptions(vector, minimality)
            for beliefs in self.answer_sets(vector, given_up)
        ]

    def exceptions(self, vector: FeatureVector, minimality: str) -> list[frozenset[int]]:
        """All minimal sets of defaults to give up, by trying every set."""
        defaults = [number for number, rule in enumerate(self.rules) if rule.default]
        restoring = [
            frozenset(chosen)
            for size in range(len(defaults) + 1)
            for chosen in combinations(defaults, size)
            if self.answer_sets(vector, chosen)
        ]
        if minimality == "cardinality":
            return [s for s in restoring if len(s) == min(map(len, restoring))]
        return [s for s in restoring if not any(other < s for other in restoring)]

    def decision(
        self, vector: FeatureVector, minimality: str = "cardinality"
    ) -> tuple[str | None, str]:
        """The class and the verdict."""
        sets = self.preferred(vector, minimality)
        if not sets:
            inconsistent = self.answer_sets(vector, contradictory=True)
            return None, "contradiction" if inconsistent else "no answer set"
        believed = frozenset.intersection(*sets)
        names = [name for name, literal in CLASSES[self.classes].items() if literal in believed]
        if len(names) == 1:
            return names[0], "believed"
        return None, "several classes" if names else "silent"

    def derived(
        self,
        given: Iterable[str],
        rules: Iterable[Rule],
        beliefs: Beliefs,
    ) -> set[str]:
        """What rules derive step by step from literals, ``not`` being read off the beliefs."""
        known = set(given)
        rules = list(rules)
        while True:
            new = {
                rule.concludes
                for rule in rules
                if any(
                    all(
                        _holds(
                            _ground(condition, number),
                            beliefs if condition.startswith("not ") else frozenset(known),
                        )
                        for condition in rule.body
                    )
                    for number in VALUES["n"]
                )
                and not (rule.default and opposite(rule.concludes) in beliefs)
            } - known
            if not new:
                return known
            known |= new


def facts(vector: FeatureVector) -> Iterator[str]:
    """What a scene shows: a value affirms itself and denies the other values."""
    shown = dict(zip(VALUES, vector, strict=True))
    if shown["f"] is not None:
        yield "f(scene)" if shown["f"] == "yes" else "-f(scene)"
    for name in ("g", "n"):
        if shown[name] is not None:
            for value in VALUES[name]:
                yield f"{'' if value == shown[name] else '-'}{name}(scene,{value})"


def solve(program: str, *, contradictory: bool = False) -> list[Beliefs]:
    """All answer sets of a program in clingo's own language."""
    if contradictory:
        program = re.sub(r"-(?=[a-z])", "n_", program)
    control = clingo.Control(["0", "--warn=none"])
    control.add("base", [], program)
    control.ground([("base", [])])
    found: list[Beliefs] = []

    def on_model(model: clingo.Model) -> None:
        symbols = map(str, model.symbols(atoms=True))
        found.append(frozenset(re.sub("^n_", "-", text) for text in symbols) - {"scene(scene)"})

    control.solve(on_model=on_model)
    return found


_SEEN = ("f(S)", "-f(S)", "g(S, dark)", "-g(S, dark)", "g(S, light)", "n(S, 2)", "-n(S, 1)")
_DERIVED = ("p(S)", "-p(S)", "q(S)", "-q(S)", "r(S)", "-r(S)")


@st.composite
def worlds(
    draw: st.DrawFn,
    *,
    defaults: bool = True,
    classes: tuple[str, ...] = ("two", "three"),
    costly: bool = False,
) -> World:
    """Up to six axioms with both negations, comparisons and, if wanted, defaults."""
    literal = st.one_of(st.sampled_from(_SEEN), st.sampled_from(_DERIVED))
    condition = st.one_of(
        literal.map(lambda text: (text,)),
        literal.map(lambda text: (f"not {text}",)),
        st.sampled_from([("n(S, N)", "N > 1"), ("n(S, N)", "N < 3")]),
    )
    rule = st.builds(
        lambda head, parts, default: Rule(
            head, tuple(dict.fromkeys(c for part in parts for c in part)), default
        ),
        st.sampled_from((*_DERIVED, *_DERIVED, "f(S)", "-f(S)")),
        st.lists(condition, max_size=3),
        st.sampled_from((False, False, True)) if defaults else st.just(False),
    )
    rules = draw(st.lists(rule, min_size=1, max_size=6, unique=True))
    return World(
        tuple(rules),
        draw(st.sampled_from(classes)),
        draw(st.tuples(*[st.integers(1, 3)] * 3)) if costly else (1, 1, 1),
    )
