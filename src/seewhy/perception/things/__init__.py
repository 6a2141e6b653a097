"""Several things in one picture: where they are, what each is, what holds between two."""
