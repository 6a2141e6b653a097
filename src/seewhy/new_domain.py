"""Write a domain folder from the template that comes with SeeWhy."""

from __future__ import annotations

import re
import shutil
import tempfile
from importlib import resources
from pathlib import Path

from seewhy.errors import DomainError

_PLACEHOLDER = "my_domain"


def write_new_domain(folder: Path) -> Path:
    """Write a working domain to ``folder``, whole or not at all.

    Raises
    ------
    DomainError
        If the folder exists, or its name cannot be a domain's.
    """
    name = folder.name
    if not re.fullmatch(r"[a-z][a-z0-9_]*", name):
        raise DomainError(
            f"'{name}' cannot name a domain; use small letters, digits and underscores, beginning "
            "with a letter"
        )
    if folder.exists():
        raise DomainError(f"{folder}: exists already; choose another name")
    folder.parent.mkdir(parents=True, exist_ok=True)
    temporary = Path(tempfile.mkdtemp(prefix=f".{name}-", dir=folder.parent))
    try:
        temporary.chmod(0o755)
        for file in resources.files("seewhy").joinpath("template").iterdir():
            text = file.read_text(encoding="utf-8").replace(_PLACEHOLDER, name)
            (temporary / file.name).write_text(text, encoding="utf-8")
        temporary.rename(folder)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
    return folder
