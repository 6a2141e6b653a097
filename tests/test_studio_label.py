"""The page Label: what a key does, what is proposed, what follows, and that all can be undone."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from seewhy.data.dataset import Dataset
from seewhy.revision.edit import Edit
from seewhy.studio import progress
from seewhy.studio.project import Project
from seewhy.studio.proposing import Proposals
from seewhy.studio.site import site
from seewhy.studio.what_next import what_next, why_next
from studio_builder import FRUIT, HTMX, RULES, TABLED, Browser, embed, pictures, with_domain


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(with_domain(pictures(tmp_path / "fruit"), FRUIT))


@pytest.fixture
def tabled(tmp_path: Path) -> Project:
    return Project(with_domain(pictures(tmp_path / "fruit"), TABLED))


@pytest.fixture
def browser(project: Project) -> Iterator[Browser]:
    with TestClient(site(project, rules=RULES, embed=embed)) as client:
        yield Browser(client)


@pytest.fixture
def tabled_browser(tabled: Project) -> Iterator[Browser]:
    with TestClient(site(tabled, rules=RULES, embed=embed)) as client:
        yield Browser(client)


def shown_picture(text: str) -> str:
    found = re.search(r'id="workbench"[^>]*data-picture="([^"]+)"', text)
    assert found
    return found[1]


def rows(project: Project) -> list[str]:
    return (project.folder / "scenes.csv").read_text().splitlines()[1:]


def test_a_value_is_said_and_stands_in_the_table(browser: Browser, project: Project) -> None:
    text = browser.post("/label/set", picture="a.png", choice="colour=red")
    assert shown_picture(text) == "a.png"
    assert rows(project) == ["a.png,,,red,,,"]
    # The next question is at hand: its values have keys.
    assert re.search(r'value="round=yes"[^>]*data-key="1"', text)
    assert 'value="colour=red" class="choice chosen"' in text
    label = project.labels().of["a.png"]["colour"]
    assert (label.how, bool(label.who), label.at[:2]) == ("typed", True, "20")


def test_when_all_is_said_the_next_picture_comes(browser: Browser, project: Project) -> None:
    for choice in ("colour=red", "round=yes"):
        text = browser.post("/label/set", picture="a.png", choice=choice)
        assert shown_picture(text) == "a.png"
    text = browser.post("/label/set", picture="a.png", choice="class=good")
    assert shown_picture(text) != "a.png"
    assert rows(project) == ["a.png,,good,red,yes,,"]


def test_without_scripts_the_same_comes_by_a_page(browser: Browser, project: Project) -> None:
    text = browser.post("/label/set", part=False, picture="a.png", choice="colour=red")
    assert text.startswith("<!doctype html>")
    assert shown_picture(text) == "a.png"
    assert rows(project) == ["a.png,,,red,,,"]


def test_proposals_are_marked_until_enter_confirms_them(browser: Browser, project: Project) -> None:
    for name, colour in (("a.png", "red"), ("b.png", "green")):
        browser.post("/label/set", picture=name, choice=f"colour={colour}")
    text = browser.get("/label?picture=d.png", part=True)
    assert 'value="colour=green" class="choice proposed" aria-pressed="false"' in text
    assert project.labels().value("d.png", "colour") is None
    assert "d.png" not in (project.folder / "scenes.csv").read_text()
    browser.post("/label/confirm", picture="d.png")
    label = project.labels().of["d.png"]["colour"]
    assert (label.value, label.how) == ("green", "confirmed")
    assert "confirmed by" in browser.get("/label?picture=d.png", part=True)


def test_nothing_is_proposed_of_what_shows_one_value(browser: Browser) -> None:
    browser.post("/label/set", picture="a.png", choice="colour=red")
    text = browser.get("/label?picture=b.png", part=True)
    assert "choice proposed" not in text
    assert "Nothing is proposed" in text
    assert "nothing is proposed yet" in browser.post("/label/confirm", picture="b.png")


def test_undo_has_no_end_and_can_be_undone(browser: Browser, project: Project) -> None:
    for choice in ("colour=red", "colour=green", "round=no"):
        browser.post("/label/set", picture="b.png", choice=choice)
    browser.get("/label?picture=a.png")
    assert shown_picture(browser.post("/label/undo")) == "b.png"
    assert project.labels().values("b.png") == {"colour": "green"}
    browser.post("/label/undo")
    assert project.labels().values("b.png") == {"colour": "red"}
    browser.post("/label/undo")
    assert project.labels().of.get("b.png", {}) == {}
    assert "nothing is left" in browser.post("/label/undo")
    for expected in ({"colour": "red"}, {"colour": "green"}, {"colour": "green", "round": "no"}):
        browser.post("/label/redo")
        assert project.labels().values("b.png") == expected
    assert "nothing was taken back" in browser.post("/label/redo")


def test_a_revision_of_the_rules_is_taken_back_by_the_same_key(
    browser: Browser, project: Project
) -> None:
    knowledge = project.folder / "fruit" / "knowledge.al"
    before = knowledge.read_text()
    browser.post("/label/set", picture="a.png", choice="colour=red")
    project.revise([Edit("knowledge.al", 0, "", "% said by Ada\n")], why="a remark", who="Ada")
    text = browser.post("/label/undo")
    assert "taken back: knowledge.al: a remark" in text
    assert knowledge.read_text() == before
    assert "brought back: knowledge.al: a remark" in browser.post("/label/redo")
    assert knowledge.read_text() == "% said by Ada\n" + before
    browser.post("/label/undo")
    browser.post("/label/undo")
    assert rows(project) == []
    # What another program wrote is not undone by a key.
    knowledge.write_text("% by an editor\n" + before)
    project.refresh()
    assert "nothing is left to take back" in browser.post("/label/undo")
    assert knowledge.read_text().startswith("% by an editor")


def test_after_a_new_label_nothing_is_brought_back(browser: Browser, project: Project) -> None:
    browser.post("/label/set", picture="a.png", choice="colour=red")
    browser.post("/label/undo")
    browser.post("/label/set", picture="a.png", choice="round=no")
    assert "nothing was taken back" in browser.post("/label/redo")
    assert project.labels().values("a.png") == {"round": "no"}


def test_features_follow_from_the_class(tabled_browser: Browser, tabled: Project) -> None:
    text = tabled_browser.post("/label/set", picture="a.png", choice="class=good")
    assert shown_picture(text) != "a.png"
    assert rows(tabled) == ["a.png,,good,red,yes,,"]
    assert tabled.labels().of["a.png"]["colour"].how == "follows"
    tabled_browser.post("/label/set", picture="a.png", choice="class=spoilt")
    assert rows(tabled) == ["a.png,,spoilt,green,no,,"]
    tabled_browser.post("/label/undo")
    tabled_browser.post("/label/undo")
    assert tabled.labels().of.get("a.png", {}) == {}


def test_what_somebody_said_stays_when_the_class_changes(
    tabled_browser: Browser, tabled: Project
) -> None:
    tabled_browser.post("/label/set", picture="a.png", choice="colour=green")
    tabled_browser.post("/label/set", picture="a.png", choice="class=good")
    assert tabled.labels().values("a.png") == {"colour": "green", "class": "good", "round": "yes"}
    tabled_browser.post("/label/set", picture="a.png", choice="class=")
    assert tabled.labels().values("a.png") == {"colour": "green"}


def test_reasons_go_on_and_off(browser: Browser, project: Project) -> None:
    for choice in ("colour=red", "round=yes", "class=good"):
        browser.post("/label/set", picture="a.png", choice=choice)
    browser.get("/label?picture=a.png")
    browser.post("/label/reason", picture="a.png", feature="colour")
    assert rows(project) == ["a.png,,good,red,yes,,colour"]
    browser.post("/label/reason", picture="a.png", feature="round")
    assert rows(project) == ["a.png,,good,red,yes,,colour round"]
    browser.post("/label/reason", picture="a.png", feature="colour")
    browser.post("/label/undo")
    assert rows(project) == ["a.png,,good,red,yes,,colour round"]


def test_previous_and_next_lead_where_one_was(browser: Browser) -> None:
    first = shown_picture(browser.get("/label"))
    second = shown_picture(browser.get("/label?go=on", part=True))
    third = shown_picture(browser.get("/label?go=on", part=True))
    assert len({first, second, third}) == 3
    assert shown_picture(browser.get("/label?go=back", part=True)) == second
    assert shown_picture(browser.get("/label?go=back", part=True)) == first
    assert shown_picture(browser.get("/label?go=on", part=True)) == second


def test_the_first_pictures_differ(browser: Browser) -> None:
    assert browser.proposer.settle(120)
    order = [name for name, _ in browser.proposer.latest().order]
    # a, c and e are red, b, d and f are green: one of each comes first.
    assert {"ace".find(name[0]) >= 0 for name in order[:2]} == {True, False}


def test_why_a_picture_is_next_is_said(browser: Browser) -> None:
    assert browser.proposer.settle(120)
    text = browser.get("/label")
    first = shown_picture(text)
    assert "Worth a label: many pictures are like it." in text
    value = "spoilt" if first[0] in "bdf" else "good"
    for choice in (f"class={value}", "colour=red", "round=yes"):
        browser.post("/label/set", picture=first, choice=choice)
    assert browser.proposer.settle(120)
    assert "Worth a label: it is unlike what is labelled." in browser.get("/label")
    assert "Worth a label" not in browser.get(f"/label?picture={first}")


def test_before_pictures_are_looked_at_the_first_are_of_everywhere(tmp_path: Path) -> None:
    """Neighbours in a folder are alike, and no chance has a say."""
    project = Project(with_domain(pictures(tmp_path / "p", 8)))
    order = list(what_next(project.pictures(), project.labels(), project.domain(), Proposals()))
    assert order[:8] == [f"{letter}.png" for letter in "aecgbfdh"]
    said = why_next("e.png", project.labels(), project.domain(), Proposals())
    assert said == "Next by its place in the folder: it is not looked at yet."


def test_news_come_only_where_there_are_any(browser: Browser) -> None:
    assert browser.proposer.settle(120)
    browser.get("/label?picture=a.png")
    version = browser.proposer.latest().version
    path = "/label/news?picture=a.png&version="
    assert browser.client.get(f"{path}{version}", headers=HTMX).status_code == 204
    assert browser.client.get(f"{path}{version - 1}", headers=HTMX).status_code == 200


def test_many_at_once(browser: Browser, project: Project) -> None:
    browser.post(
        "/label/many", part=False, feature="colour", value="red", picture=["a.png", "c.png"]
    )
    assert rows(project) == ["a.png,,,red,,,", "c.png,,,red,,,"]
    text = browser.get("/label/sheet?feature=colour&value=red")
    assert 'value="b.png"' in text
    assert 'value="a.png"' not in text
    assert 'value="a.png"' in browser.get("/label/sheet?feature=colour&value=red&which=said")
    browser.post("/label/undo")
    assert project.labels().of.get("a.png", {}) == {}
    assert project.labels().of.get("c.png", {}) == {}


def test_the_most_probable_come_first_on_the_sheet(browser: Browser) -> None:
    for name, colour in (("a.png", "red"), ("b.png", "green")):
        browser.post("/label/set", picture=name, choice=f"colour={colour}")
    text = browser.get("/label/sheet?feature=colour&value=green")
    names = re.findall(r'type="checkbox" name="picture" value="([^"]+)"', text)
    assert set(names[:2]) == {"d.png", "f.png"}
    assert set(names[2:]) == {"c.png", "e.png"}


def test_the_page_says_when_to_go_on_to_train(
    browser: Browser, project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert "Proposals come as soon as pictures of two classes" in browser.get("/label")
    for name, colour, label in (
        ("a.png", "red", "good"),
        ("b.png", "green", "spoilt"),
        ("c.png", "red", "good"),
        ("d.png", "green", "spoilt"),
    ):
        project.label({name: {"colour": colour, "round": "yes", "class": label}}, who="Ada")
    assert browser.proposer.settle(120)
    assert "recognise the class of" not in browser.get("/label")  # so few say nothing
    monkeypatch.setattr(progress, "_FEWEST", 4)
    text = browser.get("/label")
    assert re.search(r"recognise the class of \d+ % of the labelled pictures", text)
    assert '<a href="/train">' in text
    assert "Proposals come as soon as" not in text


def test_progress_says_what_would_help(browser: Browser) -> None:
    for choice in ("colour=red", "round=yes", "class=good"):
        browser.post("/label/set", picture="a.png", choice=choice)
    text = browser.get("/label/progress")
    assert "1 of 6 pictures are labelled" in text
    assert "No picture to train on shows the class spoilt" in text


def test_the_history_says_who_and_takes_back(browser: Browser, project: Project) -> None:
    browser.post("/settings", who="Ada Lovelace", back="/label")
    browser.post("/label/set", picture="a.png", choice="colour=red")
    text = browser.get("/label/history")
    assert "Ada Lovelace" in text
    number = project.record.all()[-1].number
    browser.post("/label/take-back", part=False, number=number)
    assert project.labels().of.get("a.png", {}) == {}
    assert "(taken back)" in browser.get("/label/history")
    again = browser.client.post("/label/take-back", data={"csrf": browser.csrf, "number": number})
    assert again.status_code == 422


@pytest.mark.parametrize(
    ("path", "fields", "said"),
    [
        ("/label/set", {"picture": "z.png", "choice": "colour=red"}, "no picture of the project"),
        ("/label/set", {"picture": "a.png", "choice": "colour=rad"}, "did you mean"),
        ("/label/set", {"picture": "a.png", "choice": "color=red"}, "did you mean"),
        ("/label/reason", {"picture": "a.png", "feature": "colours"}, "did you mean"),
        ("/label/many", {"picture": ["../x"], "feature": "colour", "value": "red"}, "no picture"),
    ],
)
def test_what_cannot_be_said(
    browser: Browser, project: Project, path: str, fields: dict[str, object], said: str
) -> None:
    before = len(project.record.all())
    answered = browser.client.post(path, data={"csrf": browser.csrf, **fields}, headers=HTMX)
    assert answered.status_code == 422
    assert said in answered.text
    assert answered.headers["HX-Retarget"] == "#problem"
    assert len(project.record.all()) == before


def test_what_was_labelled_trains(browser: Browser, project: Project) -> None:
    browser.post("/label/set", picture="a.png", choice="colour=red")
    (scene,) = Dataset.load(project.folder, project.domain()).scenes
    assert project.domain().named(scene.vector) == {"colour": "red", "round": None}
