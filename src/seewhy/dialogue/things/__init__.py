"""Questions about the things in a picture: read, answered with reasons, contrasted."""
