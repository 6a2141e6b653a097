"""Knowledge revised in dialogue: what is wrong with an answer, proposed, taken and taken back."""
