"""Installed packages, and a check that they work."""
