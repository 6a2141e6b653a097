"""Names of files that mean something in a source: passed over, refused, or left by an import."""

from __future__ import annotations

RECORD = "imported.json"
"""What an import leaves in the dataset folder that it writes."""

_LITTER = frozenset({"__macosx", "thumbs.db", "desktop.ini", "$recycle.bin"})


def is_litter(name: str) -> bool:
    """Whether a file or folder is hidden, or one that a system leaves behind.

    Examples
    --------
    >>> is_litter("Thumbs.db"), is_litter("first.jpg")
    (True, False)
    """
    return name.startswith(".") or name.casefold() in _LITTER


def leads_out(name: str) -> bool:
    """Whether a name, with "/" between the folders, may be of a file outside of its source.

    Examples
    --------
    >>> leads_out("../first.jpg"), leads_out("cats/first.jpg")
    (True, False)
    """
    parts = name.split("/")
    return ".." in parts or parts[0] == "" or parts[0].endswith(":") or "\0" in name
