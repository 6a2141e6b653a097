"""The studio in a real browser: the way of the keys, and that everybody can use every page."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import pytest
from PIL import Image

from seewhy.studio.pages import PAGES
from seewhy.studio.project import Project
from seewhy_lab.walk.labelling import label_until
from seewhy_lab.walk.person import Person
from seewhy_lab.walk.truth import Truth
from studio_browsing import NEEDS_CHROMIUM, hindrances, served
from studio_builder import FRUIT, pictures, with_domain
from studio_tiles import tiles_project

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = NEEDS_CHROMIUM

PATHS = [
    *(page.path for page in PAGES),
    "/label/sheet",
    "/label/progress",
    "/label/history",
    "/rules/example",
]


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(with_domain(pictures(tmp_path / "fruit"), FRUIT))


@pytest.fixture
def address(project: Project) -> Iterator[str]:
    yield from served(project)


def until(project: Project, expected: dict[str, dict[str, str]]) -> None:
    """Wait until these labels are there."""
    ends = time.monotonic() + 60
    while time.monotonic() < ends:
        labels = project.labels()
        if all(labels.values(picture) == said for picture, said in expected.items()):
            return
        time.sleep(0.05)
    raise AssertionError({picture: project.labels().values(picture) for picture in expected})


def test_labelling_by_keyboard_alone(page: Page, address: str, project: Project) -> None:
    page.goto(f"{address}/label?picture=a.png")
    # colour: red, green; round: yes, no; class: good, spoilt. All keys come at once.
    for key in ("1", "1", "1"):
        page.keyboard.press(key)
    until(project, {"a.png": {"colour": "red", "round": "yes", "class": "good"}})
    page.wait_for_selector("#workbench:not([data-picture='a.png'])")
    page.keyboard.press("ArrowLeft")
    page.wait_for_selector("#workbench[data-picture='a.png']")
    page.keyboard.press("Shift+O")  # because of the colour
    page.wait_for_selector(".reasons .chosen")
    assert project.labels().reasons == {"a.png": ("colour",)}
    page.keyboard.press("u")
    page.wait_for_selector(".reasons .choice:not(.chosen)")
    page.keyboard.press("u")
    until(project, {"a.png": {"colour": "red", "round": "yes"}})
    page.keyboard.press("r")
    until(project, {"a.png": {"colour": "red", "round": "yes", "class": "good"}})


def test_a_letter_leads_to_a_feature_and_enter_confirms(
    page: Page, address: str, project: Project
) -> None:
    for name, colour in (("a.png", "red"), ("b.png", "green")):
        project.label({name: {"colour": colour, "round": "yes", "class": "good"}}, who="Ada")
    page.goto(f"{address}/label?picture=c.png")
    page.wait_for_selector(".choice.proposed")  # comes by itself, once the heads are trained
    page.keyboard.press("c")
    page.wait_for_selector("fieldset.here:has(legend:has-text('class'))")
    page.keyboard.press("2")
    page.wait_for_selector("button[value='class=spoilt'].chosen")
    page.keyboard.press("Enter")
    until(project, {"c.png": {"colour": "red", "class": "spoilt"}})
    assert project.labels().of["c.png"]["colour"].how == "confirmed"


def test_a_key_that_comes_while_news_are_exchanged_is_not_lost(
    page: Page, address: str, project: Project
) -> None:
    page.goto(f"{address}/label?picture=c.png")
    page.evaluate("""() => {
      window.stayed = true;
      document.addEventListener("htmx:afterSwap", (event) => {
        const asked = event.detail.pathInfo.requestPath;
        if (document.body.dataset.pressed || !asked.startsWith("/label/news")) return;
        document.body.dataset.pressed = "yes";
        document.body.dispatchEvent(new KeyboardEvent("keydown", {key: "1", bubbles: true}));
      });
    }""")
    for name, colour in (("a.png", "red"), ("b.png", "green")):
        project.label({name: {"colour": colour, "round": "yes", "class": "good"}}, who="Ada")
    page.wait_for_selector("body[data-pressed]")
    until(project, {"c.png": {"colour": "red"}})
    page.wait_for_selector("button[value='colour=red'].chosen")
    assert page.evaluate("window.stayed")  # the page was not left for it
    page.goto("about:blank")  # it asks for news, and the server ends first


def test_somebody_who_knows_labels_every_picture(
    page: Page, address: str, project: Project
) -> None:
    known = {
        name: {"colour": colour, "round": "yes", "class": label}
        for name, (colour, label) in zip(
            ("a.png", "b.png", "c.png", "d.png", "e.png", "f.png"),
            3 * [("red", "good"), ("green", "spoilt")],
            strict=True,
        )
    }
    person = Person(page)
    page.goto(f"{address}/label")
    with person.step("label"):
        said = label_until(person, Truth(known, {}), count=6, done=0, pace=0.2)
    until(project, known)
    assert sorted(labelled.picture for labelled in said) == sorted(known)
    assert person.effort.confirmed + person.effort.changed == 6
    assert person.effort.keys == sum(labelled.keys for labelled in said)
    page.goto("about:blank")


def test_a_contact_sheet_by_keyboard(page: Page, address: str, project: Project) -> None:
    page.goto(f"{address}/label/sheet?feature=colour&value=red")
    for key in ("ArrowRight", "Space", "ArrowRight", "Space", "Enter"):
        page.keyboard.press(key)
    page.wait_for_selector("text=2 pictures: colour red")
    until(project, {"a.png": {"colour": "red"}, "b.png": {"colour": "red"}, "c.png": {}})


def test_pictures_are_dropped_and_names_said(page: Page, tmp_path: Path) -> None:
    project = Project(tmp_path / "fresh")
    sent = [str(path) for path in sorted(pictures(tmp_path / "photos", 25).iterdir())]
    for address in served(project):
        page.goto(f"{address}/begin")
        page.set_input_files("#single-files", sent)
        page.click("text=Send the pictures")
        page.wait_for_selector("#arrived strong:has-text('25')")
        page.fill("[name=classes]", "good")
        page.click("text=Write the domain")
        page.wait_for_selector("#problem .problem")
        page.fill("[name=classes]", "good, spoilt")  # what was typed is still there
        page.fill("[name=features]", "colour: red, green")
        page.click("text=Write the domain")
        page.wait_for_selector("#workbench")
    assert list(project.domain().features) == ["colour"]
    assert len(project.pictures()) == 25


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_everybody_can_use_every_page(chromium: Browser, project: Project, scheme: str) -> None:
    project.label(
        {
            "a.png": {"colour": "red", "round": "yes", "class": "good"},
            "b.png": {"colour": "green", "round": "yes", "class": "spoilt"},
        },
        who="Ada",
    )
    found: dict[str, list[str]] = {}
    for address in served(project):
        for width in (1280, 390):
            context = chromium.new_context(
                viewport={"width": width, "height": 800}, color_scheme=scheme, bypass_csp=True
            )
            shown = context.new_page()
            for path in PATHS:
                shown.goto(f"{address}{path}")
                problems = hindrances(shown, width)
                if problems:
                    found[f"{path} at {width}"] = problems
            context.close()
    assert found == {}


@pytest.mark.parametrize(("scheme", "width"), [("light", 1280), ("dark", 390)])
def test_asking_and_doubting_by_keyboard_alone(
    chromium: Browser,
    tmp_path: Path,
    tiles_data: Path,
    tiles_folder: Path,
    model_folder: Path,
    scheme: Literal["light", "dark"],
    width: int,
) -> None:
    folder = tiles_project(tmp_path / "p", data=tiles_data, domain=tiles_folder, model=model_folder)
    for address in served(Project(folder)):
        context = chromium.new_context(
            viewport={"width": width, "height": 800}, color_scheme=scheme, bypass_csp=True
        )
        shown = context.new_page()
        shown.set_default_timeout(60_000)
        shown.goto(f"{address}/ask?picture=images/006.png")
        shown.focus("#shows-colour-1")
        shown.keyboard.press("ArrowRight")
        shown.wait_for_selector(".then:has-text('would be')")
        assert shown.evaluate("document.activeElement.id") == "shows-colour-2"
        shown.focus("#question")
        shown.keyboard.type("why is it good?")
        shown.keyboard.press("Enter")
        shown.wait_for_selector(".asked:has-text('why is the tile good?')")
        shown.focus(".where summary")
        shown.keyboard.press("Enter")
        shown.wait_for_selector(".where img")
        shown.focus("text=No, that is wrong")
        shown.keyboard.press("Enter")
        shown.wait_for_selector(".remedies:has-text('unless it has corners')")
        assert hindrances(shown, width) == []
        shown.focus(".remedies:has-text('unless it has corners') button")
        shown.keyboard.press("Enter")
        shown.wait_for_selector("text=Take it back")
        assert "not -round(T)" in (folder / "tiles" / "knowledge.al").read_text()
        shown.goto(f"{address}/rules/learned")
        assert hindrances(shown, width) == []
        context.close()


def test_tab_reaches_the_content_first(page: Page, address: str) -> None:
    page.goto(f"{address}/label")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent") == "Skip to the content"
    page.keyboard.press("Enter")
    assert page.evaluate("document.activeElement.id") == "content"


def test_all_that_was_sent_is_told_at_once(page: Page, tmp_path: Path) -> None:
    """Pictures are sent some at a time, which nobody has to know."""
    sent = tmp_path / "sent"
    pictures(sent, 26)
    more = [Image.new("RGB", (8, 8), (n, 9, 9)) for n in range(20)]
    for number, picture in enumerate(more):
        picture.save(sent / f"more-{number}.png")
    (sent / "phone.HEIC").write_bytes(b"....ftypheic")
    (sent / "a-broken.jpg").write_bytes(b"no picture")
    for address in served(Project(tmp_path / "new")):
        page.goto(f"{address}/begin")
        page.get_by_label("Single pictures").set_input_files(sorted(sent.iterdir()))
        page.get_by_role("button", name="Send the pictures").click()
        page.get_by_text("46 pictures came.").wait_for()
        assert page.get_by_text("2 left out").is_visible()
        assert page.get_by_text("HEIC is not read: save these photographs as JPEG").is_visible()
        assert page.get_by_text("a-broken.jpg: ").is_visible()
        page.get_by_label("Single pictures").set_input_files([sent / "a.png"])
        page.get_by_role("button", name="Send the pictures").click()
        page.get_by_text("No new picture came").wait_for()
        page.get_by_label("Single pictures").set_input_files([sent / "phone.HEIC"])
        page.get_by_role("button", name="Send the pictures").click()
        page.get_by_text("None of these is a picture that is read").wait_for()
