"""Figures and the report: well-formed, escaped, and readable without a network."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest

from conftest import seen, write_domain
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.dialogue.reply import Reply
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import SeeWhyError
from seewhy.evaluation import evaluate
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.justification import Basis, Node
from seewhy.report.figure import Figure, text_lines
from seewhy.report.justification import draw_justification
from seewhy.report.page import report_page
from seewhy.report.tree import draw_tree

SVG = "{http://www.w3.org/2000/svg}"


def texts(figure: Figure) -> list[str]:
    """The words of a figure, line by line; fails where it is not well-formed."""
    root = ElementTree.fromstring(figure.svg)
    assert root.tag == f"{SVG}svg"
    return ["".join(span.itertext()) for span in root.iter(f"{SVG}tspan")]


def widest(figure: Figure) -> float:
    root = ElementTree.fromstring(figure.svg)
    assert all(float(rect.get("width", "0")) > 0 for rect in root.iter(f"{SVG}rect"))
    return max(
        float(rect.get("x", "0")) + float(rect.get("width", "0"))
        for rect in root.iter(f"{SVG}rect")
    )


def test_a_justification_as_a_figure(reasoning: Agent) -> None:
    scene = seen(reasoning, "3", "wide", "no", "yes")
    reply = reasoning.answer(scene, reasoning.questions.understand("why is it unstable?"))
    figure = draw_justification(reply.justification)
    assert " ".join(texts(figure)) == (
        'the structure is unstable: "a block that is not balanced on the one below it falls" '
        "(knowledge.al:11) a block is displaced (p = 0.90)"
    )
    assert widest(figure) <= figure.width


def test_every_answer_can_be_drawn(reasoning: Agent) -> None:
    for vector in (
        ("5", "narrow", "yes", "no"),
        ("5", "narrow", "no", "no"),
        ("2", "wide", "no", "yes"),
    ):
        for question in reasoning.questions.one_of_each():
            node = reasoning.answer(seen(reasoning, *vector), question).justification
            figure = draw_justification(node, width=400)
            assert texts(figure)
            assert widest(figure) <= 400


def test_what_is_drawn_is_escaped() -> None:
    leaf = Node("p", "a < b & 'c' \"d\" <script>", Basis.FEATURE)
    figure = draw_justification(Node("q", "</svg>", Basis.AXIOM, children=(leaf,)))
    assert texts(figure) == ["</svg>", "a < b & 'c' \"d\" <script>"]


def test_deep_and_long_justifications_are_drawn() -> None:
    node = Node("leaf", "w" * 500, Basis.FEATURE)
    for depth in range(60):
        node = Node(str(depth), f"step {depth} " * 8, Basis.AXIOM, children=(node,))
    figure = draw_justification(node)
    assert widest(figure) <= figure.width
    assert "".join(texts(figure)).endswith("w" * 40)


def test_the_tree_as_a_figure(agent: Agent) -> None:
    figure = draw_tree(agent.domain, agent.tree)
    assert texts(figure) == [
        "corners",
        "round",
        "shape?",
        "good: 59 % of 22",
        "bad",
        "bad: 100 % of 9",
        "good",
        "good: 100 % of 13",
    ]
    assert widest(figure) <= figure.width


def test_a_tree_with_unknown_values_is_drawn(tiles: Domain) -> None:
    """A branch that only an unknown value takes says so."""
    tree = DecisionTree({key: feature.values for key, feature in tiles.features.items()})
    scenes = [("red", "no"), ("green", "no"), ("blue", "no"), (None, "no")] * 5
    tree.fit(scenes, ["good", "good", "good", "bad"] * 5)
    assert "not known" in texts(draw_tree(tiles, tree))


def test_no_tree_as_a_figure(tiles: Domain) -> None:
    tree = DecisionTree({key: feature.values for key, feature in tiles.features.items()})
    assert " ".join(texts(draw_tree(tiles, tree))) == (
        "No training scene is left for it: there is no tree."
    )


def test_a_figure_is_saved_as_svg(tmp_path: Path) -> None:
    figure = Figure(width=10, height=20, content=text_lines("a & b", 1, 2, width=9)[0])
    assert figure.save(tmp_path / "deep" / "figure.SVG").read_text() == figure.svg
    assert figure._repr_svg_() == figure.svg
    for name in ("figure.png", "figure"):
        with pytest.raises(SeeWhyError) as problem:
            figure.save(tmp_path / name)
        assert str(problem.value) == (
            f"{tmp_path / name}: figures are saved as .svg; choose a name that ends so"
        )


# The report -----------------------------------------------------------------------------------


class Page(HTMLParser):
    """The elements of a page, checked to be closed in order."""

    VOID = ("meta", "img", "br", "link", "hr", "input")

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.started: list[tuple[str, dict[str, str | None]]] = []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.started.append((tag, dict(attrs)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def page(agent: Agent, dataset: Dataset) -> str:
    evaluation = evaluate(agent, dataset, questions_per_scene=2)
    return report_page(agent, evaluation, _answered(agent, dataset), command="seewhy demo <x>")


def _answered(agent: Agent, dataset: Dataset) -> list[tuple[object, list[Reply]]]:
    answered = []
    for scene in dataset.scenes[:3]:
        classified = agent.classify(scene.picture)
        replies = [agent.answer(classified, q) for q in agent.questions.one_of_each()]
        question = replace(replies[0].question, text="is <b>it</b> & 'that' <script>")
        answered.append((scene, [replace(replies[0], question=question), *replies[1:]]))
    return answered


def test_the_report_needs_no_network(page: str) -> None:
    without_names = page.replace("http://www.w3.org/2000/svg", "")
    assert not re.search(r"https?:|//[a-z]+\.|@import|url\(", without_names)
    for tag, attributes in Page(page).started:
        assert tag not in ("script", "link", "iframe", "object")
        assert attributes.get("src", "data:").startswith("data:")
        assert "href" not in attributes


def test_the_report_has_a_section_for_every_picture(page: str) -> None:
    started = Page(page).started
    assert sum(attributes.get("class") == "scene" for _, attributes in started) == 3
    assert sum(tag == "img" for tag, _ in started) == 3
    assert sum(tag == "details" for tag, _ in started) == 3 * 12


def test_the_report_escapes_what_it_shows(page: str) -> None:
    assert "<script>" not in page
    assert "<b>it</b>" not in page
    assert page.count("is &lt;b&gt;it&lt;/b&gt; &amp; &#39;that&#39; &lt;script&gt;?") == 3
    assert "seewhy demo &lt;x&gt;" in page


def test_the_figures_of_the_report_are_well_formed(page: str) -> None:
    figures = re.findall(r"<svg.*?</svg>", page, flags=re.DOTALL)
    assert len(figures) == 3 * 12 + 1
    for figure in figures:
        ElementTree.fromstring(figure)


def test_the_report_says_what_was_learned_and_known(page: str) -> None:
    for part in (
        "Of 40 training scenes, the knowledge leaves 22 open or gets them wrong.",
        "<li>of the tiles that no rule decides, if the tile is round,"
        " then it is good (1 of 2 features tested, 100 % of 13 tiles)"
        "</li>",
        "<code>good(T) if colour(T, red).</code>",
        "a blue tile with corners is bad",
        "<td>shape</td>",
    ):
        assert part in page


def test_a_title_is_escaped(agent: Agent, dataset: Dataset, tmp_path: Path) -> None:
    from conftest import DOMAIN

    text = DOMAIN.replace('title = "Tiles"', 'title = "<i>Tiles</i> & more"')
    titled = load_domain(write_domain(tmp_path / "tiles", domain=text))
    evaluation = evaluate(agent, dataset, questions_per_scene=1)
    other = Agent(titled)
    other.extractor, other.tree = agent.extractor, agent.tree
    page = report_page(other, evaluation, [], command="seewhy")
    assert "<h1>&lt;i&gt;Tiles&lt;/i&gt; &amp; more</h1>" in page
