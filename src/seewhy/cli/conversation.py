"""Questions from standard input, one a line, and their answers."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from typing import Any, Protocol

from seewhy.cli.screen import complain, print_json, say

_LEAVE = {"quit", "exit", "bye", "q"}


class Spoken(Protocol):
    """An answer: a sentence for a person, values for a program."""

    @property
    def text(self) -> str: ...

    def to_dict(self) -> dict[str, Any]: ...


def converse(
    answer: Callable[[str], Spoken],
    *,
    greeting: Sequence[str],
    json: bool,
    voice: Callable[[str], None] | None = None,
) -> None:
    """Answer question after question until the input ends, or somebody at a terminal leaves.

    What is not understood is said, with the nearest questions, and the next one is read; so is why
    knowledge or a label cannot be revised as somebody asks. A person at a terminal is greeted; with
    ``json`` every answer is one line of JSON.
    A ``voice`` says each answer as well.
    """
    from seewhy.errors import DatasetError, KnowledgeError, QuestionError, RevisionError

    interactive = sys.stdin.isatty()
    if interactive and not json:
        for line in greeting:
            say(line)
    while True:
        if interactive and not json:
            sys.stdout.write("> ")
            sys.stdout.flush()
        line = sys.stdin.readline()
        text = line.strip()
        if not text or text.casefold() in _LEAVE:
            if line and not text and not interactive:
                continue
            return
        try:
            spoken = answer(text)
        except (QuestionError, RevisionError, KnowledgeError, DatasetError) as problem:
            if json:
                nearest = problem.nearest if isinstance(problem, QuestionError) else ()
                told = {"error": str(problem), "nearest": list(nearest)}
                print_json(told, lines=False)
            else:
                complain(str(problem))
            continue
        if json:
            print_json(spoken.to_dict(), lines=False)
        else:
            say(spoken.text)
        if voice is not None:
            voice(spoken.text)
