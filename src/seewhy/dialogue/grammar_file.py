"""The grammar of questions as grammar.toml has it: phrases, and what is left out before."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib import resources
from typing import Any

from seewhy.dialogue.grammar import Form, parse_form, words_of_form

__all__ = ["around_phrases", "aside_phrases", "grammar_words", "phrases"]


@cache
def _tables() -> dict[str, Any]:
    text = resources.files("seewhy.dialogue").joinpath("grammar.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


@cache
def _forms() -> dict[str, str]:
    """Name → the form of a phrase; one that is written as a list has the list's choices."""
    return {
        name: form if isinstance(form, str) else "|".join(form)
        for name, form in _tables()["phrases"].items()
    }


@cache
def phrases() -> dict[str, Form]:
    """Return the phrases of the grammar by name."""
    return {name: parse_form(form) for name, form in _forms().items()}


@cache
def aside_phrases() -> tuple[str, ...]:
    """Return the phrases that a question may have and that change nothing of what is asked."""
    return tuple(_tables()["aside"])


@cache
def around_phrases() -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the phrases that may stand before a question, and those that may stand behind it."""
    return tuple(_tables()["before"]), tuple(_tables()["behind"])


@cache
def grammar_words() -> frozenset[str]:
    """Return the words that stand in the grammar for themselves, as they are written there."""
    return frozenset(word for form in _forms().values() for word in words_of_form(form))
