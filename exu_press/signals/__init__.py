"""Signals and states over many revolutions: cells, spectra, periods, exponents; arrays only."""
