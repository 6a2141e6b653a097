"""Questions in words become queries, and what is not a question is said to be none."""

from __future__ import annotations

import re
import string
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from conftest import write_domain
from seewhy.dialogue.question import Questions
from seewhy.dialogue.spelling import english_words
from seewhy.domain.domain import load_domain
from seewhy.errors import DomainError, QuestionError

QUESTIONS = Questions(load_domain("structure_stability"))


def asked(text: str) -> tuple[str | None, ...] | None:
    """What a text asks; None where it is refused as a question has to be."""
    try:
        return QUESTIONS.understand(text).query
    except QuestionError as problem:
        refused = problem
    assert refused.nearest
    assert len(str(refused).splitlines()) == 1
    return None


ASKED = {
    "is this structure stable?": ("is_class", "stable", None, None),
    "is it unstable?": ("is_class", "unstable", None, None),
    "what is making this structure stable?": ("why_class", "stable", None, None),
    "what is making this structure unstable?": ("why_class", "unstable", None, None),
    "why is it stable?": ("why_class", "stable", None, None),
    "why is it unstable?": ("why_class", "unstable", None, None),
    "why is it not stable?": ("why_not_class", "stable", None, None),
    "why is it not unstable?": ("why_not_class", "unstable", None, None),
    "what would need to be changed to make this structure stable?": (
        "change_to_class",
        "stable",
        None,
        None,
    ),
    "is it stable or unstable?": ("class", None, None, None),
    "how many blocks are there?": ("feature_value", None, "num_blocks", None),
    "does it have three blocks?": ("feature_is", None, "num_blocks", "3"),
    "how wide is the base?": ("feature_value", None, "base", None),
    "is the base narrow?": ("feature_is", None, "base", "narrow"),
    "does it lean?": ("feature_is", None, "lean", "yes"),
    "is it standing straight?": ("feature_is", None, "lean", "no"),
    "is a block displaced?": ("feature_is", None, "block_displaced", "yes"),
    "please explain this answer": ("explain", None, None, None),
}


@pytest.mark.parametrize(("text", "query"), ASKED.items())
def test_every_question_is_understood(text: str, query: tuple[str | None, ...]) -> None:
    assert QUESTIONS.understand(text).query == query


@pytest.mark.parametrize(
    ("text", "same_as"),
    [
        ("IS THIS STRUCTURE STABLE", "is this structure stable?"),
        ("  is   this structure  ... stable ?!", "is this structure stable?"),
        ("is this tower steady?", "is this structure stable?"),
        ("is that pile of bricks… wobbly", None),
        ("Is it wobbly?", "is it unstable?"),
        ("What's making it unstable?", "what is making this structure unstable?"),
        ("whats making the stack unsteady", "what is making this structure unstable?"),
        ("why isn’t it stable?", "why is it not stable?"),
        ("Please, can you tell me why it is unstable?", "why is it unstable?"),
        ("what needs changing to make it stable", None),
        ("what would have to be changed to make it stable?", None),
        (
            "what would need to be altered to make the construction stable?",
            "what would need to be changed to make this structure stable?",
        ),
        ("what should change to make it stable?", None),
        ("how many bricks does it have?", "how many blocks are there?"),
        ("are there 3 blocks?", "does it have three blocks?"),
        ("has it a slim base?", "is the base narrow?"),
        ("is it tilting?", "does it lean?"),
        ("does the tower lean to one side?", "does it lean?"),
        ("are any blocks misplaced?", "is a block displaced?"),
        ("is a block out of place?", "is a block displaced?"),
        ("explain", "please explain this answer"),
        ("why?", "please explain this answer"),
        ("how do you know?", "please explain this answer"),
        ("is it stabel?", "is this structure stable?"),
        ("is it unstabel?", "is it unstable?"),
        ("ìs thé strücture stable?", "is this structure stable?"),
    ],
)
def test_wording_is_forgiven(text: str, same_as: str | None) -> None:
    """Where ``same_as`` is None, the question may be refused, but not misunderstood."""
    try:
        query = QUESTIONS.understand(text).query
    except QuestionError:
        assert same_as is None
        return
    if same_as is None:
        assert query[0] in ("change_to_class", "is_class")
        assert query[1] in ("stable", "unstable")
    else:
        assert query == ASKED[same_as]


