"""How many wordings of a corpus of questions are understood as they are meant.

    python -m seewhy_lab questions_understood tests/questions/development_*.csv [--wrong]

A corpus is a table with the columns ``wording`` and ``meaning``; its name ends in that of a bundled
domain. Meanings are written without sight of the grammar (tests/questions/README.md); where one has
alternatives, separated by " / ", each is right. A wording is *misread* that is understood as
something else than it means; one that is asked back although it means something is only missed.
What could not be asked when the tables were written, such as "what else?", means in them that it
is not understood: it is right where it is understood now, and counted by itself as well.
"""

from __future__ import annotations

import argparse
import csv
import json
from collections import Counter
from pathlib import Path

from seewhy.dialogue.asked import Asks, Question
from seewhy.dialogue.question import Questions
from seewhy.domain.domain import load_domain
from seewhy.domain.folder import bundled_domains
from seewhy.errors import QuestionError

NOT_UNDERSTOOD = "not understood"
_NAMES = {
    Asks.CLASS: "what class",
    Asks.IS_CLASS: "is class={label}",
    Asks.WHY_CLASS: "why class={label}",
    Asks.WHY_NOT_CLASS: "why-not class={label}",
    Asks.CHANGE_TO_CLASS: "change-to class={label}",
    Asks.DIFFERENCE_TO_CLASS: "difference class={label}",
    Asks.BELIEF_VALUE: "meaning-for-driver",
    Asks.FEATURE_VALUE: "what {feature}",
    Asks.FEATURE_IS: "is {feature}={value}",
    Asks.EXPLAIN: "explain",
    Asks.WHY_VALUE: "why {feature}={value}",
    Asks.WHY_NOT_VALUE: "why-not {feature}={value}",
    Asks.WHICH_RULE: "which-rule",
    Asks.WHAT_TO_CHECK: "check",
    Asks.SIMILAR: "similar",
    Asks.DESCRIBE: "describe",
    Asks.HOW_MANY: "how-many {value}",
    Asks.WHICH: "which {value}",
    Asks.WHEN_CLASS: "when class={label}",
    Asks.MATTERS: "matters {feature}",
    Asks.BECAUSE: "because {feature}",
    Asks.MORE: "what-else",
    Asks.POSSIBLE: "possible {feature}",
}
_ASKED_SINCE = {Asks.WHEN_CLASS, Asks.MATTERS, Asks.BECAUSE, Asks.MORE, Asks.POSSIBLE}
"""What could not be asked when the tables were written, which mean by it that it is not."""
_JOINED = {Asks.ALL: "and", Asks.EITHER: "or", Asks.WHAT_IF: "what-if"}


def meaning_of(question: Question) -> str:
    """Return a question that was understood in the words of a corpus."""
    stated = [str(statement) for statement in question.statements]
    if question.asks in _JOINED:
        return f"{_JOINED[question.asks]} {';'.join(sorted(stated))}"
    if question.asks is Asks.CONTRAST:
        return f"contrast {'|'.join(stated)}"
    if question.asks in (Asks.HOW_SURE, Asks.WHERE):
        name = "how-sure" if question.asks is Asks.HOW_SURE else "where"
        return f"{name} {question.feature or ('class' if question.label else '')}".strip()
    return _NAMES[question.asks].format(
        label=question.label, feature=question.feature, value=question.value
    )


def meanings(text: str) -> list[str]:
    """Return what a wording may mean, what is joined in alphabetical order."""
    found = []
    for part in text.split(" / "):
        kind, _, rest = part.strip().partition(" ")
        joined = kind in _JOINED.values()
        found.append(f"{kind} {';'.join(sorted(rest.split(';')))}" if joined else part.strip())
    return found


def judge(path: Path) -> tuple[Counter[str], list[tuple[str, str, str]]]:
    """Return how many wordings are right, missed and misread, and those that are not right."""
    name = next(domain_name for domain_name in bundled_domains() if path.stem.endswith(domain_name))
    questions = Questions(load_domain(name))
    counted: Counter[str] = Counter()
    wrong = []
    with path.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            since = False
            try:
                question = questions.understand(row["wording"])
                understood, since = meaning_of(question), question.asks in _ASKED_SINCE
            except QuestionError:
                understood = NOT_UNDERSTOOD
            meant = meanings(row["meaning"])
            since = since and NOT_UNDERSTOOD in meant
            counted["asked since"] += since
            right = since or understood in meant
            kind = "right" if right else "missed" if understood == NOT_UNDERSTOOD else "misread"
            counted[kind] += 1
            if not right:
                wrong.append((row["wording"], row["meaning"], understood))
    return counted, wrong


def main() -> None:
    """Print the shares of every corpus that is named."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("corpus", type=Path, nargs="+")
    parser.add_argument("--wrong", action="store_true", help="also name what is not right")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    for path in options.corpus:
        counted, wrong = judge(path)
        total = counted["right"] + counted["missed"] + counted["misread"]
        shares = {kind: counted[kind] / total for kind in ("right", "missed", "misread")}
        if options.json:
            print(json.dumps({"corpus": path.name, "wordings": total, **counted}))
        else:
            said = ", ".join(
                f"{counted[kind]} {kind} ({share:.1%})" for kind, share in shares.items()
            )
            since = counted["asked since"]
            print(f"{path.stem}: {total} wordings, {said}" + f"; {since} asked since" * bool(since))
        if options.wrong:
            for wording, meant, understood in wrong:
                print(f"  {wording!r} means {meant!r}, understood: {understood!r}")


if __name__ == "__main__":
    main()
