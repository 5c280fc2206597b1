"""Error against run time of shipped scenes beside other solvers: scripts/precision.py."""
