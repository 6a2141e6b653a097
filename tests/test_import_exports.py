"""Exports of labelling tools as datasets: COCO, Pascal VOC, YOLO, Label Studio, CVAT."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from PIL import Image, ImageOps

from exports_builder import (
    choice,
    coco,
    cvat,
    draw,
    draw_all,
    imported,
    notes_of,
    pack,
    rectangle,
    task,
    voc,
    voc_object,
    write,
    write_json,
)
from seewhy.data.importers.annotation import AnnotatedPicture, Box, Notes
from seewhy.data.importers.boxes import boxes_in_pixels
from seewhy.data.importers.folder_files import FolderFiles
from seewhy.data.importers.json_reading import json_items
from seewhy.data.importers.picture_files import PictureHeader

ONE_CLASS = "all pictures are of one class (cat): training needs pictures of another"


def scenes(folder: Path) -> list[str]:
    return (folder / "scenes.csv").read_text().splitlines()


def things(folder: Path) -> list[str]:
    return (folder / "things.csv").read_text().splitlines()


# COCO ------------------------------------------------------------------------------------------


@pytest.fixture
def animals(tmp_path: Path) -> Path:
    """A COCO dataset of two splits."""
    home = tmp_path / "animals"
    draw_all(home, ["train2017/1.jpg", "train2017/2.jpg", "train2017/3.jpg", "val2017/1.jpg"])
    write_json(
        home / "annotations/instances_train2017.json",
        coco(
            [{"id": 1, "file_name": "1.jpg"}, {"id": 2, "file_name": "2.jpg"},
             {"id": 3, "file_name": "3.jpg"}],
            [
                {"image_id": 1, "category_id": 1, "bbox": [1, 2, 10, 5.5],
                 "segmentation": [[1, 2, 11, 2, 11, 7.5]],
                 "attributes": {"Ear Tag": True, "age": 3}},
                {"image_id": 1, "category_id": 1, "bbox": [20, 0, 20, 20], "iscrowd": 1,
                 "segmentation": {"counts": [0, 5, 795], "size": [20, 40]}},
                {"image_id": 2, "category_id": 1, "bbox": [0, 0, 2, 2]},
                {"image_id": 2, "category_id": 2, "bbox": [0, 0, 30, 20]},
            ],
        ),
    )  # fmt: skip
    write_json(
        home / "annotations/instances_val2017.json",
        coco(
            [{"id": 1, "file_name": "1.jpg"}],
            [{"image_id": 1, "category_id": 2, "segmentation": [[5, 5, 9, 5, 9, 15]]}],
        ),
    )
    write_json(
        home / "annotations/captions_val2017.json",
        coco([{"id": 1, "file_name": "1.jpg"}], [{"image_id": 1, "caption": "a dog"}]),
    )
    return home


def test_coco(animals: Path, tmp_path: Path) -> None:
    dataset, _ = imported(animals, "coco", tmp_path / "data")
    assert scenes(tmp_path / "data") == [
        "image,class,split",
        "images/train2017/1.jpg,cat,train",
        "images/train2017/2.jpg,,train",  # a cat and a dog
        "images/train2017/3.jpg,,train",
        "images/val2017/1.jpg,dog,test",
    ]
    assert things(tmp_path / "data") == [
        "image,thing,left,top,right,bottom,kind,ear_tag,age,crowd",
        "images/train2017/1.jpg,1,1,2,11,7.5,cat,yes,3,",
        "images/train2017/1.jpg,2,20,0,40,20,cat,,,yes",
        "images/train2017/2.jpg,1,0,0,2,2,cat,,,",
        "images/train2017/2.jpg,2,0,0,30,20,dog,,,",
        "images/val2017/1.jpg,1,5,5,9,15,dog,,,",
    ]
    assert dataset.kinds == {"cat": 3, "dog": 2}
    assert (
        "1 pictures have boxes of several kinds and so no class; --class largest gives them that "
        "of the largest box"
    ) in notes_of(dataset)
    assert dataset.things == 5


def test_attributes_called_like_columns_of_the_tables(tmp_path: Path) -> None:
    """Otherwise the domain that is written could not be read."""
    draw_all(tmp_path / "p", ["1.jpg"])
    said = {"x": 3, "Left": "no", "kind": "big"}
    boxes = [{"image_id": 1, "category_id": 1, "bbox": [0, 0, 5, 5], "attributes": said}]
    write_json(tmp_path / "p/labels.json", coco([{"id": 1, "file_name": "1.jpg"}], boxes))
    imported(tmp_path / "p", "coco", tmp_path / "data")
    header = things(tmp_path / "data")[0].split(",")
    assert header[:7] == ["image", "thing", "left", "top", "right", "bottom", "kind"]
    assert len(header) == 10
    assert not {"x", "left", "kind"} & set(header[7:])


@pytest.mark.parametrize(
    ("rule", "labels"), [("largest", ["cat", "dog", "", "dog"]), ("none", ["", "", "", ""])]
)
def test_the_class_of_boxes(animals: Path, tmp_path: Path, rule: str, labels: list[str]) -> None:
    _, rows = imported(animals, "coco", tmp_path / "data", class_rule=rule)
    assert [row["class"] for row in rows] == labels


def test_coco_beside_its_pictures_in_an_archive(tmp_path: Path) -> None:
    """As Roboflow exports it: one folder a split, the file among the pictures."""
    home = tmp_path / "export"
    for split in ("train", "valid"):
        draw(home / split / "same.jpg", size=(40, 20) if split == "train" else (20, 40))
        write_json(
            home / split / "_annotations.coco.json",
            coco(
                [{"id": 0, "file_name": "same.jpg"}],
                [{"image_id": 0, "category_id": 1, "bbox": [1, 1, 9, 9]}],
            ),
        )
    archive = pack(home, tmp_path / "export.zip")
    _, rows = imported(archive, "coco", tmp_path / "data")
    assert [(row["image"], row["class"], row["split"]) for row in rows] == [
        ("images/train/same.jpg", "cat", "train"),
        ("images/valid/same.jpg", "cat", "test"),
    ]


def test_coco_labels_without_a_box_are_classes(tmp_path: Path) -> None:
    draw_all(tmp_path, ["1.jpg", "2.jpg"])
    file = write_json(
        tmp_path / "labels.json",
        coco(
            [{"id": "a", "file_name": "1.jpg"}, {"id": "b", "file_name": "2.jpg"}],
            [
                {"image_id": "a", "category_id": 2},
                {"image_id": "b", "category_id": 1, "bbox": [], "segmentation": []},
            ],
        ),
    )
    _, rows = imported(file, "coco", tmp_path / "data")
    assert [row["class"] for row in rows] == ["dog", "cat"]


def test_json_is_read_an_item_at_a_time(tmp_path: Path) -> None:
    """Whatever the size of the pieces in which the file is read, the items are the same."""
    value = {
        "a": [{"n": n, "text": 'ü"\\' * n} for n in range(200)],
        "b": {"c": [1, 2]},
        "d": [],
        "e": [1.5, -2, 3e10, True, None, "x"],
    }
    write_json(tmp_path / "a.json", value)
    for size in (1, 2, 7, 64, 2**20):
        read = list(_items_in_pieces(tmp_path, size))
        assert [item for key, _, item in read if key == "a"] == value["a"]
        assert ("b", -1, {"c": [1, 2]}) in read
        assert [item for key, _, item in read if key == "e"] == value["e"]


def _items_in_pieces(folder: Path, size: int) -> Any:
    from seewhy.data.importers import json_reading

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(json_reading, "_CHUNK", size)
        yield from json_items(FolderFiles(folder), "a.json")


# Pascal VOC ------------------------------------------------------------------------------------


def test_voc(tmp_path: Path) -> None:
    home = tmp_path / "VOCdevkit/VOC2012"
    draw_all(home / "JPEGImages", ["1.jpg", "2.jpg", "3.jpg"])
    occluded = (
        "<attributes><attribute><name>Colour</name><value>Red</value></attribute></attributes>"
    )
    write(home / "Annotations/1.xml", voc("1.jpg", voc_object("cat", (1, 1, 40, 20), occluded)))
    write(home / "Annotations/2.xml", voc("2.jpg", voc_object("dog", (3, 4, 9, 9))))
    write(home / "Annotations/3.xml", voc("3.jpg"))
    write(home / "ImageSets/Main/train.txt", "1\n")
    write(home / "ImageSets/Main/val.txt", "2\n")
    write(home / "ImageSets/Main/trainval.txt", "1\n2\n")
    write(home / "ImageSets/Main/test.txt", "3\n")
    write(home / "ImageSets/Main/cat_train.txt", "1  1\n2 -1\n")
    imported(tmp_path / "VOCdevkit", "voc", tmp_path / "data")
    assert scenes(tmp_path / "data") == [
        "image,class,split",
        "images/1.jpg,cat,train",
        "images/2.jpg,dog,train",
        "images/3.jpg,,test",
    ]
    assert things(tmp_path / "data") == [
        "image,thing,left,top,right,bottom,kind,truncated,difficult,colour",
        "images/1.jpg,1,0,0,40,20,cat,no,yes,red",
        "images/2.jpg,1,2,3,9,9,dog,no,yes,",
    ]


def test_voc_beside_its_pictures(tmp_path: Path) -> None:
    """As LabelImg writes it; the name in the file may have lost its ending."""
    draw_all(tmp_path / "s", ["a.png", "b.png"])
    write(tmp_path / "s/a.xml", voc("a", voc_object("cat", (1, 1, 9, 9))))
    write(tmp_path / "s/b.xml", voc("b.png", voc_object("dog", (1, 1, 9, 9))))
    _, rows = imported(tmp_path / "s", "voc", tmp_path / "data")
    assert [(row["image"], row["class"]) for row in rows] == [
        ("images/a.png", "cat"),
        ("images/b.png", "dog"),
    ]


# YOLO ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("names", ["[cat, 'stop sign']", "{0: cat, 1: stop sign}"])
def test_yolo(tmp_path: Path, names: str) -> None:
    home = tmp_path / "set"
    draw_all(home, ["images/train/1.jpg", "images/val/2.jpg", "images/val/3.jpg"])
    splits = "path: ../datasets/set\ntrain: images/train\nval: images/val\ntest:\n"
    write(home / "data.yaml", f"{splits}names: {names}\n")
    write(home / "labels/train/1.txt", "0 0.5 0.5 0.5 0.5\n\n1 0.25 0.5 0.5 1.0 0.93\n")
    write(home / "labels/val/2.txt", "1 0.1 0.2 0.5 0.2 0.5 0.8\n")
    imported(home, "yolo", tmp_path / "data")
    assert scenes(tmp_path / "data") == [
        "image,class,split",
        "images/train/1.jpg,,train",
        "images/val/2.jpg,stop_sign,test",
        "images/val/3.jpg,,test",
    ]
    assert things(tmp_path / "data") == [
        "image,thing,left,top,right,bottom,kind",
        "images/train/1.jpg,1,10,5,30,15,cat",
        "images/train/1.jpg,2,0,0,20,20,stop_sign",
        "images/val/2.jpg,1,4,4,20,16,stop_sign",
    ]


@pytest.mark.parametrize(
    ("files", "split"),
    [
        # Roboflow: folders by split, the YAML file says ../train/images
        ({"data.yaml": "train: ../train/images\nval: ../valid/images\nnames: [cat]\n",
          "train/labels/1.txt": "0 .5 .5 .5 .5", "train/images/1.jpg": ""}, "train"),
        # a list of pictures
        ({"data.yaml": "test: lists/t.txt\nnames: [cat]\n", "lists/t.txt": "./images/1.jpg\n",
          "labels/1.txt": "0 .5 .5 .5 .5", "images/1.jpg": ""}, "test"),
        # Label Studio, LabelImg, CVAT 1.1: names in a text file
        ({"classes.txt": "cat\n", "labels/1.txt": "0 .5 .5 .5 .5", "images/1.jpg": ""}, None),
        ({"classes.txt": "cat\n", "1.txt": "0 .5 .5 .5 .5", "1.jpg": ""}, None),
        ({"obj.names": "cat\n", "train.txt": "data/obj_train_data/1.jpg",
          "obj_train_data/1.txt": "0 .5 .5 .5 .5", "obj_train_data/1.jpg": ""}, None),
        # classification has folders
        ({"train/cat/1.jpg": "", "train/dog/2.jpg": ""}, "train"),
    ],
)  # fmt: skip
def test_yolo_as_tools_write_it(tmp_path: Path, files: dict[str, str], split: str | None) -> None:
    for name, text in files.items():
        if name.endswith(".jpg"):
            draw(tmp_path / "set" / name)
        else:
            write(tmp_path / "set" / name, text)
    _, rows = imported(pack(tmp_path / "set", tmp_path / "set.zip"), "yolo", tmp_path / "data")
    assert rows[0]["class"] == "cat"
    assert rows[0].get("split") == split


# Label Studio ----------------------------------------------------------------------------------


@pytest.fixture
def uploads(tmp_path: Path) -> Path:
    """Pictures as Label Studio keeps what was uploaded, and as a user has them."""
    return draw_all(tmp_path / "media/upload/7", ["3f2a91bc-a_b.jpg", "5e1d02aa-c.jpg", "d.jpg"])


TASKS = [
    task(1, "/data/upload/7/3f2a91bc-a_b.jpg", [
        choice("class", "Good"), choice("Ripe", "Yes"), choice("defects", "Spot", "Worm Hole"),
        rectangle("Apple", (10, 10, 50, 50), region="r1"), choice("Bruised", "no", region="r1"),
        rectangle("Leaf", (50, 50, 25, 25), region="r2", rotation=90),
    ]),
    task(2, "/data/local-files/?d=somewhere/c.jpg", [choice("class", "Bad"), choice("Ripe", "No")]),
    task(3, "s3://bucket/path/d.jpg", None),
]  # fmt: skip


def test_label_studio(tmp_path: Path, uploads: Path) -> None:
    file = write_json(tmp_path / "project-7-at-2026-03-01-10-00-3f2a91bc.json", TASKS)
    draw(tmp_path / "own/somewhere/c.jpg")
    dataset, _ = imported(file, "labelstudio", tmp_path / "data", pictures=tmp_path / "media")
    assert set(notes_of(dataset)) == {
        "pictures that are not there, left out",
        "boxes that are turned, kept as the upright box around them",
        "the control 'class' is taken as the class",
        "all pictures are of one class (Good): training needs pictures of another",
        "1 of 2 pictures have no class: they are there to be labelled or classified",
    }
    draw(uploads / "c.jpg")
    dataset, _ = imported(file, "labelstudio", tmp_path / "all", pictures=tmp_path / "media")
    assert scenes(tmp_path / "all") == [
        "image,class,ripe,spot,worm_hole",
        "images/3f2a91bc-a_b.jpg,good,yes,yes,yes",
        "images/c.jpg,bad,no,no,no",
        "images/d.jpg,,,,",
    ]
    assert things(tmp_path / "all") == [
        "image,thing,left,top,right,bottom,kind,bruised",
        "images/3f2a91bc-a_b.jpg,1,4,2,24,12,apple,no",
        # 10×5 pixels turned by a quarter around (20, 10)
        "images/3f2a91bc-a_b.jpg,2,15,10,20,20,leaf,",
    ]


def test_label_studio_min(tmp_path: Path, uploads: Path) -> None:
    file = write_json(
        tmp_path / "min.json",
        [
            {
                "image": "/data/upload/7/3f2a91bc-a_b.jpg", "id": 1, "class": "Good",
                "defects": {"choices": ["Spot", "Worm Hole"]},
                "box": [{"x": 10, "y": 10, "width": 50, "height": 50, "rotation": 0,
                         "rectanglelabels": ["Apple"], "original_width": 40,
                         "original_height": 20}],
                "annotator": 1, "annotation_id": 9, "created_at": "2026-03-01T10:00:00Z",
                "updated_at": "2026-03-01T10:00:00Z", "lead_time": 4.2,
            },
            {
                "image": "/data/upload/7/5e1d02aa-c.jpg", "id": 2, "class": "Bad",
                "defects": "Spot", "annotator": 1, "annotation_id": 10,
                "created_at": "2026-03-01T10:00:00Z", "updated_at": "2026-03-01T10:00:00Z",
                "lead_time": 2.0,
            },
        ],
    )  # fmt: skip
    imported(file, "labelstudio", tmp_path / "data", pictures=uploads)
    assert scenes(tmp_path / "data") == [
        "image,class,spot,worm_hole",
        "images/3f2a91bc-a_b.jpg,good,yes,yes",
        "images/5e1d02aa-c.jpg,bad,yes,no",
    ]
    assert things(tmp_path / "data")[1:] == ["images/3f2a91bc-a_b.jpg,1,4,2,24,12,apple"]


def test_label_studio_the_newest_annotation_counts(tmp_path: Path, uploads: Path) -> None:
    first = task(1, "d.jpg", [choice("kind", "old")], updated_at="2026-01-01T00:00:00Z")
    second = task(1, "d.jpg", [choice("kind", "new")], updated_at="2026-02-01T00:00:00Z")
    skipped = task(1, "d.jpg", [choice("kind", "skipped")], was_cancelled=True)
    for completed, label in (
        ([first, second, skipped], "new"),
        ([second, first], "new"),
        ([skipped], ""),
    ):
        merged = {**first, "annotations": [one["annotations"][0] for one in completed]}
        file = write_json(tmp_path / "e.json", [merged])
        out = tmp_path / f"data{len(list(tmp_path.iterdir()))}"
        _, rows = imported(file, "labelstudio", out, pictures=uploads)
        assert [row["class"] for row in rows] == [label]


def test_label_studio_other_shapes(tmp_path: Path, uploads: Path) -> None:
    """Polygons and ellipses become the box around them; labels may be a result of their own."""
    region = {"original_width": 40, "original_height": 20, "image_rotation": 0, "to_name": "image"}
    polygon = {"points": [[10, 10], [50, 20], [30, 90]], "polygonlabels": ["A"], "closed": True}
    ellipse = {
        "x": 50,
        "y": 50,
        "radiusX": 25,
        "radiusY": 10,
        "rotation": 0,
        "ellipselabels": ["B"],
    }
    plain = {"x": 0, "y": 0, "width": 25, "height": 50, "rotation": 0}
    results = [
        {**region, "id": "p", "from_name": "poly", "type": "polygonlabels", "value": polygon},
        {**region, "id": "e", "from_name": "oval", "type": "ellipselabels", "value": ellipse},
        {**region, "id": "r", "from_name": "rect", "type": "rectangle", "value": plain},
        {**region, "id": "r", "from_name": "what", "type": "labels",
         "value": {**plain, "labels": ["C"]}},
        {**region, "id": "r", "from_name": "stars", "type": "rating",
         "value": {**plain, "rating": 4}},
        {"from_id": "p", "to_id": "e", "type": "relation", "direction": "right"},
    ]  # fmt: skip
    file = write_json(tmp_path / "e.json", [task(1, "d.jpg", results)])
    imported(file, "labelstudio", tmp_path / "data", pictures=uploads)
    assert things(tmp_path / "data") == [
        "image,thing,left,top,right,bottom,kind,stars",
        "images/d.jpg,1,4,2,20,18,a,",
        "images/d.jpg,2,10,8,30,12,b,",
        "images/d.jpg,3,0,0,10,10,c,4",
    ]


def test_label_studio_which_control_is_the_class(tmp_path: Path, uploads: Path) -> None:
    file = write_json(
        tmp_path / "e.json", [task(1, "d.jpg", [choice("hue", "red"), choice("form", "round")])]
    )
    dataset, rows = imported(file, "labelstudio", tmp_path / "none", pictures=uploads)
    assert rows[0] == {"image": "images/d.jpg", "class": "", "hue": "red", "form": "round"}
    assert "no control says the class; --class-column names it (hue, form)" in notes_of(dataset)
    _, rows = imported(
        file, "labelstudio", tmp_path / "data", pictures=uploads, class_column="form"
    )
    assert rows[0] == {"image": "images/d.jpg", "class": "round", "hue": "red"}


# CVAT ------------------------------------------------------------------------------------------


def test_cvat(tmp_path: Path) -> None:
    home = tmp_path / "export"
    draw_all(home / "images", ["Train/1.jpg", "Train/2.jpg", "3.jpg"])
    write(
        home / "annotations.xml",
        cvat(
            '<image id="0" name="1.jpg" subset="Train" width="40" height="20">'
            '<tag label="good" source="manual"><attribute name="Ripe">true</attribute></tag>'
            '<box label="apple" source="manual" occluded="1" xtl="1.00" ytl="2.00" xbr="9.50" '
            'ybr="8.00" z_order="0"><attribute name="colour">Dark red</attribute></box>'
            '<polygon label="leaf" source="manual" occluded="0" z_order="0" '
            'points="10.0,1.0;20.0,1.0;15.0,9.0"></polygon></image>\n'
            '<image id="1" name="2.jpg" subset="Train" width="40" height="20">'
            '<tag label="bad" source="manual"></tag>'
            '<skeleton label="s" source="manual" z_order="0"></skeleton></image>\n'
            '<image id="2" name="3.jpg" width="40" height="20"></image>\n'
        ),
    )
    archive = pack(home, tmp_path / "task.zip")
    dataset, _ = imported(archive, "cvat", tmp_path / "data")
    assert scenes(tmp_path / "data") == [
        "image,class,ripe,split",
        "images/Train/1.jpg,good,yes,train",
        "images/Train/2.jpg,bad,,train",
        "images/3.jpg,,,",
    ]
    assert things(tmp_path / "data") == [
        "image,thing,left,top,right,bottom,kind,colour,occluded",
        "images/Train/1.jpg,1,1,2,9.5,8,apple,dark_red,yes",
        "images/Train/1.jpg,2,10,1,20,9,leaf,,",
    ]
    assert notes_of(dataset)["shapes without a box that can be read (skeleton), left out"] == (
        "1 in images/Train/2.jpg",
    )


def test_cvat_other_shapes(tmp_path: Path) -> None:
    draw(tmp_path / "s/1.jpg")
    write(
        tmp_path / "s/annotations.xml",
        cvat(
            '<image id="0" name="1.jpg" width="40" height="20">'
            '<ellipse label="a" cx="10" cy="10" rx="4" ry="2"/>'
            '<mask label="b" rle="0, 6" left="3" top="4" width="5" height="6"/>'
            '<box label="c" xtl="10" ytl="8" xbr="14" ybr="10" rotation="90"/>'
            '<polyline label="d" points="1,2;3,4"/><points label="e" points="5,5"/></image>'
        ),
    )
    dataset, _ = imported(tmp_path / "s", "cvat", tmp_path / "data")
    assert things(tmp_path / "data")[1:] == [
        "images/1.jpg,1,6,8,14,12,a",
        "images/1.jpg,2,3,4,8,10,b",
        "images/1.jpg,3,11,7,13,11,c",
        "images/1.jpg,4,1,2,3,4,d",
    ]
    assert notes_of(dataset)["boxes that are turned, kept as the upright box around them"] == (
        "1.jpg",
    )


def test_cvat_several_tags_are_features(tmp_path: Path) -> None:
    draw_all(tmp_path / "s/images", ["1.jpg", "2.jpg"])
    write(
        tmp_path / "s/annotations.xml",
        cvat(
            '<image id="0" name="1.jpg" width="40" height="20"><tag label="wet"></tag>'
            '<tag label="cold"></tag></image>'
            '<image id="1" name="2.jpg" width="40" height="20"><tag label="wet"></tag></image>'
        ),
    )
    _, rows = imported(tmp_path / "s", "cvat", tmp_path / "data")
    assert [(row["class"], row["wet"], row["cold"]) for row in rows] == [
        ("", "yes", "yes"),
        ("", "yes", "no"),
    ]


# Boxes -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("orientation", range(1, 9))
def test_boxes_measured_before_the_camera_was_turned(orientation: int) -> None:
    """A box on the stored picture is where its content is on the upright one."""
    stored = Image.new("RGB", (40, 20))
    stored.paste((255, 255, 255), (3, 5, 10, 17))
    exif = stored.getexif()
    exif[0x0112] = orientation
    upright = ImageOps.exif_transpose(stored)
    header = PictureHeader(upright.size, stored.size, orientation)
    picture = AnnotatedPicture("a.jpg", boxes=(Box(3, 5, 10, 17, "x"),), measured_in=(40, 20))
    if upright.size == stored.size:
        # half a turn cannot be told by the size: the box counts as it stands
        assert boxes_in_pixels(picture, header, Notes()) == picture.boxes
        return
    (box,) = boxes_in_pixels(picture, header, Notes())
    assert upright.getbbox() == (box.left, box.top, box.right, box.bottom)


def test_boxes_of_a_picture_that_was_made_smaller(tmp_path: Path) -> None:
    draw(tmp_path / "s/1.jpg", size=(40, 20))
    draw(tmp_path / "s/2.jpg", size=(30, 30))
    file = write_json(
        tmp_path / "s/a.json",
        coco(
            [{"id": n, "file_name": f"{n}.jpg", "width": 400, "height": 200} for n in (1, 2)],
            [{"image_id": n, "category_id": 1, "bbox": [100, 100, 100, 50]} for n in (1, 2)],
        ),
    )
    dataset, _ = imported(file, "coco", tmp_path / "data")
    assert things(tmp_path / "data")[1:] == ["images/1.jpg,1,10,10,20,15,cat"]
    assert notes_of(dataset) == {
        ONE_CLASS: (),
        "pictures of another size than they were annotated in, boxes scaled": (),
        "boxes measured on a picture of another shape, left out": ("2.jpg is 30×30, was 400×200",),
    }


def test_boxes_outside_of_their_picture(tmp_path: Path) -> None:
    draw(tmp_path / "s/1.jpg")
    boxes = [[-5, -5, 10, 10], [30, 10, 50, 50], [50, 5, 10, 10], [5, 5, 0, 9], [39.5, 0, 1, 20.4]]
    file = write_json(
        tmp_path / "s/a.json",
        coco(
            [{"id": 1, "file_name": "1.jpg"}],
            [{"image_id": 1, "category_id": 1, "bbox": box} for box in boxes],
        ),
    )
    dataset, _ = imported(file, "coco", tmp_path / "data")
    assert things(tmp_path / "data")[1:] == [
        "images/1.jpg,1,0,0,5,5,cat",
        "images/1.jpg,2,30,10,40,20,cat",
        "images/1.jpg,3,39.5,0,40,20,cat",  # a pixel's part too far is rounding
    ]
    assert notes_of(dataset) == {
        ONE_CLASS: (),
        "boxes that reach out of their picture, cut off at its edge": (
            "1.jpg cat (-5, -5, 5, 5)",
            "1.jpg cat (30, 10, 80, 60)",
        ),
        "boxes outside of their picture, left out": ("1.jpg cat (50, 5, 60, 15)",),
        "boxes without a size, left out": ("1.jpg cat (5, 5, 5, 14)",),
    }


def test_the_report_for_a_program(animals: Path, tmp_path: Path) -> None:
    dataset, _ = imported(animals, "coco", tmp_path / "data")
    report = dataset.as_json()
    assert json.loads(json.dumps(report)) == report
    assert (report["pictures"], report["things"], report["splits"]) == (
        4,
        5,
        {"train": 3, "test": 1},
    )
    record = json.loads((tmp_path / "data/imported.json").read_text())
    assert record["finished"] is True
    assert record["report"] == report
