"""Knowledge about several things in a picture, revised in dialogue."""
