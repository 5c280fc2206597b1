"""Reynolds' equation of the long and of the short bearing, integrated without any closed form."""

import numpy as np

POINTS = 20000


def _source(eps, eps_dot, eps_w):
    theta = np.linspace(-np.pi, np.pi, POINTS + 1)  # from the narrowest gap
    gap = 1.0 - eps * np.cos(theta)
    return theta, gap, eps_dot * np.cos(theta) - 0.5 * eps_w * np.sin(theta)


def _running_integral(values, step):
    return np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]))]) * step


def _force(pressure, theta):
    step = theta[1] - theta[0]
    return (
        -12.0 * float(np.sum(pressure[:-1] * np.cos(theta[:-1]))) * step,
        -12.0 * float(np.sum(pressure[:-1] * np.sin(theta[:-1]))) * step,
    )


def _long_pressure(eps, eps_dot, eps_w):
    """Periodic pressure, zero on average across the journal."""
    theta, gap, source = _source(eps, eps_dot, eps_w)
    step = theta[1] - theta[0]
    outflow = _running_integral(source, step)
    mobility = gap**-3
    constant = np.sum((outflow * mobility)[:-1]) / np.sum(mobility[:-1])
    pressure = _running_integral((constant - outflow) * mobility, step)
    quarter = POINTS // 4
    return theta, gap, pressure - 0.5 * (pressure[quarter] + pressure[-1 - quarter])


def long_half_film(eps, eps_dot, eps_w):
    """The positive half of the pressure alone."""
    theta, _, pressure = _long_pressure(eps, eps_dot, eps_w)
    return _force(np.maximum(pressure, 0.0), theta)


def wall_moments(theta, gap, pressure, spin):
    """Shear stress of flow and rotation on the journal's and on the bearing's wall, over P c.

    theta once around; pressure in units of 12 mu R^2 / c^2; spin = omega_J - omega_B.
    """
    pressed = 6.0 * np.trapezoid(gap * np.gradient(pressure, theta), theta)
    sheared = spin * np.trapezoid(1.0 / gap, theta)
    return -sheared - pressed, sheared - pressed


def long_half_film_moments(eps, eps_dot, eps_w, spin):
    """Moments of the half film, the gap full of oil all round."""
    theta, gap, pressure = _long_pressure(eps, eps_dot, eps_w)
    return wall_moments(theta, gap, np.maximum(pressure, 0.0), spin)


def long_full_film_moments(eps, eps_w, spin):
    """Moments of Sommerfeld's film under rotation, which pulls as much as it pushes."""
    return wall_moments(*_long_pressure(eps, 0.0, eps_w), spin)


def short_half_film(eps, eps_dot, eps_w, length_to_diameter):
    """Axial flow alone: a parabola along the bearing wherever the gap feeds it."""
    theta, gap, source = _source(eps, eps_dot, eps_w)
    mean_pressure = length_to_diameter**2 * source / (3.0 * gap**3)
    return _force(np.maximum(mean_pressure, 0.0), theta)
