"""Every tuned number of the integration, with its meaning, its source and its default.

`solve_dynamic(..., tuning=Tuning(safety=0.8))` varies one; `scripts/ablation.py` prints what each
of them buys in error and run time.
"""

from dataclasses import dataclass

__all__ = ["Tuning"]


@dataclass(frozen=True)
class Tuning:
    """The numbers of step control, error estimate, predictor and step change.

    All are ratios, unless a unit is named.

    Attributes:
        safety: error at which a step is aimed, of what it may be. The reserve saves repeated steps.
        factor_max: by what a step is lengthened at most. Steps that grow by half swing about what
            their errors ask for, and are a third more with a film.
        factor_min: by what a step that failed is shortened at most.
        look_ahead: how far ahead of the start constraints are asked, over the largest step
            (`exu_press.integrate.start`).
        first_step: first step over the largest one.
        first_step_of_film: the same with a film, which takes up its load within a microsecond or
            so: a longer step leaves an overshoot of 3 % in the first loads.
        many_steps: times tolerance^(-1/2), the number of steps of a run from which on their errors
            are taken to add up as errors of either sign do (`exu_press.integrate.local_error`).
        halvings: how far a fixed step may be halved where Newton's method fails, as a power of 2.
        velocity_constant: of generalized-alpha's local error h^3 times the second derivative of the
            acceleration: 0.083 to 0.077 for spectral radii at infinity of 1 to 0.8, doubled.
        rounding: of positions and speeds, over the largest one, in each step: times 1 / (1 -
            spectral radius)^2, over the step's square, it is what alternates in accelerations.
            Measured at radii of 0.8 and 0.9 and steps of 2 and 10 us on a governor of rods and
            springs.
        penetration: what a penetration may be off by, over itself, as a part of what an
            eccentricity in free flight may be off by over the clearance. The impact that ends a
            damped contact hands the error on a thousandfold.
        least_penetration: over the clearance, up to which a penetration counts as this.
        kept_steps: within so many of the longest steps, 45 degrees of the crank, errors that a film
            keeps may add up to the tolerance.
        patience: Newton iterations after which rounding is thought of; most steps take one or two.
        reach: over the last step, how far ahead its rate of change is believed by the predictor; 0
            predicts the accelerations of the last step.
        balance: of the tolerance, to which part of the usual forces Newton's method balances them.
        jacobian_steps: of one size, which one Jacobian of flexible bodies serves at most.
        kept_balance: to which part of what is usual a kept Jacobian is to balance the forces.
        constraint_iterations: to velocities and positions that fit the constraints; each leaves
            some hundredths.
        refit: a step shorter than this, over the one that constrained velocities fit, makes them
            fit anew.
        largest_jump: of an inertia force within one step, over the run's largest one, from where
            the impacts are not resolved (`exu_press.integrate.ending`).
    """

    safety: float = 0.4
    factor_max: float = 1.2
    factor_min: float = 0.05
    look_ahead: float = 0.01
    first_step: float = 1.0 / 64.0
    first_step_of_film: float = 1e-4
    many_steps: float = 10.0
    halvings: int = 10

    velocity_constant: float = 2.0 / 12.0
    rounding: float = 4e-15
    penetration: float = 0.0625
    least_penetration: float = 1e-3
    kept_steps: float = 30.0

    patience: int = 4
    reach: float = 2.0
    balance: float = 0.2
    jacobian_steps: int = 10
    kept_balance: float = 0.3

    constraint_iterations: int = 3
    refit: float = 0.35

    largest_jump: float = 0.65
