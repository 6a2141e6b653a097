"""`make bench`: every row decides 1,000 scenes; divide by the time for scenes per second.

"plain clingo" builds, grounds and solves one program per scene, the way that the paper describes.
"""

from __future__ import annotations

import clingo
import pytest
from wide_knowledge import wide_knowledge, wide_schema, wide_vectors

from seewhy.knowledge.program import program_text
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector

SCENES = 1_000


@pytest.fixture(scope="module")
def vectors() -> list[FeatureVector]:
    return wide_vectors(SCENES)


def test_distinct_scenes(benchmark, vectors):
    others = wide_vectors(64, seed=1)

    def fresh():
        reasoner = Reasoner(wide_knowledge(), wide_schema())
        reasoner.decide_all(others)  # grounds the programs
        return (reasoner,), {}

    benchmark.pedantic(lambda reasoner: reasoner.decide_all(vectors), setup=fresh, rounds=15)


def test_repeated_scenes(benchmark, vectors):
    reasoner = Reasoner(wide_knowledge(), wide_schema())
    reasoner.decide_all(vectors)
    benchmark(reasoner.decide_all, vectors)


def test_plain_clingo_one_program_per_scene(benchmark, vectors):
    text = program_text(wide_knowledge(), wide_schema())
    names = list(wide_schema().features)
    classes = {f"holds({literal})".replace(", ", ",") for literal in wide_schema().classes.values()}

    def decide(vector: FeatureVector) -> str | None:
        control = clingo.Control(["--warn=none", "--enum-mode=cautious", "0"])
        seen = "".join(
            f":- not observed({name}, {value}).\n"
            for name, value in zip(names, vector, strict=True)
        )
        control.add("base", [], f"{text}:- not strict.\n{seen}")
        control.ground([("base", [])])
        believed: list[str] = []

        def on_model(model: clingo.Model) -> None:
            believed[:] = [
                symbol for symbol in map(str, model.symbols(atoms=True)) if symbol in classes
            ]

        control.solve(on_model=on_model)
        return believed[0] if len(believed) == 1 else None

    def decide_all() -> list[str | None]:
        return [decide(vector) for vector in vectors]

    plain = benchmark.pedantic(decide_all, rounds=2)
    # The two ways must agree, or the comparison is worth nothing.
    fast = [
        decision.label and f"holds(kind_of(thing,{decision.label}))"
        for decision in Reasoner(wide_knowledge(), wide_schema()).decide_all(vectors)
    ]
    assert plain == fast
