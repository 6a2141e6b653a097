"""The page of an evaluation of things: every wrong picture, and what was misread in it."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
from PIL import Image

from seewhy.data.thing import BoundingBox
from seewhy.domain.domain import load_domain
from seewhy.errors import PictureError
from seewhy.evaluation.share import Share
from seewhy.evaluation.things_seen import Mistake, SeenFeature, ThingsSeen, WrongScene
from seewhy.report.things_evaluation_page import things_evaluation_page
from test_report import Page

CUP, BALL = BoundingBox(10, 20, 60, 80), BoundingBox(100, 20, 190, 90)


@pytest.fixture
def found(tmp_path: Path) -> ThingsSeen:
    """Three pictures, of which two are wrong."""
    for name in ("a.png", "b.png"):
        Image.new("RGB", (200, 100), (90, 120, 150)).save(tmp_path / name)
    unsure = (Mistake("colour of red cube: blue", 0.52, (CUP,)),)
    sure = (
        Mistake("missed: green <ball>", None, (BALL,)),
        Mistake("colour of red cube: blue", 0.97, (CUP,)),
        Mistake("said: red cube is left of green ball", 0.8, (CUP, BALL)),
        Mistake("shape of red cube: sphere", 0.6, (CUP,)),
        Mistake("class: none instead of tidy"),
    )
    return ThingsSeen(
        pictures=3,
        found=4,
        missed=1,
        imagined=0,
        features={"colour": SeenFeature(Share(2, 4), 0.6)},
        relations={"left": SeenFeature(Share(3, 4), 0.5)},
        scenes=Share(1, 3),
        scenes_with_relations=Share(1, 3),
        classes=None,
        inconsistent=0,
        pictures_per_second=1.0,
        known=0,
        wrong=(
            WrongScene("a.png", tmp_path / "a.png", unsure),
            WrongScene("b.png", tmp_path / "b.png", sure),
        ),
    )


def page_of(found: ThingsSeen, most: int = 100) -> str:
    return things_evaluation_page(load_domain("tabletop"), found, command="seewhy <x>", most=most)


def test_the_page_loads_nothing_and_has_the_figures(found: ThingsSeen) -> None:
    page = page_of(found)
    assert not re.search(r"(src|href)=[\"'](https?:)?//", page)
    assert {tag for tag, _ in Page(page).started}.isdisjoint({"script", "link", "iframe"})
    cells = re.sub(r"<[^>]+>", " ", page)
    assert re.search(r"annotated\s+found\s+missed\s+imagined\s+5\s+4\s+1\s+0\s", cells)
    assert re.search(r"colour of a thing\s+50\.0 %\s+15\.0 % to 85\.0 %\s+60\.0 %\s+4", cells)
    assert "one is left of another" in cells
    assert "seewhy &lt;x&gt;" in page
    assert 'class="notice"' not in page
    assert "2 of the pictures taught the model" in page_of(replace(found, known=2))


def test_the_surest_mistakes_come_first_with_their_boxes(found: ThingsSeen) -> None:
    first, second = page_of(found).split('<div class="wrong boxed">')[1:]
    assert re.findall(r"<p>(.*?)</p>", first) == [
        '1: <span class="bad">missed: green &lt;ball&gt;</span>',
        '2: <span class="bad">colour of red cube: blue</span> (0.97)',
        '3: <span class="bad">said: red cube is left of green ball</span> (0.80)',
        '2: <span class="bad">shape of red cube: sphere</span> (0.60)',
        '<span class="bad">class: none instead of tidy</span>',
    ]
    boxes = re.findall(r"<rect x='([\d.]+)'[^>]*?(stroke-dasharray)?[^>]*/>", first)
    assert [left for left, _ in boxes] == ["160.0", "16.0", "16.0", "160.0", "16.0"]
    assert first.count("stroke-dasharray") == 1  # around what was missed
    assert "b.png" in first
    assert "(0.52)" in second
    assert "a.png" in second


def test_so_many_are_shown_as_are_asked_for(found: ThingsSeen) -> None:
    assert "Shown: 1 of 2; --most 2 shows all, --json lists all." in page_of(found, most=1)
    assert page_of(found, most=1).count("<image") == 1
    assert "None: every thing was found" in page_of(replace(found, wrong=()))


def test_a_picture_that_is_gone_is_said(found: ThingsSeen) -> None:
    found.wrong[0].picture.unlink()
    with pytest.raises(PictureError, match=r"a\.png"):
        page_of(found)
