"""Write a domain folder from the template that comes with SeeWhy."""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib import resources
from pathlib import Path

from seewhy.errors import DomainError
from seewhy.files.folders import whole_folder
from seewhy.new_domain.common_keys import with_common_keys

_PLACEHOLDER = "my_domain"


def write_new_domain(folder: Path) -> Path:
    """Write a working domain to ``folder``, whole or not at all.

    Raises
    ------
    DomainError
        If the folder exists, or its name cannot be a domain's.
    """
    check_new_folder(folder)
    texts = {
        file.name: with_common_keys(
            file.read_text(encoding="utf-8").replace(_PLACEHOLDER, folder.name)
        )
        for file in resources.files("seewhy.new_domain").joinpath("template").iterdir()
    }
    with whole_folder(folder) as temporary:
        write_texts(temporary, texts)
    return folder


def check_new_folder(folder: Path) -> None:
    """Raise a DomainError if the folder exists, or its name cannot be a domain's."""
    if not re.fullmatch(r"[a-z][a-z0-9_]*", folder.name):
        raise DomainError(
            f"'{folder.name}' cannot name a domain; use small letters, digits and underscores, "
            "beginning with a letter"
        )
    if folder.exists():
        raise DomainError(f"{folder}: exists already; choose another name")


def write_texts(folder: Path, texts: Mapping[str, str]) -> None:
    """Write files of these names and texts."""
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
