"""The knowledge language: what is read is written back, what is wrong is said with its place."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from knowledge_builders import SIGNATURE, World, worlds
from seewhy.errors import KnowledgeError, SeeWhyError
from seewhy.knowledge.axiom import Axiom, AxiomKind, Condition, Literal
from seewhy.knowledge.language import Knowledge, read_knowledge, read_knowledge_file, read_literal
from seewhy.knowledge.signature import Location

HEADER = """\
#sort structure.
#sort num = 1..5.
#sort width = {wide, narrow, "très large"}.
#static num_blocks(structure, num).
#static base(structure, width).
#static lean(structure).
#static stable(structure).
#static raining.
"""
SHORT = HEADER.count("\n") + 1
"""The number of the first line below the header."""


def refusal(source: str) -> str:
    with pytest.raises(KnowledgeError) as caught:
        read_knowledge(source)
    text = str(caught.value)
    assert "\n" not in text
    assert isinstance(caught.value, (SeeWhyError, ValueError))
    return text


def below(text: str) -> str:
    """The error of statements below the header, its lines counted from there."""
    said = refusal(HEADER + text)
    file, line, rest = said.split(":", 2)
    assert file == "knowledge.al"
    return f"{int(line) - SHORT + 1}:{rest}"


def axioms(text: str) -> list[str]:
    return list(map(str, read_knowledge(HEADER + text).axioms))


def meaning(axiom: Axiom) -> tuple[AxiomKind, Literal, tuple[Condition, ...]]:
    return axiom.kind, axiom.head, axiom.body


def written(knowledge: Knowledge) -> list[str]:
    return [str(axiom) for axiom in knowledge.axioms]


# What is read

STATEMENTS = {
    "stable(S) if lean(S).": "stable(S) if lean(S).",
    "-stable(S)if lean( S ),-lean(S).": "-stable(S) if lean(S), -lean(S).",
    "raining.": "raining.",
    "-raining.": "-raining.",
    "default raining.": "default raining.",
    "default  -stable(S)\n if lean(S).": "default -stable(S) if lean(S).",
    "stable(S) if structure(S), not lean(S).": "stable(S) if structure(S), not lean(S).",
    "stable(S) if structure(S), not -lean(S).": "stable(S) if structure(S), not -lean(S).",
    "stable(S) if structure(S), not not lean(S).": "stable(S) if structure(S), not not lean(S).",
    "stable(S) if num_blocks(S, N), N>2, N!=4.": "stable(S) if num_blocks(S, N), N > 2, N != 4.",
    "num_blocks(S, N+1) if num_blocks(S,N).": "num_blocks(S, (N+1)) if num_blocks(S, N).",
    "stable(S) if num_blocks(S, 1..3).": "stable(S) if num_blocks(S, (1..3)).",
    "stable(S) if num_blocks(S, (1;3)).": "stable(S) if num_blocks(S, (1;3)).",
    "stable(S) if num_blocks(S, _).": "stable(S) if num_blocks(S, _).",
    'stable(S) if base(S, "très large").': 'stable(S) if base(S, "très large").',
    "stable(S) if structure(S), 2 < #count { N : num_blocks(S, N) }, lean(S).": (
        "stable(S) if structure(S), 2 < #count { N: num_blocks(S,N) }, lean(S)."
    ),
    "stable(S) if structure(S), lean(S) : raining; not raining.": (
        "stable(S) if structure(S), lean(S): raining; not raining."
    ),
    "stable(X') if lean(X').": "stable(X') if lean(X').",
    "stable(S) :- lean(S).".replace(":-", "if % :- is not ours\n"): "stable(S) if lean(S).",
}


@pytest.mark.parametrize("text", STATEMENTS)
def test_what_is_read_is_written_and_read_again(text: str) -> None:
    (axiom,) = read_knowledge(HEADER + text).axioms
    assert str(axiom) == STATEMENTS[text]
    (again,) = read_knowledge(HEADER + str(axiom)).axioms
    assert meaning(again) == meaning(axiom)
    assert str(again) == str(axiom)


@given(world=worlds())
@settings(max_examples=50)
def test_random_axioms_are_written_and_read_again(world: World) -> None:
    again = read_knowledge(SIGNATURE + "\n".join(written(world.knowledge)))
    assert list(map(meaning, again.axioms)) == list(map(meaning, world.knowledge.axioms))
    assert written(world.knowledge) == list(map(str, world.rules))


def test_an_axiom_as_data() -> None:
    (axiom,) = read_knowledge(
        HEADER + "%% low is\n%%  safe\ndefault stable(S) if num_blocks(S, N), not -lean(S), N < 3."
    ).axioms
    assert axiom == Axiom(
        identifier="a1",
        kind=AxiomKind.DEFAULT,
        head=Literal("stable", ("S",)),
        body=(
            Condition("num_blocks(S, N)", Literal("num_blocks", ("S", "N"))),
            Condition("not -lean(S)", Literal("lean", ("S",), positive=False), absent=True),
            Condition("N < 3"),
        ),
        text="low is safe",
        location=Location("knowledge.al", SHORT + 2, 1),
    )
    assert axiom.variables == ("S", "N")


@pytest.mark.parametrize(
    ("text", "variables"),
    [
        ("stable(S) if structure(S), 2 < #count { N : num_blocks(S, N) }.", ("S",)),
        ("stable(S) if structure(S), M = #count { N : num_blocks(S, N) }, M > 1.", ("S", "M")),
        ("stable(S) if structure(S), lean(S) : num_blocks(S, N); raining.", ("S",)),
        ('stable(S) if lean(S), base(S, B), B != "A : {B}".', ("S", "B")),
    ],
)
def test_the_variables_of_an_axiom(text: str, variables: tuple[str, ...]) -> None:
    (axiom,) = read_knowledge(HEADER + text).axioms
    assert axiom.variables == variables


def test_the_signature() -> None:
    signature = read_knowledge(
        '#sort scene. #sort n = -1..2. #sort m={ f(a,b),3 , -2, "x, y" }.\n#static p( scene ,m).'
        "\n#static q.\n#static r()."
    ).signature
    assert {name: sort.members for name, sort in signature.sorts.items()} == {
        "scene": None,
        "n": ("-1", "0", "1", "2"),
        "m": ("f(a,b)", "3", "-2", '"x, y"'),
    }
    assert [str(predicate) for predicate in signature.predicates.values()] == [
        "p(scene, m)",
        "q",
        "r",
    ]
    assert signature.members("scene") == ()
    assert signature.predicates["p"].location == Location("knowledge.al", 2, 1)


# The sentence above an axiom


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("%% it falls\nstable(S) if lean(S).", "it falls"),
        ("%%it\n%%  falls  \nstable(S) if lean(S).", "it falls"),
        ("%% a heading\n\n%% it falls\nstable(S) if lean(S).", "it falls"),
        ("%% a heading\n \t \n%% it falls\nstable(S) if lean(S).", "it falls"),
        ("%% a heading\r\n\r\n%% it falls\r\nstable(S) if lean(S).", "it falls"),
        ("%% a heading\n\nstable(S) if lean(S).", "stable(S) if lean(S)"),
        ("% a remark\nstable(S) if lean(S).", "stable(S) if lean(S)"),
        ("%% it falls\n% a remark\nstable(S) if lean(S).", "it falls"),
        ("%% it falls\n%* a remark *%\nstable(S) if lean(S).", "it falls"),
        ("%% größer als 50 % – „fällt“\nstable(S) if lean(S).", "größer als 50 % – „fällt“"),
        ("stable(S) if lean(S). %% too late", "stable(S) if lean(S)"),
        ("stable(S) if %% inside\n lean(S).", "stable(S) if lean(S)"),
    ],
)
def test_the_sentence_above_an_axiom(text: str, sentence: str) -> None:
    (axiom,) = read_knowledge(HEADER + text).axioms
    assert axiom.text == sentence


def test_a_sentence_belongs_to_one_axiom_only() -> None:
    knowledge = read_knowledge(HEADER + "%% one\nstable(S) if lean(S). raining.\n%% two\nraining.")
    assert [axiom.text for axiom in knowledge.axioms] == ["one", "raining", "two"]
    assert [axiom.identifier for axiom in knowledge.axioms] == ["a1", "a2", "a3"]


# Errors: the whole text of each kind

STABLE = "stable(S) or -stable(S)"
FORMS = (
    "a sort is declared as '#sort name.', '#sort name = 1..5.', '#sort name = {a, b}.', "
    "'#sort name = sort + sort.' or '#sort name = things.', got "
)
MEMBER = "cannot be a member of a sort; write a name that begins with a small letter, or a number"
READS = "an axiom reads 'head if condition, condition.'"
UNBOUND = "use it in a condition without 'not', a sort such as structure(S) for instance"
ERRORS = {
    "syntax": ("stable(S) if lean(S)).", f"1:21: syntax error, unexpected ); {READS}"),
    "nothing after the comma": (
        "stable(S) if lean(S),\n.",
        f"2:1: syntax error, unexpected .; {READS}",
    ),
    "a variable as an axiom": ("S if lean(S).", f"1:3: syntax error, unexpected if; {READS}"),
    "two names": ("stable S.", f"1:8: syntax error, unexpected a variable; {READS}"),
    "missing full stop at the end": (
        "raining.\n  stable(S) if lean(S)",
        "2:3: the statement that begins here does not end; add a full stop after it",
    ),
    "missing full stop between": (
        "stable(S) if lean(S)\n-stable(S) if lean(S).",
        "1:1: found 'if' 2 times in one statement; "
        "end the statement before the second with a full stop",
    ),
    "missing full stop after a declaration": (
        "#sort x\n#static q(x).",
        "2:1: '#static' cannot stand inside of a statement; remove it, or end the statement before "
        "it with a full stop",
    ),
    "full stop alone": (
        "raining..x",
        "1:1: the statement that begins here does not end; add a full stop after it",
    ),
    "two full stops": (
        "raining. .",
        "1:10: found a full stop with no statement before it; remove it",
    ),
    "open text": (
        'stable(S) if base(S, "wide).\n',
        '1:22: the text that begins here has no end; close it with a "',
    ),
    "open comment": (
        "raining. %* no end",
        "1:10: the comment that begins here has no end; close it: *%",
    ),
    "prolog's if": (
        "stable(S) :- lean(S).",
        "1:1: found ':-'; write 'if' between head and body",
    ),
    "two ifs": (
        "stable(S) if lean(S) if raining.",
        "1:1: found 'if' 2 times in one statement; "
        "end the statement before the second with a full stop",
    ),
    "no head": (
        "if lean(S).",
        f"1:1: the head of an axiom must be one literal such as {STABLE}, got none",
    ),
    "not in the head": (
        "not stable(S) if lean(S).",
        f"1:1: the head of an axiom must be one literal such as {STABLE}, got 'not stable(S)'",
    ),
    "two heads": (
        "stable(S); lean(S) if raining, structure(S).",
        f"1:1: the head of an axiom must be one literal such as {STABLE}, got 'stable(S); lean(S)'",
    ),
    "choice": (
        "{ stable(S) } if lean(S).",
        f"1:1: the head of an axiom must be one literal such as {STABLE}, got '{{ stable(S) }}'",
    ),
    "range in the head": (
        "num_blocks(S, 1..9) if lean(S).",
        f"1:1: the head of an axiom must be one literal such as {STABLE}, "
        "got 'num_blocks(S,(1..9))'",
    ),
    "weak constraint": (
        ":~ lean(S).",
        f"1:11: syntax error, unexpected the end, expecting [; {READS}",
    ),
    "sort in the head": (
        "structure(S) if lean(S).",
        "1:1: 'structure' is a sort; its members are listed where it is declared, "
        "an axiom cannot add to them",
    ),
    "undeclared, with a near name": (
        "stabel(S) if lean(S).",
        "1:1: 'stabel' is not declared; did you mean 'stable'?",
    ),
    "undeclared, with none near": (
        "stable(S) if lean(S), -zzz(S).",
        "1:23: 'zzz' is not declared; it must be one of: num_blocks, base, lean, stable, raining, "
        "structure, num, width",
    ),
    "undeclared in an aggregate": (
        "stable(S) if lean(S), 1 < #count { N : blocks(S, N) }.",
        "1:40: 'blocks' is not declared; did you mean 'num_blocks'?",
    ),
    "wrong sort": (
        "stable(S) if base(S, 1).",
        "1:22: '1' is not of sort 'width', which 'base' takes here; "
        'it must be one of: wide, narrow, "très large"',
    ),
    "wrong sort, near": (
        "stable(S) if base(S, wild).",
        "1:22: 'wild' is not of sort 'width', which 'base' takes here; did you mean 'wide'?",
    ),
    "a name for the scene": (
        "stable(tower).",
        "1:8: 'stable' takes the structure of the picture here, got 'tower'; "
        "use a variable such as S",
    ),
    "variable of two sorts": (
        "stable(S) if base(S, N), num_blocks(S, N).",
        "1:40: 'N' is of sort 'width' elsewhere in this axiom, but 'num_blocks' takes 'num' here; "
        "use two variables",
    ),
    "too few arguments": (
        "stable(S) if base(S).",
        "1:14: 'base' takes 2 arguments (structure, width), got 1",
    ),
    "too many arguments": (
        "stable(S) if lean(S, 1).",
        "1:14: 'lean' takes 1 argument (structure), got 2",
    ),
    "arguments where none are": (
        "stable(S) if raining(S).",
        "1:14: 'raining' takes 0 arguments, got 1",
    ),
    "two argument lists": (
        "stable(S) if num_blocks(S, 1; S, 2).",
        "1:14: 'num_blocks(S,1;S,2)' is no literal; write predicate(argument, …)",
    ),
    "unbound": ("stable(S).", f"1:8: nothing says what 'S' ranges over; {UNBOUND}"),
    "unbound under not": (
        "raining. stable(S) if not lean(S).",
        f"1:17: nothing says what 'S' ranges over; {UNBOUND}",
    ),
    "unbound with a prime": (
        "stable(S') if not lean(S').",
        f"1:8: nothing says what 'S'' ranges over; {UNBOUND}",
    ),
    "unbound and anonymous": (
        "stable(_) if raining.",
        f"1:8: nothing says what '_' ranges over; {UNBOUND}",
    ),
    "theory atom": (
        "stable(S) if lean(S), &sum { 1 } > 2.",
        "1:23: '&sum { 1 } > 2' is no condition; write a literal, a comparison, or a count of "
        "literals",
    ),
    "another directive": (
        "#const n = 3.",
        "1:1: found '#const', expected a declaration; did you mean '#action'?",
    ),
    "a misspelt directive": (
        "#statik p.",
        "1:1: found '#statik', expected a declaration; did you mean '#static'?",
    ),
    "sort twice": (
        "#sort num.",
        "1:1: 'num' is declared a second time (first at knowledge.al:2:1); "
        "remove one of the two or rename it",
    ),
    "static twice": (
        "#static lean(structure).",
        "1:1: 'lean' is declared a second time (first at knowledge.al:6:1); "
        "remove one of the two or rename it",
    ),
    "static named as a sort": (
        "#static width(structure).",
        "1:1: 'width' is declared a second time (first at knowledge.al:3:1); "
        "remove one of the two or rename it",
    ),
    "sort without a name": ("#sort.", f"1:1: {FORMS}'#sort.'"),
    "sort with a capital": ("#sort Num.", f"1:1: {FORMS}'#sort Num.'"),
    "sort with nothing behind the sign": ("#sort x = .", f"1:1: {FORMS}'#sort x =.'"),
    "sort of a name": (
        "#sort x = wide.",
        "1:1: sort 'x' is made of 'wide', which is no sort declared above; "
        "did you mean 'width'? (a set of names is written {wide})",
    ),
    "member twice": ("#sort x = {a, b, a}.", "1:1: sort 'x' lists 'a' twice; remove one of them"),
    "member twice by value": (
        "#sort x = {2, 1+1}.",
        "1:1: sort 'x' lists '2' twice; remove one of them",
    ),
    "member with a capital": ("#sort x = {a, Big}.", f"1:1: 'Big' {MEMBER}"),
    "two words for a member": ("#sort x = {very wide, b}.", f"1:1: 'very wide' {MEMBER}"),
    "member left out": ("#sort x = {a, , b}.", f"1:1: '' {MEMBER}"),
    "empty range": ("#sort x = 5..1.", "1:1: sort 'x' has no members; give at least one"),
    "empty set": ("#sort x = { }.", "1:1: sort 'x' has no members; give at least one"),
    "endless range": (
        "#sort x = 1..1000000000.",
        "1:1: sort 'x' would have more than 10000 members (1..1000000000); "
        "axioms are tried with each of them, give a smaller range",
    ),
    "static with a capital": (
        "#static Lean(structure).",
        "1:1: a static is declared as '#static name(sort, sort).', got '#static Lean(structure).'",
    ),
    "static of an unknown sort": (
        "#static tall(strcture).",
        "1:1: 'tall' uses the sort 'strcture', which is not declared above; "
        "did you mean 'structure'?",
    ),
    "foreign letter": (
        "stable(S) if lean(S), größe(S).",
        "1:25: found the character 'ö'; write names with the letters a to z, digits and _, "
        'and any other text between " and "',
    ),
    "control character": (
        "stable(S) if\x00lean(S).",
        "1:13: found the character U+0000; write names with the letters a to z, digits and _, "
        'and any other text between " and "',
    ),
    "control character in text": (
        'stable(S) if base(S, "a\x00b").',
        "1:22: the text that begins here holds U+0000; remove it",
    ),
}


@pytest.mark.parametrize("kind", ERRORS)
def test_every_error_in_full(kind: str) -> None:
    text, expected = ERRORS[kind]
    assert below(text) == expected


def test_an_empty_signature_has_no_name_to_offer() -> None:
    assert refusal("p.") == "knowledge.al:1:1: 'p' is not declared; there are none"


# Places

WRONG = "stable(S) if lean(S), leen(S)."


@pytest.mark.parametrize(
    ("before", "after", "line", "column"),
    [
        ("", "", 1, 23),
        ("% a remark. with a stop.\n", "", 2, 23),
        ("%% été, 50 % – ☂\n%% zwei\n", "", 3, 23),
        ("\n \n\t\n", "", 4, 23),
        ("raining. -raining. ", "\nraining.", 1, 42),
        ("\t", "", 1, 24),
        ("raining.\t\t", "", 1, 33),
        ("%* ü. *% ", "", 1, 32),
        ("%* a\nb. *%", "", 2, 28),
        ('stable(S) if base(S, "très large"). ', "", 1, 59),
        ("\u00a0", "", 1, 24),
    ],
)
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_where_an_error_is(before: str, after: str, line: int, column: int, newline: str) -> None:
    source = (HEADER + before + WRONG + after).replace("\n", newline)
    assert refusal(source) == (
        f"knowledge.al:{line + SHORT - 1}:{column}: 'leen' is not declared; did you mean 'lean'?"
    )


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ('stable(S) if base(S, "très large"), leen(S).', "1:37"),
        ('stable(S) if base(S, "très large"),\n  base(S, "très large"), leen(S).', "2:26"),
        ('stable(S) if base(S, "très large"), base(S, small).', "1:45"),
        ('stable(S) if base(S, "très large"), lean(S, 2).', "1:37"),
        ('stable(S) if base(S, "très large") lean(S).', "1:36"),
        ('stable(S) if base(S, "très large"), not lean(T).', "1:46"),
        ('raining. stable(S) if base(S, "très large"), not lean(T).', "1:55"),
        ("stable(S)\n  if lean(S)\n  % ümlaut\n  and raining.", "4:3"),
        ("stable(S) if %* é *% leen(S).", "1:22"),
        ("default stable(S) if leen(S).", "1:22"),
    ],
)
def test_columns_count_characters(text: str, place: str) -> None:
    """clingo counts bytes, of which 'è' takes two."""
    assert below(text).startswith(f"{place}: ")


def test_the_place_of_an_axiom_is_its_first_character() -> None:
    source = HEADER + "%% é\n  raining.\t-raining. % x\n\n\n %* y\n *% raining\n."
    found = read_knowledge(source).axioms
    assert [(axiom.location.line - SHORT + 1, axiom.location.column) for axiom in found] == [
        (2, 3),
        (2, 12),
        (6, 5),
    ]


# Files


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_a_file_of_any_editor(tmp_path: Path, newline: str, mark: str) -> None:
    text = HEADER + "%% a heading\n\n%% es fällt\nstable(S) if lean(S),\n  not raining.\n"
    path = tmp_path / "own.al"
    path.write_bytes((mark + text.replace("\n", newline)).encode())
    knowledge = read_knowledge_file(path)
    (axiom,) = knowledge.axioms
    assert (str(axiom), axiom.text) == ("stable(S) if lean(S), not raining.", "es fällt")
    assert axiom.location == Location(str(path), SHORT + 3, 1)
    assert knowledge.file == str(path)


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(KnowledgeError) as caught:
        read_knowledge_file(tmp_path / "none.al")
    assert str(caught.value) == (
        f"{tmp_path / 'none.al'}: there is no such file; a domain needs its axioms in knowledge.al"
    )


def test_a_file_that_is_not_text(tmp_path: Path) -> None:
    path = tmp_path / "k.al"
    path.write_bytes(b"#sort \xff.")
    with pytest.raises(KnowledgeError) as caught:
        read_knowledge_file(path)
    assert str(caught.value) == (
        f"{path}: cannot be read as UTF-8 text ('utf-8' codec can't decode byte 0xff in "
        "position 6: invalid start byte)"
    )


def test_errors_name_the_users_file(tmp_path: Path) -> None:
    path = tmp_path / "k.al"
    path.write_text("#sort a.\n\n #sort a.")
    with pytest.raises(KnowledgeError) as caught:
        read_knowledge_file(str(path))
    assert str(caught.value) == (
        f"{path}:3:2: 'a' is declared a second time (first at {path}:1:1); "
        "remove one of the two or rename it"
    )


# Single literals


@pytest.mark.parametrize(
    ("text", "literal"),
    [
        ("stable", Literal("stable", ())),
        ("-stable(S)", Literal("stable", ("S",), positive=False)),
        (" base( S , wide ) ", Literal("base", ("S", "wide"))),
        ('base(S, "a.b")', Literal("base", ("S", '"a.b"'))),
    ],
)
def test_a_literal(text: str, literal: Literal) -> None:
    assert read_literal(text) == literal
    assert read_literal(str(literal)) == literal
    assert literal.complement.complement == literal


@pytest.mark.parametrize(
    "text",
    ["", "not stable(S)", "stable(S), lean(S)", "stable(S). lean(S)", "p if q", "p :- q", "1",
     "p(", "S", "#show p", "größe(S)", "p\x00", "{p}", "p;q", "p % q", "p(1..2)", '"p'],
)  # fmt: skip
def test_what_is_no_literal(text: str) -> None:
    with pytest.raises(KnowledgeError) as caught:
        read_literal(text)
    assert str(caught.value) == (
        f"'{text}' is not a literal; write one such as stable(S) or -stable(S)"
    )


# Whatever is typed

VALID = (
    HEADER
    + """
