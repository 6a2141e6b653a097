"""Datasets: a table beside pictures, read with errors that name file, line and remedy."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from conftest import write_tiles
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.data.dataset_domain import domain_of
from seewhy.data.picture_listing import list_pictures
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError, PictureError
from seewhy.report.contact_sheet import draw_contact_sheet

HEAD = "image,class,colour,round\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_tiles(tmp_path / "p", count=3)
    return tmp_path / "p"


def load(folder: Path, domain: Domain, text: str | bytes) -> Dataset:
    data = text.encode() if isinstance(text, str) else text
    (folder / "scenes.csv").write_bytes(data)
    return Dataset.load(folder, domain)


def message(folder: Path, domain: Domain, text: str | bytes) -> str:
    with pytest.raises(DatasetError) as problem:
        load(folder, domain, text)
    return str(problem.value).replace(str(folder), "DIR")


ROW = "images/000.png,good,red,yes\n"


@pytest.mark.parametrize(
    ("table", "expected"),
    [
        (
            "image,class,color,round\n",
            "DIR/scenes.csv:1: 'color' is no feature of the domain 'tiles'; did you mean 'colour'?",
        ),
        (
            "image,class,colour,round,weight\n",
            "DIR/scenes.csv:1: 'weight' is no feature of the domain 'tiles'; it must be one of: "
            "image, class, colour, round, split, group, reasons",
        ),
        (
            "class,colour,round\n",
            "DIR/scenes.csv:1: the column 'image' is missing; it names the picture of every row",
        ),
        (
            "image,class,colour,round,colour\n",
            "DIR/scenes.csv:1: the column 'colour' stands twice; remove one",
        ),
        (
            "",
            "DIR/scenes.csv:1: the table is empty; its first line names the columns image, class, "
            "colour, round, split, group, reasons",
        ),
        (HEAD, "DIR/scenes.csv: the table has no rows; add one per picture"),
        (HEAD + "\n,,,\n", "DIR/scenes.csv: the table has no rows; add one per picture"),
        (
            HEAD + ROW + "images/001.png,good,gren,yes\n",
            "DIR/scenes.csv:3: 'gren' is no value of 'colour'; did you mean 'green'?",
        ),
        (
            HEAD + ROW + "images/001.png,good,red,maybe\n",
            "DIR/scenes.csv:3: 'maybe' is no value of 'round'; it must be one of: yes, no",
        ),
        (
            HEAD + ROW + "images/001.png,godo,red,yes\n",
            "DIR/scenes.csv:3: 'godo' is no class of the domain 'tiles'; did you mean 'good'?",
        ),
        (
            HEAD + "images/nothing.png,good,red,yes\n",
            "DIR/scenes.csv:2: there is no picture 'images/nothing.png' in DIR; correct the path "
            "or remove the row",
        ),
        (
            HEAD + "images,good,red,yes\n",
            "DIR/scenes.csv:2: 'images' is a folder, not a picture; name a picture in it",
        ),
        (
            HEAD + ",good,red,yes\n",
            "DIR/scenes.csv:2: the cell 'image' is empty; name the picture's file",
        ),
        (
            HEAD + "images/000.png,good,red,yes,1\n",
            "DIR/scenes.csv:2: the row has more cells than there are columns; remove some, or put "
            'a cell that has a , in it in "quotes"',
        ),
        (
            "image,class,colour,round,split\nimages/000.png,good,red,yes,training\n",
            "DIR/scenes.csv:2: split must be 'train', 'test' or empty, got 'training'",
        ),
        (
            "image,class,colour,round,reasons\nimages/000.png,good,red,yes,round color\n",
            "DIR/scenes.csv:2: the reason 'color' is no feature of the domain 'tiles'; did you "
            "mean 'colour'?",
        ),
        (
            "image,class,colour,round,reasons\nimages/000.png,good,red,,round\n",
            "DIR/scenes.csv:2: 'round' is a reason, but its cell is empty; fill it in, or take "
            "the reason away",
        ),
        (
            HEAD.encode() + b"images/000.png,good,r\xf6d,yes\n",
            "DIR/scenes.csv:2: is not UTF-8 text (byte 0xf6); save the table as CSV in UTF-8",
        ),
        (
            HEAD + '"' + "x" * 200_000 + '",good,red,yes\n',
            "DIR/scenes.csv:2: has a cell of more than 131,072 characters; shorten it",
        ),
    ],
)
def test_a_wrong_table(folder: Path, tiles: Domain, table: str | bytes, expected: str) -> None:
    assert message(folder, tiles, table) == expected


def test_reasons_are_features_with_blanks_between(folder: Path, tiles: Domain) -> None:
    head = "image,class,colour,round,reasons\n"
    rows = ["images/000.png,good,red,yes,colour round colour", "images/001.png,good,red,,"]
    loaded = load(folder, tiles, head + "\n".join(rows))
    assert [scene.reasons for scene in loaded.scenes] == [("colour", "round"), ()]
    assert load(folder, tiles, HEAD + ROW).scenes[0].reasons == ()


def test_the_line_is_the_one_in_the_file(folder: Path, tiles: Domain) -> None:
    """Empty lines and cells with line breaks count as an editor counts them."""
    table = HEAD + "\n" + ROW + 'images/001.png,good,red,"y\nes"\n'
    assert message(folder, tiles, table).startswith("DIR/scenes.csv:4: 'y\nes' is no value")


def test_no_folder_and_no_table(folder: Path, tiles: Domain) -> None:
    with pytest.raises(DatasetError) as problem:
        Dataset.load(folder / "nowhere", tiles)
    assert str(problem.value) == (
        f"{folder}/nowhere: there is no such folder; give one with a scenes.csv"
    )
    with pytest.raises(DatasetError) as problem:
        Dataset.load(folder / "images", tiles)
    assert str(problem.value) == (
        f"{folder}/images: the folder has no scenes.csv; it lists the pictures with the columns "
        "image, class, colour, round"
    )


def test_bom_crlf_spaces_and_quotes_are_read(folder: Path, tiles: Domain) -> None:
    table = (
        "\ufeffimage , class,colour,round\r\n"
        'images/000.png, good ,"red",yes\r\n'
        "\r\n"
        "images/001.png,bad,,no\r\n"
    )
    dataset = load(folder, tiles, table)
    assert dataset.vectors == [("red", "yes"), (None, "no")]
    assert dataset.labels == ["good", "bad"]
    assert [scene.picture.name for scene in dataset.scenes] == ["000.png", "001.png"]


def test_columns_stand_in_any_order(folder: Path, tiles: Domain) -> None:
    table = "round,image,group,class,colour\nyes,images/000.png,a,good,\nno,images/001.png,,bad,red"
    dataset = load(folder, tiles, table)
    assert dataset.vectors == [(None, "yes"), ("red", "no")]
    assert dataset.groups == ["a", f" {folder}/images/001.png"]


def test_splits(folder: Path, tiles: Domain) -> None:
    table = "image,class,colour,round,split\n" + "".join(
        f"images/00{n}.png,good,red,yes,{split}\n" for n, split in enumerate(["train", "", "test"])
    )
    dataset = load(folder, tiles, table)
    assert [s.picture.name for s in dataset.of_split("train").scenes] == ["000.png"]
    assert [s.picture.name for s in dataset.of_split("test").scenes] == ["002.png"]
    without = load(folder, tiles, HEAD + ROW)
    assert without.of_split("train") is without.of_split("test") is without
    only = load(
        folder, tiles, "image,class,colour,round,split\nimages/000.png,good,red,yes,train\n"
    )
    with pytest.raises(DatasetError) as problem:
        only.of_split("test")
    assert str(problem.value) == (
        f"{folder}/scenes.csv: no row has split = test; add some, or leave the column out"
    )


@pytest.mark.parametrize(
    ("table", "expected"),
    [
        (
            HEAD + ROW + "images/001.png,good,green,no\n",
            "all 2 rows are of class 'good'; training needs scenes of at least two classes",
        ),
        (
            HEAD + ROW + "images/001.png,,green,no\n",
            "the only row that has a class is of class 'good'; training needs scenes of at least "
            "two classes",
        ),
        (
            HEAD + "images/000.png,,red,yes\nimages/001.png,,green,no\n",
            "no row has a class; fill the column 'class' of pictures of at least two classes, a "
            "few dozen of each if you can",
        ),
        (
            "image,colour,round\nimages/000.png,red,yes\nimages/001.png,green,no\n",
            "no row has a class; fill the column 'class' of pictures of at least two classes, a "
            "few dozen of each if you can",
        ),
        (
            HEAD + ROW + "images/001.png,bad,green,no\n",
            "every class has one picture only; training needs several of each that show different "
            "things, a few dozen if you can",
        ),
        (
            "image,class,colour,round,group\nimages/000.png,good,red,yes,one\n"
            "images/001.png,good,green,no,one\nimages/002.png,bad,green,no,two\n",
            "every class has pictures of one group only; training needs several of each that show "
            "different things, a few dozen if you can",
        ),
        (
            "image,class,colour\nimages/000.png,good,red\nimages/001.png,bad,red\n"
            "images/002.png,bad,red\n",
            "no row has a value of 'round', which training needs; fill the column 'round', or "
            "remove the feature from the domain",
        ),
    ],
)
def test_what_is_too_little_for_training(
    folder: Path, tiles: Domain, table: str, expected: str
) -> None:
    dataset = load(folder, tiles, table)
    with pytest.raises(DatasetError) as problem:
        Agent(tiles).fit(dataset)
    assert str(problem.value) == f"{folder}/scenes.csv: {expected}"


def test_a_picture_needs_no_class_and_no_features(folder: Path, tiles: Domain) -> None:
    only = load(folder, tiles, "image\nimages/000.png\nimages/001.png\n")
    assert only.labels == [None, None]
    assert only.vectors == [(None, None)] * 2
    assert len(only.with_class()) == len(only.annotated()) == 0
    assert only.pictures(16).shape == (2, 16, 16, 3)
    some = load(folder, tiles, HEAD + ROW + "images/001.png,,red,\nimages/002.png,,,\n")
    assert some.labels == ["good", None, None]
    assert [scene.line for scene in some.with_class().scenes] == [2]
    assert [scene.line for scene in some.annotated().scenes] == [2, 3]
    assert some.with_class().classes == ["good"]
    with pytest.raises(DatasetError) as problem:
        some.classes  # noqa: B018
    assert str(problem.value) == (
        f"{folder}/scenes.csv:3: the picture 'images/001.png' has no class; fill the cell 'class'"
    )


def test_a_picture_without_a_class_may_show_the_class_that_is_left_out(
    folder: Path, tiles: Domain
) -> None:
    dataset = load(folder, tiles, HEAD + ROW + "images/001.png,,red,\nimages/002.png,bad,,\n")
    assert [scene.line for scene in dataset.without_classes(["bad"]).scenes] == [2]
    assert dataset.without_classes([]) is dataset


def test_reasons_without_a_class(folder: Path, tiles: Domain) -> None:
    table = "image,class,colour,round,reasons\nimages/000.png,,red,yes,round\n"
    assert message(folder, tiles, table) == (
        "DIR/scenes.csv:2: there are reasons, but the cell 'class' is empty; say of which class "
        "they are the reasons, or take them away"
    )


def test_a_table_without_a_header(folder: Path, tiles: Domain) -> None:
    assert message(folder, tiles, ROW) == (
        "DIR/scenes.csv:1: names no column of the domain 'tiles', as the first line of a table "
        "does; put a line above the rows: image, class, colour, round"
    )


def test_backslashes_in_paths(folder: Path, tiles: Domain) -> None:
    dataset = load(folder, tiles, HEAD + "images\\000.png,good,red,yes\n")
    assert dataset.name_of(dataset.scenes[0]) == "images/000.png"
    (folder / "a\\b.png").write_bytes((folder / "images" / "001.png").read_bytes())
    as_it_is = load(folder, tiles, HEAD + "a\\b.png,good,red,yes\n")
    assert as_it_is.scenes[0].picture.name == "a\\b.png"
    assert message(folder, tiles, HEAD + "images\\no.png,good,red,yes\n") == (
        "DIR/scenes.csv:2: there is no picture 'images\\no.png' in DIR; use / in paths, and "
        "correct it or remove the row"
    )


def test_pictures_outside_of_the_folder(folder: Path, tiles: Domain, tmp_path: Path) -> None:
    secret = tmp_path / "secret.png"
    secret.write_bytes((folder / "images" / "000.png").read_bytes())
    (folder / "link.png").symlink_to(secret)
    (folder / "way").symlink_to(tmp_path)
    (folder / "inside.png").symlink_to(folder / "images" / "000.png")
    for name in (
        "../secret.png", "images/../../secret.png", str(secret), "link.png", "way/secret.png",
        "..\\secret.png", "../nothing.png", "..", "/",
    ):  # fmt: skip
        found = message(folder, tiles, HEAD + f"{name},good,red,yes\n")
        shown = name.replace("\\", "/") if name.startswith("..\\") else name
        assert found == (
            f"DIR/scenes.csv:2: the picture '{shown}' lies outside of DIR; copy it into the "
            "folder, or allow it with --outside (in Python: outside=True)"
        ), name
    rows = HEAD + "".join(
        f"{name},good,red,yes\n"
        for name in ("../secret.png", str(secret), "link.png", "way/secret.png")
    )
    (folder / "scenes.csv").write_text(rows)
    allowed = Dataset.load(folder, tiles, outside=True)
    assert [allowed.name_of(scene) for scene in allowed.scenes] == [
        "../secret.png", str(secret), "link.png", "way/secret.png"
    ]  # fmt: skip
    within = ("inside.png", "images/../images/000.png", f"{folder}/images/000.png")
    for name in within:
        assert len(load(folder, tiles, HEAD + f"{name},good,red,yes\n")) == 1, name


def test_a_table_that_is_a_link_out_of_its_folder(
    folder: Path, tiles: Domain, tmp_path: Path
) -> None:
    (folder / "scenes.csv").rename(tmp_path / "elsewhere.csv")
    (folder / "scenes.csv").symlink_to("../elsewhere.csv")
    expected = (
        f"{folder}/scenes.csv: is a link that leads out of the folder; copy the table into it, or "
        "allow it with --outside (in Python: outside=True)"
    )
    for read in (lambda: Dataset.load(folder, tiles), lambda: list_pictures([folder], tiles)):
        with pytest.raises(DatasetError) as problem:
            read()
        assert str(problem.value) == expected
    assert len(Dataset.load(folder, tiles, outside=True)) == 3


def test_a_folder_that_is_itself_reached_by_a_link(
    folder: Path, tiles: Domain, tmp_path: Path
) -> None:
    (tmp_path / "alias").symlink_to(folder)
    assert len(Dataset.load(tmp_path / "alias", tiles)) == 3


def test_paths_that_no_file_can_have(folder: Path, tiles: Domain) -> None:
    (folder / "loop.png").symlink_to("loop.png")
    os.mkfifo(folder / "pipe.png")
    long = "x" * 300 + ".png"
    for name, expected in {
        long: f"the picture's path '{'x' * 160}…' has 304 characters, more than a file can have; "
        "shorten the name",
        "loop.png": "the picture 'loop.png' is a link to itself; replace it by the picture",
        "pipe.png": "'pipe.png' is no file; name a picture's file",
        "images/": "'images/' is a folder, not a picture; name a picture in it",
        ".": "'.' is a folder, not a picture; name a picture in it",
        "images/000.png/1.png": "there is no picture 'images/000.png/1.png' in DIR; correct the "
        "path or remove the row",
        "a\x1b[31m.png": "there is no picture 'a�[31m.png' in DIR; correct the path or remove the "
        "row",
    }.items():
        found = message(folder, tiles, HEAD + f"{name},good,red,yes\n")
        assert found == f"DIR/scenes.csv:2: {expected}"


def test_a_dataset_of_another_domain(dataset: Dataset, structures: Domain) -> None:
    with pytest.raises(DatasetError) as problem:
        Agent(structures).fit(dataset)
    assert str(problem.value) == (
        f"{dataset.folder}: the dataset is of the domain 'tiles', the agent of "
        "'structure_stability'; load it with the agent's domain"
    )


def test_pictures_are_read_once_per_size(folder: Path, tiles: Domain) -> None:
    dataset = Dataset.load(folder, tiles)
    read: list[int] = []
    small = dataset.pictures(16, on_progress=read.append)
    assert small.shape == (3, 16, 16, 3)
    assert read == [1, 2, 3]
    assert dataset.pictures(16, on_progress=read.append) is small
    assert dataset.pictures(20).shape == (3, 20, 20, 3)
    assert dataset.take([2, 0]).pictures(16).tolist() == small[[2, 0]].tolist()
    assert read == [1, 2, 3]


def test_pictures_some_at_a_time(folder: Path, tiles: Domain) -> None:
    dataset = Dataset.load(folder, tiles)
    told: list[int] = []
    batches = list(dataset.iter_pictures(16, batch=2, on_progress=told.append))
    assert [batch.shape for batch in batches] == [(2, 16, 16, 3), (1, 16, 16, 3)]
    assert told == [1, 2, 3]
    whole = dataset.pictures(16)
    assert np.concatenate(batches).tolist() == whole.tolist()
    again = list(dataset.iter_pictures(16, batch=2, on_progress=told.append))
    assert np.concatenate(again).tolist() == whole.tolist()
    assert told == [1, 2, 3]  # they were read already
    assert next(Dataset.load(folder, tiles).iter_pictures(16, batch=1)).shape == (1, 16, 16, 3)


def test_a_file_that_is_no_picture_is_named(folder: Path, tiles: Domain) -> None:
    dataset = Dataset.load(folder, tiles)
    (folder / "images" / "001.png").write_text("no picture")
    with pytest.raises(PictureError, match=r"001\.png is not a picture of a known type"):
        dataset.pictures(16)


def test_digests_tell_pictures_apart(folder: Path, tiles: Domain) -> None:
    digests = Dataset.load(folder, tiles).picture_digests()
    assert len(set(digests)) == 3
    assert digests == Dataset.load(folder, tiles).picture_digests()


def test_a_contact_sheet_shows_every_scene_once(folder: Path, tiles: Domain) -> None:
    dataset = Dataset.load(folder, tiles)
    sheet = draw_contact_sheet(dataset, columns=2, rows=2, size=32)
    assert sheet.size[0] == 2 * 40 + 8
    assert draw_contact_sheet(dataset, columns=8, rows=5, size=32).size[0] == 3 * 40 + 8
    assert draw_contact_sheet(dataset, columns=1, rows=1, size=32).size[0] == 40 + 8


def test_the_domain_is_found_from_the_columns(folder: Path) -> None:
    (folder / "scenes.csv").write_text(
        "\ufeffimage,class,num_blocks,base, lean,block_displaced,split\n", encoding="utf-8"
    )
    assert domain_of(folder).name == "structure_stability"
    (folder / "scenes.csv").write_text(HEAD)
    with pytest.raises(DatasetError, match="the columns fit none of the bundled domains"):
        domain_of(folder)
    (folder / "scenes.csv").write_bytes(b"")
    with pytest.raises(DatasetError, match="the table is empty"):
        domain_of(folder)
    with pytest.raises(
        DatasetError, match=r"there is no dataset here, a folder with a scenes\.csv"
    ):
        domain_of(folder / "images")
