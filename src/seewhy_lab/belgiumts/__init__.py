"""BelgiumTS: the photographs of Belgian traffic signs, read from their official archives."""
