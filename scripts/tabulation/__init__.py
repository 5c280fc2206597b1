"""Solutions of Reynolds' equation that the tables of film laws are made of."""
