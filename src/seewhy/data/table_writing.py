"""Write the tables of a dataset: scenes.csv, and those of its things."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from pathlib import Path

from seewhy.data.dataset import TABLE, Dataset
from seewhy.data.scene_rows import cells_of_scenes
from seewhy.data.thing import RELATIONS, THINGS
from seewhy.data.thing_tables import cells_of_relations, cells_of_things
from seewhy.files.whole_files import write_whole

__all__ = ["text_of_table", "write_tables"]


def write_tables(dataset: Dataset, folder: Path | str | None = None) -> None:
    """Write what is annotated of a dataset's pictures.

    Parameters
    ----------
    dataset : Dataset
    folder : Path or str, optional
        Another folder than the dataset's. Pictures are named from there where they lie in it.

    Examples
    --------
    >>> import tempfile
    >>> from seewhy.data.scene import Scene
    >>> from seewhy.data.thing import BoundingBox, Thing
    >>> from seewhy.domain.domain import load_domain
    >>> folder = Path(tempfile.mkdtemp())
    >>> cup = Thing("cup", {"colour": "red"}, BoundingBox(1, 2, 5, 8))
    >>> scene = Scene(folder / "a.png", (), things=(cup,))
    >>> write_tables(Dataset((scene,), load_domain("tabletop"), folder))
    >>> print((folder / "things.csv").read_text())
    image,thing,left,top,right,bottom,size,colour,material,shape
    a.png,cup,1,2,5,8,,red,,
    <BLANKLINE>
    """
    target = dataset.folder if folder is None else Path(folder)
    placed = Dataset(dataset.scenes, dataset.domain, target)
    named = [(placed.name_of(scene), scene) for scene in dataset.scenes]
    tables = {TABLE: cells_of_scenes(named, dataset.domain)}
    if dataset.domain.things is not None:
        tables[RELATIONS] = cells_of_relations(named)
        tables[THINGS] = cells_of_things(named, dataset.domain.things)
    # That of the pictures comes last: where it stands, the others do.
    for name, cells in reversed(tables.items()):
        write_whole(target / name, text_of_table(cells))


def text_of_table(cells: Mapping[str, Sequence[str | None]]) -> str:
    """The text of a table: column → its cells, None for an empty one.

    Examples
    --------
    >>> text_of_table({"image": ["a.png"], "thing": [None]})
    'image,thing\\na.png,\\n'
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(cells)
    writer.writerows([cell or "" for cell in row] for row in zip(*cells.values(), strict=True))
    return text.getvalue()
