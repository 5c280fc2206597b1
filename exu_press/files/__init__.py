"""Files that a user names, and directories for results."""
