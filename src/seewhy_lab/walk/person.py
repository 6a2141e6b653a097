"""Somebody at a browser: what is clicked, pressed and typed is counted, and the time for it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Page

__all__ = ["Effort", "Person", "Step"]

SECONDS_A_CLICK = 3.0
SECONDS_A_CHARACTER = 0.3
SECONDS_CONFIRMED, SECONDS_CHANGED = 2.0, 4.0
"""Estimates of what it takes a person, not measured: to look at a picture and find what is proposed
right, or to say what it shows instead."""


@dataclass
class Effort:
    """What somebody did."""

    clicks: int = 0
    keys: int = 0
    characters: int = 0
    confirmed: int = 0
    changed: int = 0

    @property
    def seconds(self) -> float:
        """The estimate of a person's time."""
        return (
            SECONDS_A_CLICK * self.clicks
            + SECONDS_A_CHARACTER * self.characters
            + SECONDS_CONFIRMED * self.confirmed
            + SECONDS_CHANGED * self.changed
        )


@dataclass
class Step:
    """A part of the walk.

    Attributes
    ----------
    what : str
    effort : Effort
    machine : float
        Seconds that it took in this walk, in which nobody thinks or looks: what the pages, and
        where there is one a job, need.
    """

    what: str
    effort: Effort = field(default_factory=Effort)
    machine: float = 0.0


class Person:
    """Uses a page by mouse and keys, and counts.

    Parameters
    ----------
    page : playwright.sync_api.Page
    """

    def __init__(self, page: Page) -> None:
        self.page = page
        self.steps: list[Step] = []

    @property
    def effort(self) -> Effort:
        """Of the step at hand."""
        return self.steps[-1].effort

    @contextmanager
    def step(self, what: str) -> Iterator[Step]:
        """Count what is done from here on to a step of its own."""
        self.steps.append(Step(what))
        began = time.monotonic()
        yield self.steps[-1]
        self.steps[-1].machine = time.monotonic() - began

    def click(self, selector: str) -> None:
        """Click what is first there."""
        self.page.locator(selector).first.click()
        self.effort.clicks += 1

    def choose(self, selector: str, value: str) -> None:
        """Choose from a list: two clicks."""
        self.page.locator(selector).first.select_option(value)
        self.effort.clicks += 2

    def write(self, selector: str, text: str, *, pasted: bool = False) -> None:
        """Go to a field and write into it; what is pasted is two keys."""
        self.page.fill(selector, text)
        self.effort.clicks += 1
        if pasted:
            self.effort.keys += 2
        else:
            self.effort.characters += len(text)

    def press(self, key: str) -> None:
        """Press a key."""
        self.page.keyboard.press(key)
        self.effort.keys += 1
