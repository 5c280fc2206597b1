"""Terminal output: texts in columns, and the progress of a long job."""
