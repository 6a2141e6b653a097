"""Texts: the nearest name, names of strangers, templates with slots."""
