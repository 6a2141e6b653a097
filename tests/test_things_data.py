"""things.csv and relations.csv: what is read, written, and refused with its line."""

from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image

from seewhy.agent.things.thing_lessons import lessons_of
from seewhy.data.dataset import Dataset
from seewhy.data.table_writing import write_tables
from seewhy.data.thing import BoundingBox, Thing
from seewhy.data.thing_tables import things_of_file
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.things import ThingFeature
from seewhy.errors import DatasetError

DOMAIN = """\
[domain]
name = "shelf"
title = "Things on a shelf"
scene = "picture"
subject = "the shelf"

[things]
sort = "item"
most = 3
one = "item"

[things.features.colour]
[things.features.kind_of_item]

[things.relations.left]
measure = "left"
say = "{0} is left of {1}"
converse = "right"

[things.relations.right]
measure = "right"
say = "{0} is right of {1}"
converse = "left"

[things.relations.on]
measure = "seen"
say = "{0} is on {1}"

[things.relations.over]
measure = "axioms"
say = "{0} is over {1}"
"""
KNOWLEDGE = """\
#sort picture.
#sort item = things.
#sort hue = {red, blue}.
#sort sort_of_item = {cup, book}.
#static colour(item, hue).
#static kind_of_item(item, sort_of_item).
#static left(item, item).
#static right(item, item).
#static on(item, item).
#static over(item, item).
over(X, Y) if on(X, Y).
over(X, Z) if on(X, Y), over(Y, Z).
"""
THINGS = """\
image,thing,left,top,right,bottom,colour,kind
a.png,cup,10,10,20,20,red,cup
a.png,book,30,10,40,20,,book
b.png,,,,,,blue,
"""


@pytest.fixture
def domain(tmp_path: Path) -> Domain:
    folder = tmp_path / "shelf"
    folder.mkdir()
    (folder / "domain.toml").write_text(DOMAIN)
    (folder / "knowledge.al").write_text(KNOWLEDGE)
    (folder / "questions.toml").write_text("")
    return load_domain(folder)


@pytest.fixture
def data(tmp_path: Path) -> Path:
    folder = tmp_path / "data"
    folder.mkdir()
    for name in ("a", "b"):
        Image.new("RGB", (60, 40)).save(folder / f"{name}.png")
    (folder / "scenes.csv").write_text("image\na.png\nb.png\n")
    (folder / "things.csv").write_text(THINGS)
    return folder


def shown(dataset: Dataset, row: int) -> dict[str, str | None]:
    return dict(zip(dataset.domain.schema.features, dataset.vectors[row], strict=True))


def test_things_are_read_with_their_boxes(domain: Domain, data: Path) -> None:
    first, second = Dataset.load(data, domain).scenes
    assert first.things == (
        Thing("cup", {"colour": "red", "kind_of_item": "cup"}, BoundingBox(10, 10, 20, 20)),
        Thing("book", {"kind_of_item": "book"}, BoundingBox(30, 10, 40, 20)),
    )
    assert second.things == (Thing("1", {"colour": "blue"}),)


def test_values_may_be_any_word_for_them(tmp_path: Path) -> None:
    file = tmp_path / "things.csv"
    file.write_text("number,colour,shading,shape\n1,Red,hatched,wave\nthree,red,solid,oval\n")
    found, _ = things_of_file(file, load_domain("set_cards"))
    assert [tuple(thing.values.values()) for thing in found] == [
        ("one", "red", "striped", "squiggle"),
        ("three", "red", "solid", "oval"),
    ]
    file.write_text("image,kind\na.png,ball\n")
    found, _ = things_of_file(file, load_domain("tabletop"))
    assert found[0].values == {"shape": "sphere"}


def test_a_word_of_two_values_stands_for_neither() -> None:
    fill = {"full": ("solid",), "empty": ("hollow",)}
    feature = ThingFeature(
        "fill", "fill", tuple(fill), {}, fill, {"full": (), "empty": ("solid",)}, ()
    )
    assert feature.value_called("solid") is None
    assert feature.value_called("HOLLOW") == "empty"


def test_relations_are_measured_where_both_boxes_are_known(domain: Domain, data: Path) -> None:
    dataset = Dataset.load(data, domain)
    values = shown(dataset, 0)
    assert values["left(item1,item2)"] == "yes"
    assert values["right(item1,item2)"] == "no"
    assert values["item(item3)"] == "no"
    assert values["on(item1,item2)"] is None
    assert "over(item1,item2)" not in values
    assert shown(dataset, 1)["left(item1,item2)"] is None


