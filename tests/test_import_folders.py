"""Class folders as datasets: which folders are classes, splits, groups, features, archives."""

from __future__ import annotations

import json
import os
import zipfile
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from exports_builder import draw, draw_all, imported, notes_of, pack, rows_of, write
from seewhy.data.dataset import Dataset
from seewhy.data.importers import ImportRequest, import_pictures
from seewhy.data.importers.names import distinct_names, predicate_name, valid_name
from seewhy.data.importers.placing import image_names
from seewhy.domain.domain import load_domain
from seewhy.errors import DatasetError
from seewhy.knowledge.language import read_knowledge

PETS = ("cats/1.jpg", "cats/2.jpg", "dogs/1.jpg")


def classes(rows: list[dict[str, str]]) -> dict[str, str]:
    return {row["image"]: row["class"] for row in rows}


# Which folders are the classes -----------------------------------------------------------------


def test_each_folder_is_a_class(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "pets", PETS)
    dataset, rows = imported(source, "folder", tmp_path / "data")
    assert (tmp_path / "data" / "scenes.csv").read_text() == (
        "image,class\nimages/cats/1.jpg,cats\nimages/cats/2.jpg,cats\nimages/dogs/1.jpg,dogs\n"
    )
    assert dataset.classes == {"cats": 2, "dogs": 1}
    assert dataset.notes == ()
    assert not (tmp_path / "data" / "things.csv").exists()
    assert len(rows) == 3


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        # folders around the class folders are passed through
        (["a/b/cats/1.jpg", "a/b/dogs/1.jpg"], {"cats/1.jpg": "cats", "dogs/1.jpg": "dogs"}),
        # any depth below a class folder
        (["cats/old/x/1.jpg", "dogs/1.jpg"], {"cats/old/x/1.jpg": "cats", "dogs/1.jpg": "dogs"}),
        # one class alone, in the source itself or in folders around it
        (["cats/1.jpg", "cats/2.jpg"], {"1.jpg": "cats", "2.jpg": "cats"}),
        (["a/cats/1.jpg"], {"1.jpg": "cats"}),
        # no folders: pictures to be labelled
        (["1.jpg", "2.jpg"], {"1.jpg": "", "2.jpg": ""}),
        # some lie beside the folders
        (["cats/1.jpg", "dogs/1.jpg", "3.jpg"], {
            "cats/1.jpg": "cats", "dogs/1.jpg": "dogs", "3.jpg": "",
        }),
    ],
)  # fmt: skip
def test_where_the_class_folders_are(
    tmp_path: Path, names: list[str], expected: dict[str, str]
) -> None:
    _, rows = imported(draw_all(tmp_path / "source", names), "folder", tmp_path / "data")
    assert classes(rows) == {f"images/{name}": label for name, label in expected.items()}


def test_a_folder_with_nearly_all_pictures_holds_the_classes(tmp_path: Path) -> None:
    names = [f"cards/{kind}/{n}.jpg" for kind in ("one", "two") for n in range(20)]
    source = draw_all(tmp_path / "source", [*names, "tables/1.jpg"])
    dataset, _ = imported(source, "folder", tmp_path / "data")
    assert dataset.classes == {"one": 20, "two": 20}
    assert notes_of(dataset)["pictures beside cards, left out"] == ("tables/1.jpg",)
    # … and --inside says it where it is not plain
    few = draw_all(tmp_path / "few", ["cards/one/1.jpg", "cards/two/1.jpg", "tables/1.jpg"])
    unsure, _ = imported(few, "folder", tmp_path / "unsure")
    assert unsure.classes == {"cards": 2, "tables": 1}
    (note,) = notes_of(unsure).items()
    assert note == (
        "classes whose folder holds further folders (--inside FOLDER makes those the classes)",
        ("cards",),
    )
    inside, _ = imported(few, "folder", tmp_path / "inside", inside="cards")
    assert inside.classes == {"one": 1, "two": 1}


