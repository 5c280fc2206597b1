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


def long_half_film(eps, eps_dot, eps_w):
    """Periodic pressure, zero on average across the journal, its positive half alone."""
    theta, gap, source = _source(eps, eps_dot, eps_w)
    step = theta[1] - theta[0]
    outflow = _running_integral(source, step)
    mobility = gap**-3
    constant = np.sum((outflow * mobility)[:-1]) / np.sum(mobility[:-1])
    pressure = _running_integral((constant - outflow) * mobility, step)
    quarter = POINTS // 4
    pressure -= 0.5 * (pressure[quarter] + pressure[-1 - quarter])
    return _force(np.maximum(pressure, 0.0), theta)


def short_half_film(eps, eps_dot, eps_w, length_to_diameter):
    """Axial flow alone: a parabola along the bearing wherever the gap feeds it."""
    theta, gap, source = _source(eps, eps_dot, eps_w)
    mean_pressure = length_to_diameter**2 * source / (3.0 * gap**3)
    return _force(np.maximum(mean_pressure, 0.0), theta)
