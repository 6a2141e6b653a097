"""Photographs as a dataset: PNG files, scenes.csv, and what was found on the way."""

from __future__ import annotations

import io
import json
import warnings
import zlib
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from PIL import Image, ImageOps, PngImagePlugin, UnidentifiedImageError

from seewhy.data.dataset import TABLE
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError, PictureError
from seewhy.files.csv_text import csv_text
from seewhy.files.whole_files import put_all_on_disk, whole_file, write_whole
from seewhy.perception.picture_file import LARGEST_MEGAPIXELS, SMALLEST_SIDE
from seewhy_lab.belgiumts.classes import SignClass, read_classes
from seewhy_lab.belgiumts.container import DamagedFileError
from seewhy_lab.belgiumts.layout import PHOTOGRAPHS, Half, LeftOut, Photograph, open_halves

LARGEST_SIDE = 256
"""Pictures with a longer side than this (in pixels) are reduced to it."""

REGIONS = "regions.csv"
_RECORD = "imported.json"
_MOST_LEFT_OUT = 0.05
_ORIGIN = "Source"


@dataclass(frozen=True)
class ImportedHalf:
    """What was found of one half.

    Attributes
    ----------
    source : str
        The folder, or the folder in an archive, that it was read from.
    photographs : int
        How many are in the dataset.
    official : int
        How many the official half holds.
    classes : dict of str to int
        Class → how many of its photographs are in the dataset; every class of the domain's table.
    groups : int
        How many physical signs they show.
    repeated_rows : int
        Rows of the tables that name a picture again; they add nothing.
    left_out : tuple of LeftOut
        Pictures that are not in the dataset.
    rows_without_file, files_without_row : tuple of str
        The latter are in the dataset all the same: their folder says the class.
    without_pole : tuple of str
        Pictures whose name says no pole; each of them counts as a sign of its own.
    """

    source: str
    photographs: int
    official: int
    classes: dict[str, int]
    groups: int
    repeated_rows: int
    left_out: tuple[LeftOut, ...]
    rows_without_file: tuple[str, ...]
    files_without_row: tuple[str, ...]
    without_pole: tuple[str, ...]

    @property
    def empty_classes(self) -> tuple[str, ...]:
        """The classes without a photograph."""
        return tuple(key for key, count in self.classes.items() if not count)


@dataclass(frozen=True)
class ImportedDataset:
    """The dataset written; ``halves`` holds "train", "test" or both."""

    folder: Path
    halves: Mapping[str, ImportedHalf]

    @property
    def photographs(self) -> int:
        """How many photographs are in the dataset."""
        return sum(half.photographs for half in self.halves.values())

    def as_json(self) -> dict[str, object]:
        """Everything that was found, for a program."""
        return {
            "folder": str(self.folder),
            "photographs": self.photographs,
            "halves": {
                split: {**asdict(half), "empty_classes": half.empty_classes}
                for split, half in self.halves.items()
            },
        }


@dataclass(frozen=True)
class _Scene:
    image: str
    sign_class: SignClass
    split: str
    group: str
    region: tuple[int, int, int, int] | None


def import_photographs(
    paths: Sequence[Path],
    folder: Path | str,
    *,
    domain: Domain,
    on_progress: Callable[[int, int], None] | None = None,
) -> ImportedDataset:
    """Write the photographs found at ``paths`` to ``folder`` as a dataset of ``domain``.

    Written are the pictures under ``images/`` as PNG, whole and without loss (reduced where a
    side is longer than 256 pixels), ``scenes.csv`` with class, features, split and group (class
    and pole: one physical sign), and ``regions.csv``, which says where in its picture each sign
    is. The same photographs give the same files. The tables are written last, and a picture that
    is there already is not written again, so that an interrupted call goes on where it was.

    Parameters
    ----------
    paths : sequence of Path
        Archives, extracted folders, or folders that hold archives, of one half or both.
    folder : Path
    domain : Domain
        Its classes.csv says class and features of every class folder.
    on_progress : callable, optional
        Called with the pictures done and the pictures in all.

    Raises
    ------
    DatasetError
        If nothing is found at a path, its layout or a table is wrong, more than one picture in
        twenty cannot be read, or ``folder`` holds another dataset.
    DomainError
        If classes.csv does not fit the domain.
    """
    folder = Path(folder)
    if (folder / TABLE).exists() and not (folder / _RECORD).is_file():
        raise DatasetError(
            f"{folder}: holds a dataset that was not imported; choose another folder"
        )
    classes = read_classes(domain)
    with open_halves(paths, class_ids=classes.keys()) as halves:
        total = sum(len(half.photographs) for half in halves)
        done = 0
        scenes: list[_Scene] = []
        imported: dict[str, ImportedHalf] = {}
        for half in halves:
            of_half, left_out = [], list(half.left_out)
            _check_left_out(half, left_out)
            for photograph in half.photographs:
                try:
                    of_half.append(_write_picture(half, photograph, classes, folder))
                except (DamagedFileError, PictureError) as problem:
                    left_out.append(LeftOut(photograph.name, str(problem)))
                    _check_left_out(half, left_out)
                done += 1
                if on_progress is not None:
                    on_progress(done, total)
            scenes += of_half
            imported[half.split] = _account(half, of_half, left_out, classes)
    if not scenes:
        raise DatasetError(
            f"{', '.join(map(str, paths))}: not one photograph is left to import; download the "
            "archives again"
        )
    dataset = ImportedDataset(folder, imported)
    put_all_on_disk()  # the pictures, before a table says that they are there
    write_whole(folder / REGIONS, _regions(scenes))
    write_whole(folder / _RECORD, json.dumps(dataset.as_json()["halves"], indent=2) + "\n")
    write_whole(folder / TABLE, _scenes(scenes, domain))
    return dataset


