"""`seewhy learn DOMAIN`: axioms about things, from annotated pictures of several."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seewhy.cli.axiom_lines import axiom_dict, rests
from seewhy.cli.screen import print_json, remark, say
from seewhy.errors import DomainError, SeeWhyError
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.domain.domain import Domain
    from seewhy.evaluation.held_back import Judged, Proposal
    from seewhy.evaluation.things_learned import LearnedAboutThings
    from seewhy.induction.things.rule_learning import JudgedRule, ThingLearningOptions

__all__ = ["domain_of_things", "learn_from_things"]


def domain_of_things(name: Path) -> Domain | None:
    """Return the domain of a name or a folder, if it is one whose pictures show several things."""
    from seewhy.domain.domain import load_domain
    from seewhy.domain.folder import bundled_domains

    if not (name / "domain.toml").is_file() and str(name) not in bundled_domains():
        return None
    domain = load_domain(name)
    return None if domain.things is None else domain


def learn_from_things(
    domain: Domain,
    data: Path,
    out: Path | None,
    *,
    outside: bool,
    options: ThingLearningOptions,
    accept: Callable[[Proposal], bool],
    keep: bool,
    refused: Mapping[str, object],
    json: bool,
) -> None:
    """Learn, print what was learned and write it into the domain's knowledge.

    ``keep`` False only shows it. ``refused`` are options that are not for things.
    """
    from seewhy.cli.read_data import read_data
    from seewhy.cli.things_in_pictures import refuse
    from seewhy.evaluation.things_learned import learn_about_things

    refuse(refused, why="their axioms come of no tree; leave it out")
    target = _target(domain, out, keep=keep)
    found = learn_about_things(
        domain,
        read_data(data, domain, outside=outside),
        options=options,
        accept=accept,
        on_held_back=_remark_held_back,
    )
    written = keep and bool(found.added or found.withdrawn)
    if written:
        _write(found, domain.folder, target)
    if json:
        print_json(_to_dict(found, domain, written=target / "knowledge.al" if written else None))
        return
    _print(found, domain)
    if written:
        remark(f"what was learned is in {target / 'knowledge.al'}")


def _target(domain: Domain, out: Path | None, *, keep: bool) -> Path:
    """The folder whose knowledge is written; nothing is, before it is sure that it can be."""
    from seewhy.domain.folder import is_bundled

    if keep and out is None and is_bundled(domain.folder):
        raise DomainError(
            f"the domain '{domain.name}' comes with SeeWhy and stays as it is; give --out FOLDER "
            "for a copy that knows what is learned"
        )
    if out is not None and out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise SeeWhyError(f"{out}: is there already; name a new folder with --out")
    return domain.folder if out is None else out


def _write(found: LearnedAboutThings, source: Path, target: Path) -> None:
    from seewhy.files.whole_files import write_whole
    from seewhy.revision.knowledge_text import with_learned

    file = source / "knowledge.al"
    text = with_learned(file.read_text(encoding="utf-8"), found.added, found.withdrawn)
    if target != source:
        shutil.copytree(source, target, dirs_exist_ok=True)
    write_whole(target / "knowledge.al", text)


def _remark_held_back(held_back: int, pictures: int) -> None:
    remark(
        f"{held_back} of {pictures} pictures are held back: nothing is learned from them, they "
        "judge what is proposed"
    )


def _print(found: LearnedAboutThings, domain: Domain) -> None:
    for gone in found.withdrawn:
        say(f"withdrawn: {gone.statement} {gone.reason}")
    for judged in found.judgements:
        fate = "proposed" if not judged.reason else judged.fate.value
        why = f" ({judged.reason})" if judged.reason else ""
        say(f"{fate}: {_said(domain, judged)}{why}")
    if not found.found:
        say("no axiom is to be learned from these pictures")
    for axiom in found.added:
        say(f"added: {axiom}  ({rests(axiom)})")
    for proposal, accepted in found.judged:
        if proposal.falls and not accepted:
            say(f"left out, accuracy would fall: {proposal.statement}")
    if found.before is not None and found.after is not None:
        before, after = found.before.right, found.after.right
        say(
            f"annotated scenes classified rightly by the knowledge, of {found.held_back} held "
            f"back: {percent(before.value)} before, {percent(after.value)} now"
        )


def _said(domain: Domain, judged: JudgedRule) -> str:
    """A rule with the pictures that bear it out: "good: there is a red cube: 41 of 41 pictures"."""
    from seewhy.induction.sentence import things
    from seewhy.induction.things.rule_sentence import say_conditions

    rule, tally = judged.rule, judged.tally
    support = f"{tally.right} of {tally.right + tally.wrong} {things(domain)}"
    return f"{domain.classes[rule.label].say}: {say_conditions(domain, rule)}: {support}"


def _to_dict(found: LearnedAboutThings, domain: Domain, *, written: Path | None) -> dict[str, Any]:
    added = found.added if written is not None else ()
    gone = found.withdrawn if written is not None else ()
    return {
        "domain": domain.name,
        "written": None if written is None else str(written),
        "found": [axiom_dict(axiom) for axiom in found.found],
        "added": [axiom_dict(axiom) for axiom in added],
        "withdrawn": [{"statement": axiom.statement, "reason": axiom.reason} for axiom in gone],
        "candidates": [
            {
                "text": _said(domain, judged),
                "class": judged.rule.label,
                "literals": judged.rule.literals,
                "fate": judged.fate.value,
                "reason": judged.reason,
                "right": judged.tally.right,
                "wrong": judged.tally.wrong,
                "left_open": judged.tally.left,
            }
            for judged in found.judgements
        ],
        "held_back": found.held_back,
        "learned_from": found.learned_from,
        "before": _share(found.before),
        "after": _share(found.after),
    }


def _share(judged: Judged | None) -> float | None:
    return None if judged is None else judged.right.value
