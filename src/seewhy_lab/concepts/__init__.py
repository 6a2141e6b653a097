"""Concepts about several things, and what learns them from scenes."""
