"""A four-bar with clearance in three joints, against Siconos' set-valued contact.

Lengths, masses and radii are those of its example: rods of 1 kg, pins of 55 mm in bores of 60 mm,
plastic impacts, friction 0.1. Its crank follows a controlled torque; ours follows its crank.
"""

import math

import numpy as np
import pytest
from data import columns_of
from exudyn.itemInterface import MarkerNodeCoordinate, NodePointGround, ObjectConnectorCoordinate
from planar_mechanism import PlanarMechanism
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import fsolve

from exu_press import add_dry_revolute
from exu_press.laws.contact import hertz, hu_guo
from exu_press.laws.friction import coulomb

TABLE = columns_of("siconos_four_bar.csv")
FRAME, CRANK, COUPLER, ROCKER = 3.0, 1.0, 4.0, 2.5  # m
RADIUS, CLEARANCE, FRICTION, STIFFNESS = 0.055, 0.005, 0.1, 1e8  # m, m, -, N/m^1.5
PLASTIC = 0.1  # key of Hu and Guo's law, of which 0.07 is delivered; theirs is 0
INTERVAL = 0.05  # s between their rows


def ideal_angles():
    """Return the angles of coupler and rocker without clearance, (2, n), rad."""

    def gaps(angles, crank):
        coupler, rocker = angles
        arms = CRANK * np.exp(1j * crank) + COUPLER * np.exp(1j * coupler)
        gap = arms - FRAME - ROCKER * np.exp(1j * rocker)
        return gap.real, gap.imag

    starts = zip(TABLE["crank"], TABLE["coupler"], TABLE["rocker"], strict=True)
    return np.array([fsolve(gaps, (b, c), args=(a,), xtol=1e-12) for a, b, c in starts]).T


def angles(tolerance):
    """Return the angles of coupler and rocker, (2, n), rad."""
    crank_motion = CubicHermiteSpline(TABLE["t"], TABLE["crank"], TABLE["crank_speed"])
    crank_angle, coupler_angle, rocker_angle = (
        float(TABLE[name][0]) for name in ("crank", "coupler", "rocker")
    )
    mechanism = PlanarMechanism()
    middle = 0.5 * CRANK * math.cos(crank_angle), 0.5 * CRANK * math.sin(crank_angle)
    crank = mechanism.add_body(1.0, CRANK**2 / 12.0, (*middle, crank_angle))
    middle = float(TABLE["coupler_x"][0]), float(TABLE["coupler_y"][0])
    coupler = mechanism.add_body(1.0, COUPLER**2 / 12.0, (*middle, coupler_angle))
    middle = FRAME + float(TABLE["rocker_x"][0]), float(TABLE["rocker_y"][0])
    rocker = mechanism.add_body(1.0, ROCKER**2 / 12.0, (*middle, rocker_angle))
    mechanism.add_pin((mechanism.ground, 0.0), (crank, -0.5 * CRANK))
    mbs = mechanism.mbs
    still = mbs.AddNode(NodePointGround())
    mbs.AddObject(
        ObjectConnectorCoordinate(
            markerNumbers=[
                mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=still, coordinate=0)),
                mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=mechanism.nodes[0], coordinate=2)),
            ],
            offsetUserFunction=lambda mbs, t, item, o: float(crank_motion(t)) - crank_angle,
            offsetUserFunction_t=lambda mbs, t, item, o: float(crank_motion(t, 1)),
        )
    )
    for journal, bearing in (
        ((crank, (0.5 * CRANK, 0.0)), (coupler, (-0.5 * COUPLER, 0.0))),
        ((coupler, (0.5 * COUPLER, 0.0)), (rocker, (0.5 * ROCKER, 0.0))),
        ((rocker, (-0.5 * ROCKER, 0.0)), (mechanism.ground, (FRAME, 0.0))),
    ):
        add_dry_revolute(
            mbs,
            journal,
            bearing,
            radius=RADIUS,
            clearance=CLEARANCE,
            contact=hu_guo(hertz(STIFFNESS), PLASTIC),
            friction=coulomb(FRICTION, 1e-3),
        )
    _, poses, _ = mechanism.run(tolerance, float(TABLE["t"][-1]), INTERVAL)
    return poses[1:, :, 2] + np.array([[coupler_angle], [rocker_angle]])


@pytest.mark.validation(
    "code",
    "four-bar of 4 m with a clearance of 5 mm in three joints, 1 s",
    "Siconos (siconos/siconos-tutorials b6c9bfd1, examples/mechanics/FourBarLinkageWith3clearance)",
    "Apache-2.0",
    "What clearance adds to the angles of the ideal four-bar, over the most that it adds. Their "
    "crank is known at 21 instants, between which ours follows a spline; their impacts are "
    "plastic, ours deliver a restitution of 0.07.",
)
@pytest.mark.long
def test_shift_by_clearance(compare):
    ideal, ours, coarse = ideal_angles(), angles(3e-4), angles(1e-3)
    for i, name in enumerate(("coupler", "rocker")):
        theirs = TABLE[name] - ideal[i]
        shift, error = ours[i] - ideal[i], np.abs(ours[i] - coarse[i])
        compare(
            f"angle of the {name} less the ideal",
            theirs,
            shift,
            error=error,
            rel=0.12,
            scale=np.abs(theirs).max(),
            unit="mrad",
            show=1e3,
        )
