"""Runs the scripts of a checkout of Exudyn, and says how far they are off."""
