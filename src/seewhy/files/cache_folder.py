"""The folder for what can be made again and is kept only because that takes time."""

from __future__ import annotations

import os
from pathlib import Path

__all__ = ["FOLDER", "cache_folder"]

FOLDER = "SEEWHY_CACHE"
"""The environment variable that names the folder; empty: nothing is kept."""


def cache_folder() -> Path | None:
    """Where it lies: ``$SEEWHY_CACHE``, else the user's folder for caches.

    None where the variable is set to nothing.
    """
    from platformdirs import user_cache_path

    chosen = os.environ.get(FOLDER)
    if chosen is not None:
        return Path(chosen) if chosen else None
    return user_cache_path("seewhy", appauthor=False)
