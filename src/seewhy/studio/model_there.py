"""Whether a project has a model to ask, of the kind that its domain needs, and which one."""

from __future__ import annotations

from dataclasses import dataclass

from seewhy.agent.manifest_file import MANIFEST, is_of_things
from seewhy.errors import ModelError
from seewhy.studio.project import Project

__all__ = ["Missing", "missing_of", "stamp_of"]


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
    several = project.has_things
    if not project.has_model:
        first = "draw boxes" if several else "label pictures"
        return Missing(f"There is no model yet: {first} and train.", "/train", "Train")
    try:
        of_things = is_of_things(project.model_folder)
    except ModelError as problem:
        return Missing(f"{problem}.", "/train", "Train")
    if of_things != several:
        model, domain = ("one thing", "several") if several else ("several things", "one")
        sentence = f"The model is of {model} in a picture, and the domain has {domain}: train anew."
        return Missing(sentence, "/train", "Train")
    if not project.pictures():
        return Missing("There is no picture yet: send some.", "/begin", "Begin")
    return None


def stamp_of(project: Project) -> tuple[int, ...]:
    """What is another where the model is another."""
    state = (project.model_folder / MANIFEST).stat()
    return state.st_mtime_ns, state.st_size, state.st_ino
