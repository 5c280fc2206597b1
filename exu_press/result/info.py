"""How a run ended, what it took and with what: a result's metadata, in memory and in its file."""

from typing import NotRequired, TypedDict

__all__ = ["Info", "Stress"]


class Stress(TypedDict):
    """A flexible body's largest von Mises stress when its elastic energy is largest.

    Attributes:
        von_mises: Pa.
        time: s.
    """

    von_mises: float
    time: float


class Info(TypedDict):
    """Status, reason, statistics and versions, as they stand in the summary.

    This is all that a result's file may say of its run; it is read as it is written.

    Attributes:
        status: value of an `exu_press.integrate.Status`.
        reason: when, where, why it stopped, and what to try; empty when completed.
        end_time: the time reached, s.
        wall_time: the integration alone, s.
        total_time: with building the model and recording, s.
        steps: accepted ones.
        rejected_steps: repeated with a smaller size.
        newton_iterations: of all steps.
        law_evaluations: how often the clearance joints' forces were asked for.
        stress: of the flexible bodies with modes, by name.
        coordinates: of the model.
        bodies: of the model.
        connectors: of the model.
        own_items: number of objects and loads that the user added to the model.
        versions: of Python and packages, by name.
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
    coordinates: int
    bodies: int
    connectors: int
    own_items: int
    versions: dict[str, str]
