"""Every tuned number of the integration, with its meaning, its source and its default.

`solve_dynamic(..., tuning=Tuning(safety=0.8))` varies one; `scripts/ablation.py` prints what each
of them buys in error and run time.
"""

from dataclasses import dataclass

__all__ = ["Tuning"]


@dataclass(frozen=True)
class Tuning:
    """The numbers of step control, error estimate, predictor, step change and touches.

    All are ratios, unless a unit is named.

    Attributes:
        safety: error at which a step is aimed, of what it may be. The reserve saves repeated steps,
            as a swinging part's error rises and falls several times in each of its periods.
        factor_max: by what a step is lengthened at most. Steps that grow by half swing about what
            their errors ask for, and are a third more with a film.
        factor_min: by what a step that failed is shortened at most.
        foreseen_min: by what a step is shortened at most before it fails, where the error of the
            joints rises so that the next one would. Errors of bodies rise and fall too fast to be
            foreseen, and a change of step leaves an error behind, which shortening would chase.
        rise: by what the joints' error is expected to rise at most from one step to the next.
        look_ahead: how far ahead of the start constraints are asked, over the largest step
            (`exu_press.integrate.start`).
        first_step: first step over the largest one.
        first_step_of_film: first step with a film, s. Journals start centred and without load, and
            a film takes up its load within about a microsecond: a longer step would make it ring, a
            shorter one is lost in rounding.
        many_steps: times tolerance^(-1/2), the number of steps of a run from which on their errors
            are taken to add up as errors of either sign do (`exu_press.integrate.share`).
        halvings: how far a fixed step may be halved where Newton's method fails, as a power of 2.
        velocity_constant: of generalized-alpha's local error h^3 times the second derivative of the
            acceleration: 0.083 to 0.077 for spectral radii at infinity of 1 to 0.8, doubled.
        rounding: of positions, over the largest one, in each step: times 1 / (1 - spectral
            radius)^2, over the step's square, it is what alternates in accelerations. Measured at
            radii of 0.8 and 0.9 and steps of 2 and 10 us on a governor of rods and springs.
        finer_for_peaks: how much shorter than velocities need it a step may become for the peaks of
            accelerations.
        loosest_peak: what a peak may be off by, over itself, where the tolerance is looser. Few
            instants are near one, so that this costs little.
        near_peak: of a body's largest acceleration so far, from where its peak may lie between two
            instants.
        penetration: what a penetration may be off by, over itself, as a part of what an
            eccentricity in free flight may be off by over the clearance. A contact damps by its
            penetration, often for ten milliseconds, and the impact that ends it hands the error on
            a thousandfold: against the clearance alone the next peaks of dry presses are 20 % off
            at a tolerance of 1e-3; with 0.3 they are 2 % off, with 0.1 one per cent.
        least_penetration: over the clearance, up to which a penetration counts as this.
        newton_rounding: of positions, over the largest one: what Newton's method leaves of them in
            constraints, anew in every step (some 1e-11 m in the press with dry pivots). No
            eccentricity is resolved better.
        kept_steps: within so many of the longest steps, a radian of the crank, errors that a film
            keeps may add up to the tolerance.
        patience: Newton iterations after which rounding is thought of; most steps take one or two.
        reach: over the last step, how far ahead its rate of change is believed by the predictor; 0
            predicts the accelerations of the last step.
        shortest_prediction: steps, s, below this start from zero accelerations: there one iteration
            would leave newtons of rounding in the constraints.
        digits: of a speed, what rounding makes of it on its way through an iteration.
        balance: of the tolerance, to which part of the usual forces Newton's method balances them.
        constraint_iterations: to velocities and positions that fit the constraints; each leaves
            some hundredths.
        same_step: steps that differ by less, relative, are one size.
        refit: a step shorter than this, over the one that constrained velocities fit, makes them
            fit anew.
        touch_depth: penetration over clearance at which a contact's first step ends; 1e-3 to 5e-3
            do as well. 0 foresees no touch.
        touch_reserve: of this penetration, how far before the touch the step before ends: a force
            at the end of a long step, however small, acts on all of it.
        touch_begun: of this penetration, what is a touch already; no prediction misses it by half.
        shortest_touch: no step is made shorter for a touch, s: the last digits of positions, over
            its square, are accelerations of a metre a second squared there.
        touch_from_afar: of a contact's first step, how far off a touch is approached in two steps:
            what the last one leaves of velocities is what the impact begins with.
        largest_jump: of an inertia force within one step, over the run's largest one, from where
            the impacts are not resolved (`exu_press.integrate.resolution`).
    """

    safety: float = 0.4
    factor_max: float = 1.2
    factor_min: float = 0.05
    foreseen_min: float = 0.7
    rise: float = 3.0
    look_ahead: float = 0.01
    first_step: float = 1.0 / 64.0
    first_step_of_film: float = 1e-7
    many_steps: float = 10.0
    halvings: int = 10

    velocity_constant: float = 2.0 / 12.0
    rounding: float = 4e-15
    finer_for_peaks: float = 4.5
    loosest_peak: float = 1e-2
    near_peak: float = 0.65
    penetration: float = 0.1
    least_penetration: float = 1e-3
    newton_rounding: float = 1.5e-11
    kept_steps: float = 40.0

    patience: int = 4
    reach: float = 2.0
    shortest_prediction: float = 2e-6
    digits: float = 4e-15
    balance: float = 0.2

    constraint_iterations: int = 3
    same_step: float = 1e-6
    refit: float = 0.35

    touch_depth: float = 2.5e-3
    touch_reserve: float = 0.05
    touch_begun: float = 0.1
    shortest_touch: float = 1e-7
    touch_from_afar: float = 60.0

    largest_jump: float = 0.65
