"""Random scenes, each against much finer runs: do the stated errors cover the true ones?"""
