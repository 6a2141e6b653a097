"""What knowledge, goals and histories may not hold: orders to clingo, numbers beyond its own."""

from __future__ import annotations

from pathlib import Path

import clingo
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from conftest import KNOWLEDGE, write_domain
from seewhy.check.domain import check_domain
from seewhy.domain.domain import load_domain
from seewhy.errors import KnowledgeError, SeeWhyError
from seewhy.knowledge.dynamics import transition_rules
from seewhy.knowledge.ground_literal import read_ground_literal
from seewhy.knowledge.history import read_history
from seewhy.knowledge.language import read_axioms, read_knowledge, read_literal
from seewhy.knowledge.odd_loop import OddLoops
from seewhy.planning.goal import read_goal

SIGNATURE = """\
#sort n = 1..9. #sort big = 100000..100001. #static p(n). #static large(big). #static q.
#fluent basic lit(n). #action push.
"""
KNOWN = read_knowledge(SIGNATURE)
ORDERS = [
    '#include "secret"',
    "#script (lua)",
    "#external q",
    "#const a = 1",
    "#program base",
    "#show",
]


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize(
    "form", ["{}.", "default {}.", "impossible {}.", "q if {}.", "q. {}.", "push causes {}."]
)
def test_orders_to_clingo_are_refused_in_knowledge(order: str, form: str) -> None:
    with pytest.raises(KnowledgeError, match=r"^k\.al:\d+:\d+: "):
        read_knowledge(SIGNATURE + form.format(order), file="k.al")


@pytest.mark.parametrize("order", [*ORDERS, "@f()", "q(@f())", "&diff { q } < 3"])
def test_orders_to_clingo_are_refused_elsewhere(order: str) -> None:
    for read in (
        lambda: read_literal(order),
        lambda: read_literal(f"-{order}"),
        lambda: read_goal(f"lit(1), {order}", KNOWN),
        lambda: read_goal(order, KNOWN),
        lambda: read_history(f"observed {order} at 0.", KNOWN.signature),
        lambda: read_history(f"happened {order} at 0.", KNOWN.signature),
        lambda: read_ground_literal(order, KNOWN.signature, of="fluent"),
        lambda: read_axioms(f"q if {order}.", KNOWN.signature),
    ):
        with pytest.raises(SeeWhyError):
            read()


def test_no_file_is_opened(tmp_path: Path) -> None:
    included = tmp_path / "secret.lp"
    included.write_text("q.", encoding="utf-8")
    for text in (f'default #include "{included}".', f'q. #include "{included}".'):
        with pytest.raises(KnowledgeError):
            read_knowledge(SIGNATURE + text)
    with pytest.raises(KnowledgeError, match="is not a literal"):
        read_literal(f'#include "{included}"')


TOO_LARGE = "numbers go from -2147483647 to 2147483647"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("q if p(N), N > 4294967299.", f"3:16: the number 4294967299 is too large; {TOO_LARGE}"),
        ("p(2147483648).", f"3:3: the number 2147483648 is too large; {TOO_LARGE}"),
        ("q if 0xFFFFFFFF > 1.", f"3:6: the number 0xFFFFFFFF is too large; {TOO_LARGE}"),
        (
            "#sort m = 3000000000..3000000001.",
            f"3:11: the number 3000000000 is too large; {TOO_LARGE}",
        ),
        ("#sort m = {a, 3000000000}.", f"3:15: the number 3000000000 is too large; {TOO_LARGE}"),
        (
            f"q if {'9' * 5000} > 1.",
            f"3:6: the number {'9' * 20}… is too large; {TOO_LARGE}",
        ),
        (
            "q if 65536 * 65536 = 0.",
            f"3:6: '(65536*65536)' may come to 4294967296, and {TOO_LARGE}; use smaller numbers",
        ),
        (
            "q if large(N), N * N > 0.",
            f"3:16: '(N*N)' may come to 10000200001, and {TOO_LARGE}; use smaller numbers",
        ),
        (
            "q if large(N), M = N * 9, M * 9000 > 0.",
            f"3:27: '(M*9000)' may come to 8100081000, and {TOO_LARGE}; use smaller numbers",
        ),
        (
            "q if 2 ** 31 > 0.",
            f"3:6: '(2**31)' may come to 2147483648, and {TOO_LARGE}; use smaller numbers",
        ),
        (
            "q if p(1..2147483647).",
            "3:8: '(1..2147483647)' may be a range of more than 10,000 numbers, each of which is "
            "tried; write a comparison",
        ),
    ],
)
def test_numbers_that_clingo_cannot_count_are_refused(text: str, message: str) -> None:
    with pytest.raises(KnowledgeError) as caught:
        read_knowledge(SIGNATURE + text, file="k.al")
    assert str(caught.value) == f"k.al:{message}"


