"""Make a dataset with a domain's own source of pictures, in parallel and resumably."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from seewhy.data.dataset import TABLE
from seewhy.data.made_picture import Annotation, check_annotation
from seewhy.data.made_tables import made_annotations, write_made_tables
from seewhy.data.picture_source import draw_picture, load_source
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError
from seewhy.files.locks import sole_writer
from seewhy.files.whole_files import put_all_on_disk, whole_file, write_whole
from seewhy.knowledge.scene import FeatureVector

MADE = "made.json"

_NOTE: TypeAdapter[Annotation] = TypeAdapter(Annotation)


@dataclass(frozen=True)
class MadeDataset:
    """What was made.

    Attributes
    ----------
    folder : Path
    count : int
    classes : dict of str to float
        Class → its share of the pictures; empty where the source says none.
    determined : float or None
        The share of pictures whose class is the most frequent one of their feature vector: the
        best that any classifier over the features can do on these pictures. None where the source
        says no class.
    """

    folder: Path
    count: int
    classes: dict[str, float]
    determined: float | None


def make_dataset(
    domain: Domain,
    folder: Path | str,
    *,
    count: int,
    seed: int = 0,
    size: int | None = None,
    workers: int = -1,
    test_share: float = 1 / 3,
    on_progress: Callable[[int], None] | None = None,
) -> MadeDataset:
    """Write ``count`` pictures and their tables to ``folder``.

    Every picture depends on ``seed`` and its own number only, so that the files are the same
    whatever the number of workers, and an interrupted call goes on where it was. Every third
    picture (``test_share``) is marked ``split = test``. Their longer side has ``size`` pixels;
    where that is left out, as many as ``source_size`` under ``[pictures]`` of domain.toml says.

    Raises
    ------
    DomainError
        If the domain has no source of pictures.
    DatasetError
        If the folder holds a dataset made otherwise.
    BusyError
        If another process is writing it.

    Examples
    --------
    >>> import seewhy, tempfile
    >>> made = make_dataset(seewhy.load_domain("structure_stability"), tempfile.mkdtemp(),
    ...                     count=4, workers=1)
    >>> made.count
    4
    """
    folder = Path(folder)
    load_source(domain)
    size = domain.pictures.source_size if size is None else size
    with sole_writer(folder / TABLE):
        rows = _make_rows(
            domain, folder, count, seed=seed, size=size, workers=workers, on_progress=on_progress
        )
        put_all_on_disk()  # the pictures, before a table says that they are there
        write_made_tables(folder, domain, rows, test_share)
        images = folder / "images"
        for leftover in (*images.glob("*.json"), *images.glob(".??????-new.*")):
            leftover.unlink()
    labels = [row.label for row in rows if row.label is not None]
    if len(labels) < len(rows):
        return MadeDataset(folder, count, {}, None)
    vectors = [domain.vector(dict(row.features)) for row in rows]
    shares = {name: labels.count(name) / count for name in domain.classes}
    return MadeDataset(folder, count, shares, determined_share(vectors, labels))


def _make_rows(
    domain: Domain,
    folder: Path,
    count: int,
    *,
    seed: int,
    size: int,
    workers: int,
    on_progress: Callable[[int], None] | None,
) -> list[Annotation]:
    """Make the pictures that are not there; return the annotation of all."""
    from joblib import Parallel, delayed  # what else is here is used where no picture is made

    settings = {"domain": domain.name, "seed": seed, "size": size}
    (folder / "images").mkdir(parents=True, exist_ok=True)
    _check_settings(folder, settings)
    write_whole(folder / MADE, json.dumps(settings))
    known = made_annotations(folder, domain)
    tasks = (
        delayed(_make_picture)(
            str(domain.source), domain.folder, folder, seed, index, size, known.get(index)
        )
        for index in range(count)
    )
    rows: list[Annotation] = []
    for row in Parallel(n_jobs=workers, return_as="generator", batch_size=8)(tasks):
        check_annotation(domain, row)
        rows.append(row)
        if on_progress is not None:
            on_progress(len(rows))
    return rows


def determined_share(vectors: list[FeatureVector], labels: list[str]) -> float:
    """Return the share of scenes that the best classifier over the features gets right.

    Examples
    --------
    >>> determined_share([("a",), ("a",), ("a",), ("b",)], ["x", "x", "y", "y"])
    0.75
    """
    counts: dict[FeatureVector, Counter[str]] = {}
    for vector, label in zip(vectors, labels, strict=True):
        counts.setdefault(vector, Counter())[label] += 1
    return sum(max(by_class.values()) for by_class in counts.values()) / len(labels)


def _check_settings(folder: Path, settings: dict[str, object]) -> None:
    made = folder / MADE
    if made.is_file():
        text = made.read_text(encoding="utf-8", errors="replace")
        if text != json.dumps(settings):
            raise DatasetError(
                f"{folder}: holds pictures made with other settings ({' '.join(text.split())}); "
                "choose another folder or delete this one"
            )
    elif (folder / TABLE).exists():
        raise DatasetError(
            f"{folder}: holds a dataset that was not made here; choose another folder"
        )


def _make_picture(
    source: str,
    home: Path,
    folder: Path,
    seed: int,
    index: int,
    size: int,
    known: Annotation | None,
) -> Annotation:
    """Make one picture unless it is there already; return its annotation.

    The annotation lies beside the picture until the table is written.
    """
    from PIL import Image

    picture = folder / "images" / f"{index:06d}.png"
    note = picture.with_suffix(".json")
    if picture.exists() and known is not None:
        return known
    noted = _noted(note)
    if noted is not None and _is_picture(picture):
        return noted
    pixels, made = draw_picture(source, home, seed=seed, index=index, size=size)
    write_whole(note, json.dumps(made), durable=False)
    with whole_file(picture, durable=False) as temporary:
        Image.fromarray(pixels).save(temporary, compress_level=4)
    return made


def _noted(note: Path) -> Annotation | None:
    """The annotation that lies beside a picture; None where it is not whole."""
    try:
        return _NOTE.validate_json(note.read_bytes())
    except (OSError, ValidationError):
        return None


def _is_picture(file: Path) -> bool:
    """Whether a picture is whole: one that was not yet on the disk when the power failed is not."""
    from PIL import Image

    try:
        with Image.open(file, formats=["PNG"]) as opened:
            opened.verify()
    except (OSError, SyntaxError, ValueError):
        return False
    return True