def test_every_wording_of_the_templates_means_what_the_template_says() -> None:
    for question in QUESTIONS.all:
        assert QUESTIONS.understand(f"{question.text}?").query == question.query
        assert QUESTIONS.understand(question.text.upper()).query == question.query


def test_wordings_of_templates_agree_in_number() -> None:
    texts = {question.text: question.words for question in QUESTIONS.all}
    assert "does the structure have two blocks" in texts
    assert "are there two blocks" in texts
    assert not any("one blocks" in text for text in texts)
    # What is understood is told apart as the pattern has it.
    assert texts["is there one block"] == ("are", "there", "one", "block")
    assert texts["does the structure have one block"] == ("doe", "it", "have", "one", "block")


def _words(text: str) -> list[tuple[int, int]]:
    return [match.span() for match in re.finditer("[a-z]{5,}", text)]


@st.composite
def _mistyped(draw: st.DrawFn) -> tuple[str, str]:
    """A question, and the same with one letter wrong in a word of five letters or more."""
    texts = [text for text in (*ASKED, *(q.text for q in QUESTIONS.all)) if _words(text)]
    text = draw(st.sampled_from(texts))
    start, end = draw(st.sampled_from(_words(text)))
    word = text[start:end]
    at = draw(st.integers(0, len(word) - 1))
    letter = draw(st.sampled_from(string.ascii_lowercase))
    edited = draw(
        st.sampled_from(
            [
                word[:at] + word[at + 1 :],
                word[:at] + letter + word[at:],
                word[:at] + letter + word[at + 1 :],
                word[:at] + word[at + 1 : at + 2] + word[at] + word[at + 2 :],
                word + letter,
            ]
        )
    )
    return text, text[:start] + edited + text[end:]


@settings(max_examples=400)
@given(_mistyped())
def test_a_typing_error_never_asks_something_else(pair: tuple[str, str]) -> None:
    text, mistyped = pair
    assert asked(mistyped) in (QUESTIONS.understand(text).query, None)


def test_a_typing_error_is_mostly_understood() -> None:
    understood = total = 0
    for text, query in ASKED.items():
        for start, end in _words(text):
            for at in range(start, end - 1):
                swapped = text[:at] + text[at + 1] + text[at] + text[at + 2 :]
                dropped = text[:at] + text[at + 1 :]
                for mistyped, ends in ((swapped, end), (dropped, end - 1)):
                    if mistyped[start:ends] in english_words() | {"here", "there", "three"}:
                        continue  # who asks about a table means it
                    total += 1
                    understood += asked(mistyped) == query
    assert understood / total > 0.97


@pytest.mark.parametrize(
    "text",
    [
        "why is it suitable?",
        "does it learn?",
        "is it a table?",
        "is the base an arrow?",
        "is a lock displaced?",
    ],
)
def test_an_english_word_is_no_typing_error(text: str) -> None:
    assert asked(text) is None


def test_a_typing_error_between_two_words_is_asked_back() -> None:
    with pytest.raises(QuestionError) as problem:
        QUESTIONS.understand("is it ustable?")
    assert set(problem.value.nearest) >= {"is the structure stable?", "is the structure unstable?"}


EXAMPLES = (
    "ask for instance: is the structure stable? · is the structure unstable? · "
    "is the structure stable or unstable?"
)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", f"the question is empty; {EXAMPLES}"),
        (" \t\n", f"the question is empty; {EXAMPLES}"),
        ("???", f"'???' has no word in the vocabulary's alphabet; {EXAMPLES}"),
        ("🧱🧱", f"'🧱🧱' has no word in the vocabulary's alphabet; {EXAMPLES}"),
        (
            "устойчива ли конструкция?",
            f"'устойчива ли конструкция?' has no word in the vocabulary's alphabet; {EXAMPLES}",
        ),
        ("12 34", f"'12 34' has no word in the vocabulary's alphabet; {EXAMPLES}"),
        (
            "is it stable? " * 60,
            f"the question has 840 characters, at most 300 are read; {EXAMPLES}",
        ),
        (
            "what is the capital\nof France?",
            "'what is the capital of France?' is not understood; ask for instance: "
            "what is the width of the base? · what is the number of blocks? · "
            "what is making the structure stable?",
        ),
    ],
)
def test_what_is_no_question_is_refused(text: str, message: str) -> None:
    with pytest.raises(QuestionError) as problem:
        QUESTIONS.understand(text)
    assert str(problem.value) == message
    for nearest in problem.value.nearest:
        QUESTIONS.understand(nearest)


