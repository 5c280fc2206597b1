"""A press that starts and stops, and a slider-crank's closed form for models of such presses."""

import math

from exu_press import Scene

SCHEDULE = {
    "rated_torque": 400.0,
    "inertia": 300.0,
    "begins": "standing",
    "clutch_torque": 3000.0,
    "clutch_on": [0.03, 0.06],
    "clutch_off": [0.0, 0.02],
    "brake_torque": 1500.0,
    "brake_on": [0.02, 0.05],
    "brake_off": [0.0, 0.02],
    "start_time": [0.02],
    "stop_time": [0.2],
}
LIGHT = {"rod_mass": 1e-6, "slider_mass": 1e-6, "rod_inertia": 1e-8}
"""Rod and slider of a slider-crank whose crank is a free rotor."""


def keys(**given):
    """Return the keys that are not None."""
    return {name: value for name, value in given.items() if value is not None}


def scheduled(revolutions=0.4, **changes):
    """Return an eccentric press with other keys of [drive]."""
    return Scene(
        mechanism="eccentric_press",
        speed_rpm=60.0,
        joints={},
        revolutions=revolutions,
        drive=keys(**{**SCHEDULE, **changes}),
    )


class OneCoordinate:
    """A slider-crank with ideal joints over its crank angle, from the top."""

    def __init__(self, scene, on_crank):
        """Take a scene, and the inertia that turns with the crank, kg m^2."""
        self.size, self.gravity, self.on_crank = scene.slider_crank, scene.gravity, on_crank

    def terms(self, a):
        """Return J and V of the kinetic energy J a_t^2 / 2 and the potential one."""
        size = self.size
        r, rod, m, big_m = size.crank_radius, size.rod_length, size.rod_mass, size.slider_mass
        sine = r * math.sin(a) / rod
        cosine = math.sqrt(1 - sine**2)
        swing = r * math.cos(a) / (rod * cosine)  # of the rod, over the crank's
        down = -r * math.sin(a) + rod * sine * swing  # of the slider
        middle = -r * math.cos(a) / 2, (down - r * math.sin(a)) / 2
        inertia = size.crank_inertia + self.on_crank + size.rod_inertia * swing**2
        inertia += m * (middle[0] ** 2 + middle[1] ** 2) + big_m * down**2
        height = r * math.cos(a) - rod * cosine
        return inertia, self.gravity * (big_m * height + m * (r * math.cos(a) + height) / 2)

    def crank(self, a, speed):
        """Return J, and the torque that weights and the motion itself have on the crank."""
        step = 1e-5
        (j_2, v_2), (j_1, v_1), (j, _) = self.terms(a + step), self.terms(a - step), self.terms(a)
        return j, -(v_2 - v_1) / (2 * step) - 0.5 * (j_2 - j_1) / (2 * step) * speed**2


def kloss(motor, speed, free, ratio=2.5):
    """Return the torque of an induction motor whose breakdown torque is `ratio` rated ones."""
    breakdown = motor.slip * (ratio + math.sqrt(ratio**2 - 1.0))
    slip = 1.0 - speed / free
    return 2.0 * ratio * motor.rated_torque * slip * breakdown / (slip**2 + breakdown**2)
