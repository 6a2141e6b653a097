"""What must have happened unseen, and what is believed by now."""
