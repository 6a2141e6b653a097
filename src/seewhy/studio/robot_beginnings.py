"""What a robot's run begins with: its domain, the things of a scene, and what was done before."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from seewhy.data.importers.clevr import read_scenes
from seewhy.domain.domain import load_domain
from seewhy.errors import SeeWhyError
from seewhy.files.whole_files import write_whole
from seewhy.knowledge.history import History
from seewhy.planning.domain import PlanningDomain, load_planning_domain, planning_folder
from seewhy.planning.things.scene_file import chosen_scene
from seewhy.studio.project import Project

__all__ = ["LARGEST", "Beginning", "keep_file", "scenes_kept"]

LARGEST = 5_000_000
"""Bytes of a scene file, or of a history."""

_FOLDER = ".robot"
_MOST_LISTED = 60


@dataclass(frozen=True)
class Beginning:
    """What a run begins with.

    Attributes
    ----------
    domain : str
        A bundled domain, or a folder.
    scene : str
        A file of scenes, and with ``#NUMBER`` behind it which of them; empty: the domain's own.
    history : str
        A file of what was seen and done so far; empty: the domain's own.
    """

    domain: str
    scene: str = ""
    history: str = ""

    @classmethod
    def of(cls, asked: Mapping[str, Any]) -> Beginning:
        """What a job was asked to begin with."""
        return cls(asked["domain"], asked.get("scene", ""), asked.get("history", ""))

    def load(self) -> PlanningDomain:
        """The domain with these things.

        Raises
        ------
        SeeWhyError
            If the domain or the scene is wrong, or the domain has no things.
        """
        if not self.scene:
            return load_planning_domain(self.domain)
        file, _, number = self.scene.partition("#")
        scene = chosen_scene(planning_folder(self.domain), Path(file), number or None)
        return load_planning_domain(self.domain, scene=scene)

    def past(self, domain: PlanningDomain) -> History:
        """What was seen and done so far.

        Raises
        ------
        KnowledgeError
            If the file is wrong.
        """
        return domain.history_of(Path(self.history)) if self.history else domain.history


def keep_file(project: Project, name: str, content: IO[bytes]) -> Path:
    """Keep a file that a browser sent, so that runs can begin with it again.

    Raises
    ------
    SeeWhyError
        If it is too large, or neither a scene file nor a history by its name.
    """
    ending = Path(name).suffix.lower()
    if ending not in (".json", ".al"):
        raise SeeWhyError(
            f"'{name[:80]}' is neither a scene (.json) nor a history (.al), by its name"
        )
    text = content.read(LARGEST + 1)
    if len(text) > LARGEST:
        raise SeeWhyError(f"'{name[:80]}' has more than {LARGEST:,} bytes; send fewer scenes")
    stem = re.sub(r"[^\w-]+", "_", Path(name.replace("\\", "/")).stem)[:60] or "file"
    digest = hashlib.sha256(text).hexdigest()[:10]
    folder = _folder(project)
    folder.mkdir(exist_ok=True)
    file = folder / f"{stem}-{digest}{ending}"
    write_whole(file, text)
    return file


def scenes_kept(project: Project, domain: str) -> dict[str, str]:
    """The scenes that runs in a domain may begin with, of files that were sent: value → words."""
    folder = planning_folder(domain)
    things = load_domain(folder).things if (folder / "domain.toml").is_file() else None
    if things is None:
        return {}
    found: dict[str, str] = {}
    for file in sorted(_folder(project).glob("*.json")):
        try:
            numbers = read_scenes(file, things)
        except SeeWhyError:
            continue  # of another domain
        name = file.stem.rpartition("-")[0]
        found |= {f"{file}#{number}": f"{name}, scene {number}" for number in numbers}
    return dict(list(found.items())[:_MOST_LISTED])


def _folder(project: Project) -> Path:
    """Where files are kept; whole, because a run's process works in another folder."""
    return project.folder.resolve() / _FOLDER