def test_what_is_not_listed_is_not_so_where_a_relation_is_listed_at_all(
    domain: Domain, data: Path
) -> None:
    (data / "relations.csv").write_text("image,relation,thing,other\na.png,on,cup,book\n")
    values = shown(Dataset.load(data, domain), 0)
    assert (values["on(item1,item2)"], values["on(item2,item1)"]) == ("yes", "no")


def test_what_is_said_of_a_relation_goes_before_what_is_measured_and_says_its_converse(
    domain: Domain, data: Path
) -> None:
    (data / "relations.csv").write_text(
        "image,relation,thing,other,holds\na.png,left,cup,book,unknown\na.png,on,book,cup,no\n"
    )
    values = shown(Dataset.load(data, domain), 0)
    assert values["left(item1,item2)"] is None
    assert values["right(item2,item1)"] is None
    assert values["on(item2,item1)"] == "no"


def test_what_is_written_is_read_again(domain: Domain, data: Path) -> None:
    (data / "relations.csv").write_text("image,relation,thing,other\na.png,on,cup,book\n")
    dataset = Dataset.load(data, domain)
    write_tables(dataset)
    again = Dataset.load(data, domain)
    assert again == dataset
    assert again.vectors == dataset.vectors


def test_without_a_table_there_are_no_things(domain: Domain, data: Path) -> None:
    (data / "things.csv").unlink()
    dataset = Dataset.load(data, domain)
    assert dataset.scenes[0].things == ()
    assert shown(dataset, 0)["item(item1)"] == "no"


HEADER = "image,thing,left,top,right,bottom,colour\n"
WRONG = {
    "outside": (
        HEADER + "a.png,cup,10,10,70,20,red\n",
        ":2: the box (10, 10, 70, 20) of 'cup' reaches out of its picture, which is 60 × 40 "
        "pixels; correct it",
    ),
    "empty": (
        HEADER + "a.png,cup,10,10,10,20,red\n",
        ":2: the box is empty: right must be more than left, and bottom more than top, got 10, "
        "10, 10, 20",
    ),
    "no numbers": (
        HEADER + "a.png,cup,10,10,,20,red\n",
        ":2: left, top, right and bottom must be numbers (pixels), or all be empty, got '10', "
        "'10', '', '20'",
    ),
    "no finite number": (
        HEADER + "a.png,cup,10,10,nan,20,red\n",
        ":2: left, top, right and bottom must be numbers (pixels), or all be empty, got '10', "
        "'10', 'nan', '20'",
    ),
    "twice the same": (
        HEADER + "a.png,cup,1,1,9,9,red\na.png,mug,1,1,9,9,red\n",
        ":3: the box of 'mug' is that of 'cup' in line 2, and nothing else differs; remove one of "
        "the two",
    ),
    "twice the name": (
        HEADER + "a.png,cup,1,1,9,9,red\na.png,cup,2,2,9,9,red\n",
        ":3: 'cup' of 'a.png' stands in line 2, too; call one otherwise, or remove it",
    ),
    "too many": (
        HEADER + "".join(f"a.png,t{n},{n},1,9,9,red\n" for n in range(4)),
        ":5: 'a.png' has more than 3 things, the most that the domain 'shelf' allows; remove "
        "some, or raise most under [things] of its domain.toml",
    ),
    "unknown picture": (
        HEADER + "aa.png,cup,1,1,9,9,red\n",
        ":2: the picture 'aa.png' is none of scenes.csv; did you mean 'a.png'?",
    ),
    "unknown feature": (
        "image,thing,color\na.png,cup,red\n",
        ":1: 'color' is no feature of things; did you mean 'colour'?",
    ),
    "unknown value": (
        HEADER + "a.png,cup,1,1,9,9,blau\n",
        ":2: 'blau' is no value of 'colour'; did you mean 'blue'?",
    ),
    "no picture": ("thing,colour\ncup,red\n", ":1: the column 'image' is missing; add it"),
    "column twice": (
        "image,colour,colour\na.png,red,red\n",
        ":1: the column 'colour' stands twice; remove one",
    ),
}


