"""`make bench`: one justification each, with its text, JSON and picture; nothing is remembered."""

from __future__ import annotations

import json

import pytest
from default_knowledge import default_knowledge, default_schema, scene_with_exception
from wide_knowledge import wide_knowledge, wide_schema, wide_vectors

from seewhy.domain.domain import load_domain
from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.justification import Node
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.why import why
from seewhy.knowledge.why_not import why_not
from seewhy.report.justification import draw_justification


def _structures():
    domain = load_domain("structure_stability")
    reasoner = Reasoner(domain.knowledge, domain.schema)
    vector = domain.vector(
        {"num_blocks": "5", "base": "narrow", "lean": "yes", "block_displaced": "yes"}
    )
    return reasoner, vector, "unstable", "stable"


def _wide():
    reasoner = Reasoner(wide_knowledge(), wide_schema())
    vector = next(
        vector for vector in wide_vectors(500) if reasoner.decide(vector).label is not None
    )
    label = reasoner.decide(vector).label
    other = next(name for name in reasoner.schema.classes if name != label)
    return reasoner, vector, label, other


def _defaults():
    reasoner = Reasoner(default_knowledge(), default_schema())
    vector = scene_with_exception()
    (answer_set,) = reasoner.answer_sets(vector)
    assert answer_set.exceptions
    return reasoner, vector, "unsafe", "safe"


@pytest.fixture(params=[_structures, _wide, _defaults], ids=["structures", "wide", "defaults"])
def scene(request):
    reasoner, vector, label, other = request.param()
    classes = reasoner.schema.classes
    why(reasoner, vector, classes[label])  # grounds the programs
    return reasoner, vector, classes[label], classes[other], other


def _rendered(node: Node | None) -> None:
    assert node is not None
    assert node.to_text()
    assert json.dumps(node.to_dict())
    assert draw_justification(node).svg


def test_why(benchmark, scene):
    reasoner, vector, believed, _, _ = scene
    benchmark.pedantic(
        lambda: _rendered(why(reasoner, vector, believed)),
        setup=reasoner.forget,
        rounds=50,
    )


def test_why_not(benchmark, scene):
    reasoner, vector, _, refused, _ = scene
    benchmark.pedantic(
        lambda: _rendered(why_not(reasoner, vector, refused)),
        setup=reasoner.forget,
        rounds=50,
    )


def test_smallest_change(benchmark, scene):
    reasoner, vector, _, _, label = scene
    finder = ChangeFinder(reasoner)
    assert finder.smallest(vector, label)
    benchmark.pedantic(lambda: finder.smallest(vector, label), setup=reasoner.forget, rounds=50)
