"""The module that makes a domain's pictures: named by domain.toml, loaded when it is needed."""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any, Protocol

from seewhy.domain import Domain
from seewhy.errors import DomainError


class Draw(Protocol):
    """Makes one picture: uint8 of shape (height, width, 3), its feature values, its class.

    The longer side is ``size``. The picture must depend on the arguments only.
    """

    def __call__(
        self, *, seed: int, index: int, size: int
    ) -> tuple[Any, Mapping[str, str], str]: ...


class Depict(Protocol):
    """Makes a picture that shows given feature values: uint8 of shape (height, width, 3).

    The longer side is ``size``. The picture must depend on the arguments only.
    """

    def __call__(self, features: Mapping[str, str], *, seed: int, size: int) -> Any: ...


def load_source(domain: Domain) -> Draw:
    """Return the function ``draw`` of a domain's source.

    ``source`` in domain.toml is a module that can be imported, or a file of the domain's folder
    such as "pictures.py".

    Raises
    ------
    DomainError
        If the domain names no source, or it cannot be loaded.

    Examples
    --------
    >>> from seewhy.domain import load_domain
    >>> picture, features, label = load_source(load_domain("structure_stability"))(
    ...     seed=0, index=0, size=32)
    >>> picture.shape
    (32, 32, 3)
    """
    return load_draw(_named_source(domain), domain.folder)


def load_depict(domain: Domain) -> Depict:
    """Return the function ``depict`` of a domain's source, which shows what it is told.

    Raises
    ------
    DomainError
        If the domain names no source, or it cannot be loaded, or has no such function.

    Examples
    --------
    >>> from seewhy.domain import load_domain
    >>> depict = load_depict(load_domain("robot_assistant"))
    >>> depict({"desk": "yes", "sally": "yes"}, seed=0, size=32).shape
    (32, 32, 3)
    """
    depict: Depict = _load(_named_source(domain), domain.folder, "depict(features, seed=, size=)")
    return depict


def _named_source(domain: Domain) -> str:
    if domain.source is None:
        raise DomainError(
            f"the domain '{domain.name}' has no source of pictures; put your own pictures beside "
            f"a scenes.csv, or name a module with a function draw as 'source' in "
            f"{domain.folder / 'domain.toml'}"
        )
    return domain.source


def load_draw(source: str, folder: Path) -> Draw:
    """Return the function ``draw`` of a module, or of a file in ``folder``; see load_source."""
    draw: Draw = _load(source, folder, "draw(seed=, index=, size=)")
    return draw


@lru_cache(maxsize=8)
def _load(source: str, folder: Path, wanted: str) -> Any:
    """Return a function of a source; ``wanted`` is its name with its arguments."""
    try:
        if source.endswith(".py"):
            spec = importlib.util.spec_from_file_location(
                f"seewhy_source_{folder.name}", folder / source
            )
            if spec is None or spec.loader is None:
                raise ImportError(source)
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
        else:
            module = importlib.import_module(source)
        return getattr(module, wanted.partition("(")[0])
    except Exception as problem:
        raise DomainError(
            f"{folder / 'domain.toml'}: source = '{source}' must be a module that can be imported, "
            f"or a file of this folder, and have a function {wanted} "
            f"({type(problem).__name__}: {problem})"
        ) from problem


def draw_picture(
    source: str, folder: Path, *, seed: int, index: int, size: int
) -> tuple[Any, dict[str, str], str]:
    """Make one picture.

    Raises
    ------
    DomainError
        If the source fails; the text names the picture.
    """
    try:
        picture, features, label = load_draw(source, folder)(seed=seed, index=index, size=size)
        return picture, dict(features), label
    except DomainError:
        raise
    except Exception as problem:
        raise DomainError(
            f"{folder / 'domain.toml'}: the source '{source}' fails at draw(seed={seed}, "
            f"index={index}, size={size}): {type(problem).__name__}: {problem}"
        ) from problem
