"""things.csv and relations.csv beside scenes.csv: the things of pictures, and what holds of two."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from seewhy.data.listed_relations import contradicted, not_listed
from seewhy.data.scene import Scene, TablePlace
from seewhy.data.table import Table, read_table
from seewhy.data.thing import CORNERS, RELATIONS, THINGS, BoundingBox, Related, Thing
from seewhy.domain.domain import Domain
from seewhy.domain.things import ThingFeature, Things
from seewhy.errors import DatasetError, PictureError
from seewhy.text.nearest import did_you_mean

__all__ = [
    "cells_of_relations",
    "cells_of_things",
    "things_of_file",
    "things_of_picture",
    "with_things",
]

_FIRST = ("image", "thing", *CORNERS)
_NO_FEATURES = ("kind", "x", "y", "z")
"""Columns that other tools leave beside those of the features."""
_RELATION_COLUMNS = ("image", "relation", "thing", "other", "holds")
_HOLDS = {"": True, "yes": True, "no": False, "unknown": None}
_ROUNDING = 1.0
"""So many pixels a box may reach out of its picture: corners are rounded."""


def cells_of_things(
    named: Sequence[tuple[str, Scene]], things: Things
) -> dict[str, list[str | None]]:
    """Return column → its cells, one a thing with the name of its picture.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> scene = Scene(Path("a.png"), (), things=(Thing("cup", {"colour": "red"}),))
    >>> cells = cells_of_things([("a.png", scene)], load_domain("tabletop").things)
    >>> cells["thing"], cells["left"], cells["colour"]
    (['cup'], [None], ['red'])
    """
    rows = [(name, thing) for name, scene in named for thing in scene.things]
    cells: dict[str, list[str | None]] = {
        "image": [name for name, _ in rows],
        "thing": [thing.name for _, thing in rows],
    }
    for corner in CORNERS:
        cells[corner] = [
            None if thing.box is None else f"{getattr(thing.box, corner):g}" for _, thing in rows
        ]
    return cells | {key: [thing.values.get(key) for _, thing in rows] for key in things.features}


def cells_of_relations(named: Sequence[tuple[str, Scene]]) -> dict[str, list[str | None]]:
    """Return column → its cells, one for each thing that is said of two things."""
    words = {True: "yes", False: "no", None: "unknown"}
    rows = [(name, said) for name, scene in named for said in scene.related]
    return {
        "image": [name for name, _ in rows],
        "relation": [said.relation for _, said in rows],
        "thing": [said.thing for _, said in rows],
        "other": [said.other for _, said in rows],
        "holds": [words[said.holds] for _, said in rows],
    }


def things_of_file(
    file: Path, domain: Domain, *, image: str | None = None
) -> tuple[tuple[Thing, ...], tuple[Related, ...]]:
    """Return the things of one picture of a table, which need not be there.

    Relations are read from a relations.csv beside it. ``image`` names the picture where the table
    has several.

    Raises
    ------
    DatasetError
        If the table is wrong or has no such picture.
    """
    assert domain.things is not None, "the domain has no things"
    if not file.is_file():
        raise DatasetError(f"{file}: there is no such file; name a table of things")
    found = _things(file, domain.things, domain, None)
    if image is None and len(found) != 1:
        raise DatasetError(
            f"{file}: has the things of {len(found)} pictures; name one of them with --image"
        )
    if image is not None and image not in found:
        raise DatasetError(
            f"{file}: has no things of '{image}'; {did_you_mean(image, sorted(found))}"
        )
    chosen = next(iter(found)) if image is None else image
    said = _related(file.with_name(RELATIONS), domain.things, found)
    return tuple(found[chosen]), tuple(said.get(chosen, ()))


def things_of_picture(file: Path, domain: Domain, picture: Path) -> tuple[Thing, ...]:
    """Return the things of a picture in a table that may have those of others, too.

    The table names it by its path from the table's folder, or by the end of that path.

    Raises
    ------
    DatasetError
        If the table is wrong, has no such picture or several, or a box reaches out of it.
    """
    assert domain.things is not None, "the domain has no things"
    if not file.is_file():
        raise DatasetError(f"{file}: there is no such file; name a table of things")
    found = _things(file, domain.things, domain, None)
    called = [name for name in found if (file.parent / name).resolve() == picture.resolve()]
    called = called or [
        name for name in found if name and picture.resolve().as_posix().endswith(f"/{name}")
    ]
    if not called and len(found) == 1 and "" in found:
        called = [""]
    if len(called) != 1:
        raise DatasetError(
            f"{file}: has {'several pictures' if called else 'no things of a picture'} called "
            f"'{picture.name}'; the column 'image' names the picture"
        )
    _check_boxes(found[called[0]], picture, file)
    return tuple(found[called[0]])


def with_things(
    scenes: Sequence[Scene], names: Sequence[str], domain: Domain, folder: Path
) -> tuple[Scene, ...]:
    """Return the scenes with their things, where the folder has a table of them.

    ``names`` tells how the tables name the picture of each scene.

    Raises
    ------
    DatasetError
        If a table is wrong, or does not agree with scenes.csv; the text names file and line.
    """
    things = domain.things
    file = folder / THINGS
    if things is None or not file.is_file():
        return tuple(scenes)
    found = _things(file, things, domain, set(names))
    for scene, name in zip(scenes, names, strict=True):
        if scene.no_things and (here := found.get(name)):
            raise DatasetError(
                f"{file}:{here[0].line}: line {scene.line} of scenes.csv says that '{name}' shows "
                "no things; remove one of the two"
            )
        _check_boxes(found.get(name, []), scene.picture, file)
    said = _related(folder / RELATIONS, things, found)
    return tuple(
        replace(scene, things=tuple(found.get(name, ())), related=tuple(said.get(name, ())))
        for scene, name in zip(scenes, names, strict=True)
    )


@dataclass(frozen=True)
class _Cells:
    """A row by its columns; a column that is not there is an empty cell."""

    place: str
    line: int
    by_column: Mapping[str, str]

    def __getitem__(self, column: str) -> str:
        return self.by_column.get(column, "")


def _rows(file: Path, known: Sequence[str], needed: Sequence[str], what: str) -> Iterator[_Cells]:
    table: Table = read_table(file, known=known, optional=known)
    place = TablePlace(str(file))
    for column, count in Counter(table.columns).items():
        if count > 1:
            raise DatasetError(
                f"{place.at(table.line)}: the column '{column}' stands twice; remove one"
            )
        if column not in known:
            raise DatasetError(
                f"{place.at(table.line)}: '{column}' is no {what}; {did_you_mean(column, known)}"
            )
    for column in needed:
        if column not in table.columns:
            raise DatasetError(f"{place.at(table.line)}: the column '{column}' is missing; add it")
    for row in table.rows:
        yield _Cells(
            place.at(row.line), row.line, dict(zip(table.columns, row.cells, strict=False))
        )


def _things(
    file: Path, things: Things, domain: Domain, images: Collection[str] | None
) -> dict[str, list[Thing]]:
    """Picture → its things; of any pictures where ``images`` is None."""
    found: dict[str, list[Thing]] = {}
    known = (*_FIRST, *things.features, *_NO_FEATURES)
    needed = () if images is None else ("image",)
    for cells in _rows(file, known, needed, "feature of things"):
        image = cells["image"].replace("\\", "/")
        if images is not None and image not in images:
            raise DatasetError(
                f"{cells.place}: the picture '{image}' is none of scenes.csv; "
                f"{did_you_mean(image, sorted(images))}"
            )
        here = found.setdefault(image, [])
        thing = Thing(
            name=cells["thing"] or str(len(here) + 1),
            values=_values(cells, things),
            box=_box(cells),
            line=cells.line,
        )
        for other in here:
            if other.name == thing.name:
                raise DatasetError(
                    f"{cells.place}: '{thing.name}' of '{image}' stands in line {other.line}, too; "
                    "call one otherwise, or remove it"
                )
            if thing.box is not None and (other.box, other.values) == (thing.box, thing.values):
                raise DatasetError(
                    f"{cells.place}: the box of '{thing.name}' is that of '{other.name}' in line "
                    f"{other.line}, and nothing else differs; remove one of the two"
                )
        here.append(thing)
        if len(here) > things.most:
            raise DatasetError(
                f"{cells.place}: '{image}' has more than {things.most} things, the most that the "
                f"domain '{domain.name}' allows; remove some, or raise most under [things] of its "
                "domain.toml"
            )
    return found


def _values(cells: _Cells, things: Things) -> dict[str, str]:
    values = {key: cells[key] for key in things.features if cells[key]}
    # What a labelling tool calls the kind of a box is the value of one feature, where one has it.
    kind = cells["kind"]
    kinds = [key for key, feature in things.features.items() if kind in feature.values]
    kinds = kinds or [key for key, one in things.features.items() if one.value_called(kind)]
    if len(kinds) == 1:
        values.setdefault(kinds[0], kind)
    return {key: _value(said, things.features[key], cells.place) for key, said in values.items()}


def _value(said: str, feature: ThingFeature, place: str) -> str:
    value = feature.value_called(said)
    if value is None:
        raise DatasetError(
            f"{place}: '{said}' is no value of '{feature.key}'; "
            f"{did_you_mean(said, feature.values)}"
        )
    return value


def _box(cells: _Cells) -> BoundingBox | None:
    given = [cells[corner] for corner in CORNERS]
    if not any(given):
        return None
    try:
        box = BoundingBox(*map(float, given))
    except ValueError:
        box = None
    if box is None or not all(math.isfinite(getattr(box, corner)) for corner in CORNERS):
        raise DatasetError(
            f"{cells.place}: left, top, right and bottom must be numbers (pixels), or all be "
            f"empty, got {', '.join(map(repr, given))}"
        )
    if box.right <= box.left or box.bottom <= box.top:
        raise DatasetError(
            f"{cells.place}: the box is empty: right must be more than left, and bottom more than "
            f"top, got {', '.join(given)}"
        )
    return box


def _check_boxes(things: Sequence[Thing], picture: Path, file: Path) -> None:
    """Refuse boxes that reach out of their picture."""
    boxes = [(thing, thing.box) for thing in things if thing.box is not None]
    size = _size_of(picture) if boxes else None
    if size is None:
        return
    width, height = size
    for thing, box in boxes:
        if (
            min(box.left, box.top) < -_ROUNDING
            or box.right > width + _ROUNDING
            or box.bottom > height + _ROUNDING
        ):
            corners = ", ".join(f"{getattr(box, corner):g}" for corner in CORNERS)
            raise DatasetError(
                f"{file}:{thing.line}: the box ({corners}) of '{thing.name}' reaches out of its "
                f"picture, which is {width} × {height} pixels; correct it"
            )


def _size_of(picture: Path) -> tuple[int, int] | None:
    """Width and height of the upright picture; None where it is none, which is said on reading."""
    # Importers write datasets, and cannot be imported before there are any.
    from seewhy.data.importers.picture_files import read_header

    try:
        with picture.open("rb") as stream:
            return read_header(stream).size
    except (OSError, PictureError):
        return None


def _related(
    file: Path, things: Things, found: Mapping[str, Sequence[Thing]]
) -> dict[str, list[Related]]:
    """Picture → what is said of two of its things.

    Of a relation of which the table says anything, what it does not list is not so.
    """
    if not file.is_file():
        return {}
    said: dict[str, list[Related]] = {image: [] for image in found}
    for cells in _rows(file, _RELATION_COLUMNS, _RELATION_COLUMNS[:4], "column of relations"):
        image = cells["image"].replace("\\", "/")
        if image not in found:
            raise DatasetError(
                f"{cells.place}: the picture '{image}' has no things in {THINGS}; "
                f"{did_you_mean(image, found)}"
            )
        said[image].append(_one_related(cells, things, found[image]))
    listed = {related.relation for of_image in said.values() for related in of_image}
    for image, of_image in said.items():
        if (both := contradicted(of_image, things)) is not None:
            first, second = both
            raise DatasetError(
                f"{file}:{second.line}: '{second.relation}' of '{second.thing}' and "
                f"'{second.other}' is said otherwise in line {first.line}; remove one of the two"
            )
        of_image += not_listed(of_image, found[image], things, listed)
    return said


def _one_related(cells: _Cells, things: Things, here: Sequence[Thing]) -> Related:
    said = {key: one for key, one in things.relations.items() if key in things.seen}
    if cells["relation"] not in said:
        raise DatasetError(
            f"{cells.place}: '{cells['relation']}' is no relation that is seen or measured; "
            f"{did_you_mean(cells['relation'], said)}"
        )
    names = [thing.name for thing in here]
    for column in ("thing", "other"):
        if cells[column] not in names:
            raise DatasetError(
                f"{cells.place}: '{cells[column]}' is no thing of '{cells['image']}'; "
                f"{did_you_mean(cells[column], names)}"
            )
    if cells["thing"] == cells["other"]:
        raise DatasetError(
            f"{cells.place}: '{cells['relation']}' is said of '{cells['thing']}' and itself; name "
            "two things"
        )
    if cells["holds"] not in _HOLDS:
        raise DatasetError(
            f"{cells.place}: holds must be 'yes', 'no', 'unknown' or empty, got '{cells['holds']}'"
        )
    return Related(
        cells["relation"], cells["thing"], cells["other"], _HOLDS[cells["holds"]], cells.line
    )