def test_numbers_are_refused_in_goals_histories_and_literals() -> None:
    for read in (
        lambda: read_goal("lit(N), N > 4294967299", KNOWN),
        lambda: read_history("observed lit(4294967299) at 0.", KNOWN.signature),
        lambda: read_ground_literal("lit(4294967299)", KNOWN.signature, of="fluent"),
        lambda: read_literal("lit(4294967299)"),
    ):
        with pytest.raises(SeeWhyError, match=f"the number 4294967299 is too large; {TOO_LARGE}"):
            read()


def test_large_numbers_in_texts_and_names_are_none() -> None:
    known = read_knowledge(
        '#sort word = {"4294967299", a4294967299, 2147483647}. #static w(word). w(a4294967299).'
    )
    assert len(known.signature.members("word")) == 3


@pytest.mark.parametrize(
    ("goal", "message"),
    [
        ("lit(1). lit(2)", "found 2 statements; separate conditions by commas, not by full stops"),
        ("lit(1) % two", "found '%', which begins a comment; remove it"),
        ("lit(1) if lit(2)", "found an axiom; give its conditions alone, separated by commas"),
        ("dark(1)", "'dark' is not declared; it must be one of: p, large, q, lit, push, n, big"),
    ],
)
def test_a_goal_is_conditions(goal: str, message: str) -> None:
    with pytest.raises(SeeWhyError) as caught:
        read_goal(goal, KNOWN)
    assert str(caught.value) == f"the goal '{goal}' cannot be used: {message}"


ODD = """
#static dull(tile). #static faded(tile).
dull(T) if colour(T, green), not faded(T), round(T).
faded(T) if dull(T).
"""


def test_an_odd_loop_is_named_and_no_other_axiom(tmp_path: Path) -> None:
    domain = load_domain(write_domain(tmp_path / "tiles", knowledge=KNOWLEDGE + ODD))
    green = domain.vector({"colour": "green", "round": "yes"})
    loops = OddLoops(domain.knowledge, domain.schema)
    assert [str(axiom) for axiom in loops.of(green)] == [
        "dull(T) if colour(T, green), not faded(T), round(T).",
        "faded(T) if dull(T).",
    ]
    assert loops.of(domain.vector({"colour": "red", "round": "yes"})) == ()
    (note,) = check_domain(domain).warnings
    first, second = loops.of(green)
    assert note == (
        f"{first.location}: '{first}' (line {first.location.line}) and '{second}' (line "
        f"{second.location.line}) need, through 'not', that what they conclude is not believed, so "
        "that 1 of 6 feature vectors have no answer set"
    )


def test_where_no_picture_has_an_answer_set_the_loop_is_refused(tmp_path: Path) -> None:
    odd = "\n#static dull(tile). dull(T) if tile(T), not dull(T).\n"
    domain = load_domain(write_domain(tmp_path / "tiles", knowledge=KNOWLEDGE + odd))
    with pytest.raises(KnowledgeError) as caught:
        check_domain(domain)
    assert str(caught.value).endswith(
        "needs, through 'not', that its own conclusion is not believed, so that no picture has an "
        "answer set"
    )


