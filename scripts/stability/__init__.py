"""Four hundred stiff and extreme scenes: scripts/stability.py."""
