"""XML that others wrote, read without entities, external files or other surprises."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import IO
from xml.etree.ElementTree import Element

from seewhy.data.importers.source_files import DamagedFileError, SourceFiles, read_bytes

_LARGEST_DOCUMENT = 64 * 2**20
_PROLOG = re.compile(rb"<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^>\[]*(\[.*?\])?[^>]*>", re.DOTALL)
_ROOT = re.compile(rb"\s*<([A-Za-z_][\w.:-]*)")


def root_tag(files: SourceFiles, name: str) -> str:
    """Return the name of a document's first element; empty where it is no XML."""
    try:
        with files.open(name) as stream:
            head = stream.read(4096)
    except DamagedFileError:
        return ""
    found = _ROOT.match(_PROLOG.sub(b"", head.removeprefix(b"\xef\xbb\xbf")))
    return found.group(1).decode("ascii") if found else ""


def read_document(files: SourceFiles, name: str) -> Element:
    """Return the first element of a small document.

    Raises
    ------
    DamagedFileError
        If it is no XML, or declares a document type or entities.
    """
    from xml.etree.ElementTree import ParseError

    from defusedxml import DefusedXmlException
    from defusedxml.ElementTree import fromstring

    try:
        root: Element = fromstring(read_bytes(files, name, most=_LARGEST_DOCUMENT), forbid_dtd=True)
    except ParseError as problem:
        raise _damaged(files.said(name), problem) from None
    except DefusedXmlException:
        raise _unsafe(files.said(name)) from None
    except (ValueError, LookupError) as problem:
        raise _invalid(files.said(name), problem) from None
    return root


def elements(files: SourceFiles, name: str) -> Iterator[Element]:
    """Yield the elements below the first one of a large document, each of them once, whole.

    Raises
    ------
    DamagedFileError
        As :func:`read_document`.
    """
    from xml.etree.ElementTree import ParseError

    from defusedxml import DefusedXmlException
    from defusedxml.ElementTree import iterparse

    with files.open(name) as stream:
        parsed: IO[bytes] = stream
        depth = 0
        root: Element | None = None
        try:
            for event, element in iterparse(parsed, events=("start", "end"), forbid_dtd=True):
                if event == "start":
                    root = root if root is not None else element
                    depth += 1
                    continue
                depth -= 1
                if depth == 1:
                    yield element
                    if root is not None:
                        root.clear()  # what was seen does not stay in memory
        except ParseError as problem:
            raise _damaged(files.said(name), problem) from None
        except DefusedXmlException:
            raise _unsafe(files.said(name)) from None
        except LookupError as problem:  # an encoding that does not exist
            raise _invalid(files.said(name), problem) from None


def text_of(element: Element, path: str) -> str:
    """Return the text of a part of an element, without blanks around; empty where there is none.

    Examples
    --------
    >>> from xml.etree.ElementTree import fromstring
    >>> text_of(fromstring("<size><width> 40 </width></size>"), "width")
    '40'
    """
    return (element.findtext(path) or "").strip()


def number_of(element: Element, path: str) -> float | None:
    """Return the number in a part of an element, or None where there is none.

    Examples
    --------
    >>> from xml.etree.ElementTree import fromstring
    >>> number_of(fromstring("<size><width>40</width></size>"), "width")
    40.0
    """
    return as_number(text_of(element, path))


def as_number(text: str) -> float | None:
    """Return a text as a finite number of reasonable size, or None.

    Examples
    --------
    >>> as_number("2.5"), as_number("wide"), as_number("inf")
    (2.5, None, None)
    """
    try:
        number = float(text)
    except ValueError:
        return None
    return number if abs(number) <= 1e7 else None


def _damaged(said: str, problem: SyntaxError) -> DamagedFileError:
    line, column = getattr(problem, "position", (1, 0))
    what = str(problem).split(":")[0]
    return DamagedFileError(
        f"{said}:{line}:{column + 1}: is no valid XML ({what}); export it again"
    )


def _invalid(said: str, problem: Exception) -> DamagedFileError:
    return DamagedFileError(f"{said}: is no valid XML ({problem}); export it again")


def _unsafe(said: str) -> DamagedFileError:
    return DamagedFileError(
        f"{said}: declares a document type or entities, which are not read; remove the "
        "declaration or export it again"
    )