def test_many_instances_are_noted(tmp_path: Path) -> None:
    many = "\n#sort n = 1..100. #static lt(n, n). lt(A, B) if n(A), n(B), A < B.\n"
    domain = load_domain(write_domain(tmp_path / "tiles", knowledge=KNOWLEDGE + many))
    (note,) = check_domain(domain).warnings
    assert note.endswith(
        "'lt(A, B) if n(A), n(B), A < B.' has up to 10,000 instances; every question waits for them"
    )


PIECES = [
    *(
        "#sort ",
        "#static ",
        "#fluent basic ",
        "#action ",
        "default ",
        "impossible ",
        " causes ",
        " if ",
    ),
    *(
        "not ",
        "p",
        "n",
        "q",
        "lit",
        "push",
        "(",
        ")",
        ",",
        ".",
        "..",
        ";",
        ":",
        "{",
        "}",
        "=",
        "<",
        "!=",
    ),
    *(
        "#count",
        "#sum",
        "#include",
        "@",
        "&",
        "|",
        "**",
        "*",
        "+",
        "-",
        "/",
        "\\",
        "~",
        "^",
        "?",
        "_",
    ),
    *(
        "X",
        "Y__",
        "1",
        "2147483648",
        "0x",
        '"',
        "%",
        "%%",
        "%*",
        "*%",
        "\n",
        "\t",
        "é",
        "\0",
        "#inf",
    ),
]
texts = st.lists(st.sampled_from(PIECES), max_size=25).map("".join)


@st.composite
def mended(draw: st.DrawFn) -> str:
    """A real file with a few places of it changed."""
    text = draw(st.sampled_from([SIGNATURE + EXAMPLE, KNOWLEDGE, ODD + SIGNATURE]))
    for _ in range(draw(st.integers(1, 4))):
        place = draw(st.integers(0, len(text)))
        length = draw(st.integers(0, 6))
        text = text[:place] + draw(st.sampled_from(["", *PIECES])) + text[place + length :]
    return text


EXAMPLE = """\
p(X) if n(X), X < 4, not q.
%% a push lights the first
push causes lit(1) if q.
lit(X) if lit(Y), X = Y + 1, n(X).
impossible push if #count { X : lit(X) } > 3.
default -lit(2) if p(2).
"""


def check_said(problem: SeeWhyError) -> None:
    """An error is one sentence, and none of Python's."""
    said = str(problem)
    assert said
    assert "\n" not in said
    assert "Error" not in said


def accepted(text: str) -> bool:
    """Whether the text is knowledge; clingo then takes the program that is made of it."""
    try:
        known = read_knowledge(text)
    except SeeWhyError as problem:
        check_said(problem)
        return False
    control = clingo.Control(["--warn=none"])
    control.add("base", [], "\n".join(transition_rules(known, last=1)))
    control.ground([("base", [])])
    return True


fuzzed = settings(max_examples=150)


@given(text=st.one_of(texts, texts.map((SIGNATURE + "\n").__add__), st.text(max_size=40)))
@fuzzed
def test_any_text_is_knowledge_or_refused(text: str) -> None:
    accepted(text)


@given(text=mended())
@fuzzed
def test_a_spoilt_file_is_knowledge_or_refused(text: str) -> None:
    accepted(text)


def test_a_whole_file_is_knowledge() -> None:
    assert accepted(SIGNATURE + EXAMPLE)


@given(text=st.one_of(texts, st.text(max_size=30)))
@fuzzed
def test_any_goal_and_history_is_read_or_refused(text: str) -> None:
    for read in (
        lambda: read_goal(text, KNOWN),
        lambda: read_history(f"observed {text} at 0.", KNOWN.signature),
        lambda: read_history(text, KNOWN.signature),
        lambda: read_literal(text),
    ):
        try:
            read()
        except SeeWhyError as problem:
            check_said(problem)


def test_a_statement_that_is_nested_deeply_is_refused_or_read() -> None:
    for text in (f"q if {'(' * 3000}1{')' * 3000} > 0.", f"q if 1{' + 0' * 5000} > 0."):
        accepted(f"#static q. {text}")
