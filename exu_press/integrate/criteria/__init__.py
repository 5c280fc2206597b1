"""The local error of a step: one criterion a class, with its equation."""
