"""A rule by example, by conditions, or accepted from what was learned."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated
from urllib.parse import urlencode

from fastapi import APIRouter, Form, Query, Request, Response
from fastapi.responses import RedirectResponse

from seewhy.domain.tables import CLASS
from seewhy.errors import DomainError
from seewhy.revision.edit import KNOWLEDGE
from seewhy.revision.telling import say_consequences
from seewhy.revision.things.reasons import example_of_a_reason
from seewhy.studio.doubting import take
from seewhy.studio.project import Project
from seewhy.studio.rendering import from_script, render
from seewhy.studio.rule_making import MadeRule, learned_rules, rules_from, rules_in_words
from seewhy.studio.session import who_of
from seewhy.studio.state import Studio, studio_of
from seewhy.studio.talk import Talk
from seewhy.studio.writing import read_text

__all__ = ["router"]

router = APIRouter()

SHOWN = 60
"""Pictures to choose from at once."""

_MOST_CONDITIONS = 200

Values = Annotated[list[str] | None, Form(max_length=_MOST_CONDITIONS)]


@dataclass(frozen=True)
class Offered:
    """A rule as it is shown, with the key to take it by; see ``_remedy.html``."""

    key: str
    rule: MadeRule
    said: str

    @property
    def proposal(self) -> object:
        """What would be written."""
        return self.rule.proposal


@router.get("/rules/example")
def show(
    request: Request,
    of: Annotated[str, Query(max_length=200)] = "",
    page: Annotated[int, Query(ge=0)] = 0,
) -> Response:
    """Labelled pictures to choose from, and the values that a rule may ask for."""
    project = studio_of(request).project
    if project.domain_folder is None:
        return RedirectResponse("/rules", 303)
    domain, labels = project.domain(), project.labels()
    if domain.things is not None:
        example = example_of_a_reason(domain)
        return render(request, "rules_in_words.html", domain=domain, example=example)
    names = [
        name
        for name in project.pictures()
        if (said := labels.value(name, CLASS)) in domain.classes and of in ("", said)
    ]
    last = max(0, len(names) - 1) // SHOWN
    page = min(page, last)
    return render(
        request,
        "rules_example.html",
        domain=domain,
        labels=labels,
        names=names[page * SHOWN : (page + 1) * SHOWN],
        of=of,
        page=page,
        last=last,
    )


@router.post("/rules/example")
def make(
    request: Request,
    label: Annotated[str, Form(max_length=200)],
    picture: Annotated[list[str] | None, Form(max_length=SHOWN)] = None,
    shows: Values = None,
) -> Response:
    """The rules that examples or conditions make, with what each would change."""
    studio = studio_of(request)
    if studio.project.has_things:
        raise DomainError("the domain has things; say the rule in words")
    made = rules_from(
        studio.project,
        _knowledge(studio.project),
        label=label,
        examples=picture or (),
        conditions=_conditions(shows or ()),
    )
    nothing = "Each rule that these pictures suggest is known already."
    return _offered(request, studio, made, nothing=nothing)


@router.post("/rules/words")
def make_of_words(request: Request, because: Annotated[str, Form(max_length=1000)]) -> Response:
    """The rule about things that a reason in words states, with what it would change."""
    studio = studio_of(request)
    if not studio.project.has_things:
        raise DomainError("the domain has no things; make a rule by example")
    made = rules_in_words(studio.project, because)
    return _offered(request, studio, made, nothing="No rule follows from it.")


@router.get("/rules/learned")
def learned(request: Request) -> Response:
    """The rules that were learned, with the pictures that they rest on."""
    studio = studio_of(request)
    if studio.project.domain_folder is None:
        return RedirectResponse("/rules", 303)
    found = learned_rules(studio.model, _knowledge(studio.project))
    nothing = "The labelled pictures suggest no rule beyond those that there are."
    return _offered(request, studio, found, nothing=nothing)


@router.post("/rules/take")
def take_rule(request: Request, key: Annotated[str, Form(max_length=40)]) -> Response:
    """Take a rule that was offered."""
    studio = studio_of(request)
    proposal = studio.talks.of(request.state.session).proposal(key)
    entry = take(studio.project, proposal, picture="", who=who_of(request))
    done = f"kept as entry {entry.number}: {proposal.sentence}"
    return RedirectResponse(f"/rules?{urlencode({'done': done[:480]})}", 303)


def _offered(
    request: Request, studio: Studio, made: Sequence[MadeRule], *, nothing: str
) -> Response:
    talk: Talk = studio.talks.of(request.state.session)
    offered = [
        Offered(next(iter(talk.propose([rule.proposal]))), rule, _said(rule)) for rule in made
    ]
    template = "_rules_offered.html" if from_script(request) else "rules_offered.html"
    return render(request, template, offered=offered, nothing=nothing)


def _said(rule: MadeRule) -> str:
    said = say_consequences(rule.proposal.consequences)
    return f"{said[:1].upper()}{said[1:]}."


def _conditions(shows: Sequence[str]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for assignment in shows:
        key, sign, value = assignment.partition("=")
        if not sign:
            raise DomainError(f"'{assignment}' gives no value; choose one of the list")
        found.setdefault(key, []).append(value)
    return found


def _knowledge(project: Project) -> str:
    folder = project.domain_folder
    if folder is None:
        raise DomainError("there is no domain yet; name classes and features on the page Begin")
    return read_text(folder / KNOWLEDGE) or ""
