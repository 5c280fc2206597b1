"""What a terminal shows: texts in columns, and how far a long job is."""
