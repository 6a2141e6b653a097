"""Properties are tried with the same examples at every run, unless random ones are asked for."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.internal.conjecture import providers

from hypothesis_profiles import RANDOM, REPEATABLE


def examples_of(profile: str) -> list[tuple[str, int]]:
    """What a property of a text and a number is tried with."""
    tried: list[tuple[str, int]] = []

    @settings(settings.get_profile(profile), max_examples=200, database=None)
    @given(text=st.text(), number=st.integers())
    def attempt(text: str, number: int) -> None:
        tried.append((text, number))

    attempt()
    return tried


def test_repeatable_examples_do_not_depend_on_what_was_imported_before() -> None:
    before = examples_of(REPEATABLE)
    assert len(providers._get_local_constants()) == 0 or not settings.default.derandomize
    assert examples_of(REPEATABLE) == before


def test_random_examples_are_no_repeatable_ones() -> None:
    assert not settings.get_profile(RANDOM).derandomize
    assert examples_of(RANDOM) != examples_of(REPEATABLE)


def test_the_profile_of_this_run(request: pytest.FixtureRequest) -> None:
    asked = request.config.getoption("--hypothesis-profile") or REPEATABLE
    assert settings.default.derandomize == (asked == REPEATABLE)
