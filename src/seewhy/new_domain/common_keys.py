"""Keys that are often wanted, as comments for the files of a new domain."""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Collection, Mapping

from seewhy.domain.tables import DomainFile
from seewhy.report.key_reference import table_references

__all__ = ["common_keys", "with_common_keys"]

_EXAMPLES: Mapping[str, Mapping[str, object]] = {
    "domain": {"eyes": "none", "reading": "consistent", "known_share": 0.95},
    "pictures": {"flip": True, "rotate": 15, "scale": 0.1, "fit": "stretch", "size": 96},
}
_MARK = re.compile(r"^#:(\w+)((?: \w+)*)$", re.MULTILINE)
_WIDTH = 96


def common_keys(table: str, *, without: Collection[str] = ()) -> list[str]:
    """Return the often wanted keys of a table of domain.toml as lines of comments.

    Each is described as in the reference, and followed by an example that does something once its
    ``# `` is removed.

    Parameters
    ----------
    table : {"domain", "pictures"}
    without : collection of str
        Keys that the file has already.

    Examples
    --------
    >>> print("\\n".join(common_keys("pictures", without={"flip", "scale", "fit", "size"})))
    # How far training pictures are turned at most, in degrees to either side.
    # rotate = 15
    """
    (described,) = [found for found in table_references(DomainFile) if found.header == f"[{table}]"]
    meanings = {key.name: key.meaning for key in described.keys}
    lines: list[str] = []
    for name, example in _EXAMPLES[table].items():
        if name not in without:
            lines += textwrap.wrap(
                meanings[name], _WIDTH, initial_indent="# ", subsequent_indent="# "
            )
            lines.append(f"# {name} = {json.dumps(example)}")
    return lines


def with_common_keys(text: str) -> str:
    """Return the text of a file with the lines ``#:TABLE KEYS…`` filled in.

    KEYS are those that the table has already.
    """
    return _MARK.sub(
        lambda mark: "\n".join(common_keys(mark.group(1), without=mark.group(2).split())), text
    )
