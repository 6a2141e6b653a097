"""Things on the page Label: boxes that are drawn, what is said of each, and of two of them."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Form, Request, Response

from seewhy.errors import SeeWhyError
from seewhy.new_domain.words import plain_words
from seewhy.studio.drawing import (
    draw,
    move,
    relate,
    relate_to_no_other,
    remove,
    say_none,
    say_of_thing,
    things_of,
)
from seewhy.studio.pages.chosen_picture import chosen
from seewhy.studio.pages.label_shown import GO_ON, Name, shown
from seewhy.studio.session import who_of
from seewhy.studio.state import studio_of

__all__ = ["router"]

router = APIRouter()

Corner = Annotated[float | None, Form()]

_SAYS = {"yes": True, "no": False, "open": None}


@router.post("/label/thing/draw")
def draw_box(
    request: Request,
    picture: Name,
    thing: Name = "",
    left: Corner = None,
    top: Corner = None,
    right: Corner = None,
    bottom: Corner = None,
) -> Response:
    """Draw a box, or draw that of a thing anew; one in the middle where no corner is given."""
    studio, who = studio_of(request), who_of(request)
    one = things_of(studio.project).one
    _stand(request, picture)
    given = [corner for corner in (left, top, right, bottom) if corner is not None]
    if len(given) not in (0, 4) or (thing and not given):
        raise SeeWhyError("a box has four numbers: left, top, right and bottom; fill in all")
    if thing:
        move(studio.project, picture, thing, given, who=who)
        return shown(request, thing=thing, done=f"{one} {thing}: its box")
    name = draw(studio.project, picture, given or None, who=who)
    return shown(request, thing=name, done=f"{one} {name} is drawn")


@router.post("/label/thing/remove")
def remove_thing(request: Request, picture: Name, thing: Name) -> Response:
    """Remove a thing."""
    studio = studio_of(request)
    one = things_of(studio.project).one
    _stand(request, picture)
    remove(studio.project, picture, thing, who=who_of(request))
    return shown(request, done=f"{one} {thing} is removed")


@router.post("/label/thing/none")
def set_none(request: Request, picture: Name, choice: Name) -> Response:
    """Say that nothing is in the picture (``yes``), or leave it open again (``open``)."""
    studio = studio_of(request)
    many = things_of(studio.project).many
    _stand(request, picture)
    if choice not in ("yes", "open"):
        raise SeeWhyError(f"there are no {many} (yes), or it is open, got '{choice}'")
    say_none(studio.project, picture, choice == "yes", who=who_of(request))
    done = f"no {many} here" if choice == "yes" else f"open again whether there are {many}"
    return shown(request, done=done)


@router.post("/label/thing/set")
def set_value(
    request: Request, picture: Name, thing: Name, choice: Name = "", other: Name = ""
) -> Response:
    """Say a value of a thing's feature: ``FEATURE=VALUE``, an empty one for nobody knows."""
    studio = studio_of(request)
    one = things_of(studio.project).one
    _stand(request, picture)
    name, _, value = (other or choice).partition("=")
    say_of_thing(studio.project, picture, thing, name, value or None, who=who_of(request))
    at = "" if value else name
    said = plain_words(value) or "open again"
    return shown(request, at=at, thing=thing, done=f"{one} {thing}: {name} {said}")


@router.post("/label/thing/relate")
def relate_things(request: Request, picture: Name, thing: Name, choice: Name) -> Response:
    """Say that a relation holds, or not: ``RELATION=yes=OTHER``.

    ``no`` and ``open`` stand for yes where it does not hold, or nobody knows; without another
    thing no is said of all of which nothing is said yet.
    """
    studio, who = studio_of(request), who_of(request)
    one = things_of(studio.project).one
    _stand(request, picture)
    relation, _, rest = choice.partition("=")
    said, _, other = rest.partition("=")
    if said not in _SAYS:
        raise SeeWhyError(f"a relation holds (yes), does not (no) or is open, got '{said}'")
    if other:
        relate(studio.project, picture, relation, thing, other, _SAYS[said], who=who)
        done = f"{one} {thing} {relation} {other}: {said}"
    else:
        relate_to_no_other(studio.project, picture, relation, thing, who=who)
        done = f"{one} {thing} {relation}: no other"
    return shown(request, at=relation, thing=thing, done=done)


def _stand(request: Request, picture: str) -> None:
    """Stand at a picture of the project."""
    studio = studio_of(request)
    chosen(studio, picture, remedy=GO_ON)
    studio.trails.of(request.state.session).visit(picture)