@settings(max_examples=200)
@given(st.text(max_size=400))
def test_any_text_is_understood_or_refused(text: str) -> None:
    asked(text)


@settings(max_examples=200)
@given(
    st.lists(st.sampled_from(["is", "it", "not", "stable", "unstable", "why", "base"])).map(
        " ".join
    )
)
def test_words_of_the_vocabulary_in_any_order_raise_nothing_else(text: str) -> None:
    asked(text)


@pytest.mark.parametrize(
    ("questions", "message"),
    [
        (
            '[[question]]\nasks = "why_clas"\npatterns = ["why is {it} {class}"]\n',
            "1: asks = 'why_clas' is not known; did you mean 'why_class'?",
        ),
        (
            '[[question]]\nasks = "class"\npatterns = ["what is it"]\n\n'
            '[[question]]\nasks = "feature_value"\nfeature = "color"\npatterns = ["which"]\n',
            "5: 'color' is no feature of domain.toml; did you mean 'colour'?",
        ),
        (
            '[[question]]\nasks = "feature_is"\nfeature = "colour"\nvalue = "gren"\n'
            'patterns = ["is it"]\n',
            "1: 'gren' is no value of 'colour'; did you mean 'green'?",
        ),
        (
            '[[question]]\nasks = "feature_value"\npatterns = ["which colour"]\n',
            "1: asks = 'feature_value' needs a feature; add feature = \"…\"",
        ),
        (
            '[[question]]\nasks = "why_class"\npatterns = ["why"]\n',
            "1: 'why' asks about a class; name it as {class}",
        ),
        (
            '[[question]]\nasks = "class"\npatterns = ["is {it} {class}"]\n',
            "1: 'is {it} {class}' names {class}, but asks 'class'; remove it",
        ),
        (
            '[[question]]\nasks = "class"\nfeature = "colour"\npatterns = ["what"]\n',
            "1: asks = 'class' is about no feature; remove 'feature'",
        ),
        (
            '[[question]]\nasks = "feature_is"\nfeature = "colour"\npatterns = ["is {it}"]\n',
            "1: 'is {it}' needs {value}, or the question a 'value'",
        ),
    ],
)
def test_a_wrong_template_is_named_with_its_line(
    tmp_path: Path, questions: str, message: str
) -> None:
    folder = write_domain(tmp_path / "tiles", questions=questions)
    with pytest.raises(DomainError) as problem:
        Questions(load_domain(folder))
    assert str(problem.value) == f"{folder}/questions.toml:{message}"


@pytest.mark.parametrize(
    ("name", "old", "new", "complaint"),
    [
        ("domain", r"(?m)^subject = .*$", 'subject = ""', "subject = '' has no word"),
        ("domain", r"(?m)^subject = .*$", 'subject = "the a"', "subject = 'the a' has no word"),
        (
            "domain",
            r"(?m)^subject = .*$",
            'subject = "please"',
            "subject = 'please' is what questions may leave out; write what the picture shows",
        ),
        ("questions", r"(?m)^fillers = .*$", 'fillers = ["!"]', "'!' in the fillers has no word"),
        ("questions", r"\Z", '\n[synonyms]\ngood = [""]\n', "'' in the synonyms of 'good' has no"),
    ],
)
def test_phrases_without_a_word_are_refused(
    tmp_path: Path, name: str, old: str, new: str, complaint: str
) -> None:
    folder = write_domain(tmp_path / "tiles")
    file = folder / f"{name}.toml"
    file.write_text(re.sub(old, lambda _: new, file.read_text(), count=1))
    domain = load_domain(str(folder))
    with pytest.raises(DomainError, match=re.escape(complaint)):
        Questions(domain)
