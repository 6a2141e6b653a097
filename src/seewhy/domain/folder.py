"""The folders of domains: bundled ones by name, those of users by path."""

from __future__ import annotations

from pathlib import Path

from seewhy.errors import DomainError
from seewhy.text.nearest import did_you_mean

FILES = ("domain.toml", "knowledge.al", "questions.toml")
"""What a domain's folder must have."""

REVISIONS = "revisions.jsonl"
"""What it may have beside: the record of how its knowledge was revised."""

_BUNDLED = Path(__file__).parents[1] / "domains"


def bundled_domains() -> tuple[str, ...]:
    """Return the names of the domains that come with SeeWhy.

    Examples
    --------
    >>> "structure_stability" in bundled_domains()
    True
    """
    return tuple(sorted(file.parent.name for file in _BUNDLED.glob("*/domain.toml")))


def domain_folder(name: str | Path) -> Path:
    """Return the folder of a bundled domain's name or of a path to a user's folder.

    Raises
    ------
    DomainError
        If there is neither; the text gives the nearest bundled name.
    """
    path = Path(name)
    if path.is_dir():
        return path
    if str(name) in bundled_domains():
        return _BUNDLED / str(name)
    raise DomainError(
        f"'{name}' is neither a folder nor a bundled domain; "
        f"{did_you_mean(str(name), bundled_domains())}"
    )


def is_bundled(folder: Path) -> bool:
    """Whether a domain's folder is one that comes with SeeWhy.

    Examples
    --------
    >>> is_bundled(domain_folder("tabletop")), is_bundled(Path("tabletop"))
    (True, False)
    """
    return folder.resolve().is_relative_to(_BUNDLED.resolve())
