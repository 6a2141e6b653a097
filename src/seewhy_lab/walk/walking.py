"""The way from unlabelled pictures to an answer that is doubted, page by page."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from seewhy.domain.tables import CLASS
from seewhy_lab.walk.labelling import label_until
from seewhy_lab.walk.person import Person
from seewhy_lab.walk.truth import Truth

__all__ = ["Asked", "Walk", "picture_of_class"]

_LONGEST_JOB = 3_600_000
"""Milliseconds that a training may take."""


@dataclass(frozen=True)
class Asked:
    """What was answered, and what came of the doubt.

    Attributes
    ----------
    picture, question, answer : str
    flipped : str
        What the page says when a feature shows its other value.
    offered, taken : str
        What the page offers on "No, that is wrong", its first; and what it says when that is taken.
    """

    picture: str
    question: str
    answer: str
    flipped: str
    offered: str
    taken: str


class Walk:
    """Somebody's way through a studio.

    Parameters
    ----------
    person : Person
    address : str
        Of the studio.
    project : Path
        Its folder.
    truth : Truth
        What the person knows.
    look : callable
        Is called with the name of a page when there is something to be seen on it.
    """

    def __init__(
        self,
        person: Person,
        address: str,
        project: Path,
        truth: Truth,
        *,
        look: Callable[[str], object] = str,
    ) -> None:
        self.look = look
        self.person = person
        self.address = address
        self.project = project
        self.truth = truth
        self.labels = 0
        """How many pictures are labelled; those of an interrupted walk are there already."""

    def begin(self, subject: str) -> None:
        """Name what there is to say; the page Label follows."""
        person, truth = self.person, self.truth
        with person.step("Begin: name classes and features"):
            person.page.goto(self.address)
            person.write("[name=subject]", subject)
            if truth.table:
                person.click("summary:has-text('Features follow from the class')")
                person.write("[name=table]", truth.table, pasted=True)
            else:
                person.write("[name=classes]", ", ".join(truth.classes))
                lines = (f"{name}: {', '.join(values)}" for name, values in truth.features.items())
                person.write("[name=features]", "\n".join(lines))
            self.look("begin")
            person.click("text=Write the domain")
            person.page.wait_for_selector("#workbench")

    def label(self, count: int, *, pace: float) -> None:
        """Label in the order that the studio gives."""
        person = self.person
        with person.step(f"Label: {self.labels + 1} to {count}"):
            if person.page.locator("#workbench").count() == 0:
                self._go("Label")
                person.page.wait_for_selector("#workbench")
            label_until(person, self.truth, count=count, done=self.labels, pace=pace)
            self.labels = count
        self.look("label")

    def model_of(self, labels: int) -> Path:
        """Where the model of so many labels is copied to."""
        return self.project.with_name(f"model_{labels}")

    def train(self, *, keep: bool) -> None:
        """Train from the page Train, wait, and copy the model.

        Parameters
        ----------
        keep : bool
            Whether a quarter is kept for evaluation before, as the page proposes.
        """
        person = self.person
        with person.step(f"Train: on {self.labels} labels"):
            self._go("Train")
            if keep:
                person.click("text=Keep a quarter for evaluation")
                person.page.wait_for_selector("text=kept for evaluation")
            person.click("main button:text-is('Train')")
            person.page.wait_for_selector(".job .stage")
            self.look("train")
            self._wait("#now")
        shutil.copytree(self.project / "model", self.model_of(self.labels))

    def evaluate(self) -> str:
        """Evaluate on what was kept; return what the page's first row says."""
        person = self.person
        with person.step("Evaluate"):
            self._go("Evaluate")
            person.click("main button:has-text('Evaluate')")
            self._wait("#now")
            row = person.page.locator("main table tbody tr").first
            figures = " ".join(row.inner_text().split())
        self.look("evaluate")
        self._go("Rules")
        self.look("rules")
        return figures

    def ask(self, picture: Path, label: str) -> Asked:
        """Send a picture, ask why, flip a feature, and say that it is wrong."""
        person = self.person
        page = person.page
        question = f"why is it {label}?"
        with person.step("Ask: send a picture, ask why"):
            self._go("Ask")
            person.click("summary:has-text('Another picture')")
            page.set_input_files("input[name=file]", str(picture))
            person.effort.clicks += 2
            person.click("button:text-is('Send')")
            page.wait_for_selector(f".name:has-text('{picture.stem}')")
            person.write("#question", question)
            person.press("Enter")
            page.wait_for_selector("#answer .asked:has-text('why is')")
            answer = page.locator("#answer .text").inner_text()
        self.look("ask")
        with person.step("Ask: flip a feature"):
            person.click("#what-if .pill:has(input:not(:checked))")
            page.wait_for_selector("#what-if .switch.changed")
            flipped = page.locator("#what-if .then").inner_text()
        with person.step("Ask: no, that is wrong"):
            person.click("text=No, that is wrong")
            page.wait_for_selector("#doubt .doubt-panel")
            page.wait_for_timeout(500)
            offered = page.locator("#doubt .remedies li").first.inner_text()
            person.click("#doubt .remedies button")
            page.wait_for_selector("#bench .note")
            taken = page.locator("#bench .note p").first.inner_text()
        return Asked(picture.name, question, answer, flipped, offered, taken)

    def _go(self, title: str) -> None:
        self.person.click(f"nav[aria-label=Pages] >> text={title}")

    def _wait(self, running: str) -> None:
        """Wait until a job has ended that the page shows."""
        page = self.person.page
        page.wait_for_selector(running)
        page.wait_for_selector(running, state="detached", timeout=_LONGEST_JOB)
        page.wait_for_load_state()
        problem = page.locator("main .problem")
        if problem.count():
            raise SystemExit(problem.first.inner_text())


def picture_of_class(truth: Truth, label: str) -> Path:
    """The first picture of a class, in the order of the names."""
    named = (name for name in sorted(truth.files) if truth.values[name][CLASS] == label)
    return truth.files[next(named)]
