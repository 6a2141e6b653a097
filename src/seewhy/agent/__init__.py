"""Agent, and beside it what it couples: fitting, seeing, deciding, answering, the model on disk."""
