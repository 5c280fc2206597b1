"""One picture for each of the paper's figures, and what explains them."""
