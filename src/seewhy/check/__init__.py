"""What `seewhy check` looks for, over everything below."""
