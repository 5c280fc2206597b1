"""The field's standard test: crank on top, slider hanging below, clearance in the crank pin."""

from exu_press.mechanism.description import GROUND, Body, Joint, Mechanism
from exu_press.mechanism.guides import free_to_tilt, guide_of
from exu_press.mechanism.kinematics import Array, Motion, guided, rod, rotating, sliding, turning
from exu_press.scene.tables import ElasticGuide, SliderCrank

__all__ = ["slider_crank"]


def slider_crank(size: SliderCrank, elastic: ElasticGuide | None = None) -> Mechanism:
    """Return the slider-crank; the rod carries the bearing of the crank pin."""
    radius, half = size.crank_radius, size.rod_length / 2
    slider = free_to_tilt(Body("slider", size.slider_mass, 1.0), elastic)  # an ideal guide holds it

    def motion(angle: Array, speed: float) -> dict[str, Motion]:
        pin = rotating(angle, speed, radius)
        wrist = guided("slider_crank.rod_length", pin, size.rod_length, 0.0, -1)
        return {
            "crank": turning(angle, speed, 0.0),
            "rod": rod(pin, wrist),
            "slider": sliding(wrist),
        }

    return Mechanism(
        bodies=(
            Body("crank", 1.0, 1.0),  # driven at constant speed about its centre of mass
            Body("rod", size.rod_mass, size.rod_inertia),
            slider,
        ),
        joints=(
            Joint("shaft", "crank", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Joint("crank_pin", "crank", (0.0, radius), "rod", (-half, 0.0)),
            Joint("wrist_pin", "slider", (0.0, 0.0), "rod", (half, 0.0)),
        ),
        guides=(guide_of(slider, elastic),),
        crank="crank",
        slider="slider",
        slider_origin=0.0,
        motion=motion,
    )
