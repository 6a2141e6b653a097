"""What notebooks show of results: every part of them, and nothing that a stranger's name says."""

from __future__ import annotations

from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import clingo

from conftest import write_tiles
from seewhy.data.dataset import SHOWN, Dataset
from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Asks, Question
from seewhy.dialogue.reply import Classification, FeatureReading, Reply
from seewhy.domain.domain import Domain
from seewhy.evaluation.redeciding import Redecided
from seewhy.knowledge.justification import Basis, Node
from seewhy.planning.domain import load_planning_domain
from seewhy.planning.execution.execution import execute
from seewhy.planning.goal import read_goal
from seewhy.planning.planner.planner import Plan, PlanStatus
from test_advice import evaluation, good

STRANGE = "<script>alert('x')</script>&"
VOID = {"br", "img"}


class Shown(HTMLParser):
    """The text that HTML shows and the elements that it is made of; they must close in order."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.text: list[str] = []
        self.elements: list[str] = []
        self.open: list[str] = []
        self.feed(html)
        self.close()
        assert not self.open

    def handle_starttag(self, tag: str, attrs: object) -> None:  # noqa: ARG002
        self.elements.append(tag)
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text.append(data)


def test_a_justification_is_a_tree_that_folds() -> None:
    leaf = Node("colour(a)", STRANGE, Basis.FEATURE, probability=0.5)
    shown = Shown(Node("good(a)", "it is good", Basis.AXIOM, children=(leaf,))._repr_html_())
    assert shown.text == ["it is good", f"{STRANGE} (p = 0.50)"]
    assert shown.elements == ["details", "summary", "div", "div"]


def test_a_reply_shows_answer_reasons_and_features() -> None:
    reading = FeatureReading(STRANGE, 0.75)
    seen = Classification("good", "knowledge", (STRANGE,), {"colour": reading}, "decided")
    reason = Node("good(a)", f"because {STRANGE}", Basis.FEATURE)
    question = Question(Asks.EXPLAIN, f"why {STRANGE}", ())
    reply = Reply(question, f"It is {STRANGE}.", "knowledge", reason, AnswerType("why"), seen)
    shown = Shown(reply._repr_html_())
    assert shown.text == [
        *(f"why {STRANGE}?", f"It is {STRANGE}.", "by: knowledge", f"because {STRANGE}"),
        *("feature", "value", "probability", "colour", STRANGE, "0.75"),
    ]
    assert "script" not in shown.elements


def test_a_plan_is_a_numbered_list() -> None:
    actions = (clingo.parse_term('go("<b>")'), clingo.parse_term("stay"))
    shown = Shown(Plan(PlanStatus.FOUND, actions, seconds=0.012)._repr_html_())
    assert shown.text == ["found (12 ms)", 'go("<b>")', "stay"]
    assert shown.elements == ["p", "ol", "li", "li"]


def test_a_plan_that_was_not_found_says_so() -> None:
    assert "unreachable" in Plan(PlanStatus.UNREACHABLE)._repr_html_()


def test_a_run_shows_its_steps() -> None:
    domain = load_planning_domain("tabletop")
    goal = read_goal("on_table(thing5)", domain.knowledge)
    *_, run = execute(domain, goal, sensed=[], act=lambda _: [])
    shown = Shown(run._repr_html_())
    assert run.outcome is not None
    assert shown.text[0] == f"goal: on_table(thing5); {run.outcome.value}"
    assert shown.elements.count("tr") == 1 + len(run.steps)
    going_on = Shown(replace(run, outcome=None)._repr_html_())
    assert going_on.text[0].endswith("; goes on")


def test_a_dataset_shows_its_first_rows(tiles: Domain, tmp_path: Path) -> None:
    write_tiles(tmp_path / "data", count=SHOWN + 2)
    dataset = Dataset.load(tmp_path / "data", tiles)
    scenes = (replace(dataset.scenes[0], group=STRANGE), *dataset.scenes[1:])
    shown = Shown(replace(dataset, scenes=scenes)._repr_html_())
    assert shown.text[0] == f"{SHOWN + 2} pictures, of which the first {SHOWN} are shown"
    assert shown.elements.count("tr") == 1 + SHOWN
    assert STRANGE in shown.text
    few = Shown(dataset.take([0, 1])._repr_html_())
    assert few.text[0] == "2 pictures"


def test_an_evaluation_shows_figures_beside_chance_and_advice() -> None:
    plain = evaluation(seen_in_training=7)
    judged = replace(
        plain,
        feature_recognition={STRANGE: good(300)},
        training_pictures={**plain.training_pictures, STRANGE: {"good": 500, "bad": 500}},
        depended_on={STRANGE: True},
        asked_by_axioms={STRANGE: True},
        redecided=Redecided(0, 0, {STRANGE: 0}, {STRANGE: 0}, 0),
    )
    shown = Shown(judged._repr_html_())
    row = shown.text.index(STRANGE)
    assert shown.text[row : row + 5] == [STRANGE, "100.0 %", "98.7 % to 100.0 %", "50.0 %", "300"]
    assert judged.advice()[0] in shown.text
    assert "script" not in shown.elements
