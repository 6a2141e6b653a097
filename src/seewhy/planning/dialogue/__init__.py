"""Questions about a run, in words, and answers with their reasons."""
