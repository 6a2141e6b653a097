"""The laboratory, which makes the pictures of bundled domains; it is installed by itself."""

from __future__ import annotations

from importlib.util import find_spec

__all__ = ["LABORATORY", "not_there", "of_laboratory", "without_module"]

LABORATORY = "seewhy_lab"
"""Its package. It adds commands of its own to `seewhy` where it is there."""


def of_laboratory(source: str | None) -> bool:
    """Return whether a domain's source of pictures is a module of the laboratory.

    Examples
    --------
    >>> of_laboratory("seewhy_lab.simulators.traffic_signs.source"), of_laboratory("pictures.py")
    (True, False)
    """
    return source is not None and source.partition(".")[0] == LABORATORY


def not_there(source: str | None) -> str | None:
    """Return why a source cannot be loaded without the laboratory, and how to get that.

    None where the source is none of the laboratory's, or the laboratory is there.

    Examples
    --------
    >>> not_there("pictures.py") is None
    True
    """
    if not of_laboratory(source) or find_spec(LABORATORY) is not None:
        return None
    return (
        f"the pictures of this domain are made by the laboratory ({LABORATORY}), which is not "
        "installed; it comes with the source code of SeeWhy: 'pip install . ./lab' in a checkout"
    )


def without_module(problem: ModuleNotFoundError) -> str:
    """Return which module of others the laboratory lacks, and how to get it.

    Examples
    --------
    >>> without_module(ModuleNotFoundError("no mujoco", name="mujoco"))
    ... # doctest: +NORMALIZE_WHITESPACE
    "the pictures of this domain are made by the laboratory, which needs the module 'mujoco', and
    that is not installed; install it with pip install 'seewhy[lab]'"
    """
    return (
        "the pictures of this domain are made by the laboratory, which needs the module "
        f"'{problem.name}', and that is not installed; install it with pip install 'seewhy[lab]'"
    )
