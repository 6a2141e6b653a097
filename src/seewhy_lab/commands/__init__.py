"""Measurements, each a command: `python -m seewhy_lab NAME`."""
