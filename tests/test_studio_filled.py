"""Pages that have much to show, of a labelled project with a model: everybody can use them."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import pytest

from conftest import Run, draw_tile
from lamp_domain import write_lamps
from seewhy.studio.pages.evaluate import TASK as EVALUATE
from seewhy.studio.pages.robot import TASK as ROBOT
from seewhy.studio.pages.train import TASK as TRAIN
from seewhy.studio.project import Project
from seewhy.studio.robot_beginnings import Beginning
from seewhy.studio.robot_process import run_robot
from studio_browsing import NEEDS_CHROMIUM, hindrances, served
from studio_builder import ended_job
from studio_tiles import tiles_project

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = NEEDS_CHROMIUM


@pytest.fixture
def filled(
    tmp_path: Path,
    tiles_data: Path,
    tiles_folder: Path,
    model_folder: Path,
    run: Run,
    capsys: pytest.CaptureFixture[str],
) -> Project:
    """Labelled pictures and one that is not, a model, its evaluation, and a robot's run."""
    folder = tiles_project(tmp_path / "p", data=tiles_data, domain=tiles_folder, model=model_folder)
    draw_tile("blue", "yes", 99).save(folder / "images" / "new.png")
    project = Project(folder)
    wrong = next(name for name, row in project.labels().rows.items() if row["split"] == "test")
    project.label({wrong: {"colour": "green", "class": "bad"}}, who="Ada")
    ended_job(project, TRAIN)
    page = tmp_path / "page.html"
    told = run("evaluate", folder / "model", "--data", folder, "--json", "--page", page)
    shutil.copy(page, ended_job(project, EVALUATE, told.out))
    lamps = write_lamps(tmp_path / "lamps")
    asked = {"domain": str(lamps), "goal": "lit(desk)", "seed": 0, "steps": 9, "at_first": []}
    robot = ended_job(project, ROBOT, asked=asked)
    begun = Beginning(str(lamps))
    run_robot(begun, "lit(desk)", seed=0, most_steps=9, folder=robot, at_first=[])
    (robot / "output").write_text(capsys.readouterr().out)
    return project


def test_everybody_can_use_filled_pages(chromium: Browser, filled: Project) -> None:
    found: dict[str, list[str]] = {}
    looks: list[tuple[Literal["light", "dark"], int]] = [("light", 1280), ("dark", 390)]
    for address in served(filled):
        for scheme, width in looks:
            context = chromium.new_context(
                viewport={"width": width, "height": 800}, color_scheme=scheme, bypass_csp=True
            )
            shown = context.new_page()
            shown.set_default_timeout(60_000)
            for path, fill in FILLED.items():
                shown.goto(f"{address}{path}")
                fill(shown)
                if problems := hindrances(shown, width):
                    found[f"{path} at {width}"] = problems
            context.close()
    assert found == {}


def proposed(page: Page) -> None:
    page.wait_for_selector(".choice.proposed .share")


def trained(page: Page) -> None:
    page.wait_for_selector("text=The model is there")
    page.wait_for_selector("td:has-text('finished')")


def wrong_pictures(page: Page) -> None:
    page.wait_for_selector("a[href^='/label?picture=']")


def answered_and_supposed(page: Page) -> None:
    page.fill("#question", "why is it good?")
    page.keyboard.press("Enter")
    page.wait_for_selector(".answer .tree")
    page.focus("#shows-colour-1")
    page.keyboard.press("ArrowRight")
    page.wait_for_selector(".then:has-text('would be')")


def run_and_answer(page: Page) -> None:
    page.wait_for_selector("text=I press the desk lamp.")
    page.fill("[name=question]", "what is your goal?")
    page.keyboard.press("Enter")
    page.wait_for_selector("text=My goal is that the desk lamp is lit.")


def something_to_share(page: Page) -> None:
    page.wait_for_selector("a[href^='/share/answers.html']")


FILLED = {
    "/label?picture=images/new.png": proposed,
    "/label/progress": lambda page: page.wait_for_selector("text=Recognised"),
    "/train": trained,
    "/evaluate": wrong_pictures,
    "/ask?picture=images/006.png": answered_and_supposed,
    "/robot": run_and_answer,
    "/share": something_to_share,
    "/label/history": lambda page: page.wait_for_selector("text=Take back"),
}
"""Address → what fills the page; what was asked on one is shared on another."""
