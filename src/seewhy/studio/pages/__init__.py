"""The pages of the studio, in the order of the navigation; a module and a template each."""

from __future__ import annotations

from seewhy.studio.pages import ask, begin, evaluate, label, robot, rules, share, train
from seewhy.studio.pages.page import Page

__all__ = ["PAGES", "Page"]

PAGES: tuple[Page, ...] = (
    begin.PAGE,
    label.PAGE,
    rules.PAGE,
    train.PAGE,
    evaluate.PAGE,
    ask.PAGE,
    robot.PAGE,
    share.PAGE,
)
