"""Where the pictures of the bundled domains come from."""
