"""A short name for what a picture file holds."""

from __future__ import annotations

import hashlib
from pathlib import Path

__all__ = ["digest_of"]


def digest_of(picture: Path) -> str:
    """Return the first 16 digits of the SHA-256 of a file.

    Examples
    --------
    >>> import tempfile
    >>> file = Path(tempfile.mkdtemp()) / "a.png"
    >>> _ = file.write_bytes(b"a")
    >>> digest_of(file)
    'ca978112ca1bbdca'
    """
    with picture.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()[:16]