%% two blocks – größer nicht – stay
stable(S) if num_blocks(S, N), N < 3, not lean(S). % fine
%* block
   comment *% default -stable(S) if base(S, "très large"), raining.
-stable(S) if lean(S), 2 < #count { N : num_blocks(S, N) }, lean(S) : raining; -raining.
"""
)
PIECES = st.one_of(
    st.sampled_from(
        [
            *".,;:(){}[]\"%*'#@&|$~!?_-+/\\<>= \t\n\r\x00\x1b\x85\u2028\u00a0\ufeff",
            *("..", "%%", "%*", "*%", ":-", "if", "not", "default", "#sort", "#static", "é", "☂"),
            *("1..999999999999", "#count", "&sum{1}", "@f(1)", "#true", "S", "_", "-1", "1/0"),
        ]
    ),
    st.characters(codec="utf-8"),
)


@st.composite
def mutations(draw: st.DrawFn) -> str:
    """A valid file with up to four stretches of it left out, doubled or replaced."""
    text = VALID
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(text)))
        end = min(len(text), at + draw(st.integers(0, 12)))
        piece = draw(st.one_of(st.just(""), st.just(text[at:end] * 2), PIECES))
        text = text[:at] + piece + text[end:]
    return text


@given(text=mutations())
@example(text=VALID)
@example(text=VALID.replace("lean(S),", "lean(S), ☂"))
@settings(max_examples=400)
def test_whatever_is_typed_is_read_or_refused_in_one_sentence(text: str) -> None:
    try:
        knowledge = read_knowledge(text)
    except KnowledgeError as problem:
        said = str(problem)
        assert "<string>" not in said
        assert "\n" not in said
        file, line, column, _ = said.split(":", 3)
        assert file == "knowledge.al"
        lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
        assert 1 <= int(line) <= len(lines)
        assert 1 <= int(column) <= len(lines[int(line) - 1]) + 1
    else:
        declared = text.split("stable(S) if")[0]
        assume(declared.startswith(HEADER))
        again = read_knowledge(HEADER + "\n".join(written(knowledge)))
        assert list(map(meaning, again.axioms)) == list(map(meaning, knowledge.axioms))


@given(text=st.text(st.characters(codec="utf-8"), max_size=40))
@settings(max_examples=150)
def test_any_text_is_a_literal_or_is_not(text: str) -> None:
    try:
        literal = read_literal(text)
    except KnowledgeError:
        return
    assert read_literal(str(literal)) == literal
