"""Boxes in a real browser: by mouse, by finger and by keys alone, in the picture's own pixels."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import pytest
from PIL import Image

from seewhy.studio.drawing import draw
from seewhy.studio.project import Project
from studio_browsing import NEEDS_CHROMIUM, hindrances, served
from thing_pictures import piles

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = NEEDS_CHROMIUM

RED = (20, 50, 60, 90)


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(piles(tmp_path / "p"))


@pytest.fixture
def address(project: Project) -> Iterator[str]:
    yield from served(project)


def rows(project: Project, table: str = "things.csv") -> list[str]:
    file = project.folder / table
    return file.read_text().splitlines()[1:] if file.is_file() else []


def until(told: Callable[[], object], expected: object) -> None:
    ends = time.monotonic() + 60
    while time.monotonic() < ends and told() != expected:
        time.sleep(0.05)
    assert told() == expected


def on_screen(page: Page, x: float, y: float) -> tuple[float, float]:
    """Where a pixel of the picture is shown."""
    found = page.evaluate(
        """([x, y]) => {
          const shown = new DOMPoint(x, y).matrixTransform(
            document.getElementById("boxes").getScreenCTM());
          return [shown.x, shown.y];
        }""",
        [x, y],
    )
    return found[0], found[1]


def drag(page: Page, start: tuple[float, float], end: tuple[float, float]) -> None:
    """Drag from a pixel of the picture to another."""
    page.mouse.move(*on_screen(page, *start))
    page.mouse.down()
    page.mouse.move(*on_screen(page, (start[0] + end[0]) / 2, (start[1] + end[1]) / 2))
    page.mouse.move(*on_screen(page, *end))
    page.mouse.up()


def test_a_box_is_drawn_named_by_a_key_and_undone(
    page: Page, address: str, project: Project
) -> None:
    page.goto(f"{address}/label?picture=a.png")
    drag(page, (20, 50), (60, 90))
    page.wait_for_selector(".box.chosen[data-thing='1']")
    page.keyboard.press("1")  # colour: red
    until(lambda: rows(project), ["a.png,1,20,50,60,90,red,"])
    page.wait_for_selector(".box[aria-label^='block 1, red']")
    drag(page, (150, 90), (100, 40))  # from below
    page.wait_for_selector(".box.chosen[data-thing='2']")
    page.keyboard.press("2")  # green
    until(lambda: rows(project), ["a.png,1,20,50,60,90,red,", "a.png,2,100,40,150,90,green,"])
    page.keyboard.press("n")  # it is on …
    page.keyboard.press("1")  # … the first other
    said = ["a.png,on,1,2,unknown", "a.png,on,2,1,yes"]
    until(lambda: rows(project, "relations.csv"), said)
    for _ in range(3):
        page.keyboard.press("u")
    until(lambda: rows(project), ["a.png,1,20,50,60,90,red,"])
    page.keyboard.press("r")
    until(lambda: rows(project), ["a.png,1,20,50,60,90,red,", "a.png,2,100,40,150,90,,"])
    page.reload()
    page.wait_for_selector(".box[data-thing='2']")
    assert page.locator(".box").count() == 2


def test_a_box_is_moved_resized_chosen_and_left(page: Page, address: str, project: Project) -> None:
    draw(project, "a.png", (0, 0, 120, 100), who="Ada")
    draw(project, "a.png", RED, who="Ada")
    page.goto(f"{address}/label?picture=a.png")
    page.mouse.click(*on_screen(page, 40, 70))
    page.wait_for_selector(".box.chosen[data-thing='2']")  # the smaller one
    drag(page, (40, 70), (50, 60))
    until(lambda: rows(project)[1], "a.png,2,30,40,70,80,,")
    page.wait_for_selector(".box.chosen[data-box='30 40 70 80']")
    drag(page, (30, 40), (10, 20))
    until(lambda: rows(project)[1], "a.png,2,10,20,70,80,,")
    page.wait_for_selector(".box.chosen[data-box='10 20 70 80']")
    drag(page, (40, 50), (400, 50))  # no box leaves its picture
    until(lambda: rows(project)[1], "a.png,2,140,20,200,80,,")
    page.wait_for_selector(".box.chosen[data-box='140 20 200 80']")
    page.mouse.click(*on_screen(page, 60, 50))
    page.wait_for_selector(".box.chosen[data-thing='1']")
    page.mouse.click(*on_screen(page, 130, 50))
    page.wait_for_selector("#boxes:not([data-chosen])")
    assert len(rows(project)) == 2


def test_keys_alone_suffice(page: Page, address: str, project: Project) -> None:
    page.goto(f"{address}/label?picture=a.png")
    page.keyboard.press("x")
    until(lambda: rows(project), ["a.png,1,67,33,133,66,,"])
    page.wait_for_selector(".box.chosen:focus")
    for key in ("ArrowLeft", "ArrowLeft", "ArrowDown", "Shift+ArrowRight", "Shift+ArrowUp"):
        page.keyboard.press(key)
    page.keyboard.press("1")  # what was moved is kept before what comes next is said
    until(lambda: rows(project), ["a.png,1,65,34,132,66,red,"])
    page.keyboard.press("x")
    until(lambda: len(rows(project)), 2)
    page.wait_for_selector(".box.chosen[data-thing='2']:focus")
    page.keyboard.press("Shift+Tab")
    page.wait_for_selector(".box.chosen[data-thing='1']:focus")
    page.keyboard.press("Tab")
    page.keyboard.press("2")
    until(lambda: rows(project)[1].split(",")[6], "green")
    page.keyboard.press("Delete")
    until(lambda: len(rows(project)), 1)
    page.wait_for_selector("#boxes:not([data-chosen])")
    page.keyboard.press("ArrowRight")  # nothing is chosen: the next picture
    page.wait_for_selector("#workbench:not([data-picture='a.png'])")
    entries = [entry for entry in project.record.all() if entry.kind == "boxes"]
    assert len(entries) == 6  # drawn, moved, red, drawn, green, removed


def test_what_is_refused_is_said_and_the_page_stays(
    page: Page, address: str, project: Project
) -> None:
    for corner in range(4):
        draw(project, "a.png", (corner, 0, 9, 9), who="Ada")
    page.goto(f"{address}/label?picture=a.png")
    drag(page, (100, 40), (150, 90))
    page.wait_for_selector("#problem .problem:has-text('the domain allows 4')")
    assert page.locator(".box").count() == 4
    assert page.locator("#drawn-now").count() == 0
    page.mouse.click(*on_screen(page, 5, 5))
    page.wait_for_selector(".box.chosen")
    assert page.locator("#problem .problem").count() == 0


def test_a_finger_draws_in_a_photograph_that_is_shown_small(
    chromium: Browser, tmp_path: Path
) -> None:
    folder = piles(tmp_path / "p", 0)
    # A camera that was held upright: its pixels lie on their side.
    lying = Image.new("RGB", (4000, 3000), (90, 90, 90))
    notes = Image.Exif()
    notes[0x0112] = 6
    lying.save(folder / "photo.jpg", exif=notes)
    project = Project(folder)
    for address in served(project):
        context = chromium.new_context(
            viewport={"width": 390, "height": 800}, has_touch=True, is_mobile=True
        )
        page = context.new_page()
        page.goto(f"{address}/label?picture=photo.jpg")
        page.wait_for_selector("#boxes[data-width='3000'][data-height='4000']")
        start, end = on_screen(page, 600, 800), on_screen(page, 2400, 3200)
        touches = context.new_cdp_session(page)
        for kind, places in (
            ("touchStart", [start]),
            ("touchMove", [((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)]),
            ("touchMove", [end]),
            ("touchEnd", []),
        ):
            points = [{"x": x, "y": y} for x, y in places]
            touches.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        until(lambda: len(rows(project)), 1)
        assert page.evaluate("window.scrollY") == 0
        context.close()
    drawn = [float(cell) for cell in rows(project)[0].split(",")[2:6]]
    assert drawn == pytest.approx([600, 800, 2400, 3200], abs=16)  # a pixel of the screen is 12


@pytest.mark.parametrize(("scheme", "width"), [("light", 1280), ("dark", 390)])
def test_everybody_can_use_the_page_with_boxes(
    chromium: Browser, project: Project, scheme: Literal["light", "dark"], width: int
) -> None:
    draw(project, "a.png", RED, who="Ada")
    draw(project, "a.png", (100, 40, 150, 90), who="Ada")
    for address in served(project):
        context = chromium.new_context(
            viewport={"width": width, "height": 800}, color_scheme=scheme, bypass_csp=True
        )
        shown = context.new_page()
        for path in ("/label?picture=a.png", "/label?picture=a.png&thing=2", "/label/progress"):
            shown.goto(f"{address}{path}")
            assert hindrances(shown, width) == []
        context.close()
