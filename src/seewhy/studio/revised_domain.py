"""A domain as its folder would say it with other texts in its files."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.folder import FILES
from seewhy.errors import DomainError, KnowledgeError

__all__ = ["revised_domain"]


def revised_domain(folder: Path, texts: Mapping[str, str]) -> Domain:
    """Read a domain with some files' texts instead of what stands in them.

    Nothing of the folder is changed.

    Raises
    ------
    DomainError, KnowledgeError
        As :func:`~seewhy.domain.domain.load_domain`; places are named from the folder.

    Examples
    --------
    >>> folder = load_domain("structure_stability").folder
    >>> revised_domain(folder, {"knowledge.al": "stable(S) if lean(S)."})
    Traceback (most recent call last):
    seewhy.errors.KnowledgeError: knowledge.al:1:1: ...
    """
    with tempfile.TemporaryDirectory(prefix="seewhy-checked-") as staged:
        place = Path(staged) / folder.name
        place.mkdir()
        for name in FILES:
            text = texts.get(name)
            content = (folder / name).read_bytes() if text is None else text.encode()
            (place / name).write_bytes(content)
        try:
            return replace(load_domain(place), folder=folder)
        except (DomainError, KnowledgeError) as problem:
            said = str(problem).replace(f"{place}/", "").replace(str(place), folder.name)
            raise type(problem)(said) from None
