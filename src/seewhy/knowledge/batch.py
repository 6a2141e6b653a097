"""Decide several scenes in one call of the solver.

Most of the time that clingo takes for one small scene is the call itself. Where axioms speak of
one scene at a time, a program with a few copies of the scene has for its answer sets the products
of the scenes' answer sets; where it has exactly one, each scene has exactly one, and the call
decides them all. In every other case the scenes are left to be solved one by one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from seewhy.knowledge.axiom import Axiom, Literal
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.program import UNKNOWN, axiom_rules, sort_facts
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.signature import Signature

SCENES = 8
"""Copies of the scene; with more, propagation over all of them outweighs the calls saved."""

Outcome = tuple[str, ...] | None
"""The classes believed in a scene's only answer set; None where it is contradictory."""


class Batch:
    """The program with several copies of the scene, grounded once.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> batch = Batch(domain.knowledge, domain.schema)
    >>> batch.outcomes([domain.vector({"block_displaced": "yes"}), domain.vector({})])
    [('unstable',), ()]
    """

    def __init__(self, knowledge: Knowledge, schema: SceneSchema) -> None:
        self.schema = schema
        self.names = tuple(f"{schema.scene}_{number}__" for number in range(SCENES))
        self.classes = tuple(schema.classes)
        self.control = BoundedControl(
            "\n".join(self._program(knowledge)), size=grounding_size(knowledge).times(SCENES)
        )
        literals = {str(atom.symbol): atom.literal for atom in self.control.atoms}
        self._observed = tuple(
            tuple(
                {
                    (None if value == UNKNOWN else value): literals[
                        f"observed({name},{feature},{value})"
                    ]
                    for value in (*values, UNKNOWN)
                }
                for feature, values in schema.features.items()
            )
            for name in self.names
        )
        self.control.configuration.models = 2

    def outcomes(self, vectors: Sequence[FeatureVector]) -> list[Outcome] | None:
        """Return the outcome of at most :data:`SCENES` scenes, or None where the call cannot tell.

        It cannot where a scene has several answer sets or none for other reasons than a
        contradiction.
        """
        width = len(self.classes) + 1
        # Scenes that are missing to a full batch are filled up with the last one.
        filled = [*vectors, *[vectors[-1]] * (SCENES - len(vectors))]
        assumed = [
            table[value]
            for tables, vector in zip(self._observed, filled, strict=True)
            for table, value in zip(tables, vector, strict=True)
        ]
        models = self.control.solve(
            assumed, on_model=lambda model: [symbol.number for symbol in model.symbols(shown=True)]
        )
        if len(models) != 1:
            return None
        shown = sorted(models[0])
        believed: list[list[str]] = [[] for _ in filled]
        contradictory = [False] * len(filled)
        for number in shown:
            scene, position = divmod(number, width)
            if position == width - 1:
                contradictory[scene] = True
            else:
                believed[scene].append(self.classes[position])
        return [
            None if contradictory[scene] else tuple(believed[scene])
            for scene in range(len(vectors))
        ]

    def _program(self, knowledge: Knowledge) -> Iterator[str]:
        schema, signature = self.schema, knowledge.signature
        yield from sort_facts(signature, schema, scenes=self.names)
        denied = _denied_features(knowledge, schema)

        def of(literal: Literal, name: str) -> Literal:
            """The literal about the scene, said of one of the copies."""
            sorts = signature.predicates[literal.predicate].sorts
            return replace(
                literal,
                arguments=tuple(
                    name if sort == schema.scene else argument
                    for argument, sort in zip(literal.arguments, sorts, strict=True)
                ),
            )

        for name in self.names:
            for feature, values in schema.features.items():
                choices = "; ".join(
                    f"observed({name}, {feature}, {value})" for value in (*values, UNKNOWN)
                )
                yield f"1 {{ {choices} }} 1."
                for value, literal in values.items():
                    seen = f"observed({name}, {feature}, {value})"
                    yield f"holds({of(literal, name)}) :- {seen}."
                    if feature in denied:
                        for other, excluded in values.items():
                            if other != value:
                                yield f"holds({of(excluded.complement, name)}) :- {seen}."
        for axiom in knowledge.axioms:
            yield from axiom_rules(axiom, signature)
        yield from self._conflicts(signature)
        yield "#show."
        width = len(self.classes) + 1
        for scene, name in enumerate(self.names):
            for position, literal in enumerate(schema.classes.values()):
                yield f"#show {scene * width + position} : holds({of(literal, name)})."
            yield f"#show {scene * width + width - 1} : conflict({name})."

    def _conflicts(self, signature: Signature) -> Iterator[str]:
        scene = self.schema.scene
        for predicate in signature.predicates.values():
            arguments = [f"X{number}" for number in range(len(predicate.sorts))]
            inside = f"({', '.join(arguments)})" if arguments else ""
            scene_variable = (
                arguments[predicate.sorts.index(scene)] if scene in predicate.sorts else "S__"
            )
            guard = "" if scene in predicate.sorts else f", sort({scene}, S__)"
            yield (
                f"conflict({scene_variable}) :- holds({predicate.name}{inside}), "
                f"holds(-{predicate.name}{inside}){guard}."
            )


def speaks_of_one_scene(knowledge: Knowledge, schema: SceneSchema) -> bool:
    """Whether no axiom connects two scenes, so that a batch means what its scenes mean alone."""
    return all(_is_local(axiom, knowledge.signature, schema.scene) for axiom in knowledge.axioms)


def _is_local(axiom: Axiom, signature: Signature, scene: str) -> bool:
    about_scenes = {p.name for p in signature.predicates.values() if scene in p.sorts} | {scene}
    named: set[str] = set()
    for literal in (axiom.head, *(c.literal for c in axiom.body if c.literal is not None)):
        sorts = (
            (literal.predicate,)
            if literal.predicate in signature.sorts
            else signature.predicates[literal.predicate].sorts
        )
        named |= {a for a, sort in zip(literal.arguments, sorts, strict=True) if sort == scene}
    # Aggregates and conditional literals may range over scenes; they are not looked into.
    plain = all(
        condition.literal is not None or not any(name in condition.text for name in about_scenes)
        for condition in axiom.body
    )
    in_head = axiom.head.predicate in about_scenes
    return plain and "_" not in named and (len(named) == 1 if in_head else not named)


def _denied_features(knowledge: Knowledge, schema: SceneSchema) -> set[str]:
    """Features of which it matters to classification that unseen values are believed false."""
    mentioned = {axiom.head.predicate for axiom in knowledge.axioms}
    for axiom in knowledge.axioms:
        for condition in axiom.body:
            if condition.literal is None or not condition.literal.positive:
                mentioned |= {name for name in schema.features if name in condition.text}
    mentioned |= {literal.predicate for literal in schema.classes.values()}
    return {
        feature
        for feature, values in schema.features.items()
        if feature in mentioned and all(literal.positive for literal in values.values())
    }
