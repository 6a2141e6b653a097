"""Labels pictures by keyboard, in the order of the studio, as somebody who knows."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from seewhy.domain.tables import CLASS
from seewhy_lab.walk.person import Person
from seewhy_lab.walk.truth import Truth

__all__ = ["Labelled", "label_until"]

# Exchanges of the workbench that answer somebody, not those that come by themselves.
_COUNT = """() => {
  const body = document.body;
  if (body.dataset.answered) return;
  body.dataset.answered = 0;
  document.addEventListener("htmx:afterSettle", (event) => {
    if (event.detail.pathInfo?.requestPath?.startsWith("/label/news")) return;
    body.dataset.answered = Number(body.dataset.answered) + 1;
  });
}"""

_BENCH = """() => {
  const bench = document.querySelector("#workbench");
  const questions = [...bench.querySelectorAll("fieldset.question")].map((question) => ({
    name: question.querySelector("button.choice").value.split("=")[0],
    letter: question.querySelector("legend a").dataset.key,
    here: question.classList.contains("here"),
    chosen: question.querySelector(".choice.chosen")?.value.split("=")[1] ?? null,
    proposed: question.querySelector(".choice.proposed")?.value.split("=")[1] ?? null,
    keys: Object.fromEntries([...question.querySelectorAll("button.choice[data-key]")].map(
      (choice) => [choice.value.split("=")[1], choice.dataset.key])),
  }));
  return {picture: bench.dataset.picture, questions};
}"""


@dataclass(frozen=True)
class Labelled:
    """What was said of a picture.

    Attributes
    ----------
    picture : str
    confirmed : bool
        Whether all that was proposed was right.
    keys : int
    """

    picture: str
    confirmed: bool
    keys: int


def label_until(
    person: Person, truth: Truth, *, count: int, done: int, pace: float
) -> list[Labelled]:
    """Label pictures on the page Label until there are ``count`` of them.

    Parameters
    ----------
    person : Person
        At the page Label.
    truth : Truth
    count, done : int
        Labels that there are to be, and that there are.
    pace : float
        Seconds that a picture takes at least, so that the heads have the time that a person gives
        them.
    """
    person.page.wait_for_load_state()
    person.page.evaluate(_COUNT)
    found: list[Labelled] = []
    while done + len(found) < count:
        began = time.monotonic()
        found.append(_one(person, truth))
        person.page.wait_for_timeout(1000 * max(0.0, pace - (time.monotonic() - began)))
    return found


def _one(person: Person, truth: Truth) -> Labelled:
    bench: Mapping[str, Any] = person.page.evaluate(_BENCH)
    picture, confirmed, keys = bench["picture"], True, 0
    known = truth.values[picture]
    while bench["picture"] == picture:
        open_ones = [each for each in bench["questions"] if each["chosen"] is None]
        wrong = [each for each in open_ones if each["proposed"] != known[each["name"]]]
        if not open_ones:
            key = "ArrowRight"
        elif not wrong:
            key = "Enter"
        else:
            confirmed = False
            # Where the features follow from the class, saying the class says them all.
            question = next((each for each in wrong if each["here"]), None)
            question = next(
                (each for each in open_ones if each["here"] and each["name"] == CLASS), question
            )
            if question is None:
                key = wrong[0]["letter"]
            else:
                key = question["keys"][known[question["name"]]]
        _press(person, key)
        keys += 1
        bench = person.page.evaluate(_BENCH)
    if confirmed:
        person.effort.confirmed += 1
    else:
        person.effort.changed += 1
    return Labelled(picture, confirmed, keys)


def _press(person: Person, key: str) -> None:
    before = int(person.page.get_attribute("body", "data-answered") or 0)
    person.press(key)
    person.page.wait_for_selector(f"body[data-answered='{before + 1}']")
