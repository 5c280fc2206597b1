"""Numerical methods shared by laws, quantities and the start of a run."""