def test_splits(tmp_path: Path) -> None:
    names = ["train/cats/1.jpg", "Test/cats/2.jpg", "valid/dogs/3.jpg", "train/dogs/4.jpg"]
    dataset, rows = imported(draw_all(tmp_path / "s", names), "folder", tmp_path / "data")
    assert {row["image"].removeprefix("images/"): row["split"] for row in rows} == {
        "Test/cats/2.jpg": "test",
        "train/cats/1.jpg": "train",
        "train/dogs/4.jpg": "train",
        "valid/dogs/3.jpg": "train",
    }
    assert list(notes_of(dataset)) == ["the 1 pictures of the validation split are marked train"]
    two, rows = imported(
        draw_all(tmp_path / "two", ["train/cats/1.jpg", "val/dogs/3.jpg"]), "folder", tmp_path / "d"
    )
    assert two.splits == {"train": 1, "test": 1}
    assert list(notes_of(two)) == ["the 1 pictures of the validation split are marked test"]


def test_a_share_is_kept_for_tests_by_class_and_group(tmp_path: Path) -> None:
    names = [f"{kind}/p{n}_{kind}.jpg" for kind in ("cats", "dogs") for n in range(12)]
    source = draw_all(tmp_path / "s", names)
    dataset, rows = imported(source, "folder", tmp_path / "data", test_share=0.25, group="^p[0-9]+")
    assert dataset.splits == {"train": 18, "test": 6}
    by_group: dict[str, set[str]] = {}
    for row in rows:
        by_group.setdefault(row["group"], set()).add(row["split"])
    assert all(len(splits) == 1 for splits in by_group.values())
    test_classes = [row["class"] for row in rows if row["split"] == "test"]
    assert test_classes.count("cats") == 3
    again, _ = imported(source, "folder", tmp_path / "b", test_share=0.25, group="^p[0-9]+")
    assert again.splits == dataset.splits
    assert (tmp_path / "b/scenes.csv").read_text() == (tmp_path / "data/scenes.csv").read_text()


# Groups ----------------------------------------------------------------------------------------


def test_groups_by_file_names(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "s", ["a/7_1.jpg", "a/7_2.jpg", "b/8_7.jpg", "b/x.jpg"])
    dataset, rows = imported(source, "folder", tmp_path / "data", group="^([0-9]+)_")
    assert [row["group"] for row in rows] == ["7", "7", "8", ""]
    assert dataset.groups == 2
    (text,) = notes_of(dataset)
    assert text == "pictures whose name has no '^([0-9]+)_', each a group of its own"
    _, whole = imported(source, "folder", tmp_path / "whole", group="^[0-9]+")
    assert [row["group"] for row in whole] == ["7", "7", "8", ""]


def test_names_that_look_like_groups_are_said(tmp_path: Path) -> None:
    names = [f"{kind}/{person}_{kind}{n}.jpg" for kind in "01" for person in range(6) for n in "34"]
    dataset, _ = imported(draw_all(tmp_path / "s", names), "folder", tmp_path / "data")
    assert [note.text for note in dataset.notes] == [
        "file names such as 0_03.jpg may say which pictures belong together: --group '^(.+)[_-]' "
        "would make 6 groups of them, which are kept together when pictures are divided"
    ]
    # the class and a running number are none
    numbered = [f"{kind}/{kind}_{n}.jpg" for kind in ("cat", "dog") for n in range(12)]
    assert imported(draw_all(tmp_path / "n", numbered), "folder", tmp_path / "d")[0].notes == ()


# Features --------------------------------------------------------------------------------------


