"""Answers about a picture as one HTML file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from seewhy import __version__
from seewhy.dialogue.reply import Reply
from seewhy.domain.domain import Domain
from seewhy.report.card import draw_card
from seewhy.report.html import rendered

if TYPE_CHECKING:
    from seewhy.perception.where import Where

__all__ = ["answers_page"]


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
    return rendered(
        "answers.html",
        title=domain.title,
        picture=picture.name,
        answers=[
            {
                "question": f"{reply.question.text}?",
                "text": reply.text,
                "lines": reply.justification.to_text(),
                "card": draw_card(reply, picture, where=where, fit=fit).svg,
            }
            for reply in replies
        ],
        version=__version__,
    )
