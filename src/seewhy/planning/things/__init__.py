"""Planning about the things of a picture: what they are, what is said of them, what is asked."""
