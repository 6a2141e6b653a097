"""Pictures of justifications and trees, and the report of a model: files that need no network."""
