"""Metadata of a result, its end, cost and versions, in memory and in its file."""

from typing import NotRequired, TypedDict

from exu_press.model.state import State
from exu_press.scene.provenance import Provenance

__all__ = ["Error", "Errors", "Figures", "Info", "Solid", "Stress"]


class Stress(TypedDict):
    """A flexible body's largest von Mises stress of the run.

    Attributes:
        von_mises: Pa.
        time: s.
        place: (3,) in the body's frame, m.
    """

    von_mises: float
    time: float
    place: list[float]


class Solid(TypedDict):
    """Mass properties of a flexible body's solid, which replace the mechanism's.

    Attributes:
        mass: kg.
        centre_of_mass: from where the mechanism has it, in the body's frame, (2,), m.
        inertia: about it, kg m^2.
        modes: number of modal coordinates.
        frequencies: natural ones with all interfaces held in their mean motion, Hz.
    """

    mass: float
    centre_of_mass: list[float]
    inertia: float
    modes: int
    frequencies: NotRequired[list[float]]


class Error(TypedDict):
    """The error of a figure.

    Attributes:
        error: absolute, in the figure's unit.
        determined: whether the scene determines the figure; if not, runs that differ by nothing
            that is known of the scene lie between `low` and `high`.
        low: least value that it may have.
        high: largest value that it may have.
    """

    error: float
    determined: bool
    low: float
    high: float


class Figures(TypedDict):
    """Values that were read before the file left channels out.

    Attributes:
        quantities: full name -> value in SI, None where the run was too short to have it.
        strokes: bottom dead centre of every stroke.
        read_from: from which to which revolution.
        warnings: of the summary.
    """

    quantities: dict[str, float | None]
    strokes: list[dict[str, float]]
    read_from: dict[str, float]
    warnings: list[str]


class Errors(TypedDict):
    """The errors of a run's figures.

    Attributes:
        errors: by the figure's dotted name.
        horizon: instant after which the motion amplifies errors beyond the figures, s.
        lyapunov_exponent: of a difference of motions, 1/s.
    """

    errors: dict[str, Error]
    horizon: float | None
    lyapunov_exponent: float | None


class Info(TypedDict):
    """SolverStatus, reason, statistics and versions, as they stand in the summary.

    This is all that a result's file may say of its run; it is read as it is written.

    Attributes:
        status: value of an `exu_press.integrate.SolverStatus`.
        reason: when, where and why it stopped, and the cure; empty when completed.
        end_time: the time reached, s.
        wall_time: the integration alone, s.
        total_time: with building the model and recording, s.
        steps: accepted ones.
        rejected_steps: repeated with a smaller size.
        newton_iterations: of all steps.
        law_evaluations: how often the clearance joints' forces were asked for.
        stress: of the flexible bodies with modes, by name.
        solids: of the flexible bodies, by name.
        added_revolutions: how many more than asked for were run until films had settled.
        coordinates: of the model.
        bodies: of the model.
        connectors: of the model.
        own_items: number of objects and loads that the user added to the model.
        versions: of Python and packages, by name.
        provenance: of the run.
        state: at the end, from which another run can go on.
        figures: in files that do not keep all channels at all steps.
        errors: as in `Errors`, in runs that were asked for them.
        horizon: the same.
        lyapunov_exponent: the same.
    """

    status: str
    reason: str
    end_time: float
    wall_time: float
    total_time: NotRequired[float]
    steps: int
    rejected_steps: int
    newton_iterations: int
    law_evaluations: int
    stress: NotRequired[dict[str, Stress]]
    solids: NotRequired[dict[str, Solid]]
    added_revolutions: NotRequired[int]
    coordinates: int
    bodies: int
    connectors: int
    own_items: int
    versions: dict[str, str]
    provenance: NotRequired[Provenance]
    state: NotRequired[State]
    figures: NotRequired[Figures]
    errors: NotRequired[dict[str, Error]]
    horizon: NotRequired[float | None]
    lyapunov_exponent: NotRequired[float | None]
