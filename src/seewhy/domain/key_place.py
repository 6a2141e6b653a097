"""Where a key stands in domain.toml."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from seewhy.files.toml_file import line_of


@dataclass(frozen=True)
class KeyPlace:
    """Finds the line of a key in domain.toml when an error needs it."""

    path: Path

    def at(self, *keys: str) -> str:
        """Return file and line, as ``domain.toml:7``; the file is read anew for it."""
        return f"{self.path}:{line_of(self.path.read_text(encoding='utf-8-sig'), keys)}"
