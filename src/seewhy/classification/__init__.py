"""Many pictures become a table: classes, probabilities and reasons, a row a picture."""

from __future__ import annotations

from seewhy.classification.pictures import ClassifiedPicture, classify_pictures
from seewhy.classification.running import Classified, classify_to_table

__all__ = ["Classified", "ClassifiedPicture", "classify_pictures", "classify_to_table"]
