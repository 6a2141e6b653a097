"""No, that is wrong, over things: a rule gets an exception, or is added, and all is taken back."""

from __future__ import annotations

import html
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from conftest import Shelf
from seewhy.studio.project import Project
from seewhy.studio.site import site
from studio_builder import RULES, Browser, embed

PICTURE = "images/003.png"
"""A ball lies on a box: untidy, by the rules."""


@pytest.fixture
def shown(shelf: Shelf, tmp_path: Path) -> Project:
    """A project with shapes on a shelf, and a model of them."""
    folder = tmp_path / "shapes"
    shutil.copytree(shelf.data, folder)
    shutil.copytree(shelf.domain, folder / "shelf")
    shutil.copytree(shelf.model, folder / "model")
    return Project(folder)


@pytest.fixture
def asking(shown: Project) -> Iterator[Browser]:
    with TestClient(site(shown, rules=RULES, embed=embed)) as client:
        yield Browser(client)


def knowledge(project: Project) -> str:
    return (project.folder / "shelf" / "knowledge.al").read_text()


def offered(text: str) -> list[tuple[str, str]]:
    """What is offered: the axiom, and the key to take it by."""
    statements = map(html.unescape, re.findall(r"<code>([^<]+)</code>", text))
    return list(zip(statements, re.findall(r'name="key" value="(\w+)"', text), strict=True))


def test_an_exception_is_taken_and_taken_back(asking: Browser, shown: Project) -> None:
    before = knowledge(shown)
    panel = asking.get(f"/ask/doubt?picture={PICTURE}", part=True)
    assert f'hx-get="/ask/doubt/rules?picture={PICTURE}"' in panel
    assert "In truth the picture is" in panel
    assert 'placeholder="it is tidy because there is a red shape"' in panel
    text = asking.get(f"/ask/doubt/rules?picture={PICTURE}", part=True)
    rules = offered(text)
    assert rules
    assert all(statement.startswith("untidy(P) if ") for statement, _ in rules)
    assert "The rule has an exception" in text
    assert "Of 48 annotated pictures, " in text
    assert "pictures would change</summary>" in text
    assert knowledge(shown) == before
    statement, key = rules[0]
    taken = asking.post("/ask/take", picture=PICTURE, key=key)
    number = shown.record.all()[-1].number
    assert f"Kept as entry {number}: the picture is untidy where a ball lies" in taken
    assert statement in knowledge(shown)
    assert "class: untidy, by the rules" not in taken
    back = asking.post("/ask/take-back", picture=PICTURE, number=number)
    assert knowledge(shown) == before
    assert "class: untidy, by the rules" in back


def test_a_reason_makes_a_rule_which_others_give_way_to(asking: Browser, shown: Project) -> None:
    because = "it is tidy because a ball lies on a box"
    text = asking.post("/ask/reason", picture=PICTURE, because=because)
    assert "Gives way: the picture is untidy where a ball lies on something, unless it is" in text
    assert "By the rules, the picture would be tidy." in text
    ((statement, key),) = offered(text)
    taken = asking.post("/ask/take", picture=PICTURE, key=key)
    assert statement in knowledge(shown)
    assert "class: tidy, by the rules" in taken


def test_what_is_wrong_may_be_typed(asking: Browser) -> None:
    because = "No, it is tidy because a ball lies on a box"
    answered = asking.client.post(
        "/ask",
        data={"csrf": asking.csrf, "picture": PICTURE, "question": because},
        headers={"HX-Request": "true"},
    )
    assert answered.headers["HX-Retarget"] == "#doubt"
    assert len(offered(answered.text)) == 1
    panel = asking.post("/ask", picture=PICTURE, question="no, it is tidy")
    assert '<option value="tidy" selected>' in panel
    refused = asking.client.post(
        "/ask/reason", data={"csrf": asking.csrf, "picture": PICTURE, "because": "it is tidy"}
    )
    assert refused.status_code == 422
    refused = asking.client.post(
        "/ask/reason",
        data={"csrf": asking.csrf, "picture": PICTURE, "because": "it is tidy because moo"},
    )
    assert refused.status_code == 422
    assert "is not understood as a reason" in refused.text
    refused = asking.client.get("/ask/doubt", params={"picture": PICTURE, "wanted": "moo"})
    assert "&#39;moo&#39; is no class" in refused.text


def test_rules_about_things_are_judged_by_the_things(asking: Browser, shown: Project) -> None:
    text = asking.get("/rules")
    labels = (shown.folder / "scenes.csv").read_text().count(",untidy,")
    assert f"{labels} of 48 labelled pictures are decided rightly by the rules." in text
    assert f'<span class="good">{labels}</span> pictures speak for it' in text
    assert "In words</a>" in text


def test_a_rule_in_words(asking: Browser, shown: Project) -> None:
    assert 'placeholder="it is tidy because there is a red shape"' in asking.get("/rules/example")
    text = asking.post("/rules/words", because="it is tidy because there is no ball")
    ((statement, key),) = offered(text)
    assert statement == "tidy(S) if picture(S), #count { U : form(U, ball) } = 0."
    assert "Pictures that it rests on:" in text
    assert "Pictures of other classes" not in text
    page = asking.post("/rules/take", part=False, key=key)
    assert statement in html.unescape(page)
    assert statement in knowledge(shown)


def test_a_rule_by_example_is_not_made_of_things(asking: Browser) -> None:
    sent = {"csrf": asking.csrf, "label": "tidy", "shows": ["light=bright"]}
    refused = asking.client.post("/rules/example", data=sent)
    assert refused.status_code == 422
    assert "the domain has things; say the rule in words" in refused.text


def test_rules_are_learned_of_the_labelled_things(asking: Browser, shown: Project) -> None:
    file = shown.folder / "shelf" / "knowledge.al"
    kept = file.read_text().split("%% the picture is untidy")[0]
    file.write_text(kept)
    shown.refresh()
    text = asking.get("/rules/learned", part=True)
    statements = [statement for statement, _ in offered(text)]
    assert any("on(X, Y)" in statement and "ball" in statement for statement in statements)
