"""Pictures of `exu-press paper`: one for each of the paper's figures, and what explains them."""

from exu_press.plots.paper.save import save_paper

__all__ = ["save_paper"]
