"""Tables as people save them: read where it is plain, else refused with line and remedy."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from seewhy.data.table import read_table
from seewhy.errors import DatasetError

KNOWN = ("image", "class", "colour", "split", "group")
OPTIONAL = ("split", "group")
PLAIN = "image,class,colour\na.png,good,red\nb.png,bad,\n"
CELLS = [("a.png", "good", "red"), ("b.png", "bad", "")]


def saved(tmp_path: Path, content: str | bytes) -> Path:
    file = tmp_path / "scenes.csv"
    file.write_bytes(content.encode() if isinstance(content, str) else content)
    return file


def cells(tmp_path: Path, content: str | bytes) -> list[tuple[str, ...]]:
    table = read_table(saved(tmp_path, content), known=KNOWN, optional=OPTIONAL)
    return [row.cells for row in table.rows]


def refused(tmp_path: Path, content: str | bytes) -> str:
    with pytest.raises(DatasetError) as problem:
        cells(tmp_path, content)
    return str(problem.value).replace(f"{tmp_path}/", "")


@pytest.mark.parametrize(
    "content",
    [
        PLAIN,
        PLAIN.replace(",", ";"),
        PLAIN.replace(",", "\t"),
        PLAIN.replace(",", "|"),
        PLAIN.replace("\n", "\r\n"),
        PLAIN.replace("\n", "\r"),
        PLAIN.rstrip("\n"),
        "sep=;\r\n" + PLAIN.replace(",", ";"),
        "sep=,\n" + PLAIN,
        '"sep=;"\n' + PLAIN.replace(",", ";"),
        "SEP=\t\n" + PLAIN.replace(",", "\t"),
        "\n\n" + PLAIN + "\n\n",
        ",,,\n" + PLAIN + ",,\n , \n",
        "image,class,colour,,\na.png,good,red,,\nb.png,bad,,,\n,,,,\n",
        " image , class\t, colour \n a.png, good ,red\nb.png ,bad,\n",
        '"image","class","colour"\n"a.png","good","red"\n"b.png","bad",""\n',
        'image,class,colour\n"a.png" , "good" ,"red" \nb.png,bad,""\n',
        PLAIN.encode("utf-8-sig"),
        PLAIN.encode("utf-16"),
        PLAIN.encode("utf-16-be").join([b"\xfe\xff", b""]),
        PLAIN.encode("utf-32"),
    ],
)
def test_what_is_plain_is_read(tmp_path: Path, content: str | bytes) -> None:
    assert cells(tmp_path, content) == CELLS


def test_separators_in_quotes_are_part_of_a_cell(tmp_path: Path) -> None:
    text = 'image;class;colour\n"one; two.png";good;"say ""red"""\na, b.png;bad;\n'
    assert cells(tmp_path, text) == [
        ("one; two.png", "good", 'say "red"'),
        ("a, b.png", "bad", ""),
    ]


def test_a_table_of_one_column_has_no_separator(tmp_path: Path) -> None:
    assert cells(tmp_path, "image\na.png\nb;c.png\n") == [("a.png",), ("b;c.png",)]


def test_names_with_line_ends_of_other_alphabets_are_one_cell(tmp_path: Path) -> None:
    """A text editor ends no line at these characters, nor does a table."""
    names = ["a\x0b.png", "b\x0c.png", "c\x85.png", "d\u2028.png", "e\x1e.png"]
    text = "image,class\n" + "".join(f"{name},good\n" for name in names)
    file = saved(tmp_path, text)
    rows = read_table(file, known=KNOWN).rows
    assert [row.cells[0] for row in rows] == names
    assert [row.line for row in rows] == [2, 3, 4, 5, 6]


def test_lines_are_counted_as_an_editor_counts_them(tmp_path: Path) -> None:
    text = 'sep=,\n\nimage,class\na.png,good\n\n"b\n.png",bad\n\nc.png,good\n'
    table = read_table(saved(tmp_path, text), known=KNOWN)
    assert table.line == 3
    assert [row.line for row in table.rows] == [4, 6, 9]