def _check_left_out(half: Half, left_out: Sequence[LeftOut]) -> None:
    count = len(half.photographs) + len(half.left_out)
    if len(left_out) > _MOST_LEFT_OUT * count:
        last = left_out[-1]
        raise DatasetError(
            f"{half.container.path}: {len(left_out)} of {count} photographs cannot be used, more "
            f"than one in twenty, among them {last.file} ({last.reason}); download the archive "
            "again"
        )


def _account(
    half: Half,
    scenes: Sequence[_Scene],
    left_out: Iterable[LeftOut],
    classes: Mapping[int, SignClass],
) -> ImportedHalf:
    counts = Counter(scene.sign_class.key for scene in scenes)
    return ImportedHalf(
        source=str(half.container.path / half.folder),
        photographs=len(scenes),
        official=PHOTOGRAPHS[half.split],
        classes={sign_class.key: counts[sign_class.key] for sign_class in classes.values()},
        groups=len({scene.group or scene.image for scene in scenes}),
        repeated_rows=half.repeated_rows,
        left_out=tuple(left_out),
        rows_without_file=half.rows_without_file,
        files_without_row=half.files_without_row,
        without_pole=tuple(
            photograph.name for photograph in half.photographs if not photograph.group
        ),
    )


def _write_picture(
    half: Half, photograph: Photograph, classes: Mapping[int, SignClass], folder: Path
) -> _Scene:
    """Write one picture unless it is there already."""
    content = half.container.read(photograph.name)
    picture = _read_picture(content)
    name = f"images/{half.split}/{photograph.class_id:05d}/{photograph.stem}.png"
    # What a picture was made of stands in its file, so that the next call knows it again.
    origin = f"BelgiumTS {half.split} {photograph.stem} {zlib.crc32(content):08x}"
    if not _is_written(folder / name, origin):
        note = PngImagePlugin.PngInfo()
        note.add_text(_ORIGIN, origin)
        with whole_file(folder / name, durable=False) as temporary:
            picture.save(temporary, compress_level=4, pnginfo=note)
    region = photograph.region
    return _Scene(
        image=name,
        sign_class=classes[photograph.class_id],
        split=half.split,
        group=photograph.group,
        region=region.within(*picture.size) if region is not None else None,
    )


def _read_picture(content: bytes) -> Image.Image:
    """The whole picture, upright, in red, green and blue, at most 256 pixels on a side."""
    with warnings.catch_warnings():
        # Pillow warns from 89 megapixels on; the limit that counts here is SeeWhy's own.
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        try:
            image = Image.open(io.BytesIO(content), formats=("PPM", "PNG", "JPEG"))
        except Image.DecompressionBombError:
            raise PictureError("has far too many pixels for a photograph of a sign") from None
        except UnidentifiedImageError:
            raise PictureError("is no PPM, PNG or JPEG picture") from None
        except Exception as problem:
            # A decoder raises whatever the damaged bytes lead it to: struct.error, IndexError, …
            raise PictureError(f"is damaged or cut short ({problem})") from None
    width, height = image.size
    if width * height > LARGEST_MEGAPIXELS * 1_000_000:
        raise PictureError(f"has {width}×{height} pixels, too many for a photograph of a sign")
    if image.mode.startswith(("I", "F")):
        raise PictureError("has greys of more than 8 bits")
    try:
        picture = ImageOps.exif_transpose(image).convert("RGB")
    except Exception as problem:
        raise PictureError(f"is damaged or cut short ({problem})") from None
    picture.thumbnail((LARGEST_SIDE, LARGEST_SIDE), Image.Resampling.LANCZOS, reducing_gap=None)
    if min(picture.size) < SMALLEST_SIDE:
        raise PictureError(
            f"is {width}×{height} pixels, too few to see a sign ({SMALLEST_SIDE} on a side are "
            "needed)"
        )
    # Colour profiles and the like would make files differ that look the same.
    picture.info.clear()
    return picture


def _is_written(path: Path, origin: str) -> bool:
    if not path.is_file():
        return False
    try:
        with Image.open(path, formats=("PNG",)) as picture:
            return picture.info.get(_ORIGIN) == origin
    except (OSError, SyntaxError):
        return False


def _scenes(scenes: Sequence[_Scene], domain: Domain) -> str:
    rows = (
        (
            scene.image,
            scene.sign_class.key,
            *(scene.sign_class.features[key] for key in domain.features),
            scene.split,
            scene.group,
        )
        for scene in scenes
    )
    return csv_text(("image", "class", *domain.features, "split", "group"), rows)


def _regions(scenes: Sequence[_Scene]) -> str:
    rows = ((scene.image, *scene.region) for scene in scenes if scene.region is not None)
    return csv_text(("image", "left", "top", "right", "bottom"), rows)
