"""The sets of pictures that systems are compared on, and which of them are tested on."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from seewhy.data.dataset import TABLE, Dataset
from seewhy.data.importers import ImportRequest, import_pictures
from seewhy.data.making import make_dataset
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import ExperimentError
from seewhy_lab.experiments.experiment import ALL

__all__ = [
    "SETS",
    "PictureSet",
    "Pictures",
    "drawn_rows",
    "is_tested",
    "load_set",
    "require_source",
]

DOMAINS = Path(__file__).resolve().parent / "domains"
"""Domain folders of sets that no bundled domain describes."""

ARCHIVE_OF_SIGNS = "BelgiumTSC_Training.zip"

_SIDE = 112  # pixels, of eyes
_TEST_SHARE = 1 / 3  # of pictures that a source draws


@dataclass(frozen=True)
class PictureSet:
    """A set of pictures.

    Attributes
    ----------
    name, title : str
    domain : str
        A bundled domain's name or a domain folder.
    counts : tuple of int
        Labels to train on; 0 for all.
    archive : str
        The file that the photographs come from; "" where the domain's source draws the pictures.
    importer : {"folder", "belgiumts", ""}
        What reads the archive.
    group : str
        What finds the group of a picture in its file's name, where its folder is its class.
    tested : int
        One group of so many is tested on. 0: the pictures that the source marked.
    made : int
        Pictures that the source draws.
    """

    name: str
    title: str
    domain: str
    counts: tuple[int, ...]
    archive: str = ""
    importer: Literal["folder", "belgiumts", ""] = ""
    group: str = ""
    tested: int = 0
    made: int = 0


SETS = {
    chosen.name: chosen
    for chosen in (
        PictureSet(
            "structures",
            "Structures of blocks",
            "structure_stability",
            (100, 200, 400, 800, 1667),
            made=2500,
        ),
        PictureSet(
            "signs",
            "Photographs of traffic signs, tested on other poles",
            "traffic_signs",
            (100, 200, 500, 1000, ALL),
            archive=ARCHIVE_OF_SIGNS,
            importer="belgiumts",
            tested=4,
        ),
        PictureSet(
            "hands",
            "Hands showing digits, tested on other people",
            str(DOMAINS / "hands"),
            (100, 300, 1000),
            archive="hands.zip",
            importer="folder",
            group=r"^(\d+)_",
            tested=3,
        ),
        PictureSet(
            "set_cards",
            "Cards of the game SET, tested on other captures",
            str(DOMAINS / "set_cards"),
            (100, 300, 1000),
            archive="set_cards.zip",
            importer="folder",
            group=r"^(\d+_\d+)",
            tested=3,
        ),
        PictureSet(
            "rooms", "Rooms of an office building", "robot_assistant", (100, 500), made=1500
        ),
    )
}


@dataclass(frozen=True, eq=False)
class Pictures:
    """A set's pictures, divided.

    Attributes
    ----------
    train : Dataset
        Of which labels are drawn.
    test : Dataset
        The same for every seed, count and system.
    """

    train: Dataset
    test: Dataset

    def drawn(self, count: int, seed: int) -> Dataset:
        """So many of the pictures to train on, see :func:`drawn_rows`."""
        return self.train.take(drawn_rows(self.train.classes, count, seed=seed))


def load_set(chosen: PictureSet, *, archives: Path | None, folder: Path) -> Pictures:
    """Read a set; import or make its pictures where ``folder`` does not hold them yet.

    Parameters
    ----------
    chosen : PictureSet
    archives : Path or None
        The folder of the archives.
    folder : Path
        For the dataset.

    Raises
    ------
    ExperimentError
        An archive is asked for and not there, or there are fewer pictures than a set is made of.
    """
    domain = load_domain(chosen.domain)
    if not (folder / TABLE).is_file():
        _write(chosen, domain, require_source(chosen, archives=archives, folder=folder), folder)
    scenes = Dataset.load(folder, domain).with_class()
    if chosen.tested:
        tested = [
            is_tested(scene.group or scenes.name_of(scene), chosen.tested)
            for scene in scenes.scenes
        ]
    else:
        tested = [scene.split == "test" for scene in scenes.scenes]
    scenes = replace(scenes, scenes=tuple(replace(scene, split="") for scene in scenes.scenes))
    for side in (_SIDE, domain.pictures.size):
        scenes.pictures(side)  # read once for all trials
    places = {kept: [n for n, test in enumerate(tested) if test is kept] for kept in (False, True)}
    if not all(places.values()):
        raise ExperimentError(
            f"{folder}: of {len(scenes)} pictures {len(places[True])} are to be tested on, which "
            "leaves nothing to compare; give more pictures, of more groups"
        )
    return Pictures(scenes.take(places[False]), scenes.take(places[True]))


def require_source(chosen: PictureSet, *, archives: Path | None, folder: Path) -> Path | None:
    """The archive that a set still has to be read from; None where it is drawn, or there.

    Raises
    ------
    ExperimentError
        It is not there, or nobody says where.
    """
    if not chosen.archive or (folder / TABLE).is_file():
        return None
    if archives is None:
        raise ExperimentError(
            f"the set {chosen.name} is made of {chosen.archive}; name the folder that holds it "
            "with --data, or leave the set out with --sets"
        )
    archive = archives / chosen.archive
    if not archive.exists():
        raise ExperimentError(
            f"{archive}: there is no such file, of which the set {chosen.name} is made; give "
            "another folder with --data, or leave the set out with --sets"
        )
    return archive


def _write(chosen: PictureSet, domain: Domain, archive: Path | None, folder: Path) -> None:
    if archive is None:
        make_dataset(domain, folder, count=chosen.made, seed=0, test_share=_TEST_SHARE, workers=1)
        return
    if chosen.importer == "belgiumts":
        from seewhy_lab.belgiumts.conversion import import_photographs

        import_photographs([archive], folder, domain=domain)
        return
    request = ImportRequest(
        archive,
        "folder",
        features=Path(chosen.domain) / "classes.csv",
        group=chosen.group,
    )
    import_pictures(request, folder)


def is_tested(group: str, one_of: int) -> bool:
    """Whether a group is among those that are tested on, one of so many, whatever the seed.

    Examples
    --------
    >>> [number for number in range(12) if is_tested(str(number), 3)]
    [0, 6, 8, 11]
    """
    digest = hashlib.sha256(f"final/{group}".encode()).hexdigest()
    return int(digest[:8], 16) % one_of == 0


def drawn_rows(classes: Sequence[str], count: int, *, seed: int) -> list[int]:
    """Draw pictures, of every class its share, rounded up or down by chance.

    Fewer are always part of more. All are taken where ``count`` is 0.

    Raises
    ------
    ExperimentError
        There are not so many.

    Examples
    --------
    >>> classes = ["a"] * 6 + ["b"] * 3
    >>> [classes[row] for row in drawn_rows(classes, 3, seed=0)]
    ['a', 'a', 'b']
    >>> set(drawn_rows(classes, 3, seed=5)) < set(drawn_rows(classes, 6, seed=5))
    True
    """
    if count > len(classes):
        raise ExperimentError(
            f"{count} labels are asked for and {len(classes)} pictures are there to train on; "
            "choose fewer with --counts"
        )
    generator = np.random.default_rng(seed)
    labels = np.array(classes)
    places = np.empty(len(labels))
    for label in sorted(set(classes)):
        members = generator.permutation(np.flatnonzero(labels == label))
        # Evenly over 0..1, so that what lies below any limit has each class's share of it.
        places[members] = (np.arange(len(members)) + generator.uniform()) / len(members)
    chosen = np.argsort(places, kind="stable")[: count if count != ALL else len(places)]
    return sorted(chosen.tolist())
