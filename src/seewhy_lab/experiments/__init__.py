"""The paper's evaluation: every experiment by one command, resumable, with its statistics."""
