"""Who runs the code of a domain is told so."""

from __future__ import annotations

from seewhy.cli.screen import remark
from seewhy.domain.domain import Domain

__all__ = ["remark_code"]


def remark_code(domain: Domain) -> None:
    """Say that a program of the domain's folder is about to be run, if it has one."""
    from seewhy.data.picture_source import code_notice

    notice = code_notice(domain)
    if notice is not None:
        remark(notice)
