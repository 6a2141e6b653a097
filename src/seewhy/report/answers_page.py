"""Answers about a picture as one HTML file."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seewhy import __version__
from seewhy.dialogue.reply import Reply
from seewhy.domain.domain import Domain
from seewhy.knowledge.justification import Node
from seewhy.report.boxed_picture import ShownPicture
from seewhy.report.card import draw_card
from seewhy.report.html import rendered
from seewhy.report.thing_card import boxes_of_reply, spoken_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from seewhy.agent.things.thing_reply import PictureReply
    from seewhy.perception.where import Where

__all__ = ["answers_page", "answers_page_of_things"]

_LONGEST = 640
"""Of the picture with boxes, in pixels."""


def answers_page(
    domain: Domain,
    picture: Path,
    replies: Sequence[Reply],
    *,
    where: Mapping[str, Where] | None = None,
) -> str:
    """Return answers with their reasons as the text of an HTML file that opens with no network.

    Parameters
    ----------
    domain : Domain
    picture : Path
        What the answers are about.
    replies : sequence of Reply
    where : mapping of str to Where, optional
        Where features were seen, to be shown beside the reasons.

    Raises
    ------
    PictureError
        If the picture cannot be read.
    """
    fit = domain.pictures.fit
    answers = []
    for reply in replies:
        card = draw_card(reply, picture, where=where, fit=fit, reasons=False).svg
        question = f"{reply.question.text}?"
        said = {"question": question, "label": f"{question} {reply.text}", "said": False}
        answers.append({**said, "figure": card, "reasons": _Step.of(reply.justification)})
    return _page(domain, picture, answers)


def answers_page_of_things(domain: Domain, picture: Path, replies: Sequence[PictureReply]) -> str:
    """Return answers about the things in a picture as the text of such a file.

    Each has the picture with a box around each thing, and the reasons as a tree that folds: the
    boxes of what a step speaks of are marked where it is pointed at.

    Parameters
    ----------
    domain : Domain
    picture : Path
        What the answers are about.
    replies : sequence of PictureReply

    Raises
    ------
    PictureError
        If the picture cannot be read.
    """
    shown = ShownPicture.of(picture, longest=_LONGEST)
    answers = []
    for reply in replies:
        read, least = reply.read, reply.say_least_sure()
        answers.append(
            {
                "question": reply.reply.question,
                "text": reply.text,
                "note": f"Not sure: {least}." if least else "",
                "said": True,
                "label": f"{picture.name} with a box around each {read.things.one}",
                "figure": shown.with_boxes(boxes_of_reply(reply), stands=True).svg,
                "reasons": _Step.of(reply.justification, partial(spoken_of, read=read)),
            }
        )
    count = max((len(reply.read.reading.things) for reply in replies), default=0)
    return _page(domain, picture, answers, standing=shown.standing, things=count)


@dataclass(frozen=True)
class _Step:
    """A step of the reasons with the numbers of the things that it speaks of."""

    node: Node
    things: tuple[int, ...]
    below: tuple[_Step, ...]

    @classmethod
    def of(cls, node: Node, things: Callable[[Node], tuple[int, ...]] = lambda _: ()) -> _Step:
        return cls(node, things(node), tuple(cls.of(child, things) for child in node.children))


def _page(
    domain: Domain,
    picture: Path,
    answers: Sequence[dict[str, Any]],
    *,
    standing: str = "",
    things: int = 0,
) -> str:
    return rendered(
        "answers.html",
        title=domain.title,
        picture=picture.name,
        answers=answers,
        standing=standing,
        things=things,
        version=__version__,
    )
