"""Restitution of a contact law over one bounce, exactly or by integration."""

from math import expm1, log1p

from exu_press.laws.contact.damping import NormalContact
from exu_press.laws.parameters import not_negative, positive

__all__ = ["delivered_restitution", "restitution_of"]


def restitution_of(chi: float) -> float:
    r"""Restitution that a hysteretic damping delivers, for any elastic part and any mass.

    .. math::
        \ln\frac{1 + \chi}{1 - \chi e} = \chi (1 + e)

    This follows from integrating m v dv / (1 + chi v / v_0) = -f d delta from touch to release.
    With w = chi e it reads ln(1 - w) + w = ln(1 + chi) - chi. The left side is concave in w, so
    Newton's method falls to the root from above.

    Parameters
    ----------
    chi : of F = f(delta) (1 + chi rate / v_0) [-], not negative

    Returns
    -------
    e, rebound speed over approach speed [-].

    Raises
    ------
    InputError : chi is negative

    Notes
    -----
    Range: impacts not slower than the law's `slowest_impact`, and no pulling forces (A-10).

    Examples
    --------
    >>> round(restitution_of(1.5), 4)
    0.4877

    References
    ----------
    .. [1] Gonthier, Y., J. McPhee, C. Lange, and J.-C. Piedboeuf. "A Regularized Contact Model with
       Asymmetric Damping and Dwell-Time Dependent Friction." Multibody Syst. Dyn. 11 (2004):
       209-233.
    """
    not_negative(chi=chi)
    if chi < 1e-4:  # where the logarithms cancel; the next term is of order chi^3
        return 1.0 - chi * (2.0 / 3.0 - chi * 4.0 / 9.0)
    level = log1p(chi) - chi
    w = min(chi, -expm1(level - 1.0))
    while w < 1.0:
        lower = w + (log1p(-w) + w - level) * (1.0 - w) / w
        if lower >= w * (1.0 - 1e-15):
            break
        w = lower
    return w / chi


def delivered_restitution(contact: NormalContact, mass: float, speed: float) -> float:
    r"""Restitution of one bounce of a free mass, by integration with SciPy.

    .. math::
        m \ddot\delta = -F_N(\delta, \dot\delta), \qquad \delta(0) = 0, \quad \dot\delta(0) = v_0

    Parameters
    ----------
    contact : the normal force
    mass : of the free body [kg], positive
    speed : at which it arrives [m/s], positive

    Returns
    -------
    Rebound speed over approach speed [-].

    Raises
    ------
    InputError : mass or speed is not positive
    RuntimeError : the contact is not released

    Notes
    -----
    Range: any contact. It takes some milliseconds: a diagnostic, not for the time loop.

    Examples
    --------
    >>> from exu_press.laws.contact import hertz, step_damping
    >>> contact = step_damping(hertz(1e8), damping_max=1e3, damping_depth=1e-4)
    >>> round(delivered_restitution(contact, mass=1.0, speed=0.1), 5)
    0.51842
    """
    from scipy.integrate import solve_ivp  # type: ignore[import-untyped, unused-ignore]

    positive(mass=mass, speed=speed)
    depth = _elastic_depth(contact, 0.5 * mass * speed**2)
    inertia = mass * speed**2 / depth

    # In units of the undamped depth and the approach speed, so that one tolerance fits every press.
    def motion(_time: float, state: tuple[float, float]) -> tuple[float, float]:
        force, _, _ = contact.force(state[0] * depth, state[1] * speed, speed)
        return state[1], -force / inertia

    def jacobian(_time: float, state: tuple[float, float]) -> list[list[float]]:
        _, stiffness, damping = contact.force(state[0] * depth, state[1] * speed, speed)
        return [[0.0, 1.0], [-stiffness * depth / inertia, -damping * speed / inertia]]

    def separation(_time: float, state: tuple[float, float]) -> float:
        return state[0]

    separation.terminal = True  # type: ignore[attr-defined]
    separation.direction = -1.0  # type: ignore[attr-defined]
    bounce = solve_ivp(
        motion,
        (0.0, 1e9),
        (0.0, 1.0),
        "LSODA",
        events=separation,
        jac=jacobian,
        rtol=1e-9,
        atol=1e-12,
    )
    if bounce.status != 1:
        raise RuntimeError(
            f"the contact was not released within 1e9 impact times: {bounce.message}"
        )
    return -float(bounce.y[1, -1])


def _elastic_depth(contact: NormalContact, energy: float) -> float:
    """Penetration at which the elastic part alone stores `energy`, to a few percent: a scale."""
    depth = 1.0
    while contact.elastic_energy(depth) > energy:
        depth /= 1.1
    while contact.elastic_energy(depth) < energy:
        depth *= 1.1
    return depth
