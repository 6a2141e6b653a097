"""Datasets from the labels that people have: class folders, exports of labelling tools, tables."""

from seewhy.data.importers.annotation import Note
from seewhy.data.importers.formats import FORMATS
from seewhy.data.importers.importing import ImportRequest, read_source
from seewhy.data.importers.writing import ImportedDataset, import_pictures

__all__ = [
    "FORMATS",
    "ImportRequest",
    "ImportedDataset",
    "Note",
    "import_pictures",
    "read_source",
]
