"""Open what there is already: a domain, a model or a dataset is copied into the project."""

from __future__ import annotations

import shutil
from pathlib import Path

from seewhy.agent.model import read_model
from seewhy.data.importers import ImportRequest
from seewhy.domain.domain import load_domain
from seewhy.errors import SeeWhyError
from seewhy.files.folders import whole_folder
from seewhy.studio.incoming import from_source
from seewhy.studio.project import Project

__all__ = ["open_folder"]

_DOMAIN_FILE = "domain.toml"
_MODEL_FILE = "model.json"
_LARGEST = 4_000_000
"""Bytes of a file of a domain; larger ones, links and folders are left where they are."""


def open_folder(project: Project, place: Path, *, who: str) -> None:
    """Copy a domain or a model into the project, or import a dataset; the original stays as it is.

    Raises
    ------
    SeeWhyError
        If the folder is none of these, is damaged, or the project has such a thing already.
    """
    if (place / _MODEL_FILE).is_file():
        _open_model(project, place)
    elif (place / _DOMAIN_FILE).is_file():
        load_domain(place)
        _copy_domain(project, place)
        project.refresh()
    elif not place.exists():
        raise SeeWhyError(f"{place}: there is no such folder; check the spelling of the path")
    else:
        from_source(project, ImportRequest(place, ""), subject="the picture", who=who)


def _open_model(project: Project, place: Path) -> None:
    if project.has_model:
        raise SeeWhyError(
            f"the project has a model already; open {place} in a new folder ('seewhy studio NEW')"
        )
    read_model(place)  # what is damaged or edited is refused before anything is copied
    with whole_folder(project.model_folder) as temporary:
        shutil.copytree(place, temporary, dirs_exist_ok=True)
    if project.domain_folder is None:
        _copy_domain(project, place / "domain")
    project.refresh()


def _copy_domain(project: Project, place: Path) -> None:
    if project.domain_folder is not None:
        raise SeeWhyError(
            f"the project has a domain already; open {place} in a new folder ('seewhy studio NEW')"
        )
    name = load_domain(place).name
    target = project.folder / name
    with whole_folder(target) as temporary:
        for file in place.iterdir():
            plain = file.is_file() and not file.is_symlink()
            if plain and file.stat().st_size <= _LARGEST:
                shutil.copyfile(file, temporary / file.name)
