"""Structures that are asked about block by block: the pictures, and the words of the domain."""

from __future__ import annotations

import numpy as np
import pytest

from seewhy.data.thing_scene import ThingScene, thing_scene
from seewhy.dialogue.scene_conclusions import SceneConclusions
from seewhy.dialogue.things.answering import ThingAnswerer, ThingReply
from seewhy.domain.domain import Domain, load_domain
from seewhy_lab.simulators.structure_stability.annotation import annotate, displaced_blocks
from seewhy_lab.simulators.structure_stability.block_source import (
    NARROW,
    WIDE,
    colour_of,
    draw,
    width_of,
)
from seewhy_lab.simulators.structure_stability.generation import random_structure


@pytest.mark.parametrize("index", range(4))
def test_a_picture_comes_with_its_blocks(index: int) -> None:
    structure = random_structure(np.random.default_rng([5, index]))
    picture, features, label, blocks, related = draw(seed=5, index=index, size=96)
    assert (picture.shape, features, label) == ((96, 96, 3), {}, None)
    said = sorted((row["colour"], row["width"]) for row in blocks)
    assert said == sorted((colour_of(block), width_of(block)) for block in structure.blocks)
    middles = [int(row["left"]) + int(row["right"]) for row in blocks]
    assert middles == sorted(middles)
    assert sum(name == "on" for name, *_ in related) == len(structure.blocks) - 1
    assert sum(name == "beyond" for name, *_ in related) == len(displaced_blocks(structure))
    named = {row["thing"]: row for row in blocks}
    for _, upper, lower in related:
        assert int(named[upper]["top"]) < int(named[lower]["top"])


def test_no_width_is_a_matter_of_opinion() -> None:
    structures = [random_structure(np.random.default_rng([6, index])) for index in range(60)]
    widths = [block.width for structure in structures for block in structure.blocks]
    assert not any(NARROW < width < WIDE for width in widths)
    for structure in structures:
        assert annotate(structure)["base"] == width_of(structure.blocks[0])


@pytest.fixture(scope="module")
def domain() -> Domain:
    return load_domain("structure_blocks")


@pytest.fixture(scope="module")
def scene(domain: Domain) -> ThingScene:
    """Teal lies beyond the edge of red, which lies on green, which lies on purple."""
    things = domain.things
    assert things is not None
    colours = ("red", "green", "purple", "teal")
    blocks = [{"colour": colour, "width": "narrow"} for colour in colours]
    said = {"on": [(3, 0), (0, 1), (1, 2)], "beyond": [(3, 0)]}
    return SceneConclusions(domain).conclude(thing_scene(things, blocks, relations=said))


SAID = {
    "which block is displaced?": "There is one block that is displaced: the teal narrow block.",
    "is the red block on the green block?": (
        "Yes, the red narrow block is on the green narrow block."
    ),
    "what does the teal block lie on?": (
        "There is one block under the teal narrow block: the red narrow block."
    ),
    "what is the red block standing on?": (
        "There is one block under the red narrow block: the green narrow block."
    ),
    "which block stands on the lowest block?": (
        "There is one block on the purple narrow block: the green narrow block."
    ),
    "what would have to be moved?": (
        "There is one block that would have to be moved: the teal narrow block."
    ),
    "which blocks would fall?": "There is one block that would fall: the teal narrow block.",
    "what would happen if the top block were removed?": (
        "The red narrow block would be clear and the structure would be stable."
    ),
    "what would happen if the red block were removed?": (
        "The teal narrow block would fall and the green narrow block would be clear."
    ),
    "is the bottom block displaced?": "No, the purple narrow block is not displaced.",
    "how many blocks are above the purple block?": (
        "There are three blocks above the purple narrow block: the red narrow block, the green "
        "narrow block and the teal narrow block."
    ),
}


@pytest.mark.parametrize("question", SAID)
def test_blocks_are_asked_about(question: str, domain: Domain, scene: ThingScene) -> None:
    assert asked(domain, scene, question).text == SAID[question]


def test_what_would_set_it_right(domain: Domain, scene: ThingScene) -> None:
    fallen = asked(domain, scene, "is any block displaced?")
    assert fallen.text == ("Yes: there is one block that is displaced: the teal narrow block.")
    change = asked(
        domain, scene, "what would have to be otherwise for the answer to be no?", previous=fallen
    )
    assert change.text == (
        "If it were not so that the middle of the teal narrow block lies beyond the edge of the "
        "red narrow block, the answer would be no. One other change as small would do, too."
    )


def asked(
    domain: Domain, scene: ThingScene, question: str, *, previous: ThingReply | None = None
) -> ThingReply:
    assert domain.things is not None
    return ThingAnswerer(domain.things).answer(question, scene, previous=previous)
