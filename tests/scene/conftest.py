from user_kinds import install, mark

__all__ = ["install", "mark"]
