"""Traffic signs of Belgium: what they look like, what they mean, and drawn pictures of them."""
