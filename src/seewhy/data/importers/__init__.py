"""Datasets from the labels that people have: class folders, exports of labelling tools, tables."""

from seewhy.data.annotation_formats import FORMATS
from seewhy.data.importers.annotation import Note
from seewhy.data.importers.imported import ImportedDataset
from seewhy.data.importers.reading import read_source
from seewhy.data.importers.request import ImportRequest
from seewhy.data.importers.writing import import_pictures

__all__ = [
    "FORMATS",
    "ImportRequest",
    "ImportedDataset",
    "Note",
    "import_pictures",
    "read_source",
]
