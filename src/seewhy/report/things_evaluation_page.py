"""The page of an evaluation of several things in a picture: figures, and every wrong picture."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from seewhy import __version__
from seewhy.domain.tables import CLASS
from seewhy.report.boxed_picture import SHOWN, DrawnBox, boxed_picture
from seewhy.report.evaluation_page import MOST_PICTURES
from seewhy.report.html import rendered

if TYPE_CHECKING:
    from seewhy.domain.domain import Domain
    from seewhy.evaluation.things_seen import Mistake, SeenFeature, ThingsSeen, WrongScene

__all__ = ["things_evaluation_page"]

_SIDE = 320
"""Of the longer side of the pictures on the page, in pixels."""


def things_evaluation_page(
    domain: Domain, found: ThingsSeen, *, command: str, most: int = MOST_PICTURES
) -> str:
    """Return an evaluation as the text of an HTML file that opens with no network.

    Parameters
    ----------
    domain : Domain
        With things.
    found : ThingsSeen
    command : str
        The command that makes the page, for its last line.
    most : int, default 100
        How many of the wrong pictures to show.

    Raises
    ------
    PictureError
        If a wrong picture cannot be read any more.
    """
    return rendered(
        "things_evaluation.html",
        domain=domain,
        things=domain.things,
        found=found,
        rows=list(_rows(domain, found)),
        wrong=[_wrong(scene) for scene in sorted(found.wrong, key=_surest)[:most]],
        version=__version__,
        command=command,
    )


def _rows(domain: Domain, found: ThingsSeen) -> Iterator[tuple[str, SeenFeature]]:
    """What is read, in words, and how often rightly."""
    things = domain.things
    assert things is not None, "the domain has no things"
    for key, seen in found.features.items():
        yield f"{things.features[key].name} of a {things.one}", seen
    for key, seen in found.relations.items():
        yield things.relations[key].say.format("one", "another"), seen
    if found.classes is not None:
        yield CLASS, found.classes


def _surest(scene: WrongScene) -> float:
    """In the order of this the surest mistakes come first."""
    return -max(mistake.probability or 0.0 for mistake in scene.mistakes)


def _wrong(scene: WrongScene) -> dict[str, Any]:
    numbered = _numbered(scene.mistakes)
    boxes = [
        DrawnBox(box, str(number), SHOWN, dashed=mistake.probability is None)
        for number, mistake in numbered
        for box in mistake.boxes
    ]
    return {
        "image": scene.image,
        "figure": boxed_picture(scene.picture, boxes, longest=_SIDE).svg,
        "mistakes": [
            {"number": number or "", "says": mistake.says, "probability": mistake.probability}
            for number, mistake in numbered
        ],
    }


def _numbered(mistakes: Sequence[Mistake]) -> list[tuple[int, Mistake]]:
    """Mistakes with numbers: those about the same boxes the same, 0 for none about any."""
    places = list(dict.fromkeys(mistake.boxes for mistake in mistakes if mistake.boxes))
    return [
        (places.index(mistake.boxes) + 1 if mistake.boxes else 0, mistake) for mistake in mistakes
    ]
