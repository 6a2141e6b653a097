"""The web application: a model answers over HTTP."""
