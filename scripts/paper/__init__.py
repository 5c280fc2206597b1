"""The paper's section 5, number by number, and what moves each number: scripts/paper.py."""