def test_features_follow_from_the_class(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "s", ["Big Cat/1.jpg", "dog/1.jpg"])
    table = write(tmp_path / "t.csv", "name;class;Has Tail;Coat Colour\nx;big_cat;1;Dark Red\n"
                  "y;dog;0;blue\nz;cow;1;\n")  # fmt: skip
    dataset, rows = imported(source, "folder", tmp_path / "data", features=table)
    assert rows == [
        {"image": "images/Big Cat/1.jpg", "class": "big_cat", "name": "x", "has_tail": "yes",
         "coat_colour": "dark_red"},
        {"image": "images/dog/1.jpg", "class": "dog", "name": "y", "has_tail": "no",
         "coat_colour": "blue"},
    ]  # fmt: skip
    assert notes_of(dataset) == {f"classes of {table} that no picture shows": ("cow",)}
    assert (tmp_path / "data/classes.csv").read_text() == (
        "class,name,has_tail,coat_colour\nbig_cat,x,yes,dark_red\ndog,y,no,blue\n"
    )
    words = json.loads((tmp_path / "data/imported.json").read_text())["words"]
    assert words["classes"] == {"big_cat": "Big Cat", "dog": "dog"}
    assert words["features"]["coat_colour"]["values"] == {"blue": "blue", "dark_red": "Dark Red"}


def test_a_value_that_is_perhaps_spelt_wrongly_is_named(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "s", ["cat/1.jpg", "dog/1.jpg", "cow/1.jpg"])
    table = write(
        tmp_path / "t.csv", "class,coat,legs\ncat,striped,4\ndog,striped,4\ncow,stripd,5\n"
    )
    dataset, _ = imported(source, "folder", tmp_path / "data", features=table)
    assert notes_of(dataset) == {
        f"{table}: 'stripd' of 'coat' is the value of cow alone; is 'striped' meant?": ()
    }


@pytest.mark.parametrize(
    "text",
    [
        "class,tail,wild\ncats,yes,no\nwolves,yes,yes\n",
        "tail,Class,wild\n1,cats,0\n1,wolves,1\n0,snails,0\n",
        "animal;tail;wild\ncats;x;\nwolves;x;x\nsnails;;\n",  # crosses; empty is no
        # the classes tell their column
        "type,tail,kind,wild\na,y,cats,n\nb,y,wolves,y\nc,n,snails,n\n",
        "Cats,tail,wild\nCATS,True,False\nwolves,True,True\n",  # the first column
    ],
)
def test_tables_of_features_as_people_write_them(tmp_path: Path, text: str) -> None:
    source = draw_all(tmp_path / "s", ["cats/1.jpg", "wolves/1.jpg"])
    _, rows = imported(
        source, "folder", tmp_path / "data", features=write(tmp_path / "t.csv", text)
    )
    assert [(row["tail"], row["wild"]) for row in rows] == [("yes", "no"), ("yes", "yes")]


def test_features_of_the_parts_of_names(tmp_path: Path) -> None:
    names = ["1-red-oval/1.jpg", "2-red-ovals/1.jpg", "2-blue-boxes/1.jpg", "1-blue-box/1.jpg"]
    dataset, rows = imported(
        draw_all(tmp_path / "s", names), "folder", tmp_path / "data",
        class_parts="number-colour-shape",
    )  # fmt: skip
    assert {row["class"]: (row["number"], row["colour"], row["shape"]) for row in rows} == {
        "n1_red_oval": ("1", "red", "oval"),
        "n2_red_ovals": ("2", "red", "oval"),
        "n2_blue_boxes": ("2", "blue", "box"),
        "n1_blue_box": ("1", "blue", "box"),
    }
    assert dataset.features["shape"] == {"box": 2, "oval": 2}


def test_spellings_of_one_class_become_one(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "s", ["train/Big-Cat/1.jpg", "test/big cat/1.jpg", "test/b/1.jpg"])
    dataset, _ = imported(source, "folder", tmp_path / "data")
    assert dataset.classes == {"b": 1, "big_cat": 2}
    (places,) = notes_of(dataset).values()
    assert places == ("big cat = Big-Cat",)


# Names -----------------------------------------------------------------------------------------


