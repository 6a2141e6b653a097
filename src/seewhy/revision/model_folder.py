"""A model's folder, with the files of its domain revised."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from seewhy.agent.manifest_file import MANIFEST
from seewhy.domain.folder import FILES
from seewhy.errors import DomainError
from seewhy.revision.edit import KNOWLEDGE

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent

__all__ = ["folder_of_domain", "save_revised"]


def folder_of_domain(folder: Path) -> Path:
    """Return where knowledge.al lies in a model's folder or a domain's.

    Raises
    ------
    DomainError
        If the folder is neither.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> folder_of_domain(load_domain("structure_stability").folder).name
    'structure_stability'
    """
    found = folder / "domain" if (folder / MANIFEST).is_file() else folder
    if not (found / KNOWLEDGE).is_file():
        raise DomainError(
            f"{folder}: is neither a model nor a domain folder; give the folder that 'seewhy "
            "train --out' wrote, or one with knowledge.al"
        )
    return found


def save_revised(agent: Agent, folder: Path, files: Mapping[str, str]) -> None:
    """Save a model whole, with these texts among the files of its domain.

    Raises
    ------
    NotFittedError, ModelError
        As :meth:`seewhy.Agent.save`.

    Examples
    --------
    >>> from seewhy.agent.agent import Agent
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> save_revised(Agent(domain), domain.folder.parent, {})  # doctest: +IGNORE_EXCEPTION_DETAIL
    Traceback (most recent call last):
    FileNotFoundError: ...
    """
    given = agent.given
    with tempfile.TemporaryDirectory(prefix="seewhy-revision-") as staged:
        for name in FILES:
            shutil.copyfile(folder / "domain" / name, Path(staged) / name)
        for name, text in files.items():
            (Path(staged) / name).write_bytes(text.encode())
        agent.known = replace(agent.known, given=replace(given, folder=Path(staged)))
        try:
            agent.save(folder)
        finally:
            agent.known = replace(agent.known, given=given)
