"""Features that follow from the class: from a table, or from the parts of the classes' names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from seewhy.data.importers.column_words import CLASS_WORDS, column_like
from seewhy.data.importers.folder_files import FolderFiles
from seewhy.data.importers.names import same_words, valid_name
from seewhy.data.importers.tables import Row, open_table
from seewhy.data.importers.yes_or_no import yes_or_no
from seewhy.errors import DatasetError
from seewhy.text.nearest import did_you_mean, nearest

_SURE_WORDS = 7
"""So many of the words for a class mean nothing else; later ones may name a feature."""

_ALIKE = 82.0  # of 100, see rapidfuzz's ratio: two letters of six changed places are 83
_LONG = 4

_CROSSES = frozenset({"x", "yes", "y", "1", "true", "✓", "✔", "*"})


@dataclass(frozen=True)
class ClassFeatures:
    """Class → feature → value, in the words of whoever wrote them.

    Attributes
    ----------
    features : tuple of str
        In the order of the table.
    values : mapping
        Class → feature → value; a value that nobody said is left out.
    said : str
        Where it stands, for a sentence to the user.
    """

    features: tuple[str, ...]
    values: Mapping[str, Mapping[str, str]]
    said: str

    def of(self, class_name: str) -> Mapping[str, str] | None:
        """Return the features of a class, however it is spelt; None where no row is of it."""
        if class_name in self.values:
            return self.values[class_name]
        for like in (same_words, valid_name, _as_number):
            wanted = like(class_name)
            for name, values in self.values.items():
                if wanted and like(name) == wanted:
                    return values
        return None

    def for_classes(self, classes: Iterable[str]) -> ClassFeatures:
        """Return the same for just these classes, spelt so.

        Raises
        ------
        DatasetError
            If no row is of one of them; the text gives the nearest class of the table.
        """
        found: dict[str, Mapping[str, str]] = {}
        lacking: list[str] = []
        for name in classes:
            values = self.of(name)
            if values is None:
                lacking.append(name)
            else:
                found[name] = values
        if lacking:
            others = f" (nor those of {len(lacking) - 1} others)" if len(lacking) > 1 else ""
            raise DatasetError(
                f"{self.said}: no row says the features of the class '{lacking[0]}'{others}; "
                f"{did_you_mean(lacking[0], self.values)}"
            )
        return replace(self, values=found)


def read_class_features(path: Path | str, classes: Collection[str] = ()) -> ClassFeatures:
    """Read a table with a row a class: a column that names it, and a column a feature.

    The class is in the column in which most of ``classes`` stand; where none does, in the one
    called class (label, category, …), or in the first. In a column that has nothing but crosses
    (x, yes, 1) and empty cells, empty means no; in others it means that nobody knows.

    Raises
    ------
    DatasetError
        If it is no such table, or has two rows for one class.

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "fingers.csv"
    >>> _ = path.write_text("class,thumb,index\\n0,,no\\n1,x,yes\\n")
    >>> read_class_features(path).of("1")
    {'thumb': 'yes', 'index': 'yes'}
    """
    path = Path(path)
    if not path.is_file():
        raise DatasetError(f"{path}: there is no such file; it says the features of every class")
    with open_table(FolderFiles(path.parent), path.name) as table:
        columns, rows = table.columns, list(table.rows)
    if not rows:
        raise DatasetError(f"{path}: the table has no rows; add one per class")
    label = _label_column(columns, rows, classes)
    features = tuple(column for column in columns if column != label)
    if not features:
        raise DatasetError(
            f"{path}: has the column '{label}' alone; add a column for every feature"
        )
    crossed = {feature for feature in features if _is_crossed(rows, feature)}
    # What means yes and no is told by the whole table, whichever classes are shown.
    means = {feature: yes_or_no(_cells(rows, feature)) or {} for feature in features}
    values: dict[str, dict[str, str]] = {}
    for row in rows:
        name = row.cells[label]
        if not name:
            raise DatasetError(f"{row.place}: the cell '{label}' is empty; name the class")
        if name in values:
            raise DatasetError(
                f"{row.place}: the class '{name}' stands a second time; remove one of the rows"
            )
        values[name] = {
            feature: ("yes" if row.cells[feature] else "no")
            if feature in crossed
            else means[feature].get(row.cells[feature], row.cells[feature])
            for feature in features
            if row.cells[feature] or feature in crossed
        }
    return ClassFeatures(features, values, str(path))


def doubtful_values(said: ClassFeatures) -> list[str]:
    """Say which values are perhaps another one, spelt wrongly: in one row alone, and nearly alike.

    Examples
    --------
    >>> rows = {str(n): {"index": "stretched"} for n in range(3)} | {"8": {"index": "streched"}}
    >>> doubtful_values(ClassFeatures(("index",), rows, "fingers.csv"))
    ["fingers.csv: 'streched' of 'index' is the value of 8 alone; is 'stretched' meant?"]
    >>> rows = {str(n): {"thumb": "folded"} for n in range(3)} | {"9": {"thumb": "fodled"}}
    >>> doubtful_values(ClassFeatures(("thumb",), rows, "fingers.csv"))
    ["fingers.csv: 'fodled' of 'thumb' is the value of 9 alone; is 'folded' meant?"]
    """
    found = []
    for feature in said.features:
        rows = {name: row[feature] for name, row in said.values.items() if feature in row}
        counts = Counter(rows.values())
        usual = [value for value, count in counts.items() if count > 1]
        for name, value in rows.items():
            meant = nearest(value, usual, at_least=_ALIKE) if counts[value] == 1 else None
            # Numbers, and words of two or three letters, are alike by chance.
            if meant is not None and len(value) >= _LONG and value.isalpha():
                found.append(
                    f"{said.said}: '{value}' of '{feature}' is the value of {name} alone; is "
                    f"'{meant}' meant?"
                )
    return found


def _label_column(columns: Sequence[str], rows: Sequence[Row], classes: Collection[str]) -> str:
    wanted = {valid_name(name) for name in classes}
    named = {
        column: len(wanted & {valid_name(row.cells[column]) for row in rows}) for column in columns
    }
    usual = column_like(columns, CLASS_WORDS[:_SURE_WORDS])
    most = max(named.values())
    if most and named.get(usual or "", 0) < most:
        return next(column for column in columns if named[column] == most)
    return usual or columns[0]


def _cells(rows: Sequence[Row], feature: str) -> set[str]:
    return {row.cells[feature] for row in rows if row.cells[feature]}


def _is_crossed(rows: Sequence[Row], feature: str) -> bool:
    cells = {row.cells[feature].casefold() for row in rows}
    return "" in cells and len(cells) == 2 and cells - {""} <= _CROSSES


def features_of_parts(pattern: str, classes: Sequence[str]) -> ClassFeatures:
    """Return features that the classes' names are made of, as a pattern divides them.

    Of a part that occurs in the singular and in the plural, both are the same value.

    Raises
    ------
    DatasetError
        If the pattern names no parts, or a class does not fit it.

    Examples
    --------
    >>> features_of_parts("number-shape", ["1-oval", "2-ovals"]).values
    {'1-oval': {'number': '1', 'shape': 'oval'}, '2-ovals': {'number': '2', 'shape': 'oval'}}
    """
    parts = re.findall(r"[A-Za-z]+", pattern)
    between = re.split(r"[A-Za-z]+", pattern)
    if len(parts) < 2 or len(set(parts)) < len(parts) or not all(between[1:-1]):
        raise DatasetError(
            f"'{pattern}' does not divide the names of classes; write what their parts are, with "
            "what stands between them, such as number-colour-shape"
        )
    expression = re.escape(between[0]) + "".join(
        f"(.+?){re.escape(after)}" for after in between[1:]
    )
    values: dict[str, dict[str, str]] = {}
    for name in classes:
        found = re.fullmatch(expression, name)
        if found is None:
            raise DatasetError(
                f"the class '{name}' is not made as '{pattern}' says; correct the pattern, or give "
                "a table of the classes' features with --features"
            )
        values[name] = dict(zip(parts, (part.strip() for part in found.groups()), strict=True))
    for part in parts:
        singular = _singulars({parts_of_class[part] for parts_of_class in values.values()})
        for parts_of_class in values.values():
            parts_of_class[part] = singular.get(parts_of_class[part], parts_of_class[part])
    return ClassFeatures(tuple(parts), values, f"the pattern {pattern}")


def _singulars(words: set[str]) -> dict[str, str]:
    """Plural → singular, for the words that occur in both."""
    found: dict[str, str] = {}
    for word in words:
        for singular in (word.removesuffix("s"), word.removesuffix("es")):
            if singular != word and singular in words:
                found[word] = singular
        if word.endswith("ies") and f"{word[:-3]}y" in words:
            found[word] = f"{word[:-3]}y"
    return found


def _as_number(text: str) -> str:
    return str(int(text)) if text.strip().isascii() and text.strip().isdigit() else ""
