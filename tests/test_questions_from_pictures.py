"""Questions asked of what is annotated of a picture and of what was seen in it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from conftest import Shelf
from seewhy.agent.things.thing_agent import ThingAgent
from seewhy.data.dataset import Dataset
from seewhy.data.thing_scene import thing_scene
from seewhy.dialogue.things.answering import ThingAnswerer
from seewhy.domain.domain import load_domain
from seewhy_lab.commands.questions_from_pictures import Compared, asked_of, compared, main

WORDINGS = {
    "count 0": ["How many blocks are there?"],
    "query 0": ["What color is the ball?", "What color is the block?"],
}


def test_a_wording_is_asked_where_it_has_an_answer() -> None:
    things = load_domain("tabletop").things
    assert things is not None
    scene = thing_scene(things, [{"shape": "cube", "colour": "red"}], relations={})
    generator = np.random.default_rng(0)
    asked = set(asked_of(WORDINGS, scene, ThingAnswerer(things), each=5, generator=generator))
    # There is no ball whose colour could be asked.
    assert asked == {
        ("count 0", "How many blocks are there?", 1),
        ("query 0", "What color is the block?", "red"),
    }


@pytest.mark.parametrize(
    ("annotated", "seen", "right"),
    [(1, 1, True), (1, 2, False), (1, True, False), ("red", None, False), (("a",), ("a",), True)],
)
def test_answers_are_the_same_in_kind(
    annotated: int | str | tuple[str, ...], seen: int | str | None, right: bool
) -> None:
    assert Compared("count 0", "?", annotated, seen).is_right is right


def test_what_a_model_sees_is_asked_the_same(shelf: Shelf) -> None:
    agent = ThingAgent.load(shelf.model)
    dataset = Dataset.load(shelf.data, agent.domain).of_split("test")
    wordings = {"count 0": ["How many shapes are there?"], "exist 0": ["Is there a red shape?"]}
    found = compared(agent, dataset, wordings, each=2, seed=0)
    assert len(found) == 2 * len(dataset)
    assert sum(asked.is_right for asked in found) >= 0.8 * len(found)


def test_the_table_names_kinds_and_the_total(
    shelf: Shelf, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scenes, questions = tmp_path / "scenes.json", tmp_path / "questions.json"
    scenes.write_text(
        json.dumps({"scenes": [{"image_index": 0, "objects": [], "relationships": {}}]})
    )
    asked = {
        "image_index": 0,
        "question": "How many shapes are there?",
        "answer": 0,
        "template_filename": "zero_hop.json",
        "question_family_index": 0,
    }
    questions.write_text(json.dumps({"questions": [asked]}))
    arguments = ["--data", str(shelf.data), "--scenes", str(scenes), "--questions", str(questions)]
    main([str(shelf.model), *arguments])
    told = capsys.readouterr().out
    assert "zero_hop" in told
    assert "12 pictures; " in told

    questions.write_text("{")
    with pytest.raises(SystemExit) as ended:
        main([str(shelf.model), *arguments])
    assert ended.value.code == 2
    assert f"{questions}" in capsys.readouterr().err.replace("\n", "")
