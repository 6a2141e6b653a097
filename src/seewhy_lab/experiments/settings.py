"""What the trials in a folder depend on, kept beside them: trials of other settings never mix."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from seewhy.errors import ExperimentError
from seewhy.files.whole_files import write_whole

__all__ = ["SETTINGS", "check_settings", "digest", "require_settings"]

SETTINGS = "settings.json"


def check_settings(folder: Path, settings: Mapping[str, Any]) -> None:
    """Keep the settings of the trials in a folder, or refuse a folder that has others.

    Raises
    ------
    ExperimentError
        The text names what differs.

    Examples
    --------
    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> check_settings(folder, {"tested": 10})
    >>> check_settings(folder, {"tested": 20})  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ...
    seewhy.errors.ExperimentError: ...: holds trials with other settings (tested); choose ...
    """
    require_settings(folder, settings)
    if not (folder / SETTINGS).exists():
        write_whole(folder / SETTINGS, json.dumps(settings, indent=1))


def require_settings(folder: Path, settings: Mapping[str, Any]) -> None:
    """Refuse a folder that has other settings, as :func:`check_settings` does; keep none."""
    file = folder / SETTINGS
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
        wrong = [key for key, value in settings.items() if found.get(key) != value]
    except FileNotFoundError:
        return
    except NotADirectoryError:
        raise ExperimentError(
            f"{folder}: is a file, or lies in one; choose a folder for the results with --out"
        ) from None
    except (ValueError, AttributeError, RecursionError):
        raise ExperimentError(
            f"{file}: is not as it was written; choose another folder with --out, or delete this "
            "one"
        ) from None
    if wrong:
        raise ExperimentError(
            f"{folder}: holds trials with other settings ({', '.join(wrong)}); choose another "
            "folder with --out, or delete this one"
        )


def digest(*files: Path) -> str:
    """Return a short digest of the contents of files."""
    return hashlib.sha256(b"\0".join(file.read_bytes() for file in files)).hexdigest()[:16]
