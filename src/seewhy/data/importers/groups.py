"""Which pictures belong together, by their file names."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from posixpath import basename

from seewhy.data.importers.annotation import AnnotatedPicture, Notes, readable
from seewhy.errors import DatasetError

_LONGEST_PATTERN = 200
_FEWEST_GROUPS = 5
SUGGESTED = "^(.+)[_-]"
"""The pattern that is proposed: what stands before the last _ or -."""

_NUMBERED = re.compile(r"(.+)[_-]\d+$")


def grouping(pattern: str | None, *, option: str = "--group ") -> re.Pattern[str] | None:
    """Return a user's expression as one that can be searched for.

    Parameters
    ----------
    pattern : str or None
    option : str
        What problems call it, with a blank behind it.

    Raises
    ------
    DatasetError
        If it is no regular expression.
    """
    if pattern is None:
        return None
    if len(pattern) > _LONGEST_PATTERN:
        raise DatasetError(
            f"{option}has {len(pattern)} characters, at most {_LONGEST_PATTERN} are read"
        )
    try:
        return re.compile(pattern)
    except re.error as problem:
        raise DatasetError(
            f"{option}'{pattern}': is no regular expression ({problem}); '^(.+)_' names what "
            "stands before the last _"
        ) from None


def grouped(
    pictures: Sequence[AnnotatedPicture], pattern: re.Pattern[str] | None, notes: Notes
) -> list[AnnotatedPicture]:
    """Return pictures with the groups that a pattern finds in their file names.

    Its first group (or all of it) names the group. Where there is no pattern, and file names look
    as if they told which pictures belong together, that is noted.

    Raises
    ------
    DatasetError
        If it is found in no name.

    Examples
    --------
    >>> shown = [AnnotatedPicture("a/7_1.jpg"), AnnotatedPicture("b/7_2.jpg")]
    >>> [picture.group for picture in grouped(shown, grouping("^(.+)_"), Notes())]
    ['7', '7']
    """
    if pattern is None:
        _suggest_groups(pictures, notes)
        return list(pictures)
    ungrouped = f"pictures whose name has no '{pattern.pattern}', each a group of its own"
    found_groups = []
    for picture in pictures:
        group = group_of(picture.file, pattern)
        if not group:
            notes.add(ungrouped, picture.file)
        found_groups.append(replace(picture, group=group or picture.group))
    if pictures and not any(picture.group for picture in found_groups):
        raise DatasetError(
            f"--group '{pattern.pattern}': is found in no file name, the first is "
            f"'{basename(pictures[0].file)}'; correct the expression"
        )
    return found_groups


def group_of(file: str, pattern: re.Pattern[str]) -> str:
    """Return the group that a pattern finds in a file's name; empty where it finds none.

    Examples
    --------
    >>> group_of("a/7_1.jpg", re.compile("^(.+)_")), group_of("a/7.jpg", re.compile("^(.+)_"))
    ('7', '')
    """
    found = pattern.search(basename(file))
    if found is None:
        return ""
    return readable((found.group(1) if found.groups() else found.group()) or "")


def suggested_groups(pictures: Iterable[tuple[str, str]]) -> int:
    """How many groups :data:`SUGGESTED` finds; 0 where names do not look as if they told any.

    Parameters
    ----------
    pictures : iterable of (str, str)
        The file of a picture, and its class. Groups that show one class each are none.

    Examples
    --------
    >>> suggested_groups((f"{person}_{n}.jpg", str(n)) for person in range(5) for n in range(3))
    5
    >>> suggested_groups((f"{kind}_{n}.jpg", kind) for kind in "abcde" for n in range(3))
    0
    """
    found: dict[str, set[str]] = {}
    count = numbered = 0
    for file, class_name in pictures:
        count += 1
        match = _NUMBERED.fullmatch(basename(file).rpartition(".")[0])
        if match is not None:
            numbered += 1
            found.setdefault(match.group(1), set()).add(class_name)
    over_classes = sum(len(classes) > 1 for classes in found.values())
    likely = (
        numbered >= 0.8 * count
        and len(found) >= _FEWEST_GROUPS
        and numbered >= 2 * len(found)
        and 2 * over_classes >= len(found)
    )
    return len(found) if likely else 0


def _suggest_groups(pictures: Sequence[AnnotatedPicture], notes: Notes) -> None:
    """Say so where file names look as if they told which pictures belong together."""
    if any(picture.group for picture in pictures):
        return
    count = suggested_groups((picture.file, picture.class_name) for picture in pictures)
    if count:
        notes.add(
            f"file names such as {basename(pictures[0].file)} may say which pictures belong "
            f"together: --group '{SUGGESTED}' would make {count:,} groups of them, which are "
            "kept together when pictures are divided"
        )
