"""Solution verification: the errors of a run's figures, and chaotic motion."""
