"""What `exudyn_examples.py` does with each of Exudyn's own scripts."""
