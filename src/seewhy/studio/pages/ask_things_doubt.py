"""No, that is wrong, where pictures show several things: what was misread, imagined or missed."""

from __future__ import annotations

from typing import Annotated
from urllib.parse import urlencode

from fastapi import APIRouter, Form, Request, Response
from fastapi.responses import RedirectResponse

from seewhy.domain.domain import Domain
from seewhy.errors import SeeWhyError
from seewhy.revision.remarks import says_wrong
from seewhy.revision.things.reasons import class_named, example_of_a_reason, gives_reason
from seewhy.studio import doubting_things
from seewhy.studio.correcting_things import Correcting
from seewhy.studio.doubting import take
from seewhy.studio.pages.ask_things import begin, shown_anew
from seewhy.studio.pages.chosen_picture import chosen
from seewhy.studio.pages.done import Done
from seewhy.studio.pages.remedies import shown_remedies
from seewhy.studio.record import Entry
from seewhy.studio.rendering import from_script, render
from seewhy.studio.session import who_of
from seewhy.studio.state import Studio, studio_of
from seewhy.studio.thing_talk import ThingTalk

__all__ = [
    "doubt_about_things",
    "reason_about_things",
    "remarked_about_things",
    "router",
    "rules_about_things",
    "take_about_things",
    "take_back_about_things",
]

router = APIRouter()

Name = Annotated[str, Form(max_length=2000)]

_NO_RULE = "No rule is behind it that an exception, or one more condition, would mend."
_TAUGHT = "What sees learns from it when it is trained again."


@router.post("/ask/correct")
def correct(request: Request, picture: Name, choice: Name) -> Response:
    """Keep a correction, ``1.colour=red``, ``gone.1`` or ``there.1``, and answer anew."""
    studio, talk = _about(request, picture)
    with studio.things.at_work():
        correcting = Correcting(studio.project, talk.picture, studio.things.look(talk.picture))
        beside = correcting.keeps_all
        entry = _corrected(correcting, choice, who=who_of(request))
    things = correcting.read.things
    kept = f"Kept as entry {entry.number}. {_TAUGHT}"
    if beside:
        kept += f" The boxes of all other {things.many} are kept with it, as they were found."
    if entry.body.get("none"):
        kept += f" No {things.one} is left: the picture is said to show none."
    return shown_anew(request, studio, talk, Done(kept, entry.number))


@router.post("/ask/missing")
def missing(request: Request, picture: Name) -> Response:
    """Go and draw what was missed, beside the boxes of what was found."""
    studio, talk = _about(request, picture)
    with studio.things.at_work():
        read = studio.things.look(talk.picture)
        Correcting(studio.project, talk.picture, read).as_found(who=who_of(request))
    return RedirectResponse(f"/label?{urlencode({'picture': talk.picture})}", 303)


def doubt_about_things(request: Request, picture: str, *, wanted: str = "") -> Response:
    """What may be wrong about what was read; the rules and reasons are asked for from there."""
    studio, talk = _about(request, picture)
    begin(studio, talk)
    domain = studio.project.domain()
    if wanted and wanted not in domain.classes:
        raise SeeWhyError(f"'{wanted}' is no class of the domain; choose one of the list")
    talk.wanted = wanted or None
    read = talk.replies[-1].read
    part = "_ask_things_doubt.html"
    response = render(
        request,
        part if from_script(request) else "ask_doubt.html",
        part=part,
        picture=talk.picture,
        read=read,
        keeps_all=Correcting(studio.project, talk.picture, read).keeps_all,
        wanted=wanted,
        classes=domain.classes,
        subject=domain.subject,
        example=example_of_a_reason(domain, _other_class(domain, read.reading.label)),
    )
    response.headers["HX-Retarget"] = "#doubt"
    return response


def _other_class(domain: Domain, label: str | None) -> str | None:
    """A class of which the picture was not taken to be."""
    return next((key for key in domain.classes if key != label), None)


def rules_about_things(request: Request, picture: str) -> Response:
    """Exceptions to the rules behind the class and the answer, and what rules may ask more."""
    studio, talk = _about(request, picture)
    begin(studio, talk)
    found = doubting_things.for_the_rules(studio.things, talk)
    return shown_remedies(request, found, picture=talk.picture, nothing=_NO_RULE)


def reason_about_things(request: Request, picture: str, because: str) -> Response:
    """The rule that a reason states: "it is good because there is a red ball"."""
    studio, talk = _about(request, picture)
    begin(studio, talk)
    found = doubting_things.for_a_reason(studio.things, talk, because)
    return shown_remedies(request, found, picture=talk.picture, nothing="No rule follows from it.")


def remarked_about_things(request: Request, picture: str, remark: str) -> Response | None:
    """What follows from a remark that the answer is wrong; None where it is a question."""
    domain = studio_of(request).project.domain()
    if gives_reason(remark):
        response = reason_about_things(request, picture, remark)
        response.headers["HX-Retarget"] = "#doubt"
        return response
    if says_wrong(remark):
        return doubt_about_things(request, picture)
    said = class_named(domain, remark) if remark.strip().casefold().startswith("no") else None
    if said is None or remark.rstrip().endswith("?"):
        return None
    return doubt_about_things(request, picture, wanted=said)


def take_about_things(request: Request, picture: str, key: str) -> Response:
    """Take what was proposed of the rules, and answer the last question anew."""
    studio, talk = _about(request, picture)
    proposal = talk.proposal(key)
    entry = take(studio.project, proposal, picture=talk.picture, who=who_of(request))
    talk.wanted = None
    done = Done(f"Kept as entry {entry.number}: {proposal.sentence}.", entry.number)
    return shown_anew(request, studio, talk, done)


def take_back_about_things(request: Request, picture: str, number: int) -> Response:
    """Take a correction back, and answer the last question anew."""
    studio, talk = _about(request, picture)
    studio.project.take_back(number, who=who_of(request))
    return shown_anew(request, studio, talk, Done(f"Taken back: entry {number}.", None))


def _about(request: Request, picture: str) -> tuple[Studio, ThingTalk]:
    """The talk about a picture, where pictures show several things."""
    studio = studio_of(request)
    if not studio.project.has_things:
        raise SeeWhyError("this is for pictures of several things; doubt the answer instead")
    talk = studio.thing_talks.of(request.state.session)
    talk.about(chosen(studio, picture))
    return studio, talk


def _corrected(correcting: Correcting, choice: str, *, who: str) -> Entry:
    said, _, rest = choice.partition(".")
    if said in ("gone", "there"):
        number = _number(rest)
        takes = correcting.not_there if said == "gone" else correcting.there
        return takes(number, who=who)
    feature, _, value = rest.partition("=")
    return correcting.value(_number(said), feature, value, who=who)


def _number(said: str) -> int:
    if not (said.isascii() and said.isdecimal() and 0 < len(said) < 4 and int(said)):
        raise SeeWhyError(f"things are counted from 1, got '{said[:40]}'; choose one of the list")
    return int(said) - 1
