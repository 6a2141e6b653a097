"""An agent for pictures of several things: what it learns, sees, reads and says of them."""
