"""Shortest plans, and what makes looking for them fast."""
