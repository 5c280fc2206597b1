"""The state at the end of a run: all that its continuation by another run needs."""

from typing import Any, NotRequired, TypedDict

__all__ = ["State"]


class State(TypedDict):
    """Everything that determines a run's future, as numbers in lists.

    Attributes:
        time: s.
        step: last step, s, the first one of the next run.
        coordinates: of Exudyn's system: second-order ones and their rates, first-order ones,
            constraint forces, data variables; without reference values.
        accelerations: of the second-order coordinates.
        reference: values of the second-order coordinates; they depend on the start angle and, of
            flexible bodies, on the speed.
        joints: memory of clearance joints and guideways: bristles, approach speeds, paths.
        clocks: memory of pulses and sheets of loads.
        films: temperature, deg C, and pressure, Pa, of films whose oil warms.
        start_stop: memory of clutch, brake and their schedule; of a drive with a clutch.
    """

    time: float
    step: float
    coordinates: list[list[float]]
    accelerations: list[float]
    reference: list[float]
    joints: dict[str, Any] | None
    clocks: list[tuple[float, float | None]]
    films: NotRequired[dict[str, tuple[float, float]]]
    start_stop: NotRequired[list[float]]
