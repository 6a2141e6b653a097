"""A walk through the studio as a person would go, with a browser, counted and timed."""
