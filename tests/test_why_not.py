"""Looking conditions up says what evaluating them with clingo says."""

from __future__ import annotations

from hypothesis import example, given, settings

from knowledge_builders import CLASSES, Rule, World, worlds
from seewhy.knowledge import nearest_instances as module
from seewhy.knowledge.evidence import evidence_of
from seewhy.knowledge.language import read_literal
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.why_not import shortfall, why_not

NOTHING_OPEN = World((Rule("p(S)", ("f(S)", "not g(S, dark)")), Rule("p(S)", ("-q(S)",))), "three")


@given(world=worlds())
@example(world=NOTHING_OPEN)
@settings(max_examples=25)
def test_looking_up_and_solving_agree(world: World) -> None:
    reasoner = Reasoner(world.knowledge, world.schema)
    literals = [read_literal(text) for text in CLASSES[world.classes].values()]
    looked_up = module._looked_up
    for vector in world.vectors[::5]:
        for literal in literals:
            quick = why_not(reasoner, vector, literal)
            module._looked_up = lambda *_: None  # type: ignore[assignment]
            try:
                assert why_not(reasoner, vector, literal) == quick
            finally:
                module._looked_up = looked_up


@given(world=worlds(defaults=False))
@settings(max_examples=25)
def test_the_shortfall_is_that_of_the_nearest_axiom(world: World) -> None:
    reasoner = Reasoner(world.knowledge, world.schema)
    for vector in world.vectors[::7]:
        evidence = evidence_of(reasoner, vector)
        for text in CLASSES[world.classes].values():
            literal = read_literal(text)
            node = why_not(reasoner, vector, literal)
            if node.holds:
                continue
            nearest = node.children[0] if node.children else None
            expected = None
            if nearest is not None and nearest.axiom is not None:
                rule = world.rule(nearest.axiom.identifier)
                beliefs = frozenset(evidence.holds)
                expected = min(rule.failures(beliefs))
            assert shortfall(evidence, literal) == expected
