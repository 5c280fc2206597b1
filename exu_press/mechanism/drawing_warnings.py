"""Warnings about drawings that are allowed but hardly meant, as with lengths in another unit."""

import math
from collections.abc import Iterator

from exu_press.mechanism.mechanism import Mechanism

__all__ = ["drawing_warnings"]

LARGEST = 30.0
"""m, of a mechanism."""

FAR = 3.0
"""Sizes of the mechanism, from a body's joints to its centre of mass."""

SHORT = 0.02
"""Stroke over the crank's circle: a shorter one is hardly meant."""


LIGHT = 1e-3
"""Mass over that of the heaviest body: with clearance a lighter one needs steps that are shorter by
thirty, the root of it, than the motion of the others asks for."""


def drawing_warnings(mechanism: Mechanism, stroke: float) -> Iterator[str]:
    """Yield warnings about a drawing of another size than machines, or than the rest of it.

    The stroke of its output, m, is infinite where the crank does not turn.
    """
    size = mechanism.size
    if size > LARGEST:
        yield (
            f"the mechanism {mechanism.name} is {size:.3g} m large. Lengths are in m: is the "
            "drawing in mm? Then divide its lengths by 1000."
        )
    for body in mechanism.bodies:
        joints = [joint.at for joint in mechanism.joints_of(body.name)]
        distance = min((math.dist(body.centre_of_mass, at) for at in joints), default=0.0)
        if distance > FAR * size:
            yield (
                f"bodies.{body.name}.centre_of_mass lies {distance:.3g} m from the next "
                f"joint of the body, in a mechanism of {size:.3g} m: is it in the coordinates of "
                "the drawing?"
            )
    heaviest = max(mechanism.bodies, key=lambda body: body.mass)
    for body in mechanism.bodies:
        if body.mass < LIGHT * heaviest.mass:
            yield (
                f"bodies.{body.name}.mass = {body.mass:g} kg is "
                f"{body.mass / heaviest.mass:.2g} times that of {heaviest.name}, too small for "
                f"steps that its neighbours take. A mass of {LIGHT * heaviest.mass:.2g} kg is as "
                "good as none for them."
            )
    if mechanism.guides and stroke < SHORT * 2.0 * mechanism.crank_radius:
        yield (
            f"the output moves {1e3 * stroke:.3g} mm only, while the crank's circle is "
            f"{2e3 * mechanism.crank_radius:.3g} mm wide. `exu-press draw` shows the drawing: is "
            "a link too short?"
        )
