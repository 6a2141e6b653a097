"""Small random knowledge, and what follows from it by the book: clingo's own classical negation.

The programs have negation of both kinds, ``not not``, comparisons, aggregates, conditional
literals, defaults with their exceptions, and loops. What follows is worked out for every scene,
and shares no code with the reasoner.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, product

import clingo

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.language import Knowledge, read_knowledge, read_literal
from seewhy.knowledge.scene import FeatureVector, SceneSchema

__all__ = [
    "FEATURES",
    "JOINT",
    "Beliefs",
    "RandomAxiom",
    "RandomKnowledge",
    "holding",
    "random_knowledge",
]

SIGNATURE = """\
#sort scene.
#sort shade = {dark, light}.
#sort num = 1..3.
#sort mark = {a, b}.
#static f(scene).
#static g(scene, shade).
#static n(scene, num).
#static p(scene).
#static q(scene).
#static r(scene).
#static m(scene, mark).
"""
FEATURES: Mapping[str, tuple[str, ...]] = {
    "f": ("yes", "no"),
    "g": ("dark", "light"),
    "n": ("1", "2", "3"),
}
_CLASSES = {"yes": "p(scene)", "no": "-p(scene)"}
_SHOWN = ("f(S)", "-f(S)", "g(S, dark)", "-g(S, dark)", "g(S, light)", "n(S, 2)", "-n(S, 1)")
_CONCLUDED = ("p(S)", "-p(S)", "q(S)", "-q(S)", "r(S)", "-r(S)", "m(S, a)", "m(S, b)")
_COMPARED = (("n(S, N)", "N > 1"), ("n(S, N)", "N < 3"), ("g(S, X)", "X != dark"))
JOINT = (
    "#count { Y : m(S, Y) } >= 1",
    "#count { Y : m(S, Y) } < 2",
    "#count { Y : m(S, Y) } = 1",
    "#count { Y : m(S, Y), not q(S) } > 0",
    "not #count { Y : m(S, Y) } > 1",
    "#sum { N : n(S, N) } > 1",
    "#sum { 1, f : f(S); 1, q : q(S); 2, r : r(S) } >= 2",
    "#max { N : n(S, N) } < 3",
    "m(S, Y) : mark(Y)",
    "q(S) : m(S, a)",
    "not m(S, Y) : g(S, light), mark(Y)",
    "m(S, _)",
    "not m(S, _)",
    "n(S, 1..2)",
)
_SORTS = "scene(scene). shade(dark; light). num(1..3). mark(a; b)."
Beliefs = frozenset[str]


@dataclass(frozen=True)
class RandomAxiom:
    """One axiom; its variables are S, the scene, and others where it compares."""

    head: str
    body: tuple[str, ...]
    default: bool = False

    def __str__(self) -> str:
        # After 'p(X) : q(X)' a comma would go on with what stands behind the colon.
        body = "; ".join(("scene(S)", *self.body))
        return f"{'default ' if self.default else ''}{self.head} if {body}."


@dataclass(frozen=True)
class RandomKnowledge:
    """Random axioms over three features, and the beliefs that follow by the book."""

    axioms: tuple[RandomAxiom, ...]

    @property
    def source(self) -> str:
        """The text in the knowledge language."""
        return SIGNATURE + "\n".join(map(str, self.axioms)) + "\n"

    @cached_property
    def knowledge(self) -> Knowledge:
        """The knowledge as SeeWhy reads it."""
        return read_knowledge(self.source)

    @cached_property
    def schema(self) -> SceneSchema:
        """The features and the classes p and -p."""
        literals: dict[str, dict[str, Literal]] = {"f": {}}
        literals["f"] = {"yes": read_literal("f(scene)"), "no": read_literal("-f(scene)")}
        for name in ("g", "n"):
            literals[name] = {value: Literal(name, ("scene", value)) for value in FEATURES[name]}
        classes = {name: read_literal(text) for name, text in _CLASSES.items()}
        return SceneSchema("scene", literals, classes, {})

    @cached_property
    def scenes(self) -> list[FeatureVector]:
        """All feature vectors, those with unknown values included."""
        return list(product(*((*values, None) for values in FEATURES.values())))

    def preferred(self, scene: FeatureVector) -> list[Beliefs]:
        """The answer sets under every smallest set of exceptions to defaults (CR-Prolog)."""
        if scene not in self._preferred:
            self._preferred[scene] = self._solve(scene)
        return self._preferred[scene]

    @cached_property
    def _preferred(self) -> dict[FeatureVector, list[Beliefs]]:
        return {}

    def _solve(self, scene: FeatureVector) -> list[Beliefs]:
        defaults = [number for number, axiom in enumerate(self.axioms) if axiom.default]
        for size in range(len(defaults) + 1):
            found = [
                beliefs
                for given_up in combinations(defaults, size)
                for beliefs in self._answer_sets(scene, given_up)
            ]
            if found:
                return found
        return []

    def _answer_sets(self, scene: FeatureVector, given_up: tuple[int, ...]) -> list[Beliefs]:
        if given_up not in self._controls:
            self._controls[given_up] = self._control(given_up)
        control, shown = self._controls[given_up]
        assumed = [
            shown[f"shown({name},{'none' if value is None else value})"]
            for name, value in zip(FEATURES, scene, strict=True)
        ]
        found: list[Beliefs] = []

        def on_model(model: clingo.Model) -> None:
            found.append(frozenset(map(str, filter(_is_belief, model.symbols(atoms=True)))))

        control.solve(assumed, on_model=on_model)
        return found

    @cached_property
    def _controls(self) -> dict[tuple[int, ...], tuple[clingo.Control, dict[str, int]]]:
        return {}

    def _control(self, given_up: tuple[int, ...]) -> tuple[clingo.Control, dict[str, int]]:
        lines = [_SORTS]
        for name, values in FEATURES.items():
            choices = "; ".join(f"shown({name}, {value})" for value in (*values, "none"))
            lines.append(f"1 {{ {choices} }} 1.")
        lines += ["f(scene) :- shown(f, yes).", "-f(scene) :- shown(f, no)."]
        for name in ("g", "n"):
            for value in FEATURES[name]:
                lines.append(f"{name}(scene, {value}) :- shown({name}, {value}).")
                lines.append(
                    f"-{name}(scene, {value}) :- shown({name}, V), V != {value}, V != none."
                )
        for number, axiom in enumerate(self.axioms):
            body = "; ".join(("scene(S)", *axiom.body))
            unless = f"; not {_denied(axiom.head)}" if axiom.default else ""
            lines.append(f"{axiom.head} :- {body}{unless}.")
            if number in given_up:
                lines.append(f"{_denied(axiom.head)} :- {body}.")
        control = clingo.Control(["0", "--warn=none"], logger=lambda *_: None)
        control.add("base", [], "\n".join(lines))
        control.ground([("base", [])])
        shown = {
            str(atom.symbol): atom.literal
            for atom in control.symbolic_atoms.by_signature("shown", 2)
        }
        return control, shown

    def believed(self, scene: FeatureVector) -> Beliefs | None:
        """What all preferred answer sets share; None where there is none."""
        if scene not in self._believed:
            sets = self.preferred(scene)
            self._believed[scene] = frozenset.intersection(*sets) if sets else None
        return self._believed[scene]

    @cached_property
    def _believed(self) -> dict[FeatureVector, Beliefs | None]:
        return {}

    def suffices(self, scene: FeatureVector, features: Iterable[str], belief: str) -> bool:
        """Whether every scene that shares some features' values has a belief, or no answer set."""
        places = [list(FEATURES).index(name) for name in features]
        return all(
            (believed := self.believed(other)) is None or belief in believed
            for other in self.scenes
            if all(other[place] == scene[place] for place in places)
        )


