"""Many pictures become a table: classes, probabilities and reasons, a row a picture."""

from __future__ import annotations

from seewhy.classifying.pictures import ClassifiedPicture, classify_pictures
from seewhy.classifying.running import Classified, classify_to_table

__all__ = ["Classified", "ClassifiedPicture", "classify_pictures", "classify_to_table"]
