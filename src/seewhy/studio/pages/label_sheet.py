"""The contact sheet: many pictures at once, the most probable first."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated
from urllib.parse import urlencode

from fastapi import APIRouter, Form, Query, Request, Response
from fastapi.responses import RedirectResponse

from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.errors import SeeWhyError
from seewhy.new_domain.words import plain_words
from seewhy.studio.label import Label
from seewhy.studio.labelling import choose
from seewhy.studio.rendering import render
from seewhy.studio.session import who_of
from seewhy.studio.state import Studio, studio_of

__all__ = ["router"]

router = APIRouter()

SHOWN = 48
"""Pictures of one sheet."""

WHICH = {"open": "not labelled", "all": "all", "said": "labelled so"}

Text = Annotated[str, Query(max_length=200)]


@dataclass(frozen=True)
class Cell:
    """A picture of the sheet."""

    picture: str
    label: Label | None
    proposed: tuple[str, float] | None


@router.get("/label/sheet")
def show(
    request: Request,
    feature: Text = "",
    value: Text = "",
    which: Text = "open",
    page: Annotated[int, Query(ge=0)] = 0,
    done: Text = "",
) -> Response:
    """Pictures by the probability of a value, with a box each to choose them by."""
    studio = studio_of(request)
    if studio.project.domain_folder is None:
        return RedirectResponse("/begin", 303)
    values = _values(studio.project.domain())
    if not values:
        raise SeeWhyError(
            "all that this domain asks is of things, which are labelled one picture at a time; go "
            "on with Label"
        )
    feature = feature if feature in values else next(iter(values))
    value = value if value in values[feature] else values[feature][0]
    which = which if which in WHICH else "open"
    names = _ranked(studio, feature, value, which)
    last = max(0, (len(names) - 1) // SHOWN)
    page = min(page, last)
    proposals, labels = studio.proposer.latest(), studio.project.labels()
    cells = [
        Cell(
            name,
            labels.of.get(name, {}).get(feature),
            proposals.best(name, feature),
        )
        for name in names[page * SHOWN : (page + 1) * SHOWN]
    ]
    return render(
        request,
        "label_sheet.html",
        cells=cells,
        feature=feature,
        value=value,
        values=values,
        words={name: plain_words(name) for name in values},
        which=which,
        kinds=WHICH,
        page=page,
        last=last,
        count=len(names),
        done=done,
    )


@router.post("/label/many")
def set_many(
    request: Request,
    feature: Annotated[str, Form(max_length=200)],
    value: Annotated[str, Form(max_length=200)],
    picture: Annotated[list[str] | None, Form(max_length=SHOWN)] = None,
    which: Annotated[str, Form(max_length=10)] = "open",
) -> Response:
    """Say one value of all pictures that were chosen."""
    studio = studio_of(request)
    chosen = picture or []
    there = set(studio.project.pictures())
    lost = [name for name in chosen if name not in there]
    if lost:
        raise SeeWhyError(f"'{lost[0]}' is no picture of the project; load the page again")
    said = f"{len(chosen)} pictures: {feature} {value}" if chosen else "no picture was chosen"
    if chosen:
        values: dict[str, dict[str, str | None]] = {name: {feature: value} for name in chosen}
        choose(studio.project, values, who=who_of(request), how="sheet")
    query = {"feature": feature, "value": value, "which": which, "done": said}
    return RedirectResponse(f"/label/sheet?{urlencode(query)}", 303)


def _values(domain: Domain) -> dict[str, tuple[str, ...]]:
    features = {name: feature.values for name, feature in domain.features.items()}
    return {CLASS: tuple(domain.classes), **features} if domain.classes else features


def _ranked(studio: Studio, feature: str, value: str, which: str) -> list[str]:
    """The pictures meant, those first in which the value is most probable."""
    labels, proposals = studio.project.labels(), studio.proposer.latest()

    def is_meant(name: str) -> bool:
        said = labels.value(name, feature)
        return {"open": said is None, "all": True, "said": said == value}[which]

    def probability(name: str) -> float:
        return proposals.of(name, feature).get(value, 0.0)

    return sorted(filter(is_meant, studio.project.pictures()), key=lambda name: -probability(name))
