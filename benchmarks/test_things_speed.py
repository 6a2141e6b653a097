"""`make bench`: scenes of ten things: distinct ones, a justification, and the smallest change.

"plain clingo" builds, grounds and solves one program a scene, of what is seen as facts.
"""

from __future__ import annotations

from collections.abc import Callable

import clingo
import pytest
from things_knowledge import (
    scenes_of_ten,
    set_knowledge,
    set_schema,
    tabletop_knowledge,
    tabletop_schema,
)

from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.program import axiom_rules, sort_facts
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.why import why
from seewhy.knowledge.why_not import why_not

SCENES = 500
World = tuple[Knowledge, SceneSchema]


def _world(knowledge: Callable[[], Knowledge], schema: Callable[[Knowledge], SceneSchema]) -> World:
    known = knowledge()
    return known, schema(known)


@pytest.fixture(
    scope="module",
    params=[(tabletop_knowledge, tabletop_schema), (set_knowledge, set_schema)],
    ids=["tabletop", "set"],
)
def world(request: pytest.FixtureRequest) -> World:
    return _world(*request.param)


def test_distinct_scenes(benchmark, world):
    vectors = scenes_of_ten(world[1], SCENES)
    others = scenes_of_ten(world[1], 64, seed=1)

    def fresh():
        reasoner = Reasoner(*world)
        reasoner.decide_all(others)  # grounds the program
        return (reasoner,), {}

    benchmark.pedantic(lambda reasoner: reasoner.decide_all(vectors), setup=fresh, rounds=3)


def test_plain_clingo_one_program_per_scene(benchmark, world):
    knowledge, schema = world
    vectors = scenes_of_ten(schema, 20)
    rules = "\n".join(
        [
            *sort_facts(knowledge.signature, schema, scenes=(schema.scene,)),
            *(
                rule
                for axiom in knowledge.axioms
                for rule in axiom_rules(axiom, knowledge.signature)
            ),
            ":- holds(L), holds(-L).",
        ]
    )
    classes = {
        f"holds({literal})".replace(", ", ","): name for name, literal in schema.classes.items()
    }

    def decide(vector: FeatureVector) -> str | None:
        seen = [
            literals[value]
            for literals, value in zip(schema.features.values(), vector, strict=True)
            if value is not None
        ]
        facts = "".join(f"holds({literal})." for literal in seen)
        denied = "".join(
            f"holds({other.complement})."
            for literals, value in zip(schema.features.values(), vector, strict=True)
            if value is not None and "no" not in literals
            for name, other in literals.items()
            if name != value
        )
        control = clingo.Control(["--warn=none"])
        control.add("base", [], f"{rules}\n{facts}{denied}")
        control.ground([("base", [])])
        believed: list[str] = []
        control.solve(
            on_model=lambda model: believed.extend(
                classes[text] for text in map(str, model.symbols(atoms=True)) if text in classes
            )
        )
        return believed[0] if len(believed) == 1 else None

    plain = benchmark.pedantic(lambda: [decide(vector) for vector in vectors], rounds=2)
    # The two ways must agree, or the comparison is worth nothing.
    assert plain == [decision.label for decision in Reasoner(*world).decide_all(vectors)]


@pytest.fixture
def scene(world):
    reasoner = Reasoner(*world)
    vectors = scenes_of_ten(world[1], 200)
    vector = next(v for v in vectors if reasoner.decide(v).label is not None)
    label = reasoner.decide(vector).label
    other = next(name for name in world[1].classes if name != label)
    why(reasoner, vector, world[1].classes[label])  # grounds the program
    return reasoner, vector, label, other


def test_why(benchmark, scene):
    reasoner, vector, label, _ = scene
    literal = reasoner.schema.classes[label]
    benchmark.pedantic(
        lambda: why(reasoner, vector, literal).to_text(), setup=reasoner.forget, rounds=10
    )


def test_why_not(benchmark, scene):
    reasoner, vector, _, other = scene
    literal = reasoner.schema.classes[other]
    benchmark.pedantic(
        lambda: why_not(reasoner, vector, literal).to_text(), setup=reasoner.forget, rounds=10
    )


def test_smallest_change(benchmark, world):
    reasoner = Reasoner(*world)
    finder = ChangeFinder(reasoner)
    vectors = scenes_of_ten(world[1], 10, seed=5)
    finder.smallest(vectors[0], next(iter(world[1].classes)))  # grounds the programs
    asked = [
        (vector, label)
        for vector in vectors
        for label in world[1].classes
        if reasoner.decide(vector).label != label
    ]

    left = list(asked)

    def next_question() -> tuple[tuple[FeatureVector, str], dict[str, str]]:
        reasoner.forget()
        return left.pop(), {}

    # Every question is a round of its own: the largest is the longest that anybody waits.
    benchmark.pedantic(finder.smallest, setup=next_question, rounds=len(asked))
