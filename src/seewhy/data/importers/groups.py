"""Which pictures belong together, by their file names."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from posixpath import basename

from seewhy.data.importers.annotation import AnnotatedPicture, Notes, readable
from seewhy.errors import DatasetError

_LONGEST_PATTERN = 200
_FEWEST_GROUPS = 5
_NUMBERED = re.compile(r"(.+)[_-]\d+$")


def grouping(pattern: str | None) -> re.Pattern[str] | None:
    """Return a user's expression as one that can be searched for.

    Raises
    ------
    DatasetError
        If it is no regular expression.
    """
    if pattern is None:
        return None
    if len(pattern) > _LONGEST_PATTERN:
        raise DatasetError(
            f"--group has {len(pattern)} characters, at most {_LONGEST_PATTERN} are read"
        )
    try:
        return re.compile(pattern)
    except re.error as problem:
        raise DatasetError(
            f"--group '{pattern}': is no regular expression ({problem}); '^(.+)_' names what "
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
        found = pattern.search(basename(picture.file))
        group = "" if found is None else (found.group(1) if found.groups() else found.group()) or ""
        if not group:
            notes.add(ungrouped, picture.file)
        found_groups.append(replace(picture, group=readable(group) or picture.group))
    if pictures and not any(picture.group for picture in found_groups):
        raise DatasetError(
            f"--group '{pattern.pattern}': is found in no file name, the first is "
            f"'{basename(pictures[0].file)}'; correct the expression"
        )
    return found_groups


def _suggest_groups(pictures: Sequence[AnnotatedPicture], notes: Notes) -> None:
    """Say so where file names look as if they told which pictures belong together."""
    if any(picture.group for picture in pictures):
        return
    found: dict[str, set[str]] = {}
    count = 0
    for picture in pictures:
        stem = basename(picture.file).rpartition(".")[0]
        match = _NUMBERED.fullmatch(stem)
        if match is not None:
            count += 1
            found.setdefault(match.group(1), set()).add(picture.class_name)
    over_classes = sum(len(classes) > 1 for classes in found.values())
    if (
        count >= 0.8 * len(pictures)
        and len(found) >= _FEWEST_GROUPS
        and count >= 2 * len(found)
        and 2 * over_classes >= len(found)
    ):
        notes.add(
            f"file names such as {basename(pictures[0].file)} may say which pictures belong "
            f"together: --group '^(.+)[_-]' would make {len(found):,} groups of them, which are "
            "kept together when pictures are divided"
        )
