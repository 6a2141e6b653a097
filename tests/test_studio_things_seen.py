"""A project with things in the studio: trained by boxes, asked about, evaluated."""

from __future__ import annotations

import html
import json
import re
import shutil
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from fastapi.testclient import TestClient

from conftest import Shelf, trained_shelf
from seewhy.perception.backbones import embedded
from seewhy.perception.backbones.embedded import SIDE
from seewhy.studio import jobs
from seewhy.studio.drawing import draw, say_of_thing
from seewhy.studio.jobs import Jobs, jobs_of
from seewhy.studio.keeping_back import keep_back, kept, place
from seewhy.studio.project import Project
from seewhy.studio.site import site
from studio_browsing import NEEDS_CHROMIUM, hindrances, served
from studio_builder import RULES, Browser, embed, ended_job
from test_studio_share import is_whole
from thing_pictures import piles

if TYPE_CHECKING:
    from playwright.sync_api import Browser as Chromium


@pytest.fixture(scope="module")
def shelf(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Shelf]:
    """A model that processes of the studio read, which see all pixels."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(embedded, "SIDE", SIDE)
        yield trained_shelf(tmp_path_factory.mktemp("things"))


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(piles(tmp_path / "p", 14))


@pytest.fixture
def browser(project: Project) -> Iterator[Browser]:
    with TestClient(site(project, rules=RULES, embed=embed)) as client:
        yield Browser(client)


def draw_in(project: Project, start: int, end: int) -> None:
    """Draw a red block in some of the pictures, and say all of it."""
    for name in project.pictures()[start:end]:
        thing = draw(project, name, (20, 50, 60, 90), who="Ada")
        say_of_thing(project, name, thing, "colour", "red", who="Ada")
        say_of_thing(project, name, thing, "round", "no", who="Ada")


def test_what_training_on_things_lacks_is_said(browser: Browser, project: Project) -> None:
    text = browser.get("/train")
    assert "no block is drawn yet; draw a box around each in at least 10 pictures" in text
    assert "classes" not in text
    thing = draw(project, "a.png", (20, 50, 60, 90), who="Ada")
    assert "no thing with a box has a value of" in browser.get("/train")
    say_of_thing(project, "a.png", thing, "colour", "red", who="Ada")
    say_of_thing(project, "a.png", thing, "round", "no", who="Ada")
    text = browser.get("/train")
    assert "1 picture has a box around each thing; to find things, at least 10 are needed" in text
    refused = browser.client.post("/train", data={"csrf": browser.csrf})
    assert refused.status_code == 422
    assert "at least 10 are needed" in refused.text
    assert not project.record.holding(jobs.JOB)


def test_pictures_with_boxes_are_counted_and_a_quarter_is_kept(
    browser: Browser, project: Project
) -> None:
    draw_in(project, 0, 12)
    draw(project, "m.png", None, who="Ada")  # a box in the middle
    table = project.folder / "things.csv"
    table.write_text(table.read_text() + "n.png,1,,,,,red,no\n")  # a thing without a box
    project.label({"n.png": {"class": "stable"}}, who="Ada")
    assert "13 pictures with a box around each block" in browser.get("/train")
    browser.post("/train/keep-back", part=False)
    things = project.domain().things
    assert kept(project.labels(), things) == {"train": 10, "test": 3}
    rows = project.labels().rows
    assert rows["n.png"]["split"] == "train"
    assert "10 pictures with a box" in browser.get("/train")
    assert "3 more are kept for evaluation" in browser.get("/train")


def test_what_is_drawn_later_is_placed_when_training_begins(project: Project) -> None:
    draw_in(project, 0, 8)
    keep_back(project, who="Ada")
    draw_in(project, 8, 14)
    place(project, who="Ada")
    labels = project.labels()
    assert set(labels.rows) == set(project.pictures())
    assert kept(labels, project.domain().things) == {"train": 10, "test": 4}


def test_training_on_things_is_the_same_command(
    browser: Browser, project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    draw_in(project, 0, 14)
    begun: list[Any] = []
    monkeypatch.setattr(
        Jobs, "start", lambda _, *said, **options: begun.append((*said, options["asked"]))
    )
    browser.post("/train", part=False)
    task, module, said, asked = begun[0]
    assert (task, module) == ("train", "seewhy")
    assert said == ["train", "piles", "--data", ".", "--out", "model"]
    assert asked["pictures"] == 14


# Asking ---------------------------------------------------------------------------------------


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


PICTURE = "images/003.png"


def suggested(text: str) -> list[str]:
    return [html.unescape(one) for one in re.findall(r'name="question" value="([^"]+)"', text)]


def shown_rows(project: Project) -> list[str]:
    """The rows of the things of the picture, from the left to the right."""
    rows = (project.folder / "things.csv").read_text().splitlines()
    found = [row for row in rows if row.startswith(PICTURE)]
    return sorted(found, key=lambda row: sum(map(float, row.split(",")[2:5:2])))


def count_of(project: Project, value: str = "") -> int:
    rows = (project.folder / "things.csv").read_text().splitlines()
    return sum(row.startswith(PICTURE) and value in row for row in rows)


def test_what_was_seen_of_each_thing_is_shown(asking: Browser, shown: Project) -> None:
    text = asking.get(f"/ask?picture={PICTURE}")
    count = count_of(shown)
    assert text.count('<rect class="line"') >= count
    assert len(re.findall(r'<th scope="row"><a href="[^>]*>\d: ', text)) == count
    assert re.search(r"<td>(small|large) <span class=\"soft\">\d+ %</span></td>", text)
    assert 'viewBox="0 0 128 96"' in text
    assert 'text-anchor="end"' in text  # a name at the right is not cut off
    assert "Sure." in text or "Not sure: " in text
    assert "what is there?" in text
    assert "/ask/where" not in text
    assert re.findall(r'<span class="holds" data-of="(\d)" tabindex="0">', text) == [
        str(number) for number in range(count)
    ]


def test_questions_are_answered_in_one_conversation(asking: Browser, shown: Project) -> None:
    asked = {"picture": PICTURE}
    text = asking.post("/ask", **asked, question="how many red shapes are there?")
    reds = count_of(shown, ",red,")
    assert re.search(
        rf'<p class="text">[^<]*\b({reds}|{["no", "one", "two", "three", "four"][reds]})\b', text
    )
    assert 'class="tree"' in text
    assert "chosen" in text or not reds
    text = asking.post("/ask", **asked, question="and the blue ones?")
    assert "blue" in re.findall(r'<p class="text">([^<]+)', text)[0]
    text = asking.post("/ask", **asked, question="why?")
    assert text.count('<li><span class="soft">') == 2
    refused = asking.client.post("/ask", data={"csrf": asking.csrf, **asked, "question": "moo"})
    assert refused.status_code == 422
    assert asking.get("/ask").count('<li><span class="soft">') == 2  # the talk goes on
    other = asking.get("/ask?picture=images/004.png")
    assert '<li><span class="soft">' not in other
    refused = asking.client.post("/ask", data={"csrf": asking.csrf, **asked, "question": " "})
    assert "nothing is asked" in refused.text


def test_every_question_that_is_suggested_is_answered(asking: Browser) -> None:
    first = suggested(asking.get(f"/ask?picture={PICTURE}"))
    assert "how many shapes are there?" in first
    assert "why?" in first
    assert 4 <= len(first) <= 7
    for question in first:
        asking.post("/ask", picture=PICTURE, question="what is there?")
        asking.post("/ask", picture=PICTURE, question=question)
    following = suggested(asking.post("/ask", picture=PICTURE, question="how many red shapes?"))
    assert any(one.startswith("and the ") for one in following)
    assert "and the red ones?" not in following


def test_a_rule_that_is_revised_holds_at_once(asking: Browser, shown: Project) -> None:
    before = asking.get(f"/ask?picture={PICTURE}")
    assert "contradicts the knowledge" not in before
    file = shown.folder / "shelf" / "knowledge.al"
    file.write_text(file.read_text() + "tidy(P) if picture(P).\nuntidy(P) if tidy(P).\n")
    shown.refresh()
    assert "contradicts the knowledge" in asking.get(f"/ask?picture={PICTURE}")


def test_a_model_that_was_trained_for_other_features_says_so(
    asking: Browser, shown: Project
) -> None:
    file = shown.folder / "shelf" / "domain.toml"
    file.write_text(file.read_text().replace('measure = "left"', 'measure = "seen"'))
    shown.refresh()
    assert "were changed since the model was trained" in asking.get(f"/ask?picture={PICTURE}")


def test_what_is_missing_for_asking_is_a_sentence(
    browser: Browser, project: Project, model_folder: Path
) -> None:
    assert "There is no model yet: draw boxes and train." in browser.get("/ask")
    shutil.copytree(model_folder, project.folder / "model")
    text = browser.get("/ask")
    assert "The model is of one thing in a picture, and the domain has several: train anew." in text
    refused = browser.client.post(
        "/ask", data={"csrf": browser.csrf, "picture": "a.png", "question": "what is there?"}
    )
    assert refused.status_code == 422
    assert "train anew" in refused.text


def test_answers_about_things_are_a_whole_file(asking: Browser, shown: Project) -> None:
    address = f"/share/answers.html?picture={PICTURE}"
    nothing = asking.client.get(address)
    assert nothing.status_code == 422
    assert f"nothing was asked of {PICTURE} yet" in nothing.text
    assert address in asking.get(f"/ask?picture={PICTURE}")
    asking.post("/ask", picture=PICTURE, question="how many red shapes are there?")
    assert f"2 answers about {PICTURE}, with the reasons and where each thing is" in asking.get(
        "/share"
    )
    kept = is_whole(asking.client, address, "003.html")
    assert kept.count("<image") == 1  # the picture stands once, and is shown twice
    assert kept.count("href='#picture'") == 2
    assert kept.count("class='box-") == 2 * count_of(shown)
    assert "<h2>how many red shapes are there?</h2>" in kept
    assert re.search(r'class="holds of-\d" tabindex="0">[^<]* red', kept)


def test_what_if_is_a_function_of_its_address(asking: Browser, shown: Project) -> None:
    address = f"/ask/what-if?picture={PICTURE}"
    text = asking.get(f"/ask?picture={PICTURE}")
    count = count_of(shown)
    boxes = re.findall(
        rf'class="box" data-number="(\d)" href="{re.escape(address)}&amp;go=(\d)"', text
    )
    assert boxes == [(str(number), str(number + 1)) for number in range(count)]
    assert "As it was seen" not in text
    asking.post("/ask", picture=PICTURE, question="how many red shapes are there?")
    reds = count_of(shown, ",red,")
    fields = "&".join(f"shows.{number + 1}.colour=red" for number in range(count))
    then = asking.get(f"{address}&{fields}&gone=1&at=2&more=1", part=True)
    assert then.startswith('<section id="what-if"')
    said = re.findall(r'<p class="small soft">If (.*?):</p>', then)
    assert said[0].count(" were red") == count - reds
    assert "were not there" in said[0]
    words = ["no", "one", "two", "three", "four", "five"]
    assert f"<strong>There are {words[count]} red shapes: " in then
    assert f'<input type="hidden" name="at" value="{count + 1}">' in then
    assert '<input type="hidden" name="gone" value="1">' in then
    assert "taken away</a>" in then
    # The picture has the boxes as they are supposed to be.
    assert '<svg id="read-boxes"' in then
    assert then.count('hx-swap-oob="true"') == 1
    one = r'<a id="box-\d".*?<g class="([^"]*)">.*?<text[^>]*>([^<]*)'
    drawn = re.findall(one, then, re.DOTALL)
    assert [kind.split()[-1] for kind, _ in drawn].count("gone") == 1
    assert drawn[0][0].endswith("gone")
    assert sum(kind.endswith("changed") for kind, _ in drawn[1:]) == sum(
        ",blue," in row for row in shown_rows(shown)[1:]
    )
    assert all("red" in name for kind, name in drawn if kind.endswith("changed"))
    assert "By the rules the picture would " in then
    kept = asking.post("/ask", picture=PICTURE, question="how many shapes are there?", gone="1")
    assert f"<strong>There are {words[count - 1]} shapes: " in kept
    assert kept.count('<path class="halo"') == 1
    assert "hx-swap-oob" not in kept
    page = asking.get(f"{address}&gone=1")
    assert "<h1>What if</h1>" in page
    assert page.count('<path class="halo"') == 1
    assert '<path class="halo"' not in asking.get(f"/ask?picture={PICTURE}")
    refused = asking.client.get(f"{address}&shows.1.colour=mauve")
    assert refused.status_code == 422
    assert "&#39;mauve&#39; is no value of &#39;colour&#39;" in refused.text


def test_a_misread_value_is_one_more_label_and_is_taken_back(
    asking: Browser, shown: Project
) -> None:
    """In a picture that is annotated: the label of the thing whose box it is."""
    asked = {"picture": PICTURE}
    before = asking.post("/ask", **asked, question="how many red shapes are there?")
    panel = asking.post("/ask", **asked, question="no, that is wrong")
    assert "No box is drawn" not in panel
    assert asking.client.get("/ask/doubt", params=asked).status_code == 200
    place, value = next(
        (number, value)
        for number, value in re.findall(r'<option value="(\d)\.colour=(red|blue)"', panel)
    )
    drawn, held = shown.labels().drawn_in(PICTURE), len(shown.record.holding())
    text = asking.post("/ask/correct", **asked, choice=f"{place}.colour={value}")
    number = shown.record.all()[-1].number
    assert f"Kept as entry {number}. What sees learns from it" in text
    assert "are kept with it" not in text
    changed = [
        (name, thing)
        for name, thing in shown.labels().drawn_in(PICTURE).things.items()
        if thing != drawn.things[name]
    ]
    assert [thing.values["colour"].value for _, thing in changed] == [value]
    assert f"{PICTURE},{changed[0][0]}," in (shown.folder / "things.csv").read_text()
    after = re.findall(r'<p class="text">([^<]+)', text)
    assert after != re.findall(r'<p class="text">([^<]+)', before)
    assert f'<td>{value} <span class="soft">100 %</span></td>' in text
    assert "Taken back" in asking.post("/ask/take-back", **asked, number=number)
    assert shown.labels().drawn_in(PICTURE) == drawn
    assert len(shown.record.holding()) == held


def test_where_nothing_is_drawn_all_that_was_found_is_kept(asking: Browser, shown: Project) -> None:
    things = shown.folder / "things.csv"
    rows = things.read_text().splitlines()
    relations = shown.folder / "relations.csv"
    for file in (relations, things):
        kept = [row for row in file.read_text().splitlines() if not row.startswith(PICTURE)]
        file.write_text("\n".join(kept) + "\n")
    shown.refresh()
    asked = {"picture": PICTURE}
    panel = asking.get(f"/ask/doubt?picture={PICTURE}", part=True)
    assert "the boxes of all shapes are kept as they were found" in panel
    text = asking.post("/ask/correct", **asked, choice="gone.1")
    assert "The boxes of all other shapes are kept with it, as they were found." in text
    count = sum(row.startswith(PICTURE) for row in rows)
    assert sorted(shown.labels().drawn_in(PICTURE).things) == list(map(str, range(2, count + 1)))
    assert len(re.findall(r'<th scope="row"><a href="[^>]*>\d: ', text)) == count - 1
    for left in range(count - 1, 0, -1):
        text = asking.post("/ask/correct", **asked, choice=f"gone.{left}")
    assert "No shape is left: the picture is said to show none." in text
    assert shown.labels().drawn_in(PICTURE).none
    assert any(scene.no_things for scene in shown.dataset().scenes)
    assert "No shape was found." in text
    refused = asking.client.post(
        "/ask/correct", data={"csrf": asking.csrf, **asked, "choice": "gone.1"}
    )
    assert refused.status_code == 422
    assert "there is no shape 1 in what was read" in refused.text


def test_what_was_missed_is_drawn_beside_what_was_found(
    browser: Browser, asking: Browser, shown: Project
) -> None:
    picture = shown.pictures()[0]
    drawn = shown.labels().drawn_in(picture)
    answered = asking.client.post(
        "/ask/missing", data={"csrf": asking.csrf, "picture": picture}, follow_redirects=False
    )
    assert answered.headers["Location"] == f"/label?picture={picture.replace('/', '%2F')}"
    assert shown.labels().drawn_in(picture) == drawn  # it has boxes already
    refused = browser.client.post("/ask/missing", data={"csrf": browser.csrf, "picture": "a.png"})
    assert "There is no model yet" in refused.text


@pytest.mark.parametrize(
    ("choice", "complaint"),
    [
        ("9.colour=red", "there is no shape 9 in what was read"),
        ("0.colour=red", "things are counted from 1"),
        ("1.hue=red", "is no feature of things"),
        ("1.colour=mauve", "is no value of"),
        ("there.9", "what was doubtful is not any more"),
    ],
)
def test_a_correction_of_what_is_not_there_is_refused(
    asking: Browser, shown: Project, choice: str, complaint: str
) -> None:
    held = len(shown.record.all())
    refused = asking.client.post(
        "/ask/correct", data={"csrf": asking.csrf, "picture": PICTURE, "choice": choice}
    )
    assert refused.status_code == 422
    assert complaint in refused.text
    assert len(shown.record.all()) == held


def test_a_picture_that_cannot_be_read_is_said(asking: Browser, shown: Project) -> None:
    (shown.folder / PICTURE).write_bytes(b"no picture")
    text = asking.get(f"/ask?picture={PICTURE}")
    assert 'class="problem" role="alert"' in text
    assert "003.png" in text


# Evaluating -----------------------------------------------------------------------------------


def test_figures_and_wrong_pictures_of_things(asking: Browser, shown: Project) -> None:
    thing, drawn = next(iter(shown.labels().drawn_in(PICTURE).things.items()))
    other = "blue" if drawn.values["colour"].value == "red" else "red"
    say_of_thing(shown, PICTURE, thing, "colour", other, who="Ada")
    asking.post("/evaluate", part=False)
    end = time.monotonic() + 240
    while jobs_of(shown).of("evaluate")[0].runs:
        assert time.monotonic() < end
        time.sleep(0.2)
    job = jobs_of(shown).of("evaluate")[0]
    assert job.state == "finished", job.lines()
    found, text = job.printed(), asking.get("/evaluate")
    assert found["known"] == 0
    assert f"{found['things']['annotated']} drawn" in text
    assert "colour of a shape" in text
    assert "one is left of another" in text
    whole = found["scenes_wholly_right"]
    assert f"<strong>{whole['right']} of {whole['of']}</strong> pictures are wholly right" in text
    assert f'href="/label?picture={PICTURE}"' in text
    assert f'href="/ask?picture={PICTURE}"' in text
    assert re.search(rf'class="wrong">colour of {other}', text)
    assert re.search(rf'class="wrong">colour of {other}[^<]*</span> \(\d+ % sure\)', text)
    assert "/evaluate/page.html" in text
    name = "shapes-evaluation.html"
    kept = asking.client.get("/evaluate/page.html")
    assert kept.headers["Content-Disposition"] == f'attachment; filename="{name}"'
    assert f'<p class="name">{PICTURE}</p>' in kept.text
    say_of_thing(shown, PICTURE, thing, "colour", drawn.values["colour"].value, who="Ada")
    assert "Its boxes or labels were changed since" in asking.get("/evaluate")
    (shown.folder / "model" / "model.json").touch()
    assert "The model was trained again since" in asking.get("/evaluate")


SHARE = {"right": 1, "of": 2, "accuracy": 0.5}
PRINTED: dict[str, Any] = {
    "pictures": 70,
    "things": {"annotated": 2, "found": 2, "missed": 0, "imagined": 1},
    "features": {"colour": {**SHARE, "majority": 0.6}, "gone": {**SHARE, "majority": 0.6}},
    "relations": {"on": {**SHARE, "majority": 0.9}},
    "scenes_wholly_right": SHARE,
    "scenes_wholly_right_with_relations": SHARE,
    "class": {**SHARE, "majority": 0.7},
    "inconsistent": 3,
    "pictures_per_second": 1.0,
    "known": 4,
    "wrong": [
        {"image": f"images/{n:03}.png", "wrong": ["a", "b<", "c", "d", "e"]} for n in range(99)
    ],
}


def test_what_the_evaluation_of_things_printed_is_told(asking: Browser, shown: Project) -> None:
    ended_job(shown, "evaluate", json.dumps(PRINTED))
    text = asking.get("/evaluate")
    assert "4 of the pictures taught the model" in text
    assert "3 could not be read as the knowledge allows" in text
    assert "one is on another" in text
    assert "gone" not in text
    assert "b&lt;" in text
    assert "and 1 more" in text
    assert text.count('class="tile"') == 48  # the others are no pictures of the project


def test_an_evaluation_of_the_other_kind_is_not_shown(asking: Browser, shown: Project) -> None:
    ended_job(shown, "evaluate", json.dumps({"scenes": 3, "wrong": []}))
    text = asking.get("/evaluate")
    assert "Figures" not in text
    assert "on 12 pictures kept for it" in text


def test_what_is_missing_for_evaluating_things_is_a_sentence(
    browser: Browser, project: Project, shelf: Shelf, model_folder: Path
) -> None:
    assert "There is no model yet" in browser.get("/evaluate")
    shutil.copytree(shelf.model, project.folder / "model")
    draw_in(project, 0, 8)
    assert "No labelled picture is kept for evaluation" in browser.get("/evaluate")
    browser.post("/evaluate/keep-back", part=False)
    assert "on 2 pictures kept for it" in browser.get("/evaluate")
    shutil.rmtree(project.model_folder)
    shutil.copytree(model_folder, project.model_folder)
    text = browser.get("/evaluate")
    assert "The model is of one thing in a picture, and the domain has several" in text
    assert "Keep a quarter" not in text
    refused = browser.client.post("/evaluate", data={"csrf": browser.csrf})
    assert refused.status_code == 422
    (project.model_folder / "model.json").write_text("{")
    assert "model.json" in browser.get("/evaluate")
    assert "model.json" in browser.get("/ask")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_everybody_can_use_the_pages_of_things(
    chromium: Chromium, shown: Project, scheme: Any
) -> None:
    ended_job(shown, "evaluate", json.dumps(PRINTED))
    width = 390 if scheme == "dark" else 1280
    for address in served(shown):
        context = chromium.new_context(
            viewport={"width": width, "height": 800}, color_scheme=scheme, bypass_csp=True
        )
        page = context.new_page()
        for path in ("/train", f"/ask?picture={PICTURE}", "/evaluate"):
            page.goto(f"{address}{path}")
            assert hindrances(page, width) == []
        page.goto(f"{address}/ask?picture={PICTURE}")
        page.locator(".answer .holds[tabindex]").nth(1).focus()
        assert page.locator(".box.pointed").get_attribute("data-number") == "1"
        page.locator(".boxes.read a").nth(1).focus()
        page.keyboard.press("Enter")
        page.locator("[name='shows.2.form']:checked").focus()
        page.wait_for_function("document.querySelector('#supposed-form')['htmx-internal-data']")
        page.keyboard.press("ArrowRight")
        page.get_by_text("As it was seen").wait_for()
        assert page.locator(".boxes .changed").count() == 1
        page.locator("#gone").check()
        page.locator(".boxes .gone path").first.wait_for(state="attached")
        page.locator("#gone").uncheck()
        page.locator(".boxes .gone").wait_for(state="detached")
        page.locator("[name='shows.2.form']:checked").focus()
        assert page.evaluate("document.activeElement.name") == "shows.2.form"
        page.locator("#question").fill("how many balls are there?")
        page.keyboard.press("Enter")
        page.get_by_text("how many balls are there?").nth(1).wait_for()
        assert page.get_by_text("As it was seen").is_visible()  # what is supposed stays so
        page.get_by_text("No, that is wrong").click()
        page.get_by_label("1: ", exact=False).first.wait_for()
        page.get_by_text("Trying exceptions").wait_for(state="detached")
        assert hindrances(page, width) == []
        context.close()


for needed in NEEDS_CHROMIUM:
    test_everybody_can_use_the_pages_of_things = needed(test_everybody_can_use_the_pages_of_things)
