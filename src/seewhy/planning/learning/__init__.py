"""Learn from the record of earlier runs what is usually so at first, and what does not work."""
