"""Where in a domain's files something stands, for errors."""

from __future__ import annotations

from pathlib import Path

from seewhy.files.toml_file import line_of


class Place:
    """Finds the line of a key in domain.toml when an error needs it."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def at(self, *keys: str) -> str:
        return f"{self.path}:{line_of(self.path.read_text(encoding='utf-8-sig'), keys)}"
