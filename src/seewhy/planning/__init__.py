"""Plans, diagnoses and execution with a domain's knowledge about change."""
