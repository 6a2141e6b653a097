"""A robot that stacks boxes: a folder that plans, and knows of no pictures."""

from __future__ import annotations

from pathlib import Path

__all__ = ["TOWER"]

TOWER = Path(__file__).parent / "tower_building"
