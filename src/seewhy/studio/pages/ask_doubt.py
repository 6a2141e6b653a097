"""No, that is wrong: what may be wrong about an answer, and what each remedy would change."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from fastapi import APIRouter, Form, Query, Request, Response

from seewhy.domain.assignments import named_values
from seewhy.errors import SeeWhyError
from seewhy.revision.proposal import Proposal
from seewhy.revision.remarks import Remark, Says, remark_of
from seewhy.studio import doubting
from seewhy.studio.offered import Remedy
from seewhy.studio.pages.ask_things_doubt import (
    doubt_about_things,
    reason_about_things,
    rules_about_things,
)
from seewhy.studio.pages.chosen_picture import chosen
from seewhy.studio.pages.done import Done
from seewhy.studio.pages.remedies import shown_remedies
from seewhy.studio.rendering import from_script, render
from seewhy.studio.state import Studio, studio_of
from seewhy.studio.talk import Talk

__all__ = ["doubted", "router", "taken"]

router = APIRouter()

Name = Annotated[str, Query(max_length=2000)]


@router.get("/ask/doubt")
def doubt(
    request: Request,
    picture: Name,
    wanted: Annotated[str, Query(max_length=200)] = "",
    feature: Annotated[str, Query(max_length=400)] = "",
) -> Response:
    """What may have been misread; the rules and reasons are asked for from there."""
    studio = studio_of(request)
    if studio.project.has_things:
        return doubt_about_things(request, picture, wanted=wanted)
    talk = studio.talks.of(request.state.session)
    talk.about(chosen(studio, picture))
    with studio.model.at_work() as agent:
        if wanted and wanted not in agent.domain.classes:
            raise SeeWhyError(f"'{wanted}' is no class of the domain; choose one of the list")
        talk.wanted = wanted or None
        about = tuple(named_values(agent.domain, [feature]).items()) if feature else ()
    return _shown(request, studio, talk, about=about)


@router.get("/ask/doubt/rules")
def rules(request: Request, picture: Name) -> Response:
    """Exceptions to the rules behind the answer, and conditions that they may ask more."""
    studio = studio_of(request)
    if studio.project.has_things:
        return rules_about_things(request, picture)
    talk = studio.talks.of(request.state.session)
    talk.about(chosen(studio, picture))
    found = doubting.for_the_rules(studio.model, talk)
    return _remedies(request, talk, found, nothing="No exception and no condition mends it.")


@router.post("/ask/reason")
def reason(
    request: Request,
    picture: Annotated[str, Form(max_length=2000)],
    because: Annotated[str, Form(max_length=1000)],
) -> Response:
    """The rule that a reason states: "it is good because it is red"."""
    studio = studio_of(request)
    if studio.project.has_things:
        return reason_about_things(request, picture, because)
    talk = studio.talks.of(request.state.session)
    talk.about(chosen(studio, picture))
    found = doubting.for_a_reason(studio.model, talk, because)
    return _remedies(request, talk, found, nothing="No rule follows from it.")


def doubted(request: Request, remark: str) -> Response:
    """What follows from a remark such as "no, it is bad because it has corners"."""
    studio = studio_of(request)
    talk = studio.talks.of(request.state.session)
    with studio.model.at_work() as agent:
        meant = remark_of(agent.questions, remark)
    assert meant is not None
    if meant.says is Says.BECAUSE:
        found = doubting.for_a_reason(studio.model, talk, remark)
        response = _remedies(request, talk, found, nothing="No rule follows from it.")
    else:
        response = _otherwise(request, talk, meant)
    response.headers["HX-Retarget"] = "#doubt"
    return response


def _otherwise(request: Request, talk: Talk, meant: Remark) -> Response:
    """What may have been misread, where somebody says what the picture is or shows instead."""
    labels = [said.label for said in meant.statements if said.label]
    talk.wanted = labels[0] if labels else None
    about = tuple((said.feature, said.value) for said in meant.statements if said.feature)
    return _shown(request, studio_of(request), talk, about=about)


def remedies_of(studio: Studio, found: Mapping[str, Proposal]) -> list[Remedy]:
    """Proposals as they are shown."""
    return [
        Remedy(key, proposal, doubting.said_of(studio.model, proposal))
        for key, proposal in found.items()
    ]


def taken(studio: Studio, talk: Talk, key: str, *, who: str) -> Done:
    """Take what was proposed."""
    proposal = talk.proposal(key)
    entry = doubting.take(studio.project, proposal, picture=talk.picture, who=who)
    kept = f"Kept as entry {entry.number}: {proposal.sentence}."
    if proposal.reading is not None:
        kept += " It is one more label; the networks see it so when they are trained again."
    return Done(kept, entry.number)


def _remedies(
    request: Request, talk: Talk, found: Mapping[str, Proposal], *, nothing: str
) -> Response:
    remedies = remedies_of(studio_of(request), found)
    return shown_remedies(request, remedies, picture=talk.picture, nothing=nothing)


def _shown(
    request: Request,
    studio: Studio,
    talk: Talk,
    *,
    about: tuple[tuple[str, str | None], ...] = (),
) -> Response:
    found = doubting.misread(studio.model, talk, about)
    with studio.model.at_work() as agent:
        shown: dict[str, Any] = {
            "part": "_ask_doubt.html",
            "picture": talk.picture,
            "remedies": remedies_of(studio, found),
            "wanted": talk.wanted or "",
            "classes": agent.domain.classes,
            "features": agent.domain.features,
            "scene": studio.model.look(talk.picture),
            "subject": agent.domain.subject,
        }
    template = "_ask_doubt.html" if from_script(request) else "ask_doubt.html"
    return render(request, template, **shown)
