"""Labelling by hand: what is proposed, what follows, and which picture is worth most."""
