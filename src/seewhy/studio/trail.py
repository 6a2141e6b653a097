"""Which pictures a browser was shown, so that "previous" and "next" lead where one expects."""

from __future__ import annotations

from collections.abc import Iterable

__all__ = ["Trail"]


class Trail:
    """The pictures that one browser was shown, in their order, and where it stands.

    Examples
    --------
    >>> trail = Trail()
    >>> [trail.go_on(["a", "b", "c"]), trail.go_on(["a", "b", "c"]), trail.go_back()]
    ['a', 'b', 'a']
    >>> trail.go_on(["c"])
    'b'
    """

    def __init__(self) -> None:
        self._shown: list[str] = []
        self._at = -1

    @property
    def here(self) -> str | None:
        """The picture at which the browser stands."""
        return self._shown[self._at] if self._shown else None

    def visit(self, picture: str) -> None:
        """Stand at a picture, behind which what was shown before is forgotten."""
        if self.here != picture:
            self._shown = [*self._shown[: self._at + 1], picture]
            self._at = len(self._shown) - 1

    def go_on(self, order: Iterable[str]) -> str | None:
        """Go to the next picture: what was shown after this one, else the first new one."""
        if self._at + 1 < len(self._shown):
            self._at += 1
            return self.here
        shown = set(self._shown)
        new = next((picture for picture in order if picture not in shown), None)
        if new is not None:
            self.visit(new)
        return new

    def go_back(self) -> str | None:
        """Go to the picture shown before this one; stay where there is none."""
        self._at = max(self._at - 1, 0) if self._shown else -1
        return self.here
