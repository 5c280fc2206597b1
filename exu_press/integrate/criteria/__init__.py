"""What one step misses: one criterion a class, with its equation."""