@given(st.text())
@example("IF")
def test_every_name_can_stand_in_the_knowledge(text: str) -> None:
    value, feature = valid_name(text), predicate_name(text)
    knowledge = read_knowledge(
        f"#sort shown. #sort values_of = {{{value}, another}}. "
        f"#static {feature}(shown, values_of). #static known_as(shown). "
        f"known_as(S) if {feature}(S, {value})."
    )
    assert value in knowledge.signature.members("values_of")
    assert valid_name(value) == value


@given(st.lists(st.text(max_size=8), unique=True))
def test_different_names_stay_different(texts: list[str]) -> None:
    names = distinct_names(texts)
    assert len({names[text] for text in texts}) == len(set(names.values()))
    assert all(valid_name(name) == name for name in names.values())


@given(
    st.lists(st.text(st.characters(codec="utf-8"), min_size=1, max_size=12), unique=True).map(
        lambda parts: [f"a/{part.replace('/', '-')}" for part in parts]
    )
)
def test_every_picture_gets_a_place_of_its_own(files: list[str]) -> None:
    names = image_names(files)
    assert len({name.casefold() for name in names}) == len(files)
    assert all(name.startswith("images/") and ".." not in name.split("/") for name in names)


# Writing ---------------------------------------------------------------------------------------


def test_pictures_are_linked_where_they_can_be(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "s", PETS)
    linked, _ = imported(source, "folder", tmp_path / "linked")
    assert linked.linked
    assert (tmp_path / "linked/images/cats/1.jpg").samefile(source / "cats/1.jpg")
    copied, _ = imported(source, "folder", tmp_path / "copied", copy=True)
    assert not copied.linked
    copy = tmp_path / "copied/images/cats/1.jpg"
    assert not copy.samefile(source / "cats/1.jpg")
    assert copy.read_bytes() == (source / "cats/1.jpg").read_bytes()


def test_pictures_are_copied_where_they_cannot_be_linked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: Path) -> None:
        raise OSError(18, "Invalid cross-device link")

    monkeypatch.setattr(Path, "hardlink_to", refuse)
    dataset, rows = imported(draw_all(tmp_path / "s", PETS), "folder", tmp_path / "data")
    assert not dataset.linked
    assert all((tmp_path / "data" / row["image"]).is_file() for row in rows)


@pytest.mark.parametrize("packed", [False, True])
def test_an_interrupted_import_goes_on(tmp_path: Path, packed: bool) -> None:
    source = draw_all(tmp_path / "s", [f"{kind}/{n}.png" for kind in "ab" for n in range(4)])
    source = pack(source, tmp_path / "s.zip") if packed else source
    request = ImportRequest(source, "folder", copy=True)
    folder = tmp_path / "data"

    def interrupt(done: int, total: int) -> None:
        assert total == 8
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        import_pictures(request, folder, on_progress=interrupt)
    assert sorted(path.name for path in folder.iterdir()) == ["images", "imported.json"]
    before = {path: path.stat().st_ino for path in folder.glob("images/*/*")}
    assert len(before) == 3
    other = ImportRequest(source, "folder", copy=True, group="^[0-9]")
    with pytest.raises(DatasetError, match="holds an unfinished import of another source or"):
        import_pictures(other, folder)
    import_pictures(request, folder)
    assert len(rows_of(folder / "scenes.csv")) == 8
    # what was there is not written again
    assert {path: path.stat().st_ino for path in before} == before
    import_pictures(request, tmp_path / "at once")
    for name in ("scenes.csv",):
        assert (folder / name).read_bytes() == (tmp_path / "at once" / name).read_bytes()


