"""Whether a project has a model to ask, of the kind that its domain needs, and which one."""

from __future__ import annotations

from dataclasses import dataclass

from seewhy.agent.manifest_file import MANIFEST, is_of_things
from seewhy.errors import ModelError
from seewhy.studio.project import Project

__all__ = ["Missing", "missing_of", "other_kind", "stamp_of"]


@dataclass(frozen=True)
class Missing:
    """What a page lacks, in one sentence, and the page where it comes from."""

    sentence: str
    path: str
    words: str


def missing_of(project: Project) -> Missing | None:
    """What there must be before a question can be answered; None where all is there."""
    if project.domain_folder is None:
        return Missing("There is no domain yet: name classes and features.", "/begin", "Begin")
    if not project.has_model:
        first = "draw boxes" if project.has_things else "label pictures"
        return Missing(f"There is no model yet: {first} and train.", "/train", "Train")
    other = other_kind(project)
    if other is not None:
        return other
    if not project.pictures():
        return Missing("There is no picture yet: send some.", "/begin", "Begin")
    return None


def other_kind(project: Project) -> Missing | None:
    """That the model is not of the kind that the domain needs, or damaged; None where it is."""
    several = project.has_things
    try:
        if is_of_things(project.model_folder) == several:
            return None
    except ModelError as problem:
        return Missing(f"{problem}.", "/train", "Train")
    model, domain = ("one thing", "several") if several else ("several things", "one")
    sentence = f"The model is of {model} in a picture, and the domain has {domain}: train anew."
    return Missing(sentence, "/train", "Train")


def stamp_of(project: Project) -> tuple[int, ...]:
    """What is another where the model is another."""
    state = (project.model_folder / MANIFEST).stat()
    return state.st_mtime_ns, state.st_size, state.st_ino
