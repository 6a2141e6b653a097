"""A domain: a folder that a user writes, read, checked and worded."""