def test_columns_at_the_end_may_be_missing_where_they_are_optional(tmp_path: Path) -> None:
    text = "image,class,split,group\na.png,good\nb.png,good,test\nc.png,good,,one\n"
    assert cells(tmp_path, text) == [
        ("a.png", "good"),
        ("b.png", "good", "test"),
        ("c.png", "good", "", "one"),
    ]


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (
            PLAIN + "c.png;good;red\n",
            "scenes.csv:4: the cells of line 4 are separated by ; and those of line 1 by ,; use "
            "one of them in the whole table",
        ),
        (
            PLAIN.replace(",", ";") + "c.png\tgood\tred\n",
            "scenes.csv:4: the cells of line 4 are separated by tabs and those of line 1 by ;; use "
            "one of them in the whole table",
        ),
        (
            "image,split\na.png;train\n",
            "scenes.csv:2: the cells of line 2 are separated by ; and those of line 1 by ,; use "
            "one of them in the whole table",
        ),
        (
            "image,class;colour\na.png,good;red\n",
            "scenes.csv:1: the columns are separated by , and by ;; use one of them in the whole "
            "table",
        ),
        (
            "sep=;\n" + PLAIN,
            "scenes.csv:2: line 1 says that cells are separated by ;, and those of line 2 are "
            "separated by ,; remove line 1",
        ),
        (
            PLAIN + "c.png,good\n",
            "scenes.csv:4: the row has 2 of 3 cells; add what is missing up to 'colour', an empty "
            "cell where nothing is known",
        ),
        (
            "image,class,split,colour\na.png,good,train\n",
            "scenes.csv:2: the row has 3 of 4 cells; add what is missing up to 'colour', an empty "
            "cell where nothing is known",
        ),
        (
            PLAIN + "c.png,good,red,new\n",
            "scenes.csv:4: the row has more cells than there are columns; remove some, or put a "
            'cell that has a , in it in "quotes"',
        ),
        (
            PLAIN.replace(",", "\t") + "c.png\tgood\tred\tnew\n",
            "scenes.csv:4: the row has more cells than there are columns; remove some, or put a "
            'cell that has a tab in it in "quotes"',
        ),
        (
            'image,class,colour\n"a.png,good,red\nb.png,bad,\n',
            "scenes.csv:2: a quote is opened in line 2 and not closed there; close it, or write "
            '"" for a quote that belongs to the cell',
        ),
        (
            PLAIN + '"c.png,good,red\nd.png,good,red\n"e.png",good,red\n',
            "scenes.csv:4: a quote is opened in line 4 and not closed there; close it, or write "
            '"" for a quote that belongs to the cell',
        ),
        (
            PLAIN + '"c.png,good,red\n' + "d.png,good,red\n" * 20_000,
            "scenes.csv:4: a quote is opened in line 4 and not closed there; close it, or write "
            '"" for a quote that belongs to the cell',
        ),
        (
            PLAIN + '"c"d.png,good,red\n',
            'scenes.csv:4: a quote is closed in the midst of a cell; write "" for a quote that '
            "belongs to the cell",
        ),
        (
            PLAIN + "c.png,go\0od,red\n",
            "scenes.csv:4: has a NUL byte, which no text has; the file is damaged, save the table "
            "as CSV again",
        ),
        (
            PLAIN.encode() + b"c.png,good,r\xf6t\n",
            "scenes.csv:4: is not UTF-8 text (byte 0xf6); save the table as CSV in UTF-8",
        ),
        (
            PLAIN.encode("utf-16-le"),
            "scenes.csv: is UTF-16 without the mark of its byte order; save the table as CSV in "
            "UTF-8",
        ),
        (
            PLAIN.encode("utf-16")[:-1],
            "scenes.csv: is damaged or cut short: not all of it is UTF-16; save the table as CSV "
            "in UTF-8",
        ),
        (
            b"PK\x03\x04" + b"\0" * 40,
            "scenes.csv: is a workbook or an archive, no text; save the table as CSV in UTF-8",
        ),
        (
            b"\xd0\xcf\x11\xe0" + b"\0" * 40,
            "scenes.csv: is a workbook, no text; save the table as CSV in UTF-8",
        ),
        (
            "",
            "scenes.csv:1: the table is empty; its first line names the columns image, class, "
            "colour, split, group",
        ),
        (
            "\n ,;\n",
            "scenes.csv:1: the table is empty; its first line names the columns image, class, "
            "colour, split, group",
        ),
    ],
)
def test_what_is_not_plain_is_named_with_its_line(
    tmp_path: Path, content: str | bytes, expected: str
) -> None:
    assert refused(tmp_path, content) == expected


words = st.text(
    st.characters(codec="utf-8", exclude_categories=["Cc", "Cs"]), min_size=1, max_size=8
).map(str.strip)


@given(
    rows=st.lists(st.tuples(words, words, words), min_size=1, max_size=6),
    separator=st.sampled_from(",;\t|"),
    quoting=st.sampled_from([csv.QUOTE_MINIMAL, csv.QUOTE_ALL]),
    ending=st.sampled_from(["\n", "\r\n", "\r"]),
    encoding=st.sampled_from(["utf-8", "utf-8-sig", "utf-16"]),
)
def test_what_a_program_writes_is_read_as_it_was(
    tmp_path_factory: pytest.TempPathFactory,
    rows: list[tuple[str, str, str]],
    separator: str,
    quoting: int,
    ending: str,
    encoding: str,
) -> None:
    text = io.StringIO()
    writer = csv.writer(text, delimiter=separator, quoting=quoting, lineterminator=ending)  # type: ignore[arg-type]
    writer.writerows([("image", "class", "colour"), *rows])
    file = saved(tmp_path_factory.mktemp("tables"), text.getvalue().encode(encoding))
    table = read_table(file, known=KNOWN)
    assert table.separator == separator
    assert [row.cells for row in table.rows] == [row for row in rows if any(row)]


def test_what_is_in_quotes_stays_as_it_is(tmp_path: Path) -> None:
    text = 'image,class\n"a"" ,b.png",good\n'
    assert cells(tmp_path, text) == [('a" ,b.png', "good")]
