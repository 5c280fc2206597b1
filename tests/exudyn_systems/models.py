"""Small systems of Exudyn's items, with settings."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import stand_in_system
from stand_in_system import planar_body

exu.config.suppressWarnings = True


def settings(end, steps, *, period=0.01):
    """Return settings of a run that writes no file."""
    return stand_in_system.settings(end, steps, period)


def rotor():
    """Return an unbalanced disc on springs that turns at half its critical speed.

    Its angle grows to 1250 rad while its centre moves by millimetres.
    """
    mbs = exu.SystemContainer().AddSystem()
    eccentricity, mass, stiffness = 1e-2, 1.6, 4000.0
    critical = np.sqrt(stiffness / mass)
    spin = [0.0, 0.0, 0.5 * critical]
    disc, node = planar_body(mbs, mass, 0.4, [0.0, eccentricity, 0.0], spin)
    ground = mbs.AddObject(items.ObjectGround())
    markers = [
        mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=ground)),
        mbs.AddMarker(
            items.MarkerBodyPosition(bodyNumber=disc, localPosition=[0, -eccentricity, 0])
        ),
    ]
    mbs.AddObject(
        items.ObjectConnectorCartesianSpringDamper(
            markerNumbers=markers, stiffness=[stiffness] * 2 + [0.0], damping=[0.8] * 2 + [0.0]
        )
    )
    mbs.Assemble()
    return mbs, node


def double_pendulum(velocity=0.0):
    """Return two bars that start upside down, a chaotic motion."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    before, at = ground, [0.0, 0.0, 0.0]
    for number in range(2):
        pose = [0.05, 0.5 + number, 0.5 * np.pi + 0.1 * number]
        body, _ = planar_body(mbs, 1.0, 1.0 / 12.0, pose, [0.0, 0.0, velocity])
        mass = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=body))
        mbs.AddLoad(items.LoadMassProportional(markerNumber=mass, loadVector=[0.0, -9.81, 0.0]))
        markers = [
            mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=one, localPosition=place))
            for one, place in ((before, at), (body, [-0.5, 0.0, 0.0]))
        ]
        mbs.AddObject(
            items.ObjectConnectorCartesianSpringDamper(
                markerNumbers=markers, stiffness=[1e4] * 2 + [0.0], damping=[1.0] * 2 + [0.0]
            )
        )
        before, at = body, [0.5, 0.0, 0.0]
    mbs.Assemble()
    return mbs
