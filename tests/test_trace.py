"""Execution traces: what each component did, as text and as JSON."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from PIL import Image

from conftest import Result, Run, draw_tile, seen, write_domain
from seewhy.agent.agent import Agent
from seewhy.agent.trace import Trace, trace_of
from seewhy.dialogue.reply import UNCERTAIN, UNKNOWN, FeatureReading
from seewhy.domain.domain import load_domain

Tracing = Callable[..., Result]


@pytest.fixture
def traced(run: Run, model_folder: Path, tmp_path: Path) -> Tracing:
    """Trace a tile through the model of the tests."""

    def traced(colour: str, is_round: str, *options: str) -> Result:
        path = tmp_path / "tile.png"
        draw_tile(colour, is_round, 1).save(path)
        return run("trace", model_folder, path, *options)

    return traced


def plain(result: Result) -> str:
    assert (result.code, result.err) == (0, "")
    return re.sub(r"\d\.\d\d", "#", result.out)


KNOWN = """\
Person: WHY is this tile bad??
Agent: The tile is blue, and it has corners.

networks
  colour: blue (p = #)
  shape: no (p = #)

knowledge
  every preferred answer set says that the tile is bad:
    the tile is bad: "a blue tile with corners is bad" (knowledge.al:11)
    ├─ the tile is blue (p = #)
    └─ the tile has corners (p = #)

decision tree
  not asked: the knowledge decides

question
  understood as: why is the tile bad?
  type: why_class, class bad

answer
  found by reasoning
  because of what the knowledge concludes above
"""
LEARNED = """\
Person: is it good?
Agent: Yes, the tile is good.

networks
  colour: green (p = #)
  shape: yes (p = #)

knowledge
  no class follows:
    the knowledge does not decide: no axiom concludes a class
    ├─ it does not follow that the tile is good
    │  └─ does not apply: "a red tile is good" (knowledge.al:8)
    │     └─ but the tile is green (p = #)
    └─ it does not follow that the tile is bad
       └─ does not apply: "a blue tile with corners is bad" (knowledge.al:11)
          ├─ but the tile is green (p = #)
          └─ but the tile is round (p = #)

decision tree
  of the tiles that no rule decides, if the tile is round, then it is good \
(1 of 2 features tested, 100 % of 13 tiles)

question
  understood as: is the tile good?
  type: is_class, class good

answer
  found by the recurrent network (LSTM)
  because:
    the tile is good
    ├─ of the tiles that no rule decides, if the tile is round, then it is good \
(1 of 2 features tested, 100 % of 13 tiles)
    │  └─ the tile is round (p = #)
    ├─ the answer was chosen by the recurrent network (p = # among the answers that fit)
    └─ the knowledge does not decide: no axiom concludes a class
       ├─ it does not follow that the tile is good
       │  └─ does not apply: "a red tile is good" (knowledge.al:8)
       │     └─ but the tile is green (p = #)
       └─ it does not follow that the tile is bad
          └─ does not apply: "a blue tile with corners is bad" (knowledge.al:11)
             ├─ but the tile is green (p = #)
             └─ but the tile is round (p = #)
"""
CLASS_ONLY = """\
networks
  colour: red (p = #)
  shape: no (p = #)

knowledge
  every preferred answer set says that the tile is good:
    the tile is good: "a red tile is good" (knowledge.al:8)
    └─ the tile is red (p = #)

decision tree
  not asked: the knowledge decides

class
  good (p = #), by the knowledge
"""


def test_what_the_knowledge_answers(traced: Tracing) -> None:
    assert plain(traced("blue", "no", "--question", "WHY is this tile bad??")) == KNOWN


def test_what_was_learned_answers(traced: Tracing) -> None:
    assert plain(traced("green", "yes", "-q", "is it good?")) == LEARNED


def test_without_a_question_there_is_the_class(traced: Tracing) -> None:
    assert plain(traced("red", "no")) == CLASS_ONLY


def test_a_program_reads_the_same(traced: Tracing) -> None:
    result = traced("green", "yes", "-q", "what colour is it?", "--json")
    found = json.loads(result.out)
    assert list(found) == [
        "image",
        *("asked", "text", "class", "class_probability", "method"),
        *("networks", "knowledge", "tree", "question", "answer"),
    ]
    assert (found["text"], found["class"]) == ("The tile is green.", "good")
    assert found["networks"]["features"]["colour"]["value"] == "green"
    assert found["networks"]["known"] is True
    assert (found["knowledge"]["verdict"], found["knowledge"]["class"]) == ("silent", None)
    assert found["tree"]["path"]["conditions"] == {"round": ["yes"]}
    assert found["question"] == {
        "text": "what colour is the tile?",
        "type": "feature_value",
        "arguments": {"feature": "colour"},
    }
    assert found["answer"]["found_by"] == "the recurrent network (LSTM)"
    assert json.loads(traced("red", "no", "--json").out)["answer"] is None


def test_the_gate_is_told(traced: Tracing) -> None:
    told = plain(traced("red", "no", "--gate", "1"))
    assert re.search(
        r"not asked: the (colour|shape) is seen with a probability of # only, and # is demanded\n"
        r"\ndecision tree\n  of the tiles that no rule decides, if the tile has corners, "
        r"then it is bad ",
        told,
    )
    assert told.endswith("class\n  bad, by the decision tree\n")


def test_bad_input(traced: Tracing, run: Run, model_folder: Path, tmp_path: Path) -> None:
    result = traced("red", "no", "-q", "what is the meaning of life?")
    assert (result.code, result.out) == (2, "")
    assert result.err.startswith("seewhy: 'what is the meaning of life?' is not understood; ask")
    (tmp_path / "note.png").write_text("hello")
    result = run("trace", model_folder, tmp_path / "note.png")
    assert (result.code, result.out) == (2, "")
    assert "note.png is not a picture of a known type" in result.err
    result = run("trace", tmp_path / "nowhere", tmp_path / "note.png")
    assert (result.code, result.out) == (2, "")
    assert result.err.count("\n") == 1


# What pictures of tiles do not show


def part(found: Trace, name: str) -> str:
    sections = dict(section.split("\n", 1) for section in found.to_text().split("\n\n"))
    return sections[name]


def test_what_is_overruled(agent: Agent) -> None:
    scene = seen(agent, "red", "no")
    overruled = FeatureReading("red", 0.3, ("blue", 0.6))
    found = trace_of(agent, replace(scene, features={**scene.features, "colour": overruled}))
    assert part(found, "networks").splitlines()[0] == (
        "  colour: red (p = 0.30); overruled: the network alone saw blue (p = 0.60), which does "
        "not fit what is known"
    )
    assert found.to_dict()["networks"]["features"]["colour"]["overruled"] == {
        "value": "blue",
        "probability": 0.6,
    }


def test_what_the_witness_saw(agent: Agent) -> None:
    overruled = FeatureReading("red", 0.3, ("blue", 0.6))
    scene = seen(agent, "red", "no")
    scene = replace(
        scene, features={**scene.features, "colour": overruled}, class_seen=("good", 0.97)
    )
    found = trace_of(agent, scene)
    assert part(found, "networks").splitlines() == [
        "  colour: red (p = 0.30); overruled: the network alone saw blue (p = 0.60), which does "
        "not fit what is known and the class that is seen",
        "  shape: no (p = 0.90)",
        "  class: good (p = 0.97), seen by a network of its own; a witness to what the features "
        "are",
    ]
    assert found.to_dict()["networks"]["class_seen"] == {"class": "good", "probability": 0.97}


def test_what_a_question_presumes(agent: Agent) -> None:
    good = seen(agent, "red", "no")
    blue = replace(seen(agent, "blue", "no"), probability=0.25)
    other = [replace(blue, vector=good.vector, features=good.features), blue]
    question = agent.questions.understand("why is it bad?")
    for may_be, said in zip(other, ("the same features", "colour blue"), strict=True):
        scene = replace(good, otherwise=(may_be,))
        found = trace_of(agent, scene, reply=agent.answer(scene, question))
        assert part(found, "answer").splitlines()[0] == (
            f"  supposes what the question presumes: the tile is bad (p = 0.25), with {said}"
        )
        answer = found.to_dict()["answer"]
        assert answer["supposed"] == {"class": "bad", "probability": 0.25}
        assert found.to_dict()["class"] == "good"


def test_a_picture_that_is_not_known(agent: Agent) -> None:
    scene = replace(
        seen(agent, "red", "no"), label=None, method="none", verdict=UNKNOWN, score=0.41
    )
    reply = agent.answer(scene, agent.questions.understand("is it good?"))
    found = replace(trace_of(agent, scene, asked="is it good?", reply=reply), least_likeness=0.9)
    assert part(found, "networks").splitlines()[-1] == (
        "  likeness to pictures of training: 0.410; at least 0.900 is asked for, so the picture "
        "is not known"
    )
    not_asked = "  not asked: the picture is like none that is known"
    assert part(found, "knowledge") == part(found, "decision tree") == not_asked
    assert part(found, "answer").splitlines()[0] == "  found by no component"


def test_where_there_is_no_tree(tmp_path: Path) -> None:
    agent = Agent(load_domain(write_domain(tmp_path / "tiles")))
    found = trace_of(agent, seen(agent, "green", "yes"))
    assert part(found, "decision tree") == (
        "  not asked: there is none, for training left nothing open"
    )
    assert part(found, "class") == "  none: neither the knowledge nor a tree gives one"


def test_an_exception_to_a_default_is_told(tmp_path: Path) -> None:
    knowledge = (
        "#sort tile. #sort hue = {red, green, blue}. #static colour(tile, hue). "
        "#static round(tile). #static good(tile).\n"
        "%% tiles are good\ndefault good(T) if colour(T, C).\n"
        "%% a good tile is round\nround(T) if good(T).\n"
    )
    agent = Agent(load_domain(write_domain(tmp_path / "tiles", knowledge=knowledge)))
    found = trace_of(agent, seen(agent, "blue", "no"))
    assert found.concluded.label == "bad"
    assert part(found, "knowledge").splitlines()[-1] == (
        '  other than usual: "tiles are good" does not hold here'
    )
    assert found.to_dict()["knowledge"]["exceptions"] == ["default good(T) if colour(T, C)."]


def test_an_uncertain_scene_names_the_feature(agent: Agent) -> None:
    scene = seen(agent, "red", "no")
    features = {**scene.features, "round": FeatureReading("no", 0.4)}
    uncertain = replace(
        scene, label="bad", method="tree", verdict=UNCERTAIN, features=features, probability=None
    )
    assert trace_of(agent, uncertain).concluded.not_asked == (
        "the shape is seen with a probability of 0.40 only, and 0.00 is demanded"
    )


def test_grey_pictures_are_traced(agent: Agent, tmp_path: Path) -> None:
    from seewhy.agent.trace import trace

    Image.new("L", (40, 20), 128).save(tmp_path / "grey.png")
    assert trace(agent, tmp_path / "grey.png").to_text().startswith("networks\n  colour: ")
