"""Make a dataset with a domain's own source of pictures, in parallel and resumably."""

from __future__ import annotations

import csv
import json
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from seewhy.data.dataset import TABLE
from seewhy.data.picture_source import draw_picture, load_source
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError, DomainError
from seewhy.files.csv_text import csv_text
from seewhy.files.locks import sole_writer
from seewhy.files.whole_files import put_all_on_disk, whole_file, write_whole
from seewhy.knowledge.scene import FeatureVector

MADE = "made.json"

_NOTE: TypeAdapter[tuple[dict[str, str], str]] = TypeAdapter(tuple[dict[str, str], str])


@dataclass(frozen=True)
class MadeDataset:
    """What was made.

    Attributes
    ----------
    folder : Path
    count : int
    classes : dict of str to float
        Class → its share of the pictures.
    determined : float
        The share of pictures whose class is the most frequent one of their feature vector: the
        best that any classifier over the features can do on these pictures.
    """

    folder: Path
    count: int
    classes: dict[str, float]
    determined: float


def make_dataset(
    domain: Domain,
    folder: Path | str,
    *,
    count: int,
    seed: int = 0,
    size: int = 112,
    workers: int = -1,
    test_share: float = 1 / 3,
    on_progress: Callable[[int], None] | None = None,
) -> MadeDataset:
    """Write ``count`` pictures and their scenes.csv to ``folder``.

    Every picture depends on ``seed`` and its own number only, so that the files are the same
    whatever the number of workers, and an interrupted call goes on where it was. Every third
    picture (``test_share``) is marked ``split = test``.

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
    with sole_writer(folder / TABLE):
        rows = _make_rows(
            domain, folder, count, seed=seed, size=size, workers=workers, on_progress=on_progress
        )
        put_all_on_disk()  # the pictures, before a table says that they are there
        _write_table(folder, domain, rows, test_share)
        images = folder / "images"
        for leftover in (*images.glob("*.json"), *images.glob(".??????-new.*")):
            leftover.unlink()
    vectors = [domain.vector(dict(features)) for features, _ in rows]
    labels = [label for _, label in rows]
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
) -> list[tuple[dict[str, str], str]]:
    """Make the pictures that are not there; return the annotation of all."""
    from joblib import Parallel, delayed  # what else is here is used where no picture is made

    settings = {"domain": domain.name, "seed": seed, "size": size}
    (folder / "images").mkdir(parents=True, exist_ok=True)
    _check_settings(folder, settings)
    write_whole(folder / MADE, json.dumps(settings))
    known = _rows_of(folder, domain)
    tasks = (
        delayed(_make_picture)(
            str(domain.source), domain.folder, folder, seed, index, size, known.get(index)
        )
        for index in range(count)
    )
    rows: list[tuple[dict[str, str], str]] = []
    for row in Parallel(n_jobs=workers, return_as="generator", batch_size=8)(tasks):
        _check_annotation(domain, *row)
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


def _check_annotation(domain: Domain, features: dict[str, str], label: str) -> None:
    """Raise a DomainError if a source annotates in other words than its domain."""
    known = {key: feature.values for key, feature in domain.features.items()}
    if label in domain.classes and features.keys() == known.keys():
        wrong = [f"{key} = {value}" for key, value in features.items() if value not in known[key]]
    else:
        wrong = [f"class {label}, features {', '.join(features)}"]
    if wrong:
        raise DomainError(
            f"{domain.folder / 'domain.toml'}: the source '{domain.source}' must give values of "
            f"{', '.join(known)} and a class among {', '.join(domain.classes)}, got {wrong[0]}"
        )


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


def _rows_of(folder: Path, domain: Domain) -> dict[int, tuple[dict[str, str], str]]:
    """The annotation of pictures that an earlier call with the same settings finished."""
    if not (folder / TABLE).is_file():
        return {}
    with (folder / TABLE).open(newline="", encoding="utf-8") as stream:
        try:
            return {
                int(Path(row["image"]).stem): (
                    {key: row[key] for key in domain.features},
                    row["class"],
                )
                for row in csv.DictReader(stream)
            }
        except (csv.Error, KeyError, TypeError, ValueError):
            raise DatasetError(
                f"{folder / TABLE}: is not as it was made; delete it and the pictures are "
                "annotated again, or choose another folder"
            ) from None


def _make_picture(
    source: str,
    home: Path,
    folder: Path,
    seed: int,
    index: int,
    size: int,
    known: tuple[dict[str, str], str] | None,
) -> tuple[dict[str, str], str]:
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
    pixels, features, label = draw_picture(source, home, seed=seed, index=index, size=size)
    write_whole(note, json.dumps([features, label]), durable=False)
    with whole_file(picture, durable=False) as temporary:
        Image.fromarray(pixels).save(temporary, compress_level=4)
    return features, label


def _noted(note: Path) -> tuple[dict[str, str], str] | None:
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


def _write_table(
    folder: Path, domain: Domain, rows: list[tuple[dict[str, str], str]], test_share: float
) -> None:
    lines = []
    for index, (features, label) in enumerate(rows):
        # Spread evenly: every third for a third, whatever the count.
        is_test = int((index + 1) * test_share) > int(index * test_share)
        lines.append(
            [
                f"images/{index:06d}.png",
                label,
                *(features[key] for key in domain.features),
                "test" if is_test else "train",
            ]
        )
    columns = ["image", "class", *domain.features, "split"]
    write_whole(folder / TABLE, csv_text(columns, lines))
