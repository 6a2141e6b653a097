"""Networks that have seen millions of pictures before, one entry a family."""

from seewhy.perception.backbones.registry import (
    EMBEDDED,
    NONE,
    load_backbone,
    require_backbone,
    sides_of,
)

__all__ = ["EMBEDDED", "NONE", "load_backbone", "require_backbone", "sides_of"]
