"""What somebody changed in a text, as edits that can be taken back one by one."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import SequenceMatcher

from seewhy.revision.edit import Edit, FileName, edited, newline_of

__all__ = ["edits_between"]


def edits_between(file: FileName, old: str, new: str) -> tuple[Edit, ...]:
    r"""Return the edits that make one text of another, a passage of whole lines each.

    The lines of the new text end as those of the old one.

    Examples
    --------
    >>> edits_between("knowledge.al", "a.\nb.\nc.\n", "a.\nb.\nd.\nc.\n")
    (Edit(file='knowledge.al', at=3, before='b.\n', after='b.\nd.\n'),)
    """
    new = "\n".join(new.replace("\r\n", "\n").split("\n")).replace("\n", newline_of(old))
    if old == new:
        return ()
    found = tuple(_passages(file, old, new))
    if all(edit.before for edit in found) and edited({file: old}, found)[file] == new:
        return found
    return (Edit(file, 0, old, new),)


def _passages(file: FileName, old: str, new: str) -> Iterator[Edit]:
    """A passage for each change, with a line beside it, so that it is found again."""
    lines, others = old.splitlines(keepends=True), new.splitlines(keepends=True)
    moved = 0
    matcher = SequenceMatcher(None, lines, others, autojunk=False)
    for what, first, last, other_first, other_last in matcher.get_opcodes():
        if what == "equal":
            continue
        above, below = (1, 0) if first > 0 else (0, 1)
        kept_above, kept_below = lines[first - above : first], lines[last : last + below]
        before = "".join([*kept_above, *lines[first:last], *kept_below])
        after = "".join([*kept_above, *others[other_first:other_last], *kept_below])
        yield Edit(file, len("".join(lines[: first - above])) + moved, before, after)
        moved += len(after) - len(before)
