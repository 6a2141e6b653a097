"""Dataset: a folder with pictures and scenes.csv, annotated features and classes."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seewhy.data.contradiction import require_agreement
from seewhy.data.digest import digest_of
from seewhy.data.picture_path import require_own_table
from seewhy.data.reading_ahead import read_ahead
from seewhy.data.scene import Scene, TablePlace
from seewhy.data.scene_rows import OPTIONAL, cells_of_scenes, columns_of, scenes_of_rows
from seewhy.data.scene_vector import vector_with_things
from seewhy.data.table import read_table
from seewhy.data.thing_tables import with_things
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError
from seewhy.knowledge.scene import FeatureVector
from seewhy.text.nearest import did_you_mean
from seewhy.text.notebook import html_line, html_table

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["TABLE", "Dataset", "Scene"]

TABLE = "scenes.csv"

BATCH = 64
"""Pictures that are in the memory at a time where they need not all be."""

SHOWN = 10
"""Rows that a notebook shows of a dataset."""


@dataclass(frozen=True)
class Dataset:
    """Pictures of one domain with what is annotated of them.

    On disk a dataset is plain: pictures, and a table ``scenes.csv`` with a column ``image`` (a
    path from the folder) and optionally ``class``, one column per feature of the domain,
    ``split`` ("train" or "test"), ``group`` and ``reasons`` (the features that are why the picture
    is of its class, with blanks between). An empty cell, or a column that is left out, is what
    nobody knows: a table that only names pictures is one of pictures to classify. Where the domain
    has things, ``things.csv`` and ``relations.csv`` may lie beside it. docs/data.md says what such
    tables may look like.

    Examples
    --------
    >>> import seewhy, tempfile
    >>> domain = seewhy.load_domain("structure_stability")
    >>> from seewhy.data.making import make_dataset
    >>> folder = tempfile.mkdtemp()
    >>> _ = make_dataset(domain, folder, count=6, seed=0)
    >>> len(Dataset.load(folder, domain))
    6
    """

    scenes: tuple[Scene, ...]
    domain: Domain
    folder: Path
    origin: TablePlace | None = None

    # Reading and writing ----------------------------------------------------------------------

    @staticmethod
    def load(folder: Path | str, domain: Domain, *, outside: bool = False) -> Dataset:
        """Read a dataset and check every row against the domain.

        Parameters
        ----------
        folder : Path or str
        domain : Domain
        outside : bool, default False
            Whether the table may name pictures that lie outside of the folder.

        Raises
        ------
        DatasetError
            If the folder, its table or a row is wrong; the text names the file and the line.
        """
        folder = Path(folder)
        file = folder / TABLE
        if not folder.is_dir():
            raise DatasetError(f"{folder}: there is no such folder; give one with a {TABLE}")
        if not file.is_file():
            raise DatasetError(
                f"{folder}: the folder has no {TABLE}; it lists the pictures with the columns "
                f"image, class, {', '.join(domain.features)}"
            )
        require_own_table(file, outside=outside)
        table = read_table(file, known=columns_of(domain), optional=OPTIONAL)
        scenes = scenes_of_rows(
            table.columns,
            ((row.line, row.cells) for row in table.rows),
            domain,
            folder=folder,
            place=TablePlace(str(file)),
            header=table.line,
            outside=outside,
        )
        dataset = Dataset(scenes=tuple(scenes), domain=domain, folder=folder)._checked()
        names = [dataset.name_of(scene) for scene in dataset.scenes]
        return replace(dataset, scenes=with_things(dataset.scenes, names, domain, folder))

    @staticmethod
    def from_frame(
        frame: pd.DataFrame, domain: Domain, *, folder: Path | str = ".", outside: bool = False
    ) -> Dataset:
        """Make a dataset of a pandas data frame with the columns of ``scenes.csv``.

        Parameters
        ----------
        frame : pandas.DataFrame
            A row a picture. What is missing (None, NaN, NA) is what nobody knows; whole numbers
            are read as such, True and False as "yes" and "no".
        domain : Domain
        folder : Path or str, default "."
            Where paths in the column ``image`` begin.
        outside : bool, default False
            Whether pictures may lie outside of ``folder``.

        Raises
        ------
        DatasetError
            If a column, a value or a picture is none; rows are counted from 0.
        """
        from seewhy.data.frame import cells_of_frame

        folder = Path(folder)
        place = TablePlace("the frame", row="row")
        columns, rows = cells_of_frame(frame)
        scenes = scenes_of_rows(
            columns, enumerate(rows), domain, folder=folder, place=place, outside=outside
        )
        return Dataset(tuple(scenes), domain, folder, place)._checked()

    def to_frame(self) -> pd.DataFrame:
        """Return the table as a pandas data frame, with the columns of ``scenes.csv``.

        What nobody knows is None. :meth:`from_frame` makes the same dataset of it.

        Raises
        ------
        SeeWhyError
            If pandas is not installed.
        """
        from seewhy.files.data_frame import data_frame

        return data_frame(self._cells(self.scenes))

    def _repr_html_(self) -> str:
        """What a notebook shows: how many pictures there are, and the first rows of the table."""
        cells = self._cells(self.scenes[:SHOWN])
        more = f", of which the first {SHOWN} are shown" if len(self) > SHOWN else ""
        rows = ([cell or "" for cell in row] for row in zip(*cells.values(), strict=True))
        return html_line(f"{len(self)} pictures{more}") + html_table([*cells], rows)

    def _cells(self, scenes: Sequence[Scene]) -> dict[str, list[str | None]]:
        return cells_of_scenes([(self.name_of(scene), scene) for scene in scenes], self.domain)

    def _checked(self) -> Dataset:
        """This dataset, if it has rows that do not contradict each other."""
        if not self.scenes:
            raise DatasetError(f"{self.table.name}: the table has no rows; add one per picture")
        rows: dict[str, list[int]] = {}
        for position, scene in enumerate(self.scenes):
            rows.setdefault(os.fspath(scene.picture), []).append(position)
        require_agreement(self, [same for same in rows.values() if len(same) > 1])
        return self

    # What it holds ----------------------------------------------------------------------------

    def __len__(self) -> int:
        return len(self.scenes)

    @property
    def table(self) -> TablePlace:
        """How errors name the table and its rows."""
        return TablePlace(str(self.folder / TABLE)) if self.origin is None else self.origin

    def name_of(self, scene: Scene) -> str:
        """The path of a scene's picture from the folder; as it is where it lies elsewhere."""
        inside = scene.picture.is_relative_to(self.folder)
        return (scene.picture.relative_to(self.folder) if inside else scene.picture).as_posix()

    @property
    def vectors(self) -> list[FeatureVector]:
        """The annotated feature vectors, one per scene; things and relations stand behind."""
        if self.domain.things is None:
            return [scene.vector for scene in self.scenes]
        return [
            vector_with_things(self.domain, scene.vector, scene.things, scene.related)
            for scene in self.scenes
        ]

    @property
    def labels(self) -> list[str | None]:
        """The annotated classes, one per scene; None where nobody said it."""
        return [scene.label for scene in self.scenes]

    @property
    def classes(self) -> list[str]:
        """The annotated classes, one per scene, where all have one; see :meth:`with_class`.

        Raises
        ------
        DatasetError
            If a scene has none.
        """
        found = []
        for scene in self.scenes:
            if scene.label is None:
                raise DatasetError(
                    f"{self.table.at(scene.line)}: the picture '{self.name_of(scene)}' has no "
                    "class; fill the cell 'class'"
                )
            found.append(scene.label)
        return found

    @property
    def groups(self) -> list[str]:
        """The group of every scene; without one, a picture is a group of its own."""
        # No cell begins with a blank, so that no name of a group is that of a picture.
        return [scene.group or f" {scene.picture}" for scene in self.scenes]

    # Parts of it ------------------------------------------------------------------------------

    def of_split(self, split: str) -> Dataset:
        """Return the scenes of a split; all scenes where the table names no splits."""
        if not any(scene.split for scene in self.scenes):
            return self
        chosen = tuple(scene for scene in self.scenes if scene.split == split)
        if not chosen:
            raise DatasetError(
                f"{self.table.name}: no row has split = {split}; add some, or leave the column out"
            )
        return self.of_scenes(chosen)

    def with_class(self) -> Dataset:
        """Return the scenes whose class somebody said; the same dataset where all are such."""
        chosen = tuple(scene for scene in self.scenes if scene.label is not None)
        return self if len(chosen) == len(self) else self.of_scenes(chosen)

    def annotated(self) -> Dataset:
        """Return the scenes of which a class or some feature is known."""
        chosen = tuple(
            scene
            for scene in self.scenes
            if scene.label is not None or any(value is not None for value in scene.vector)
        )
        return self if len(chosen) == len(self) else self.of_scenes(chosen)

    def without_classes(self, classes: Sequence[str]) -> Dataset:
        """Return the scenes of all other classes.

        A picture of which nobody said the class may show one of those, and is left out, too.

        Raises
        ------
        DatasetError
            If there is no such class, or if nothing is left.
        """
        for name in classes:
            if name not in self.domain.classes:
                raise DatasetError(
                    f"'{name}' is no class of the domain '{self.domain.name}'; "
                    f"{did_you_mean(name, self.domain.classes)}"
                )
        if not classes:
            return self
        chosen = tuple(
            scene for scene in self.scenes if scene.label is not None and scene.label not in classes
        )
        if not chosen:
            raise DatasetError(
                f"{self.table.name}: without the class{'es' * (len(set(classes)) > 1)} "
                f"{', '.join(dict.fromkeys(classes))} nothing is left; leave out fewer"
            )
        return self.of_scenes(chosen)

    def take(self, positions: Sequence[int]) -> Dataset:
        """Return the scenes at some positions; pictures that were read are not read again."""
        taken = self.of_scenes(tuple(self.scenes[position] for position in positions))
        for size, pixels in self._pixels.items():
            taken._pixels[size] = pixels[list(positions)]
        return taken

    def of_scenes(self, scenes: tuple[Scene, ...]) -> Dataset:
        """Return a dataset of other scenes; files that were read are not read again."""
        same = replace(self, scenes=scenes)
        same.__dict__["_digests"] = self._digests
        return same

    # Pictures ---------------------------------------------------------------------------------

    def picture_digests(self) -> list[str]:
        """Return a short digest of every picture file, to tell later what was trained on."""
        known = self._digests
        for scene in self.scenes:
            if scene.picture not in known:
                known[scene.picture] = digest_of(scene.picture)
        return [known[scene.picture] for scene in self.scenes]

    @cached_property
    def _digests(self) -> dict[Path, str]:
        return {}

    @cached_property
    def _pixels(self) -> dict[int, NDArray[np.uint8]]:
        return {}

    def with_pictures(self, pixels: NDArray[np.uint8]) -> Dataset:
        """Return the same scenes with their pictures as an earlier :meth:`pictures` gave them."""
        same = self.of_scenes(self.scenes)
        same._pixels[pixels.shape[1]] = pixels
        return same

    def pictures(
        self, size: int, *, on_progress: Callable[[int], None] | None = None
    ) -> NDArray[np.uint8]:
        """Return all pictures as uint8 of shape (scenes, size, size, 3); read once per size.

        Raises
        ------
        PictureError
            If a file is not a picture.
        """
        if size not in self._pixels:
            pixels = np.empty((len(self), size, size, 3), dtype=np.uint8)
            done = 0
            for some in self.iter_pictures(size, on_progress=on_progress):
                pixels[done : done + len(some)] = some
                done += len(some)
            self._pixels[size] = pixels
        return self._pixels[size]

    def iter_pictures(
        self, size: int, *, batch: int = BATCH, on_progress: Callable[[int], None] | None = None
    ) -> Iterator[NDArray[np.uint8]]:
        """Yield the pictures in the order of the scenes, some at a time.

        Not more than two batches are in the memory, one of which is read while the other is used.
        What :meth:`pictures` has read already is not read again.

        Parameters
        ----------
        size : int
            Side in pixels.
        batch : int, default 64
            How many at a time; the last may be fewer.
        on_progress : callable, optional
            Called with the number of pictures read so far.

        Yields
        ------
        ndarray of uint8, shape (batch, size, size, 3)

        Raises
        ------
        PictureError
            If a file is not a picture.
        """
        from seewhy.perception.picture import read_picture

        if size in self._pixels:
            for start in range(0, len(self), batch):
                yield self._pixels[size][start : start + batch]
            return
        read = partial(read_picture, size=size, fit=self.domain.pictures.fit)
        paths = (scene.picture for scene in self.scenes)
        some: list[NDArray[np.uint8]] = []
        for number, picture in enumerate(read_ahead(read, paths, ahead=batch), start=1):
            some.append(picture)
            if on_progress is not None:
                on_progress(number)
            if len(some) == batch or number == len(self):
                yield np.stack(some)
                some = []
