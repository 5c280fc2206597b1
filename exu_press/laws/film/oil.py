"""Viscosity of an oil over temperature and pressure, and the temperature of a film."""

import math
from collections.abc import Callable

__all__ = ["HOTTEST", "STEADY", "film_temperature", "roelands", "walther"]

SHIFT = 0.7
"""mm^2/s, of ASTM D341 for kinematic viscosities above 2 mm^2/s."""

KELVIN = 273.15

HOTTEST = 250.0
"""deg C, above which no mineral oil is used: it cracks, and burns."""

STEADY = 0.5
"""K, within which a film has found its temperature."""


def walther(
    temperature: float, first: tuple[float, float], second: tuple[float, float]
) -> tuple[float, float]:
    r"""Return an oil's kinematic viscosity from two of its data sheet, and its derivative.

    .. math::
        \log_{10} \log_{10} (\nu + 0.7) = A - B \log_{10} T

    with nu in mm^2/s and T in K; A and B follow from the two points.

    Parameters
    ----------
    temperature : [deg C]
    first : temperature [deg C] and kinematic viscosity [mm^2/s] of a point
    second : the same of another one, warmer and thinner

    Returns
    -------
    nu [mm^2/s] and d nu/d T [mm^2/(s K)].

    Notes
    -----
    Range: between the pour point and about 150 deg C, from 2 to 2e7 mm^2/s. Times the density in
    kg/m^3 and 1e-6 it is the dynamic viscosity in Pa s.

    Examples
    --------
    An oil of 30 mm^2/s at 40 deg C and 5.23 at 100 deg C has at 60 deg C

    >>> round(walther(60.0, (40.0, 30.0), (100.0, 5.23))[0], 1)
    14.4

    References
    ----------
    .. [1] ASTM D341-20. Standard practice for viscosity-temperature equations and charts for liquid
       petroleum or hydrocarbon products.
    """
    slopes = [math.log10(math.log10(nu + SHIFT)) for _, nu in (first, second)]
    logs = [math.log10(t + KELVIN) for t, _ in (first, second)]
    b = (slopes[0] - slopes[1]) / (logs[1] - logs[0])
    kelvin = temperature + KELVIN
    inner = 10.0 ** (slopes[0] - b * (math.log10(kelvin) - logs[0]))
    shifted = 10.0**inner
    return shifted - SHIFT, -shifted * math.log(10.0) * inner * b / kelvin


def roelands(viscosity: float, coefficient: float, pressure: float) -> tuple[float, float]:
    r"""Return the viscosity under pressure, and its derivative.

    .. math::
        \eta = \eta_0 \exp\left[(\ln \eta_0 + 9.67)
        \left(\left(1 + p / p_0\right)^Z - 1\right)\right], \quad
        Z = \frac{\alpha p_0}{\ln \eta_0 + 9.67}

    with p_0 = 0.196 GPa. Z is such that the derivative without pressure is Barus', alpha eta_0.

    Parameters
    ----------
    viscosity : eta_0 without pressure [Pa s], above 6.4e-5
    coefficient : alpha [1/Pa]
    pressure : p [Pa], not negative

    Returns
    -------
    eta [Pa s] and d eta/d p [s].

    Notes
    -----
    Range: up to about 1 GPa.

    Examples
    --------
    >>> round(roelands(0.1, 2e-8, 5e8)[0], 1)  # Barus' law gives 2203
    120.2

    References
    ----------
    .. [1] Roelands, C. J. A. Correlational aspects of the viscosity-temperature-pressure
       relationship of lubricating oils. Thesis, Delft, 1966.
    """
    reference, above = 1.96e8, math.log(viscosity) + 9.67
    z = coefficient * reference / above
    ratio = 1.0 + pressure / reference
    viscosity_under_pressure = viscosity * math.exp(above * (ratio**z - 1.0))
    return viscosity_under_pressure, viscosity_under_pressure * coefficient * ratio ** (z - 1.0)


def film_temperature(
    power: float,
    carried: float,
    conducted: float,
    supply: float,
    frame: float,
    thinning: Callable[[float], float],
) -> float:
    r"""Return the temperature at which a film gets rid of its heat.

    .. math::
        P\, \frac{\eta(T)}{\eta_0} = \rho c\, Q\, (T - T_s) + G\, (T - T_f)

    The journal's motion is held: with it the dissipation is in proportion to the viscosity, and the
    side flow Q does not depend on it. The oil in the film has one temperature, with which it leaves
    the ends.

    Parameters
    ----------
    power : P, dissipated at the viscosity eta_0 [W], not negative
    carried : rho c Q, of the side flow [W/K], not negative
    conducted : G, to the frame [W/K], not negative
    supply : T_s of the oil that enters [deg C]
    frame : T_f [deg C]
    thinning : T [deg C] -> eta(T) / eta_0, falling

    Returns
    -------
    T [deg C]; infinity where the film is above `HOTTEST` then, as oil does not stand it.

    Notes
    -----
    A side flow at the film's temperature is Raimondi and Boyd's, whose oil leaves the ends with the
    mean of inlet and outlet. DIN 31652 lets it leave with the outlet's: its rise is half of this
    one, where nothing is conducted.

    Examples
    --------
    100 W at 40 deg C, 10 W/K, and an oil that loses half of its viscosity in 20 K:

    >>> round(film_temperature(100.0, 6.0, 4.0, 40.0, 40.0, lambda t: 0.5 ** ((t - 40) / 20)), 2)
    47.67

    References
    ----------
    .. [1] Raimondi, A. A., and J. Boyd. "A Solution for the Finite Journal Bearing and Its
       Application to Analysis and Design." ASLE Trans. 1 (1958): 159-209.
    .. [2] DIN 31652-1:2017. Hydrodynamic plain journal bearings under steady-state conditions.
    """

    def missing(temperature: float) -> float:
        off = carried * (temperature - supply) + conducted * (temperature - frame)
        return power * thinning(temperature) - off

    low = min(supply, frame) if conducted else supply
    if missing(low) <= 0.0:  # nothing is dissipated
        return low
    if missing(HOTTEST) > 0.0:
        return math.inf
    from scipy.optimize import brentq  # only where oil warms

    return float(brentq(missing, low, HOTTEST, xtol=1e-9))