def test_a_picture_that_changed_meanwhile_is_written_again(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "s", ["a/1.png", "b/1.png"])
    request = ImportRequest(source, "folder", copy=True)

    def interrupt(*_: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        import_pictures(request, tmp_path / "data", on_progress=interrupt)
    draw(source / "a/1.png", colour="blue")
    os.utime(source / "a/1.png", (1_000_000_000, 1_000_000_000))
    import_pictures(request, tmp_path / "data")
    assert (tmp_path / "data/images/a/1.png").read_bytes() == (source / "a/1.png").read_bytes()


def test_the_dataset_is_one_like_any_other(tmp_path: Path, tiles_folder: Path) -> None:
    source = draw_all(tmp_path / "s", ["good/1.jpg", "bad/1.jpg", "3.jpg"])
    table = write(tmp_path / "t.csv", "class,colour,round\ngood,red,yes\nbad,blue,no\n")
    imported(source, "folder", tmp_path / "data", features=table)
    loaded = Dataset.load(tmp_path / "data", load_domain(tiles_folder))
    assert [(scene.label, scene.vector) for scene in loaded.scenes] == [
        (None, (None, None)),
        ("bad", ("blue", "no")),
        ("good", ("red", "yes")),
    ]


def test_a_dataset_inside_of_its_source(tmp_path: Path) -> None:
    """What was written there before is no part of the source, finished or not."""
    source = draw_all(tmp_path / "s", [f"{kind}/{n}.png" for kind in "ab" for n in range(3)])
    request = ImportRequest(source, "folder")

    def interrupt(*_: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        import_pictures(request, source / "data", on_progress=interrupt)
    assert import_pictures(request, source / "data").classes == {"a": 3, "b": 3}
    assert import_pictures(request, source / "again").classes == {"a": 3, "b": 3}


def test_file_names_that_are_no_text(tmp_path: Path) -> None:
    """Names in another encoding than the system's."""
    source = draw_all(tmp_path / "s", ["cats/1_1.png"])
    folder = os.fsdecode(os.fsencode(source) + b"/caf\xe9")
    Path(folder).mkdir()
    for name in (b"\xff_1.png", b"\xfe_2.png", b"note\xe9.txt"):
        draw(tmp_path / "one.png").rename(Path(folder) / os.fsdecode(name))
    imported(source, "folder", tmp_path / "ungrouped", test_share=0.5)
    dataset, rows = imported(source, "folder", tmp_path / "data", group="^(.)_")
    assert [(row["image"], row["class"], row["group"]) for row in rows] == [
        ("images/caf_/__2.png", "caf", "?"),
        ("images/caf_/__1.png", "caf", "?"),
        ("images/cats/1_1.png", "cats", "1"),
    ]
    assert json.loads((tmp_path / "data/imported.json").read_text())["words"]["classes"] == {
        "caf": "caf?",
        "cats": "cats",
    }
    assert notes_of(dataset)["files that are no pictures, left out"] == ("caf?/note?.txt",)


# Archives --------------------------------------------------------------------------------------


def test_a_zip_archive_is_read_where_it_is(tmp_path: Path) -> None:
    names = ["pets/cats/1.jpg", "pets/dogs/1.jpg", "__MACOSX/pets/cats/._1.jpg", "pets/.DS_Store"]
    archive = pack(draw_all(tmp_path / "s", names[:3]), tmp_path / "pets.zip")
    dataset, rows = imported(archive, "folder", tmp_path / "data")
    assert classes(rows) == {"images/cats/1.jpg": "cats", "images/dogs/1.jpg": "dogs"}
    assert dataset.notes == ()
    assert not dataset.linked


def test_names_of_windows_in_an_archive(tmp_path: Path) -> None:
    picture = draw(tmp_path / "1.png").read_bytes()
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        for name in ("pets\\cats\\1.png", "pets\\dogs\\1.png"):
            member = zipfile.ZipInfo("x")
            member.filename = name  # the constructor would mend it
            archive.writestr(member, picture)
    _, rows = imported(tmp_path / "a.zip", "folder", tmp_path / "data")
    assert classes(rows) == {"images/cats/1.png": "cats", "images/dogs/1.png": "dogs"}