def holding(conditions: Sequence[str], beliefs: Beliefs) -> list[bool]:
    """Return for every condition without free variables whether it holds."""
    lines = [_SORTS, *(f"{belief}." for belief in sorted(beliefs))]
    lines += [f"holds__({number}) :- {text}." for number, text in enumerate(conditions)]
    control = clingo.Control(["--warn=none"], logger=lambda *_: None)
    control.add("base", [], "\n".join(lines))
    control.ground([("base", [])])
    true = {
        atom.symbol.arguments[0].number
        for atom in control.symbolic_atoms.by_signature("holds__", 1)
        if atom.is_fact
    }
    return [number in true for number in range(len(conditions))]


def random_knowledge(generator: random.Random) -> RandomKnowledge:
    """Return between one and eight random axioms.

    Examples
    --------
    >>> known = random_knowledge(random.Random(0))
    >>> known == random_knowledge(random.Random(0))
    True
    """
    axioms = dict.fromkeys(_axiom(generator) for _ in range(generator.randint(1, 8)))
    return RandomKnowledge(tuple(axioms))


def _axiom(generator: random.Random) -> RandomAxiom:
    heads = (*_CONCLUDED, *_CONCLUDED, "f(S)", "-f(S)")
    body: list[str] = []
    for _ in range(generator.choice((0, 1, 1, 2, 2, 3))):
        literal = generator.choice((*_SHOWN, *_CONCLUDED))
        kind = generator.random()
        if kind < 0.4:
            body.append(literal)
        elif kind < 0.7:
            body.append(f"not {literal}")
        elif kind < 0.77:
            body.append(f"not not {literal}")
        elif kind < 0.84:
            body += generator.choice(_COMPARED)
        else:
            body.append(generator.choice(JOINT))
    return RandomAxiom(
        generator.choice(heads), tuple(dict.fromkeys(body)), default=generator.random() < 0.2
    )


def _denied(head: str) -> str:
    return head[1:] if head.startswith("-") else f"-{head}"


def _is_belief(symbol: clingo.Symbol) -> bool:
    return symbol.name in ("f", "g", "n", "p", "q", "r", "m")