@pytest.mark.parametrize("kind", WRONG)
def test_things_that_are_refused(domain: Domain, data: Path, kind: str) -> None:
    text, problem = WRONG[kind]
    (data / "things.csv").write_text(text)
    with pytest.raises(DatasetError) as error:
        Dataset.load(data, domain)
    assert str(error.value) == f"{data / 'things.csv'}{problem}"


WRONG_RELATIONS = {
    "no such thing": (
        "a.png,on,cup,bok,\n",
        ":2: 'bok' is no thing of 'a.png'; did you mean 'book'?",
    ),
    "no such relation": (
        "a.png,onn,cup,book,\n",
        ":2: 'onn' is no relation that is seen or measured; did you mean 'on'?",
    ),
    "concluded": (
        "a.png,over,cup,book,\n",
        ":2: 'over' is no relation that is seen or measured; it must be one of: left, right, on",
    ),
    "itself": (
        "a.png,on,cup,cup,\n",
        ":2: 'on' is said of 'cup' and itself; name two things",
    ),
    "no such picture": (
        "c.png,on,cup,book,\n",
        ":2: the picture 'c.png' has no things in things.csv; did you mean 'a.png'?",
    ),
    "no such truth": (
        "a.png,on,cup,book,maybe\n",
        ":2: holds must be 'yes', 'no', 'unknown' or empty, got 'maybe'",
    ),
}


@pytest.mark.parametrize("kind", WRONG_RELATIONS)
def test_relations_that_are_refused(domain: Domain, data: Path, kind: str) -> None:
    rows, problem = WRONG_RELATIONS[kind]
    (data / "relations.csv").write_text(f"image,relation,thing,other,holds\n{rows}")
    with pytest.raises(DatasetError) as error:
        Dataset.load(data, domain)
    assert str(error.value) == f"{data / 'relations.csv'}{problem}"


# Pictures that show none ----------------------------------------------------------------------


def test_a_picture_may_be_said_to_show_none(domain: Domain, data: Path, tmp_path: Path) -> None:
    (data / "things.csv").write_text("".join(THINGS.splitlines(keepends=True)[:3]))
    (data / "scenes.csv").write_text("image,things\na.png,\nb.png,none\n")
    dataset = Dataset.load(data, domain)
    assert [scene.no_things for scene in dataset.scenes] == [False, True]
    copy = tmp_path / "copy"
    write_tables(dataset, copy)
    assert (copy / "scenes.csv").read_text().splitlines()[0].startswith("image,class,things")
    again = Dataset.load(copy, domain, outside=True)
    assert [scene.no_things for scene in again.scenes] == [False, True]
    lessons = lessons_of(_often(dataset), side=16)
    assert lessons.places is not None
    counts = sorted(len(boxes) for boxes in lessons.places.boxes)
    assert counts == [0] * 10 + [2] * 10  # where nothing is, that is taught, too
    assert len(lessons.things.boxes) == 20


def _often(dataset: Dataset) -> Dataset:
    """Each picture ten times: so many are needed."""
    return dataset.of_scenes([scene for scene in dataset.scenes for _ in range(10)])


def test_pictures_that_show_none_are_not_enough(domain: Domain, data: Path) -> None:
    (data / "things.csv").write_text("".join(THINGS.splitlines(keepends=True)[:3]))
    (data / "scenes.csv").write_text("image,things\na.png,\nb.png,none\n")
    first, second = Dataset.load(data, domain).scenes
    few = Dataset.load(data, domain).of_scenes([first, *[second] * 12])
    with pytest.raises(DatasetError, match="1 picture has a box around each thing"):
        lessons_of(few, side=16)


@pytest.mark.parametrize(
    ("scenes", "complaint"),
    [
        (
            "image,things\na.png,none\nb.png,\n",
            r"things\.csv:2: line 2 of scenes\.csv says that 'a\.png' shows no things",
        ),
        (
            "image,things\na.png,\nb.png,two\n",
            r"scenes\.csv:3: things must be 'none' \(nothing is there\) or empty, got 'two'",
        ),
    ],
)
def test_what_is_wrong_about_none_is_said(
    domain: Domain, data: Path, scenes: str, complaint: str
) -> None:
    (data / "scenes.csv").write_text(scenes)
    with pytest.raises(DatasetError, match=complaint):
        Dataset.load(data, domain)
