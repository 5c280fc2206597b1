"""A journal turning in a bearing at rest: equilibrium, stiffness, damping, flow, stability."""

from exu_press.studies.bearing.coefficients import BearingCoefficients, bearing_coefficients

__all__ = ["BearingCoefficients", "bearing_coefficients"]
