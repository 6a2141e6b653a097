"""The module that makes a domain's pictures: named by domain.toml, loaded when it is needed."""

from __future__ import annotations

import ast
import importlib
import importlib.util
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from importlib.machinery import ModuleSpec
from pathlib import Path
from typing import Any, Protocol, TypeGuard

from seewhy.data.laboratory import LABORATORY, not_there, of_laboratory, without_module
from seewhy.data.made_picture import Annotation, annotation_of
from seewhy.domain.domain import Domain
from seewhy.errors import DomainError


class Draw(Protocol):
    """Makes one picture: uint8 of shape (height, width, 3), its feature values, its class.

    Where the domain has things, they and their relations follow, as in
    :class:`seewhy.data.made_picture.Annotation`. The longer side is ``size``. The picture must
    depend on the arguments only.
    """

    def __call__(self, *, seed: int, index: int, size: int) -> tuple[Any, ...]: ...


class Depict(Protocol):
    """Makes a picture that shows given feature values: uint8 of shape (height, width, 3).

    The longer side is ``size``. The picture must depend on the arguments only.
    """

    def __call__(self, features: Mapping[str, str], *, seed: int, size: int) -> Any: ...


def load_source(domain: Domain) -> Draw:
    """Return the function ``draw`` of a domain's source.

    ``source`` in domain.toml is a file of the domain's folder such as "pictures.py"; in domains
    that come with SeeWhy, one of its modules.

    Raises
    ------
    DomainError
        If the domain names no source, or it cannot be loaded.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> picture, features, label = load_source(load_domain("structure_stability"))(
    ...     seed=0, index=0, size=32)
    >>> picture.shape
    (32, 32, 3)
    """
    return load_draw(_named_source(domain), domain.folder)


def code_notice(domain: Domain) -> str | None:
    """Return the sentence for who is about to run a domain's code; None where it is our own.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> code_notice(load_domain("structure_stability")) is None
    True
    """
    if domain.source is None or not domain.source.endswith(".py"):
        return None
    return (
        f"{domain.folder / domain.source} is a program, which now runs with your rights; run only "
        "those of people whom you trust"
    )


def check_source(domain: Domain) -> None:
    """Raise a DomainError if a domain's source is not there, or has no function ``draw``.

    Nothing of it is run, so that a stranger's domain can be checked.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> check_source(load_domain("structure_stability"))
    """
    source, folder = _named_source(domain), domain.folder
    if missing := not_there(source):
        raise DomainError(f"{folder / 'domain.toml'}: {missing}")
    file = folder / source if source.endswith(".py") else _file_of_module(source)
    problem = "there is no such module" if file is None else _lacks_draw(file)
    if problem:
        raise DomainError(_no_source(source, folder, "draw(seed=, index=, size=)", problem))


def _file_of_module(name: str) -> Path | None:
    """The file of a module, which is found without importing what it belongs to."""
    spec: ModuleSpec | None = None
    within: Sequence[str] | None = None
    parts = name.split(".")
    for depth in range(len(parts)):
        called = ".".join(parts[: depth + 1])
        finders = (getattr(finder, "find_spec", None) for finder in sys.meta_path)
        found = (find(called, within) for find in finders if find is not None)
        spec = next((place for place in found if place is not None), None)
        within = None if spec is None else spec.submodule_search_locations
        if spec is None or (within is None and depth + 1 < len(parts)):
            return None
    return None if spec is None or spec.origin is None else Path(spec.origin)


def _lacks_draw(file: Path) -> str:
    """What is wrong with the text of a source; empty where nothing is."""
    if file.suffix != ".py":
        return ""  # what is compiled shows its functions when it is loaded
    try:
        names = set(_defined(ast.parse(file.read_bytes()).body))
    except OSError as problem:
        return str(problem.strerror)
    except SyntaxError as problem:
        return f"line {problem.lineno}: {problem.msg}"
    except (ValueError, RecursionError) as problem:
        return str(problem)
    return "" if names & {"draw", "*", "__getattr__"} else "it has no function draw"


def _defined(nodes: Iterable[ast.AST]) -> Iterator[str]:
    """The names that statements define in their module; "*" for all of another one."""
    for node in nodes:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.Import | ast.ImportFrom):
            yield from (alias.asname or alias.name for alias in node.names)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        else:
            yield from _defined(ast.iter_child_nodes(node))


def load_depict(domain: Domain) -> Depict:
    """Return the function ``depict`` of a domain's source, which shows what it is told.

    Raises
    ------
    DomainError
        If the domain names no source, or it cannot be loaded, or has no such function.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
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
            f"a scenes.csv, or name a file with a function draw as 'source' in "
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
    if missing := not_there(source):
        raise DomainError(f"{folder / 'domain.toml'}: {missing}")
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
        if _lacks_library(problem, source):
            raise DomainError(f"{folder / 'domain.toml'}: {without_module(problem)}") from problem
        why = f"{type(problem).__name__}: {problem}"
        raise DomainError(_no_source(source, folder, wanted, why)) from problem


def _lacks_library(problem: Exception, source: str) -> TypeGuard[ModuleNotFoundError]:
    """Whether the laboratory is there, and something that it imports is not."""
    if not of_laboratory(source) or not isinstance(problem, ModuleNotFoundError):
        return False
    return str(problem.name).partition(".")[0] not in ("seewhy", LABORATORY)


def _no_source(source: str, folder: Path, wanted: str, why: str) -> str:
    return (
        f"{folder / 'domain.toml'}: source = '{source}' must be a file of this folder that has a "
        f"function {wanted} ({why})"
    )


def draw_picture(
    source: str, folder: Path, *, seed: int, index: int, size: int
) -> tuple[Any, Annotation]:
    """Make one picture.

    Raises
    ------
    DomainError
        If the source fails; the text names the picture.
    """
    try:
        picture, *said = load_draw(source, folder)(seed=seed, index=index, size=size)
        return picture, annotation_of(*said)
    except DomainError:
        raise
    except Exception as problem:
        raise DomainError(
            f"{folder / 'domain.toml'}: the source '{source}' fails at draw(seed={seed}, "
            f"index={index}, size={size}): {type(problem).__name__}: {problem}"
        ) from problem
